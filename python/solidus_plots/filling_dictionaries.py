"""What icoReactingMultiphaseInterFoam of OpenFOAM 1912 reads besides the mesh: fields, materials and numerics.

The model and the choices that are made here are described in docs/theory/filling.md.
"""

from dataclasses import dataclass

import numpy as np

from solidus_plots.filling_mesh import HEADER

GAS = {"density": 1.0, "heat": 1000.0, "viscosity": 2e-5, "prandtl": 0.7}  # warm air; it has hardly any heat
MOLAR_WEIGHT = 50  # of no consequence for what does not react
AIR_PRESSURE = 1e5  # [Pa] at vents
DRAG = 1e6  # C of Voller and Prakash's drag [kg/(m3 s)]: metal that is half frozen comes to rest within a millisecond
COMPRESSION = 1.0  # of interfaces
SHUT_SHARE = 0.02  # of gas in a cube below which its vent is shut
PHASES = ("gas", "melt", "solid")
DIMENSIONS = {"T": "[0 0 0 1 0 0 0]", "U": "[0 1 -1 0 0 0 0]", "p_rgh": "[1 -1 -2 0 0 0 0]"}


def gas_conductivity():
    return GAS["viscosity"] * GAS["heat"] / GAS["prandtl"]


@dataclass
class Melt:
    """Constants of the metal for the flow, in SI: filling takes place within some ten kelvin."""

    density: float
    heat: float  # specific, between freezing and pouring
    latent: float  # per mass
    freezing: float  # temperature at which it freezes
    conductivity: float
    solid_conductivity: float
    viscosity: float
    tension: float


@dataclass
class Flow:
    gravity: tuple  # [m/s2]
    velocity: tuple  # in the gate
    pouring: float  # temperature [K]
    air: float  # temperature of the air, at the start and through vents [K]
    rate: float  # of the change of phase, coefficient of the Lee model [1/s]
    step: float  # the longest [s]
    courant: float = 0.35


def dictionary(folder, name, text, kind="dictionary"):
    path = folder / name
    path.parent.mkdir(parents=True, exist_ok=True)
    path.write_text(HEADER.format(kind=kind, location=path.parent.name, name=path.name) + text)


def of_values(values):
    """A field for a dictionary: one number, or one for each cell or face."""
    if np.ndim(values) == 0:
        return f"uniform {float(values):.9g}"
    return f"nonuniform List<scalar>\n{len(values)}\n(\n" + "\n".join(f"{value:.9g}" for value in values) + "\n)"


def field(folder, name, internal, patches, kind="volScalarField"):
    """Writes a field. internal: as text; patches: {name: entries as text}."""
    names = {patch: patch if patch.isidentifier() else f'"{patch}"' for patch in patches}  # those in quotes are patterns
    entries = "".join(f"    {names[patch]}\n    {{\n        {text}\n    }}\n" for patch, text in patches.items())
    dictionary(folder, name, f"dimensions {DIMENSIONS.get(name.split('/')[-1], '[0 0 0 0 0 0 0]')};\n"
               f"internalField {internal};\nboundaryField\n{{\n{entries}}}\n", kind)


INSULATING = "type zeroGradient;"


def vent_speeds(air, flow, area):
    """Outward speeds of the gas through faces of vents, which together let out what comes in [m/s]; faces that are shut have none. air:
    its share in the cube of each face, by which the flow [m3/s] is divided; area: of a face [m2]."""
    gas = np.where(np.asarray(air) < SHUT_SHARE, 0, air)
    if not gas.any():
        gas[:] = 1  # no air is left at a vent
    return flow / area * gas / gas.sum()


def gate_velocity(velocity):
    """The entry of U for the gate."""
    return "type fixedValue; value uniform ({:.12g} {:.12g} {:.12g});".format(*velocity)


def vent_share(shares):
    """The entry of the share of a phase for faces of vents [face]: of gas alone on those through which it passes, of melt on those that
    are shut, which give off its heat."""
    return f"type fixedValue; value {of_values(shares)};"


def vent_velocity(velocities):
    """The entry of U for faces of vents [face][axis]."""
    rows = "\n".join(f"({u:.12g} {v:.12g} {w:.12g})" for u, v, w in velocities)
    return f"type fixedValue; value nonuniform List<vector>\n{len(velocities)}\n(\n{rows}\n);"


