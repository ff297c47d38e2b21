"""A mesh that the run refines: orders, the same answers as a mesh of half the size, any number of processes, restart, mistakes."""

import csv
import math

from program import SOURCES, ProgramTest, solidus

# A harmonic temperature, 50 degC + 100 K sin(20 x) sinh(20 y)/sinh(2) with x and y in metres, by its values on the whole boundary.
FORMULA = '"323.15 + 100*sin(20*x)*(exp(20*y) - exp(-20*y))/7.25372081569404"'
HARMONIC = """title = "A harmonic temperature"
[analysis]
kind = "plane_strain"
physics = "heat"
[mesh]
shape = "block"
element = "{element}"
[mesh.block]
size = ["100 mm", "100 mm"]
divisions = [5, 5]
[time]
steady = true
[heat]
tolerance = 1e-12
[[body]]
name = "block"
material = "steel_mould"
initial_temperature = "50 degC"
{conditions}
[[probe]]
name = "T"
kind = "point"
field = "temperature"
point = ["40 mm", "60 mm"]
unit = "K"
"""


def harmonic(element):
    sides = "".join(f'[[thermal_condition]]\nname = "{side}"\ngroup = "{side}"\nkind = "temperature"\ntemperature = {{ formula = {FORMULA} }}\n'
                    for side in ("x_min", "x_max", "y_min", "y_max"))
    return HARMONIC.format(element=element, conditions=sides)


def last_row(folder):
    with open(folder / "history.csv", encoding="utf-8") as file:
        rows = list(csv.DictReader(line for line in file if not line.startswith("#")))
    return {name: float(value) for name, value in rows[-1].items() if value}


class Refine(ProgramTest):
    def run_case(self, name, case, *arguments, processes=1):
        self.done("run", str(case), "-o", name, *arguments, env={"SOLIDUS_PROCESSES": str(processes)})
        return self.folder / name

    def test_the_error_of_a_harmonic_temperature_falls_with_the_order(self):
        exact = 323.15 + 100 * math.sin(20 * 0.04) * math.sinh(20 * 0.06) / math.sinh(2)
        for element, order in (("tri3", 2), ("quad8", 3)):
            case = self.write(f"{element}.toml", harmonic(element))
            errors = [abs(last_row(self.run_case(f"{element}{n}", case, "--set", f"mesh.refine={n}"))["T[K]"] - exact) for n in range(3)]
            for coarse, fine in zip(errors, errors[1:]):
                self.assertGreater(math.log2(coarse / fine), order - 0.3, f"{element}: {errors}")

    def test_two_blocks_in_contact_are_those_of_half_the_size(self):
        short = ("--set", "time.end=4 s", "--set", "mechanics.tolerance=1e-9", "--set", "heat.tolerance=1e-10")
        case = SOURCES / "cases/two_blocks"
        coarse = ("--set", "mesh.two_blocks.lower_divisions=[4,4,2]", "--set", "mesh.two_blocks.upper_divisions=[3,3,2]")
        half = ("--set", "mesh.two_blocks.lower_divisions=[8,8,4]", "--set", "mesh.two_blocks.upper_divisions=[6,6,4]")
        refined = self.run_case("refined", case, *short, *coarse, "--set", "mesh.refine=1")
        expected = last_row(self.run_case("half", case, *short, *half))
        # Two processes have the same mesh, and a run that they began goes on with one.
        both = self.run_case("both", case, *short, *coarse, "--set", "mesh.refine=1", processes=2)
        begun = self.run_case("begun", case, *short, *coarse, "--set", "mesh.refine=1", "--set", "time.end=2 s", processes=2)
        self.run_case("begun", case, *short, *coarse, "--set", "mesh.refine=1", "--restart")
        for found in (refined, both, begun):
            for name, value in last_row(found).items():
                if name != "energy_defect[J]":
                    self.assertAlmostEqual(value, expected[name], delta=1e-8 * max(1, abs(expected[name])), msg=f"{found}: {name}")

    def test_a_part_of_a_geometry_is_refined_flat_or_on_arcs(self):
        case = SOURCES / "cases/bracket_from_step"
        for skin in ("automatic", "curved"):
            result = solidus("check", str(case), "--set", "mesh.refine=1", "--set", f"mesh.refined_skin={skin}", cwd=self.folder)
            self.assertEqual(result.returncode, 0, result.stderr)
            self.assertRegex(result.stderr, r"mesh refined once: \d+ nodes from \d+")
            self.assertEqual("on arcs; 0 on straight edges" in result.stderr, skin == "curved", result.stderr)

    def test_mistakes_are_said(self):
        case = self.write("tri3.toml", harmonic("tri3"))
        for value in ("-1", "7", "1.5"):
            result = solidus("check", str(case), "--set", f"mesh.refine={value}", cwd=self.folder)
            self.assertEqual(result.returncode, 1)
            self.assertRegex(result.stderr, "refine")
        result = solidus("check", str(SOURCES / "cases/two_blocks"), "--set", "mesh.refine=6", "--set",
                         "mesh.two_blocks.lower_divisions=[90,90,40]", cwd=self.folder)
        self.assertEqual(result.returncode, 1)
        self.assertRegex(result.stderr, r"'refine' is 6: the refined mesh would have 8.5e\+10 elements")
