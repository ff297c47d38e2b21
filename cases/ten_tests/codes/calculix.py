"""CalculiX: TEST/calculix.inp, which includes mesh.inp; numbers are read from the tables that it prints (calculix.dat).

A temperature or displacement is that of the node at the place, a stress the mean over the integration points of the element
whose middle is next to it, the pressure of the shrink fit the radial stress in the core, which is the same all over it.
CalculiX 2.20 has no latent heat: decks have it in the specific heat, over a range that its iteration can follow.
"""
from pathlib import Path
import re
import shutil
import subprocess

import score

TESTS = ["stefan", "alloy", "corner", "clamped_cube", "weiner_boley", "ring_on_core"]
WITHOUT = {
    "closing_gap": "`*GAP CONDUCTANCE` depends on pressure and temperature; a dependence on the width of an open gap needs a subroutine "
                   "(`gapcon.f`) and a compiler",
    "plastic_work": "plastic work does not become heat",
    "pipe": "no feeding",
    "rubbing": "heat of friction uses a given sliding speed (`*GAP HEAT GENERATION`), not that of the bodies; no input file"}
IN_CORE = [0.049, 0.001, 0.0]
COMPONENTS = {"xx": 0, "yy": 1, "zz": 2, "xy": 3, "rr": 0, "tt": 2}


def version():
    program = shutil.which("ccx")
    if program is None:
        return None
    said = subprocess.run([program, "-v"], capture_output=True, text=True).stdout
    return "CalculiX " + said.split()[-1]


def mesh(path):
    """Nodes by number, and the corners of elements by number."""
    nodes, elements, into = {}, {}, None
    for line in path.read_text().splitlines():
        if line.startswith("*"):
            into = {"*NODE": nodes, "*ELEMENT": elements}.get(line.split(",")[0])
        elif into is not None:
            number, *rest = line.split(",")
            into[int(number)] = [float(x) for x in rest] if into is nodes else [int(n) for n in rest]
    return nodes, elements


def tables(path):
    """What was printed: (quantity, time, {number of node or element: [rows of values]})."""
    found = []
    for line in path.read_text().splitlines():
        head = re.match(r"\s*(temperatures|displacements|stresses).* (?:for|of) set .* and time\s+(\S+)", line)
        if head:
            found.append((head[1], float(head[2]), {}))
        elif found and line.strip() and line.split()[0].isdigit():
            number, *values = line.split()
            values = [float(v) for v in values]
            found[-1][2].setdefault(int(number), []).append(values[1:] if found[-1][0] == "stresses" else values)
        elif line.strip():
            found.append((line.strip(), 0.0, {}))
    return found


def distance(a, b):
    return sum((x - y)**2 for x, y in zip(a, b))**0.5


def nearest(points, place):
    """All numbers of points that are nearest to the place, to a micrometre."""
    least = min(distance(p, place) for p in points.values())
    return [n for n, p in points.items() if distance(p, place) < least + 1e-6]


def value(row, printed, nodes, middles):
    field, place = row["field"], [float(row[c]) for c in "xyz"]
    quantity = {"temperature": "temperatures", "displacement_x": "displacements"}.get(field, "stresses")
    time = float(row["time"])
    blocks = [block for name, at, block in printed if name == quantity and abs(at - time) < 1e-6 * max(1, time)]
    if quantity != "stresses":
        number = nearest(nodes, place)[0]
        number = next(n for n in [number] if any(n in b for b in blocks))
        found = next(b[number][0][0] for b in blocks if number in b)
        return found * (1e6 if row["unit"] == "um" else 1)
    component = 0 if field == "pressure" else COMPONENTS[field.split("_")[1]]
    if field == "pressure":
        place = IN_CORE
    rows = {n: r for block in blocks for n, r in block.items()}
    chosen = [r[component] for n in nearest({n: middles[n] for n in rows}, place) for r in rows[n]]
    return sum(chosen) / len(chosen) * (-1e-6 if field == "pressure" else 1e-6)


def write_planes(folder, nodes):
    """All nodes of the two free faces along the strip move alike: equations for each of them."""
    out = []
    for axis in (1, 2):
        far = max(p[axis] for p in nodes.values())
        first, *others = [n for n, p in nodes.items() if abs(p[axis] - far) < 1e-9]
        for n in others:
            out += ["*EQUATION", "2", f"{n},{axis + 1},1.,{first},{axis + 1},-1."]
    (folder / "plane.inp").write_text("\n".join(out) + "\n")


def answer(test, folder):
    for name in ("mesh.inp", "calculix.inp"):
        shutil.copy(score.HERE / test / name, folder)
    nodes, elements = mesh(folder / "mesh.inp")
    if test == "weiner_boley":
        write_planes(folder, nodes)
    with (folder / "log").open("w") as log:
        subprocess.run(["ccx", "calculix"], cwd=folder, stdout=log, stderr=log, check=True, timeout=1800)
    if "*ERROR" in (folder / "log").read_text():
        raise RuntimeError(next(line for line in (folder / "log").read_text().splitlines() if "*ERROR" in line).strip())
    middles = {n: [sum(x) / len(e) for x in zip(*(nodes[c] for c in e))] for n, e in elements.items()}
    printed = tables(Path(folder) / "calculix.dat")
    return {row["name"]: value(row, printed, nodes, middles) for row in score.right(test)}
