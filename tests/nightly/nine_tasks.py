"""The nine first tasks of docs/developers/README.md, done in a copy of the sources: every change that the pages show is made, Solidus is
built with all of them, and each is seen at work in it.

    nine_tasks.py TREE BUILD    TREE: a copy of the sources that may be changed; BUILD: its configured build folder

TREE/BUILD is changed: never call it for a folder in which you work.
"""

import csv
import json
from pathlib import Path
import re
import subprocess
import sys

ROOT = Path(__file__).resolve().parents[2]
sys.path[:0] = [str(ROOT / "python"), str(ROOT / "tests/program")]
from solidus_docs.page_changes import Change, changes  # noqa: E402

UNIT = ('    {"m3", {"cm3", "cm³", 1e6}},', '    {"m3", {"dm3", "dm³", 1e3}},')
SOLVER = ("k_direct_limit_2d = 15000", "k_direct_limit_2d = 10")
COLUMN = '''    {{.name = "heat_left", .unit = "J", .label = "Heat that left", .doc = "Heat in, with the other sign"},
     with_heat,
     [](const RunSums& s) { return -s.energy.heat_in; }},
'''
BEHIND = "    {columns::k_heat_in, with_heat, [](const RunSums& s) { return s.energy.heat_in; }},\n"
CASE = """
title = "A plate of a freezing alloy on a chill"
[analysis]
kind = "plane_strain"
[mesh]
shape = "two_blocks"
element = "quad4"
[mesh.two_blocks]
lower = ["40 mm", "40 mm"]
lower_divisions = [4, 3]
upper = ["40 mm", "1.5 mm"]
upper_divisions = [20, 4]
[time]
end = "10 s"
step = "1 s"
[output]
every = "5 s"
extremes = true
[[body]]
name = "upper"
material = "own.toml"
initial_temperature = "700 degC"
[[body]]
name = "lower"
material = "steel_mould"
initial_temperature = "200 degC"
[[contact]]
name = "interface"
slave = "upper_bottom"
master = "lower_top"
[contact.heat]
conductance = "2000 W/m2/K"
gap_law = "constant"
[[thermal_condition]]
name = "curing"
group = "lower"
kind = "source"
law = "decaying"
initial_power = "2e6 W/m3"
lifetime = "50 s"
[[mechanical_condition]]
name = "stand"
group = "lower_y_min"
kind = "displacement"
ux = "0 mm"
uy = "0 mm"
[[mechanical_condition]]
name = "hold"
group = "upper_y_max"
kind = "displacement"
ux = "0 mm"
uy = "0 mm"
[[probe]]
name = "inside"
kind = "point"
point = ["20 mm", "20 mm"]
field = "temperature"
unit = "degC"
"""
CARD = 'like = "aluminium_alsi7mg"\nbridged_fraction = { value = "0.9", source = "this test" }\n'
SU2 = "NDIME= 2\nNELEM= 1\n9 0 1 2 3 0\nNPOIN= 4\n0 0 0\n1 0 1\n1 1 2\n0 1 3\nNMARK= 0\n"


class Task:
    """A task with the changes that it takes and what shows that it works."""

    def __init__(self, name, made, check):
        self.name, self.made, self.check = name, made, check


def of_page(page, *files):
    found = {change.file: change for change in changes((ROOT / f"docs/developers/{page}.md").read_text(encoding="utf-8"))}
    return [found[file] for file in files]


def copy(file, source):
    return [Change(file, source, [])]


def replaced(file, old, new):
    return [Change(file, None, [(old.rstrip("\n").split("\n"), new.rstrip("\n").split("\n"))])]


def in_line(tree, file, old, new):
    line = next(line for line in (tree / file).read_text(encoding="utf-8").splitlines() if old in line)
    return replaced(file, line, line.replace(old, new))


class Solidus:
    def __init__(self, tree, build):
        self.tree, self.program, self.folder = tree, build / "solidus", build / "nine_tasks"
        self.folder.mkdir(exist_ok=True)
        (self.folder / "case.toml").write_text(CASE)
        (self.folder / "own.toml").write_text(CARD)
        (self.folder / "square.su2").write_text(SU2)

    def __call__(self, *arguments, fails=False):
        done = subprocess.run([self.program, *arguments], cwd=self.folder, text=True, capture_output=True, stdin=subprocess.DEVNULL)
        if (done.returncode != 0) != fails:
            raise AssertionError(f"{arguments}: exit code {done.returncode}\n{done.stdout[-2000:]}{done.stderr[-2000:]}")
        return done.stdout + done.stderr

    def summary(self):
        return json.loads((self.folder / "out/summary.json").read_text())

    def page(self):
        import base64
        import zlib
        text = (self.folder / "out/report.html").read_text(encoding="utf-8")
        run, = json.loads(zlib.decompress(base64.b64decode(re.search(r'id="meta">([^<]*)<', text)[1]), -15))["runs"]
        return run


def expect(condition, what):
    if not condition:
        raise AssertionError(what)


def equation(solidus):
    found = subprocess.run([sys.executable, "-m", "solidus_docs.equations", "4.97"], cwd=solidus.tree, text=True, capture_output=True,
                           env={"PYTHONPATH": "python"})
    expect(found.returncode == 0 and "src/" in found.stdout, found.stdout + found.stderr)


def criterion(solidus):
    expect("Strain rate that melt feeds" in solidus("explain", "--fields", "feedable_strain_rate"), "the field")
    solidus("run", ".", "-o", "out", "--report", "--no-progress")
    expect("feedable_strain_rate" in solidus.summary()["fields"], "the field in the summary")
    expect(any(row["label"] == "Strain rate that melt feeds" for row in solidus.page()["quantities"]), "the label in the report")


