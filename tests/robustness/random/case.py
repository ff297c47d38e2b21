"""A random valid case: every element, kind, scheme, contact law and phase change on a mesh of a few elements.

The seed alone makes the case. What may be combined follows the documentation; what the program refuses with a
message that names the place in the file is counted as such by check.py and should stay rare.
"""

import random
from dataclasses import dataclass, field

from growth import growth
from interface import contact
from material import material
from writing import Writer, around

PLANE = ["tri3", "tri6", "quad4", "quad8"]
SOLID = ["tet4", "tet10", "hex8", "hex20"]
SOLIDS = ["steel_mould", "h13_tool_steel", "copper_chill"]
CASTINGS = {  # liquidus [degC]
    "aluminium_99_7": 660, "aluminium_99_7_plastic": 660, "aluminium_1070": 658, "aluminium_alsi7mg": 614,
    "grey_iron": 1190, "nodular_iron": 1150, "low_carbon_steel": 1524,
}


@dataclass
class Case:
    """Text of the case and of its material files, and what the invariants need to know of it."""
    seed: int
    text: str = ""
    files: dict = field(default_factory=dict)
    processes: int = 1
    facts: dict = field(default_factory=dict)


def random_case(seed, only="", grows=False):
    """The case of a seed; only: the physics that all are to have, whatever the seed draws; grows: its body does."""
    rng = random.Random(seed)
    case = Case(seed)
    facts = case.facts
    w = Writer()
    kind = facts["kind"] = rng.choice(["plane_strain", "axisymmetric", "solid"])
    drawn = rng.choice(["heat", "mechanics"] + 6 * ["thermomechanical"])
    physics = facts["physics"] = "heat" if grows else only or drawn
    element = facts["element"] = rng.choice(SOLID if kind == "solid" else PLANE)
    dynamic = facts["dynamic"] = physics != "heat" and rng.random() < 0.08
    w.add(title=f"A random case, seed {seed}")
    gravity = rng.choice([None, "9.81 m/s2"]) if physics != "heat" else None
    w.section("[analysis]", kind=kind, physics=physics, gravity=gravity)
    shape = mesh(rng, w, facts, kind, element, ["block"] if grows else [])
    facts["shape"] = shape
    bodies = choose_bodies(rng, case, shape, physics)
    steps = time(rng, w, facts, physics, dynamic)
    for name, body in bodies.items():
        w.section("[[body]]", name=name, group=body["group"], material=body["material"],
                  initial_temperature=f"{body['temperature']} degC", physics=body.get("physics"))
    facts["temperatures"] = [body["temperature"] for body in bodies.values()]
    if physics != "mechanics":
        thermal_conditions(rng, w, facts, kind, shape)
    if physics != "heat":
        mechanical_conditions(rng, w, kind, shape, bodies)
    if shape != "block":
        contact(rng, w, facts, kind, physics, shape, bodies, dynamic)
    if grows:
        growth(rng, w, case, kind)
    numerics(rng, w, facts, physics, dynamic, grows)
    w.section("[output]", checkpoint_every=1, stage_ends=False)
    case.processes = facts["processes"] = 2 if rng.random() < 0.05 else 1
    facts["steps"] = steps
    case.text = "\n".join(w.lines) + "\n"
    return case


def mesh(rng, w, facts, kind, element, only):
    shape = rng.choice(only or ["block", "two_blocks", "two_blocks", "two_blocks"] + (["cylinder_in_mould"] * 2 if kind == "axisymmetric" else []))
    dim = 3 if kind == "solid" else 2
    few = 2 if kind == "solid" else 4
    w.section("[mesh]", shape=shape, element=element)
    length = round(around(rng, 10, 120), 1)

    def size(last):
        return [f"{length} mm"] * (dim - 1) + [f"{round(last, 2)} mm"]

    def divisions():
        return [rng.randint(1, few) for _ in range(dim)]

    if shape == "block":
        height = length * rng.uniform(0.2, 1.5)
        w.section("[mesh.block]", size=size(height), divisions=divisions())
        facts["size"] = [length] * (dim - 1) + [round(height, 2)]
    elif shape == "two_blocks":
        w.section("[mesh.two_blocks]", lower=size(length * rng.uniform(0.2, 0.8)),
                  upper=size(length * rng.uniform(0.2, 0.8)), lower_divisions=divisions(), upper_divisions=divisions())
    else:
        w.section("[mesh.cylinder_in_mould]", radius=f"{length} mm", height=f"{2 * length} mm", mould_wall=f"{length} mm", mould_bottom=f"{0.7 * length:.1f} mm",
                  mould_height=f"{2.7 * length:.1f} mm", element_size=f"{length / rng.choice([2, 3]):.2f} mm", mould_element_size=f"{length / 2:.2f} mm")
    return shape


