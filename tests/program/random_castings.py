"""Castings by random numbers, from which it is measured what steps are worth that a program chooses with nothing set.

`casting(seed, index)` draws one: a pot, a ring around a core, half of a bar in a closed die, or a quarter of a block, of one of
twenty alloys in a die, in copper or in sand. `compare()` runs it as it comes and with fixed steps an eighth as long, and says how
far apart their answers are. What is computed stays in the folder, so that an interrupted survey goes on where it was.

    random_castings.py PROGRAM FOLDER --seed 1 --count 12     runs them and prints a table
"""

import csv
from dataclasses import dataclass
import itertools
import json
import math
from pathlib import Path
import random

from castings_with_errors import answers, run

# Alloy: temperature from and to which it is poured [°C].
LIGHT = {"aluminium_alsi7mg": (650, 720), "aluminium_alsi12": (610, 680), "aluminium_alsi9cu3": (630, 690), "aluminium_alsi10mg": (620, 690),
         "aluminium_alsi6cu4": (640, 710), "aluminium_alcu4mgti": (680, 730), "aluminium_almg5": (660, 720), "pure_aluminium": (680, 740),
         "magnesium_az91": (630, 690), "magnesium_am60": (650, 700)}
ZINC = {"zinc_zamak3": (405, 440), "zinc_zamak5": (405, 440), "pure_zinc": (440, 480)}
COPPER = {"brass": (980, 1050), "tin_bronze": (1060, 1140), "aluminium_bronze": (1080, 1150)}
IRON = {"grey_iron": (1270, 1350), "nodular_iron": (1280, 1350), "compacted_iron": (1280, 1350)}
STEEL = {"medium_carbon_steel": (1540, 1590), "stainless_steel_316": (1490, 1550)}
# Kind of mould: what it may be of, how warm [°C], the conductance of its wall [W/m²K], which metals are poured into it.
MOULDS = {
    "die": (("h13_tool_steel", "cast_iron_die"), (120, 300), (1500, 8000), (LIGHT, LIGHT, ZINC, COPPER)),
    "copper": (("copper_mould",), (60, 200), (1500, 6000), (LIGHT, ZINC, COPPER)),
    "sand": (("green_sand", "furan_sand"), (20, 20), (500, 1500), (LIGHT, COPPER, IRON, IRON, STEEL)),
}
KINDS = ("pot", "pot", "ring", "bar", "block")
SHORTER = 8  # how many of the fixed steps there are to one of its own, in the mean

CASE = """title = "{name}"
[analysis]
kind = "{analysis}"
gravity = "9.81 m/s2"
[mesh]
file = "casting.msh"
unit = "mm"
[time]
until = "solid"
end = "{end:.4g} s"
step = "{step:.3g} s"
adaptive = true
[[body]]
name = "part"
role = "casting"
material = "{alloy}"
initial_temperature = "{poured:.0f} degC"
[[body]]
name = "mould"
role = "mould"
material = "{mould}"
initial_temperature = "{warm:.0f} degC"
[[thermal_condition]]
name = "outside"
group = "outside"
kind = "film"
coefficient = "60 W/m2/K"
ambient = "25 degC"
[[mechanical_condition]]
name = "floor"
group = "floor"
kind = "displacement"
{up} = "0 mm"
[[contact]]
name = "wall"
slave = "part_surface"
master = "mould_surface"
[contact.heat]
conductance = "{conductance:.0f} W/m2/K"
gap_law = "gas"
gas_conductivity = "{gas:.3f} W/m/K"
"""
PLANE = """[[mechanical_condition]]
name = "plane_{axis}"
group = "plane_{axis}"
kind = "displacement"
u{axis} = "0 mm"
"""
PROBE = """[[probe]]
name = "T_{name}"
field = "temperature"
point = [{point}]
body = "part"
unit = "degC"
"""


