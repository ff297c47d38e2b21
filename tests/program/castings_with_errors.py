"""Castings whose answers are compared with those of half the element and an eighth of the step: whether the errors that a
run states are as large as its errors are.

`references()` computes the finer runs once (hours for all; they lie in tests/verification/reference/answer_errors.csv with
the program's version); `stated()` runs a casting with its defaults and puts stated and true errors side by side.
"""

import csv
import json
from pathlib import Path
import re
import shutil
import subprocess

ROOT = Path(__file__).resolve().parents[2]
TABLE = ROOT / "tests/verification/reference/answer_errors.csv"

POT = """title = "{name}"
[analysis]
kind = "axisymmetric"
physics = "{physics}"
gravity = "9.81 m/s2"
[mesh]
shape = "cylinder_in_mould"
element = "{element}"
[mesh.cylinder_in_mould]
radius = "{radius} mm"
height = "{height} mm"
mould_wall = "{wall} mm"
mould_bottom = "{wall} mm"
mould_height = "{mould_height} mm"
element_size = "{size} mm"
mould_element_size = "{mould_size} mm"
[time]
until = "solid"
end = "{end} s"
step = "{step} s"
adaptive = true
[[body]]
name = "part"
role = "casting"
material = "{alloy}"
initial_temperature = "{poured} degC"
[[body]]
name = "mould"
role = "mould"
material = "{mould}"
initial_temperature = "{warm} degC"
[[thermal_condition]]
name = "outside"
group = "mould_outside"
kind = "film"
coefficient = "60 W/m2/K"
ambient = "25 degC"
"""
FLOOR = """[[mechanical_condition]]
name = "floor"
group = "mould_bottom"
kind = "displacement"
uz = "0 mm"
"""
GAP = """[[contact]]
name = "wall"
slave = "part_surface"
master = "mould_surface"
[contact.heat]
conductance = "{conductance} W/m2/K"
gap_law = "gas"
gas_conductivity = "0.045 W/m/K"
"""
LIBRARY = """[[interface]]
bodies = "all"
"""


def pot(radius, height, wall, size, alloy, poured, mould, warm, end, conductance=None, heat=False, element="tri3"):
    """A pot that is open on top; without a conductance its interface is that of the library."""
    return dict(radius=radius, height=height, wall=wall, size=size, alloy=alloy, poured=poured, mould=mould, warm=warm, end=end,
                conductance=conductance, heat=heat, element=element)


H13 = "h13_tool_steel"
POTS = {
    "alsi7mg_die": pot(20, 80, 25, 2, "aluminium_alsi7mg", 690, H13, 200, 200, 2500),
    "az91_die": pot(35, 55, 30, 3.2, "magnesium_az91", 680, H13, 220, 600, 2500),
    "zamak5_die": pot(12, 60, 20, 1.5, "zinc_zamak5", 430, H13, 150, 300, 5000),
    "brass_iron_die": pot(30, 40, 40, 3, "brass", 1000, "cast_iron_die", 250, 600, 1500),
    "grey_iron_sand": pot(40, 100, 50, 4, "grey_iron", 1320, "green_sand", 20, 9000),
    "steel_sand": pot(25, 60, 40, 3, "medium_carbon_steel", 1560, "furan_sand", 20, 5000),
    "steel_sand_heat": pot(25, 60, 40, 3, "medium_carbon_steel", 1560, "furan_sand", 20, 5000, heat=True),
    "alsi9cu3_sand_heat": pot(40, 100, 50, 4, "aluminium_alsi9cu3", 720, "green_sand", 20, 9000, heat=True),
    "alcu4mgti_die": pot(20, 80, 25, 2.5, "aluminium_alcu4mgti", 720, H13, 250, 300),
    "tin_bronze_copper": pot(60, 30, 30, 3, "tin_bronze", 1120, "copper_mould", 100, 600, 3000),
    "alsi12_steel_heat": pot(15, 120, 15, 1.5, "aluminium_alsi12", 650, "steel_mould", 180, 300, 2000, heat=True),
    "alsi10mg_die": pot(30, 60, 30, 6, "aluminium_alsi10mg", 680, H13, 200, 600),
    "nodular_iron_sand": pot(50, 50, 60, 5, "nodular_iron", 1350, "furan_sand", 20, 12000),
    "pure_aluminium_die": pot(20, 80, 25, 2, "pure_aluminium", 700, H13, 200, 300, 2500),
    "am60_quads": pot(25, 40, 25, 3, "magnesium_am60", 690, H13, 200, 300, 3000, element="quad4"),
    "alsi9cu3_quads": pot(45, 25, 30, 3, "aluminium_alsi9cu3", 680, "cast_iron_die", 250, 600, 2000, element="quad4"),
    "steel_quadratic_heat": pot(30, 50, 50, 6, "low_carbon_steel", 1600, "green_sand", 20, 6000, heat=True, element="tri6"),
}
# Made by `solidus new` in three dimensions, heat alone.
PARTS = {
    "bracket": ("cases/bracket_from_step/bracket.step", "aluminium_alsi7mg", "sand"),
    "hook": ("tests/parts/hook.step", "medium_carbon_steel", "sand"),
    "stepped_plate": ("tests/parts/stepped_plate.step", "zinc_zamak5", "gravity_die"),
}
NAMES = [*POTS, *PARTS]