def choose_bodies(rng, case, shape, physics):
    """One body is poured or hot, the other one cold; roles that are turned around now and then."""
    names = {"block": ["block"], "two_blocks": ["upper", "lower"], "cylinder_in_mould": ["part", "mould"]}[shape]
    bodies = {}
    for i, name in enumerate(names):
        if i == 0:
            library = rng.random() < 0.5
            what = rng.choice(list(CASTINGS))
            liquidus = CASTINGS[what] if library else rng.choice([600, 900, 1300])
            if not library:
                what = "made_up.toml"
                case.files[what] = material(rng, "made up", liquidus)
            temperature = round(rng.choice([liquidus + rng.uniform(1, 100), liquidus * rng.uniform(0.6, 0.98)]), 1)
            if physics == "mechanics":
                temperature = round(liquidus * rng.uniform(0.2, 0.9), 1)
        else:
            what = rng.choice(SOLIDS + (["green_sand"] if physics != "mechanics" else []) + ["aluminium_alsi7mg"])
            temperature = rng.choice([20.0, 200.0, 472.0])
        body = {"group": name, "material": what, "temperature": temperature, "molten": i == 0 and temperature > liquidus}
        if what == "green_sand" and physics == "thermomechanical":
            body["physics"] = "heat"
        bodies[name] = body
    return bodies


def time(rng, w, facts, physics, dynamic):
    steps = rng.randint(2, 6)
    step = around(rng, 1e-6, 1e-3) if dynamic else around(rng, 0.05, 1000)
    adaptive = physics != "mechanics" and not dynamic and rng.random() < 0.35
    facts["adaptive"], facts["end"] = adaptive, step * steps
    w.section("[time]", end=f"{step * steps:.6g} s", step=f"{step:.6g} s", adaptive=adaptive or None)
    if not adaptive:
        return steps
    control = rng.choice(["predictor", "doubling", "none"])
    w.add(error_control=control, solid_fraction_change=0.4)
    if control != "none":  # few steps: the error allowed goes with the range of temperatures
        w.add(temperature_error="20 K", displacement_error="0.1 mm" if physics == "thermomechanical" else None)
    return steps


def faces(shape, kind):
    last = "z" if kind == "solid" else "y"
    if shape == "cylinder_in_mould":
        return ["part_top", "mould_outside", "mould_bottom"]
    if shape == "block":
        return ["x_max", f"{last}_max", f"{last}_min"]
    return ["upper_x_max", f"upper_{last}_max", "lower_x_max", f"lower_{last}_min"]


def thermal_conditions(rng, w, facts, kind, shape):
    """None in a third of the cases; facts say what bounds the temperatures have."""
    facts["insulated"] = True
    facts["heated"] = False
    if rng.random() < 0.33:
        return
    surfaces = faces(shape, kind)
    rng.shuffle(surfaces)
    for i, group in enumerate(surfaces[: rng.randint(1, len(surfaces))]):
        what = rng.choice(["temperature", "flux", "film", "film", "radiation"])
        ambient = rng.choice([20.0, 100.0, 300.0])
        facts["insulated"] = False
        if what != "flux":
            facts["temperatures"].append(ambient)
        keys = {"name": f"condition_{i}", "group": group, "kind": what}
        if what == "temperature":
            keys["temperature"] = f"{ambient} degC"
        elif what == "flux":
            keys["flux"] = f"{rng.choice([-1, 1]) * min(around(rng, 1e2, 1e4), 3e5 / facts['end']):.4g} W/m2"  # some tens of kelvin
            facts["heated"] = True
        elif what == "film":
            keys |= {"coefficient": f"{around(rng, 5, 5000):.4g} W/m2/K", "ambient": f"{ambient} degC"}
        else:
            keys |= {"emissivity": round(rng.uniform(0.1, 1), 2), "ambient": f"{ambient} degC"}
        w.section("[[thermal_condition]]", **keys)