@dataclass
class Casting:
    """A box of metal in a mould: lines of its grid [mm], which of them bound the metal, and what it is made of."""

    name: str
    kind: str
    lines: list  # for each direction, up last
    metal: list  # for each direction the first and last line of the metal
    open_top: bool
    quads: bool
    alloy: str
    mould: str
    poured: float  # [°C]
    warm: float  # [°C]
    conductance: float  # [W/m²K]
    gas: float  # [W/mK]
    step: float  # [s]

    def planes(self):
        """Directions whose first line is a plane of symmetry."""
        return {"pot": [], "ring": [], "bar": [0], "block": [0, 1]}[self.kind]

    def case(self):
        """The text of its case file."""
        up = len(self.lines) - 1
        axes = "xyz" if self.kind in ("bar", "block") else "rz"
        text = CASE.format(name=self.name, analysis={"bar": "plane_strain", "block": "solid"}.get(self.kind, "axisymmetric"),
                           end=5000 * self.step, step=self.step, alloy=self.alloy, poured=self.poured, mould=self.mould, warm=self.warm,
                           up="u" + axes[up], conductance=self.conductance, gas=self.gas)
        text += "".join(PLANE.format(axis=axes[d]) for d in self.planes())
        first = [lines[a] for lines, (a, b) in zip(self.lines, self.metal)]
        last = [lines[b] for lines, (a, b) in zip(self.lines, self.metal)]
        middle = [lines[(a + b) // 2] for lines, (a, b) in zip(self.lines, self.metal)]
        for name, point in (("bottom", [*first[:-1], first[-1]]), ("middle", middle), ("rim", last)):
            text += PROBE.format(name=name, point=", ".join(f'"{x:.9g} mm"' for x in point))
        return text

    def mesh(self):
        """Its mesh in Gmsh's format 2.2: the cells of the grid as triangles or tetrahedra of one orientation, or as quadrilaterals."""
        dimension = len(self.lines)
        number, points, cells, skins = {}, [], [], []

        def node(body, index):
            if (body, index) not in number:
                number[body, index] = len(number) + 1
                points.append([lines[i] for lines, i in zip(self.lines, index)] + [0.0] * (3 - dimension))
            return number[body, index]

        def is_metal(index):
            return all(a <= i < b for i, (a, b) in zip(index, self.metal))

        def exists(index):
            return all(0 <= i < len(lines) - 1 for i, lines in zip(index, self.lines))

        for index in itertools.product(*(range(len(lines) - 1) for lines in self.lines)):
            body = 1 if is_metal(index) else 2
            for corners in cell_corners(dimension, self.quads):
                cells.append((body, [node(body, tuple(i + c for i, c in zip(index, corner))) for corner in corners]))
            for direction, end in itertools.product(range(dimension), (0, 1)):
                beyond = tuple(i + (2 * end - 1) * (d == direction) for d, i in enumerate(index))
                group = self.group(body, direction, end, exists(beyond), exists(beyond) and is_metal(beyond))
                if group:
                    for corners in face_corners(dimension, self.quads, direction, end):
                        skins.append((group, [node(body, tuple(i + c for i, c in zip(index, corner))) for corner in corners]))
        return gmsh_text(points, cells, skins, {(2, 4): 3, (2, 3): 2, (3, 4): 4}[dimension, len(cells[0][1])], dimension)

    def group(self, body, direction, end, exists, metal_beyond):
        """The number of the group that a face of a cell belongs to, 0 for none."""
        if exists:
            return 0 if metal_beyond == (body == 1) else (3 if body == 1 else 4)
        if end == 0 and direction in self.planes():
            return 7 + direction
        if body == 1:
            return 0  # the free top, or the axis
        if end == 0 and direction == 0 and self.kind in ("pot", "ring"):
            return 0
        return 6 if direction == len(self.lines) - 1 and end == 0 else 5


NAMES = {1: "part", 2: "mould", 3: "part_surface", 4: "mould_surface", 5: "outside", 6: "floor", 7: "plane_x", 8: "plane_y"}


def cell_corners(dimension, quads):
    """Corners of the elements that a cell of the grid is cut into (H. W. Kuhn), each of positive volume."""
    if quads:
        return [[(0, 0), (1, 0), (1, 1), (0, 1)]]
    elements = []
    for order in itertools.permutations(range(dimension)):
        corner, corners = [0] * dimension, [(0,) * dimension]
        for d in order:
            corner[d] = 1
            corners.append(tuple(corner))
        odd = sum(order[i] > order[j] for i in range(dimension) for j in range(i + 1, dimension)) % 2
        if odd:
            corners[-1], corners[-2] = corners[-2], corners[-1]
        elements.append(corners)
    return elements


def face_corners(dimension, quads, direction, end):
    """Corners of the faces of those elements on one side of the cell."""
    if dimension == 2:
        low, high = [0, 0], [1, 1]
        low[direction] = high[direction] = end
        return [[tuple(low), tuple(high)]]
    faces = []
    for corners in cell_corners(dimension, quads):
        face = [corner for corner in corners if corner[direction] == end]
        if len(face) == dimension:
            faces.append(face)
    return faces


def gmsh_text(points, cells, skins, kind, dimension):
    """The mesh in Gmsh's format 2.2."""
    out = ["$MeshFormat", "2.2 0 8", "$EndMeshFormat", "$PhysicalNames"]
    used = sorted({group for group, _ in cells + skins})
    out += [str(len(used))] + [f'{dimension if group < 3 else dimension - 1} {group} "{NAMES[group]}"' for group in used]
    out += ["$EndPhysicalNames", "$Nodes", str(len(points))]
    out += [f"{i} {x:.12g} {y:.12g} {z:.12g}" for i, (x, y, z) in enumerate(points, 1)]
    out += ["$EndNodes", "$Elements", str(len(cells) + len(skins))]
    elements = [({2: 1, 3: 2}[dimension], *skin) for skin in skins] + [(kind, *cell) for cell in cells]
    out += [f"{i} {form} 2 {group} {group} {' '.join(map(str, nodes))}" for i, (form, group, nodes) in enumerate(elements, 1)]
    return "\n".join([*out, "$EndElements", ""])


def outward(start, thickness, first, growth):
    """Lines beyond `start`, in the direction of the sign of `first`, to the thickness of a wall."""
    lines, size = [], first
    while abs(sum(lines)) + 0.5 * abs(size) < thickness:
        lines.append(size)
        size *= growth
    scale = thickness / abs(sum(lines))
    return [start + scale * x for x in itertools.accumulate(lines)]


def casting(seed, index):
    """Draws a casting. The same two numbers are the same casting."""
    draw = random.Random(f"{seed} {index}")
    kind = KINDS[index % len(KINDS)]
    mould_kind = draw.choice(("die", "die", "copper", "sand"))
    moulds, warm, conductance, metals = MOULDS[mould_kind]
    alloy, poured = draw.choice(sorted(draw.choice(metals).items()))
    solid_block = kind == "block"
    half_width = draw.uniform(9, 20 if solid_block else 30)
    height = draw.uniform(0.5, 1.5 if solid_block else 2) * 2 * half_width
    section = min(2 * half_width, height)
    size = section / draw.uniform(*((6, 9) if solid_block else (10, 18)))
    growth = 1.6 if solid_block else 1.35
    wall = draw.uniform(0.8, 1.6) * half_width + 8
    first = size if mould_kind != "sand" else 0.5 * size

    def span(low, high):
        n = max(2, round((high - low) / size))
        return [low + (high - low) * i / n for i in range(n + 1)]

    open_top = kind in ("pot", "ring", "block")
    lines, metal = [], []
    for direction in range(3 if solid_block else 2):
        up = direction == (2 if solid_block else 1)
        low = draw.uniform(0.5, 2) * half_width if kind == "ring" and not up else 0
        high = height if up else low + half_width * (1 if kind != "ring" else draw.uniform(0.6, 1.2))
        inner = span(low, high)
        before = []
        if up:
            before = outward(low, wall, -first, growth)[::-1]
        elif kind == "ring":
            before = outward(low, low, -first, growth)[::-1]
            before[0] = 0.0
        after = [] if up and open_top else outward(high, wall, first, growth)
        lines.append(before + inner + after)
        metal.append((len(before), len(before) + len(inner) - 1))
    modulus = 0.25 * section  # [mm]
    step = (0.005 if mould_kind != "sand" else 0.03) * modulus**2
    return Casting(f"{kind}_{seed}_{index}", kind, lines, metal, open_top, kind in ("pot", "ring") and draw.random() < 0.25, alloy,
                   draw.choice(moulds), draw.uniform(*poured), draw.uniform(*warm),
                   math.exp(draw.uniform(*map(math.log, conductance))), draw.uniform(0.03, 0.08), step)


def temperatures(folder):
    """Times of a run and the temperatures of its probes."""
    with (folder / "results/history.csv").open(newline="") as file:
        rows = list(csv.DictReader(file))
    return [float(row["time[s]"]) for row in rows], {name: [float(row[name]) for row in rows] for name in rows[0] if name.startswith("T_")
                                                     and name not in ("T_min[degC]", "T_max[degC]")}


def between(times, values, time):
    """The value of a table at a time, on straight lines."""
    for i in range(1, len(times)):
        if times[i] >= time:
            return values[i - 1] + (values[i] - values[i - 1]) * (time - times[i - 1]) / (times[i] - times[i - 1])
    return values[-1]


def kept(path, wanted, make):
    """What was computed before for the same `wanted`, or computed now."""
    if path.exists():
        found = json.loads(path.read_text())
        if all(found[key] == value for key, value in wanted.items() if key != "shorter than"):
            if "shorter than" not in wanted or found["step"] <= wanted["shorter than"]:
                return found
    found = {**wanted, **make()}
    path.write_text(json.dumps(found))
    return found


def measured(program, where, options):
    """Answers of a run by name with the stated errors of the step, its probes, steps and nodes."""
    summary = run(program, where, options)
    times, probes = temperatures(where)
    return {"answers": {name: [value, of_step] for name, (value, _, of_step, _) in answers(summary).items()}, "times": times,
            "probes": probes, "end": summary["end_time[s]"], "steps": summary["steps"], "nodes": summary["mesh"]["nodes"]}


def compare(program, folder, drawn, settings=()):
    """Runs a casting with nothing set and with fixed steps an eighth as long in the mean.

    @returns by answer its value, its stated error of the step, and its value with the short steps; with numbers of steps and nodes, and
             as "temperatures" the largest difference of any probe's temperature at any time of both [K]
    """
    where = Path(folder) / drawn.name
    text = drawn.case()
    (where / "case").mkdir(parents=True, exist_ok=True)
    (where / "case/case.toml").write_text(text)
    (where / "case/casting.msh").write_text(drawn.mesh())
    options = [part for setting in settings for part in ("--set", setting)]
    own = kept(where / "own.json", {"case": text, "settings": list(settings)}, lambda: measured(program, where, options))
    wanted = own["end"] / own["steps"] / SHORTER

    def with_short_steps():
        fixed = ("time.adaptive=false", f"time.step={wanted:.6g} s", f"output.every={own['end']:.6g} s")
        return {"step": wanted, **measured(program, where, [part for setting in fixed for part in ("--set", setting)])}

    # What was computed with steps that are a little longer serves too: a change of the rule of steps need not compute all again.
    short = kept(where / "short.json", {"case": text, "shorter than": 1.3 * wanted}, with_short_steps)
    until = min(own["times"][-1], short["times"][-1])
    apart = max(abs(value - between(short["times"], short["probes"][name], time)) for name, values in own["probes"].items()
                for time, value in zip(own["times"], values) if time <= until)
    # A casting without pores has no such answer.
    both = {name: [*pair, short["answers"].get(name, [0])[0]] for name, pair in own["answers"].items()}
    return {"answers": both, "temperatures": apart, "steps": own["steps"], "nodes": own["nodes"]}


def difference(found, answer):
    """How far an answer of `compare()` is off [%], pores in points of the casting [%]; nothing for answers it does not have."""
    if answer not in found["answers"]:
        return None
    value, _, fine = found["answers"][answer]
    return value - fine if answer == "pores" else 100 * (value / fine - 1)


ANSWERS = ("solid after", "largest gap", "largest distortion", "largest von Mises", "pores")


def row(drawn, found):
    """A line of the table."""
    cells = [drawn.kind + (", quads" if drawn.quads else ""), drawn.alloy, drawn.mould]
    cells += [f"{x:.1f}" if x is not None and a != "pores" else "" if x is None else f"{x:+.3f} of {found['answers'][a][2]:.3f}"
              for a, x in ((a, difference(found, a)) for a in ANSWERS)]
    return "| " + " | ".join([*cells, f"{found['temperatures']:.1f}", str(found["steps"])]) + " |"


if __name__ == "__main__":
    import argparse

    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("program", help="the program")
    parser.add_argument("folder", help="for the runs; what is there is not computed again")
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--count", type=int, default=12)
    parser.add_argument("--first", type=int, default=0)
    parser.add_argument("--set", action="append", default=[], help="a setting of the runs whose steps are their own")
    options = parser.parse_args()
    for index in range(options.first, options.first + options.count):
        drawn = casting(options.seed, index)
        try:
            print(row(drawn, compare(str(Path(options.program).resolve()), options.folder, drawn, options.set)), flush=True)
        except RuntimeError as failed:
            print(f"| {drawn.name} | {drawn.alloy} | {failed}", flush=True)
