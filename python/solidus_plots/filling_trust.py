"""What the OpenFOAM that is found can be trusted with: a jet of metal that fills a short duct with slipping walls, whose velocity is known,
through cubes and through cells that are sheared by 5.7 degrees. It takes some seconds, once for each build.

Debian's build of 1912 is right in cubes along the axes, and wrong in cells that are sheared (docs/theory/filling.md#model).
"""

import json
import os
from pathlib import Path
import shutil
import tempfile

import numpy as np

from solidus_plots import filling_dictionaries as dictionaries
from solidus_plots.filling_flow import SOLVER, FlowError, FoamRun
from solidus_plots.filling_mesh import HEADER, Cubes, write_mesh

SLOPE = 0.1  # tangent of 5.7 degrees
WRONG = 0.02  # of the speed, beyond which a velocity counts as wrong
COUNTS = (12, 4, 4)
EDGE = 0.005  # [m]
STEPS, STEP = 20, 5e-4  # [s]
MELT = dictionaries.Melt(2500.0, 1100.0, 4e5, 500.0, 90.0, 90.0, 2e-3, 0.9)


def write_duct(folder, slope):
    """A duct full of metal, along x, and sideways by the slope."""
    cubes = Cubes(np.zeros(3), EDGE, np.argwhere(np.ones(COUNTS, bool)))
    faces, directions = cubes.skin()
    of = {"gate": directions[:, 0] < 0, "leak": directions[:, 0] > 0, "free": directions[:, 0] == 0}
    write_mesh(folder, cubes, [(name, "patch", faces[chosen], directions[chosen]) for name, chosen in of.items()])
    # The points of the mesh are moved; cells and faces stay what they are.
    file = folder / "constant/polyMesh/points"
    text = file.read_text()
    points = np.array(text[text.index("(", text.index("}")) + 1:text.rindex(")")].replace("(", " ").replace(")", " ").split(), float).reshape(-1, 3)
    points[:, 1] += slope * points[:, 0]
    rows = "\n".join("({:.15g} {:.15g} {:.15g})".format(*point) for point in points)
    file.write_text(HEADER.format(kind="vectorField", location="constant/polyMesh", name="points") + f"{len(points)}\n(\n{rows}\n)\n")
    flow = dictionaries.Flow((0, 0, -1e-6), (1, slope, 0), 900.0, 900.0, 1.0, STEP)
    field, still = dictionaries.field, dictionaries.INSULATING
    field(folder, "0/U", f"uniform (1 {slope:g} 0)", {"gate": dictionaries.gate_velocity(flow.velocity), "leak": still, "free": "type slip;"},
          "volVectorField")
    pressure = f"value uniform {dictionaries.AIR_PRESSURE:g};"
    field(folder, "0/p_rgh", f"uniform {dictionaries.AIR_PRESSURE:g}", {
        "gate": f"type fixedFluxPressure; {pressure}", "free": f"type fixedFluxPressure; {pressure}", "leak": f"type fixedValue; {pressure}"})
    for phase in dictionaries.PHASES:
        share = int(phase == "melt")
        field(folder, f"0/alpha.{phase}", f"uniform {share}", {"gate": f"type fixedValue; value uniform {share};", "leak": still, "free": still})
    field(folder, "0/T", "uniform 900", {"gate": "type fixedValue; value uniform 900;", "leak": still, "free": still})
    dictionaries.write_materials(folder, MELT, flow)
    dictionaries.write_numerics(folder)
    dictionaries.write_control(folder, flow, STEPS * STEP, STEPS * STEP)
    return len(cubes.cells)


def error_in_duct(folder, slope):
    """How far the velocity is off in the mean, of the speed; infinite where the flow breaks down."""
    cells = write_duct(folder, slope)
    run = FoamRun(folder, cells, 1)
    try:
        run.run(lambda line: None)
        velocity = run.read([name for time, name in run.times() if time > 0][-1], "U")
    except FlowError:
        return float("inf")
    return float(np.linalg.norm(velocity - np.array([1, slope, 0]), axis=1).mean())


def cache_file():
    return Path(os.environ.get("XDG_CACHE_HOME") or Path.home() / ".cache") / "solidus" / "openfoam.json"


def errors(version):
    """{"cubes": error, "sheared": error} of the build that is found, from the cache or computed."""
    program = Path(shutil.which(SOLVER)).resolve()
    build = f"{version} {program} {program.stat().st_size} {program.stat().st_mtime_ns}"
    file = cache_file()
    try:
        known = json.loads(file.read_text())
        if known["build"] == build:
            return known["errors"]
    except (OSError, ValueError, KeyError, TypeError):
        pass
    with tempfile.TemporaryDirectory(prefix="solidus_openfoam_") as name:
        found = {what: error_in_duct(Path(name) / what, slope) for what, slope in (("cubes", 0.0), ("sheared", SLOPE))}
    # Where nothing can be kept the next filling tries again.
    try:
        file.parent.mkdir(parents=True, exist_ok=True)
        part = file.with_suffix(f".{os.getpid()}")
        part.write_text(json.dumps({"build": build, "errors": found}))
        part.replace(file)
    except OSError:
        pass
    return found


def told(found):
    """A sentence. Throws FlowError where not even cubes come out right."""
    if not found["cubes"] <= WRONG:
        raise FlowError(f"the OpenFOAM that is found is wrong by {100 * found['cubes']:.2g} % of the speed in a duct of cubes, whose flow is known: "
                        "its fillings are worth nothing; another build")
    right = f"in a duct whose flow is known its velocity is right within {max(found['cubes'], 1e-6):.0e} of the speed in cubes, which is what Solidus makes"
    if found["sheared"] <= WRONG:
        return f"{right}, and in sheared cells within {max(found['sheared'], 1e-6):.0e}"
    wrong = "breaks down" if not np.isfinite(found["sheared"]) else f"is wrong by {100 * found['sheared']:.2g} %"
    return f"{right}; in sheared cells it {wrong}, so no other meshes with this build"