def wall_entry(conductance, mould, value):
    """T of a wall that takes heat by a conductance [W/(m2 K)] of each face to a mould of one temperature [K]; none: INSULATING."""
    if np.size(conductance) == 0 or not np.any(conductance):
        return INSULATING
    return (f"type externalWallHeatFluxTemperature; mode coefficient; kappaMethod lookup; kappa kappaEff; "
            f"h {of_values(conductance)}; Ta constant {mould:.9g}; value uniform {value:.9g};")


def write_fields(folder, flow, walls):
    """The fields at the start: a cavity full of air. What passes a face of a vent is gas, whatever share of the cube behind it is, as
    through sand or a slit; its speed is set for each stretch. Through the leak, a single face, nothing is left to pass; it gives the
    pressure its level. walls: {name of a patch of walls or vents: the entry of T}; \"free\" lets metal
    slip."""
    sticky, still = "wall_.*", "type fixedValue; value uniform (0 0 0);"
    field(folder, "0/U", "uniform (0 0 0)", {
        "gate": gate_velocity(flow.velocity),
        "leak": still, **{name: still for name in walls if name.startswith("vent")}, sticky: "type noSlip;", "free": "type slip;"},
        "volVectorField")
    field(folder, "0/p_rgh", f"uniform {AIR_PRESSURE:g}", {
        "(gate|free|wall_.*|vent_.*)": f"type fixedFluxPressure; value uniform {AIR_PRESSURE:g};",
        "leak": f"type fixedValue; value uniform {AIR_PRESSURE:g};"})
    vents = [name for name in walls if name.startswith("vent")]
    for phase in PHASES:
        start, gate = (1, 0) if phase == "gas" else (0, 1 if phase == "melt" else 0)
        field(folder, f"0/alpha.{phase}", f"uniform {start}", {
            "gate": f"type fixedValue; value uniform {gate};",
            **{name: f"type fixedValue; value uniform {start};" for name in ("leak", *vents)},
            "(free|wall_.*)": INSULATING})
    field(folder, "0/T", f"uniform {flow.air:.9g}", {
        "gate": f"type fixedValue; value uniform {flow.pouring:.9g};", "leak": INSULATING, **walls})


def thermophysical(folder, phase, state, transport, density, heat, formation):
    """state: \"fluid\" or \"solid\"."""
    kind = ("heRhoThermo", "const") if state == "fluid" else ("heSolidThermo", "constIso")
    dictionary(folder, f"constant/thermophysicalProperties.{phase}", f"""thermoType
{{
    type {kind[0]};
    mixture pureMixture;
    transport {kind[1]};
    thermo hConst;
    equationOfState rhoConst;
    specie specie;
    energy sensibleEnthalpy;
}}
mixture
{{
    specie {{ nMoles 1; molWeight {MOLAR_WEIGHT}; }}
    equationOfState {{ rho {density:.9g}; }}
    thermodynamics {{ Cp {heat:.9g}; Hf {formation:.9g}; }}
    transport {{ {transport} }}
}}
""")


def write_materials(folder, melt, flow):
    """Three phases, and the change between melt and solid: the solid has the larger enthalpy of formation and melt turns into it
    with a negative coefficient; with other signs frozen metal gives off no heat or takes it up."""
    gas = GAS
    thermophysical(folder, "gas", "fluid", f"mu {gas['viscosity']:g}; Pr {gas['prandtl']:g};", gas["density"], gas["heat"], 0)
    thermophysical(folder, "melt", "fluid",
                   f"mu {melt.viscosity:.9g}; Pr {melt.viscosity * melt.heat / melt.conductivity:.9g};", melt.density, melt.heat, 0)
    thermophysical(folder, "solid", "solid", f"kappa {melt.solid_conductivity:.9g};", melt.density, melt.heat, melt.latent)
    # A tension is needed for every pair of phases; between melt and its own solid there is none.
    tensions = "".join(f"    ({a} and {b}) {{ type constant; sigma {sigma:.9g}; }}\n" for a, b, sigma in (
        ("gas", "melt", melt.tension), ("gas", "solid", melt.tension), ("melt", "solid", 0.0)))
    dictionary(folder, "constant/phaseProperties", f"""type massTransferMultiphaseSystem;
phases ({' '.join(PHASES)});
gas {{ type pureMovingPhaseModel; }}
melt {{ type pureMovingPhaseModel; }}
solid {{ type pureStaticSolidPhaseModel; }}
surfaceTension
(
{tensions});
interfacePorous
(
    (solid and melt) {{ type VollerPrakash; solidPhase alpha.solid; Cu {DRAG:g}; }}
);
massTransferModel
(
    (melt to solid) {{ type Lee; C {-flow.rate:.9g}; Tactivate {melt.freezing:.9g}; }}
    (solid to melt) {{ type Lee; C {flow.rate:.9g}; Tactivate {melt.freezing:.9g}; }}
);
""")
    dictionary(folder, "constant/turbulenceProperties", "simulationType laminar;\n")
    write_gravity(folder, flow.gravity)