def mechanical_conditions(rng, w, kind, shape, bodies):
    """No rigid motion: a support below, planes of symmetry; then held or loaded faces."""
    last, radial = ("z", "x") if kind == "solid" else ("y", "x")
    across = "ur" if kind == "axisymmetric" else "ux"
    along = "u" + last
    n = 0

    def support(group, direction):
        nonlocal n
        n += 1
        w.section("[[mechanical_condition]]", name=f"support_{n}", group=group, kind="displacement",
                  **{direction: "0 mm"})

    mechanical = [name for name, body in bodies.items() if body.get("physics") != "heat"]
    if shape == "cylinder_in_mould":
        if "mould" in mechanical:
            support("mould_bottom", along)
        return
    prefixes = [""] if shape == "block" else [f"{name}_" for name in mechanical]
    for prefix in prefixes:
        support(f"{prefix}{radial}_min", across)
        if kind == "solid":
            support(f"{prefix}y_min", "uy")
    if shape == "block" or "lower" in mechanical:
        support(f"{prefixes[-1]}{last}_min", along)
    if rng.random() < 0.3:
        support(f"{prefixes[0]}{radial}_max", across)
    top = f"{prefixes[0]}{last}_max"
    load = rng.choice(["none", "none", "pressure", "held"])
    if load == "pressure" and not bodies[next(iter(bodies))]["molten"]:  # melt flows away from it
        w.section("[[mechanical_condition]]", name="load", group=top, kind="pressure",
                  pressure=f"{around(rng, 0.01, 1):.4g} MPa")
    if load == "held":
        support(top, along)


def numerics(rng, w, facts, physics, dynamic, grows):
    # The open rule is for smooth temperatures: a chill by more than this over- and undershoots below 0 K.
    smooth = max(facts["temperatures"]) - min(facts["temperatures"]) < 300
    heat = {"integration": rng.choice(["closed", "open"]) if smooth and not grows else "closed"}
    facts["closed"] = heat["integration"] == "closed"
    schemes = ["isentropic", "isothermal", "double_pass", "block_iterative", "simultaneous", "simultaneous"]
    facts["scheme"] = scheme = rng.choice(schemes) if physics == "thermomechanical" else physics
    if rng.random() < 0.3 and scheme in ("isentropic", "isothermal", "heat") and not dynamic:
        heat["stepping"] = rng.choice(["backward_euler", "sdirk2"])
    if rng.random() < 0.3:
        heat["solver"] = rng.choice(["direct", "jacobi", "incomplete"])
    if physics != "mechanics":
        w.section("[heat]", **heat)
    tight = facts["tight"] = physics == "thermomechanical" and rng.random() < 0.3
    if tight:  # then what residuals leave of the first law is rounding
        w.add(tolerance=1e-11)
    if physics == "heat":
        return
    w.section("[mechanics]", tolerance=1e-9 if tight else None, b_bar=rng.choice([None, None, False]),
              simplices=rng.choice([None, None, "mixed", "displacement"]))
    if rng.random() < 0.15 and scheme not in ("simultaneous", "double_pass") and not dynamic:
        w.add(integration="bdf2")
    if dynamic:
        w.section("[dynamics]", method=rng.choice(["backward_euler", "newmark", "trapezoidal", "generalised_alpha"]),
                  mass=rng.choice(["consistent", "lumped"]))
    if physics != "thermomechanical":
        return
    form = "energy"
    if rng.random() < 0.2 and heat.get("stepping") != "sdirk2" and scheme != "double_pass":
        form = rng.choice({"isothermal": ["entropy", "literal", "temperature"]}.get(scheme, ["entropy"]))
    facts["form"] = form
    keys = {"scheme": scheme, "structural_heating": form}
    if scheme == "simultaneous" and rng.random() < 0.3 and not dynamic:
        keys["integration"] = "sdirk2"
    w.section("[coupling]", **keys)
    if scheme == "block_iterative":
        passes = rng.choice(["isentropic", "isothermal"])
        w.section("[coupling.iteration]", passes=passes, sweep=rng.choice(["gauss_seidel", "jacobi"]),
                  loop=rng.choice(["nested", "single"]))
        relaxation = rng.choice(["none", "fixed"] + (["aitken"] if passes == "isothermal" else []))
        w.add(relaxation=relaxation, factor=0.9 if relaxation != "none" else None)