def run(program, folder, arguments):
    """Runs a case. Returns its summary."""
    shutil.rmtree(folder / "results", ignore_errors=True)
    done = subprocess.run([program, "run", "case", *arguments, "--no-progress", "-o", "results"], cwd=folder, capture_output=True,
                          text=True, check=False)
    if done.returncode != 0:
        raise RuntimeError(f"{folder.name}: {done.stderr}")
    return json.loads((folder / "results/summary.json").read_text())


def make(program, folder, name, finer):
    """Writes a casting, with elements so much smaller than its own. Returns options of the run."""
    shutil.rmtree(folder, ignore_errors=True)
    folder.mkdir(parents=True)
    if name in PARTS:
        part, alloy, process = PARTS[name]
        subprocess.run([program, "new", str(ROOT / part), "--alloy", alloy, "--process", process, "--fineness", str(finer), "-o",
                        "case"], cwd=folder, capture_output=True, text=True, check=True)
        return ["--heat-only"]
    p = dict(POTS[name])
    text = POT + ("" if p["heat"] else FLOOR) + (GAP if p["conductance"] else LIBRARY)
    (folder / "case").mkdir()
    (folder / "case/case.toml").write_text(text.format(
        **{**p, "size": p["size"] / finer}, name=name, physics="heat" if p["heat"] else "thermomechanical",
        mould_height=p["height"] + p["wall"], mould_size=2 * p["size"] / finer, step=p["end"] / 400))
    return []


def answers(summary):
    """The answers by name: value, stated error, of which by the step and by the mesh; times in s, lengths in µm, stress in MPa,
    pores in % of the casting."""
    given = summary["answers"]
    found = {}

    def add(name, holder, value, unit, factor):
        found[name] = [factor * holder[key] for key in (value, f"error[{unit}]", f"error_of_step[{unit}]", f"error_of_mesh[{unit}]")]

    for casting in given["castings"].values():
        if not casting["riser"]:
            add("solid after", casting["last_melt_froze"], "value[s]", "s", 1)
    gaps = given.get("largest_gaps", {}).values()
    if gaps:
        add("largest gap", max(gaps, key=lambda gap: gap["value[m]"]), "value[m]", "m", 1e6)
    if "largest_distortion" in given:
        add("largest distortion", given["largest_distortion"], "value[m]", "m", 1e6)
    if "largest_von_mises" in given:
        add("largest von Mises", given["largest_von_mises"], "value[Pa]", "Pa", 1e-6)
    if "pores" in given:
        add("pores", given["pores"], "share_of_casting", "1", 100)
    return found


def references(program, folder, names):
    """Computes the finer runs of these castings into the table, which keeps its other rows."""
    rows = {}
    if TABLE.exists():
        for row in csv.DictReader(TABLE.open(newline="")):
            rows[row["casting"], row["answer"]] = row
    version = re.search(r"Solidus (\S+)", subprocess.run([program, "--version"], capture_output=True, text=True, check=True).stdout)[1]
    for name in names:
        where = Path(folder) / name
        options = make(program, where, name, 1)
        default = run(program, where, options)
        step = default["end_time[s]"] / default["steps"] / 8
        options = make(program, where, name, 2)
        fine = run(program, where, [*options, "--set", "time.adaptive=false", "--set", f"time.step={step:.6g} s", "--set",
                                    f"output.every={default['end_time[s]']:.6g} s"])
        for answer, (value, *_) in answers(fine).items():
            rows[name, answer] = {"casting": name, "answer": answer, "reference": f"{value:.6g}", "version": version,
                                  "steps": str(fine["steps"]), "nodes": str(fine["mesh"]["nodes"])}
        with TABLE.open("w", newline="") as file:
            table = csv.DictWriter(file, ["casting", "answer", "reference", "version", "steps", "nodes"], lineterminator="\n")
            table.writeheader()
            table.writerows(sorted(rows.values(), key=lambda row: (NAMES.index(row["casting"]), row["answer"])))
        print(name, answers(fine), flush=True)


def stated(program, folder, name):
    """Runs a casting with its defaults. Yields answer, value, stated error, true error."""
    where = Path(folder) / name
    found = answers(run(program, where, make(program, where, name, 1)))
    with TABLE.open(newline="") as file:
        for row in csv.DictReader(file):
            if row["casting"] == name and row["answer"] in found:
                value, error, *_ = found[row["answer"]]
                yield row["answer"], value, error, abs(value - float(row["reference"]))


if __name__ == "__main__":
    import argparse

    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("program", help="the program")
    parser.add_argument("folder", help="for the runs")
    parser.add_argument("castings", nargs="*", default=NAMES)
    options = parser.parse_args()
    references(str(Path(options.program).resolve()), options.folder, options.castings or NAMES)