def write_gravity(folder, gravity):
    """gravity: three numbers [m/s2]."""
    dictionary(folder, "constant/g", "dimensions [0 1 -2 0 0 0 0];\nvalue ({:.9g} {:.9g} {:.9g});\n".format(*gravity),
               "uniformDimensionedVectorField")


def write_control(folder, flow, end, interval):
    """The run from the last time on until another [s]; fields are written every interval. There are
    no function objects, nor conditions with expressions: Debian 13's build of OpenFOAM 1912 ends with an error at the first of them."""
    dictionary(folder, "system/controlDict", f"""application icoReactingMultiphaseInterFoam;
startFrom latestTime;
startTime 0;
stopAt endTime;
endTime {end:.12g};
deltaT {flow.step / 20:.9g};
writeControl adjustableRunTime;
writeInterval {interval:.12g};
purgeWrite 0;
writeFormat ascii;
writePrecision 10;
writeCompression off;
timeFormat general;
timePrecision 10;
runTimeModifiable no;
adjustTimeStep yes;
maxDeltaT {flow.step:.9g};
maxCo {flow.courant:.9g};
maxAlphaCo {flow.courant:.9g};
maxAlphaDdt {flow.courant:.9g};
maxDi 1e6;
""")


def write_numerics(folder, processes=1, axis=0):
    """Schemes, solvers, and the parts for processes: slices of as many cubes across an axis, since Debian's openfoam has no scotch."""
    pairs = " ".join(f"({a} and {b}) {c:g}" for a, b, c in (
        ("gas", "melt", COMPRESSION), ("gas", "solid", 0), ("melt", "solid", 0)))
    dictionary(folder, "system/fvSchemes", """ddtSchemes { default Euler; }
gradSchemes { default Gauss linear; }
divSchemes
{
    default none;
    div(rhoPhi,U) Gauss upwind;
    "div\\(phi,alpha.*\\)" Gauss downwind phi;
    "div\\(phir,alpha.*\\)" Gauss linear;
    div(((rho*nuEff)*dev2(T(grad(U))))) Gauss linear;
    "div\\(.*,T\\)" Gauss upwind;
}
laplacianSchemes { default Gauss linear orthogonal; }
interpolationSchemes { default linear; }
snGradSchemes { default orthogonal; }
fluxRequired { default no; p_rgh; "alpha.*"; }
""")
    dictionary(folder, "system/fvSolution", f"""solvers
{{
    "rho.*" {{ solver diagonal; tolerance 1e-5; relTol 0; }}
    "alpha.*"
    {{
        nAlphaCorr 1;
        nAlphaSubCycles 2;
        cAlphas ({pairs});
        solver smoothSolver; smoother symGaussSeidel; tolerance 1e-8; relTol 0;
    }}
    "pcorr.*|p_rgh|sPhi.*" {{ solver PCG; preconditioner DIC; tolerance 1e-7; relTol 0.01; }}
    p_rghFinal {{ $p_rgh; relTol 0; }}
    "U.*" {{ solver smoothSolver; smoother symGaussSeidel; tolerance 1e-6; relTol 0; }}
    "e.*|T.*" {{ solver PBiCGStab; preconditioner DILU; tolerance 1e-9; relTol 0; }}
}}
PIMPLE {{ momentumPredictor no; nOuterCorrectors 1; nCorrectors 3; nNonOrthogonalCorrectors 0; }}
relaxationFactors {{ equations {{ ".*" 1; }} }}
""")
    counts = " ".join(str(processes if d == axis else 1) for d in range(3))
    dictionary(folder, "system/decomposeParDict", f"numberOfSubdomains {processes};\nmethod simple;\n"
               f"simpleCoeffs {{ n ({counts}); delta 0.001; }}\n")