def source(solidus):
    expect("decays" in solidus("explain", "thermal_condition.law"), "the law")
    with (solidus.folder / "out/history.csv").open() as file:
        *_, last = csv.DictReader(file)
    # 40 mm by 40 mm by 1 m, from 0 to 10 s; the chill is insulated elsewhere
    exact = 2e6 * 0.04 * 0.04 * 50 * (1 - 2.718281828459045 ** (-10 / 50))
    expect(abs(float(last["heat_in[J]"]) - exact) < 1e-9 * exact, f"heat {last['heat_in[J]']}, not {exact}")


def formats(solidus):
    expect("ranges at" in solidus("export", "out", "--ranges", "ranges.csv"), "the export")
    expect((solidus.folder / "out/extremes.csv").is_file(), "the format of a run")
    expect("SU2" in solidus("mesh-info", "square.su2") or "quad4" in solidus("mesh-info", "square.su2"), "the format of meshes")


def finding(solidus):
    expect("melt freezes on its way" in solidus("check", "."), "the finding in check")
    expect("thin walls" in solidus("explain", "--findings", "--manual"), "its row of the page")


def key(solidus):
    expect("grains bridge" in solidus("explain", "--material", "bridged_fraction"), "the key")
    (solidus.folder / "own.toml").write_text(CARD.replace('"0.9"', '"2"'))
    expect("bridged_fraction" in solidus("check", ".", fails=True), "its limits")
    (solidus.folder / "own.toml").write_text(CARD)


def solver(solidus):
    """What `automatic` chooses takes as many iterations in the last step as multigrid, and not as many as factors, which stand in for multigrid
    where it has not converged in the first ones."""
    taken = {}
    for kind in ("automatic", "multigrid", "direct"):
        solidus("run", ".", "-o", kind, "--no-progress", "--set", f'mechanics.solver="{kind}"')
        with (solidus.folder / kind / "steps.csv").open() as file:
            taken[kind] = [row["mechanics_linear_iterations[1]"] for row in csv.DictReader(file)]
    expect(taken["automatic"][-1] == taken["multigrid"][-1] != taken["direct"][-1], taken)


def verb(solidus):
    expect(re.search(r"upper [\d.e-]+ kg", solidus("weigh", ".")), "the verb")
    expect("weigh" in solidus("help"), "the verb in the help")


def unit(solidus):
    expect("shown in dm³" in solidus("explain", "--fields", "pool_volume"), "the unit of a field")
    expect(solidus.page()["units"]["m3"]["text"] == "dm³", "the unit of the report")


def section(solidus):
    expect([s["title"] for s in solidus.page()["sections"]] == ["Thermometers"], "the section of the report")


def column(solidus):
    with (solidus.folder / "out/history.csv").open() as file:
        *_, last = csv.DictReader(file)
    expect(float(last["heat_left[J]"]) == -float(last["heat_in[J]"]), "the column")
    expect("Heat that left" in solidus("explain", "--tables", "--manual"), "its row of the page")
    rows = solidus.page()["declared"]["tables"]["history"]
    expect(any(row["label"] == "Heat that left" for row in rows), "its label in the report")


def tasks(tree):
    laws = "tests/laws"
    return [
        Task("find an equation", [], equation),
        Task("add a criterion", of_page("add_a_criterion", "src/criteria/kinds/feedable_strain.cpp"), criterion),
        Task("add a heat source", of_page("add_a_source", "src/cases/decaying_source.cpp", "src/cases/source_law.cpp"), source),
        Task("add a format of export", copy("src/app/exports/range_table.cpp", f"{laws}/range_table.cpp"), lambda _: None),
        Task("add a format of fields", of_page("add_a_format", "src/results/formats/format_extremes.cpp"), lambda _: None),
        Task("add a format of meshes", of_page("add_a_format", "src/mesh/files/format_su2.cpp"), formats),
        Task("add a finding", of_page("add_a_check_finding", "src/check/findings/thin_walls.cpp"), finding),
        Task("add a key of a card", [], key),  # it is in the file of the criterion, which reads it
        Task("change a default of solvers", in_line(tree, "src/linear/automatic_solver.hpp", *SOLVER), solver),
        Task("add a verb", copy("src/app/verbs/weigh.cpp", f"{laws}/weigh.cpp"), verb),
        Task("change a unit", replaced("src/quantities/shown_units.cpp", *UNIT), unit),
        Task("add a section of the report", copy("src/app/probe_section.cpp", f"{laws}/probe_section.cpp"), section),
        Task("add a column", replaced("src/coupling/history_columns.cpp", BEHIND, BEHIND + COLUMN), column),
    ]


def main(tree, build):
    all_tasks = tasks(tree)
    for task in all_tasks:
        files = [change.file for change in task.made]
        expect(len(files) <= 2, f"{task.name}: {files}")
        for change in task.made:
            change.apply(tree)
        print(f"{task.name}: {', '.join(files) or 'no file'}", flush=True)
    subprocess.run(["cmake", "--build", build, "--target", "solidus", "-j", "2"], check=True, stdout=subprocess.DEVNULL)
    solidus = Solidus(tree, build)
    for task in all_tasks:
        task.check(solidus)
        print(f"{task.name}: works", flush=True)


if __name__ == "__main__":
    main(Path(sys.argv[1]).resolve(), Path(sys.argv[2]).resolve())
