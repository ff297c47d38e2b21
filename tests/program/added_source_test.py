"""A law of heat sources in one file of the tests, which no source, Python or page names, is wherever sources are."""

import csv
import math
import os

import program
from program import ProgramTest, solidus

NAME, KEYS = "decaying", ("initial_power", "lifetime")
#: W/m³ and s of the source; ρ c of the material below [J/(m³ K)]
POWER, LIFETIME, CAPACITY = 2e6, 50.0, 2700.0 * 900.0
CASE = """
title = "An insulated block whose heat of curing fades"
[analysis]
kind = "plane_strain"
physics = "heat"
[mesh]
shape = "block"
element = "quad4"
[mesh.block]
size = ["10 mm", "10 mm"]
divisions = [2, 2]
[time]
end = "100 s"
step = "5 s"
[[body]]
name = "block"
material = "own.toml"
initial_temperature = "20 degC"
[[thermal_condition]]
name = "curing"
group = "block"
kind = "source"
POWER
[[probe]]
name = "mean"
kind = "mean"
field = "temperature"
group = "block"
unit = "K"
"""
LAW = f'law = "{NAME}"\ninitial_power = "{POWER:g} W/m3"\nlifetime = "{LIFETIME:g} s"'
FORMULA = f'power = {{ formula = "{POWER:g} * exp(-t/{LIFETIME:g})" }}'
MATERIAL = """

title = "Block"
density = "2700 kg/m3"
specific_heat = "900 J/kg/K"
conductivity = "100 W/m/K"
"""


class AddedSource(ProgramTest):
    @classmethod
    def setUpClass(cls):
        cls.own, program.PROGRAM = program.PROGRAM, os.environ["SOLIDUS_WITH_ADDED_PARTS"]

    @classmethod
    def tearDownClass(cls):
        program.PROGRAM = cls.own

    def run_with(self, power, folder):
        """The rows of the history of a run with this power."""
        self.write("own.toml", MATERIAL)
        self.write("case.toml", CASE.replace("POWER", power))
        self.done("run", ".", "-o", folder, "--no-progress")
        with (self.folder / folder / "history.csv").open() as file:
            return list(csv.DictReader(file))

    def test_no_file_of_the_program_names_it(self):
        for part in ("src", "python", "web/report/src"):
            for file in (program.SOURCES / part).rglob("*.*"):
                if file.is_file() and file.suffix in (".cpp", ".hpp", ".py", ".ts", ".json"):
                    self.assertNotIn("initial_power", file.read_text(encoding="utf-8"), file)

    def test_it_heats_by_its_integral_and_as_its_formula_does(self):
        by_law = self.run_with(LAW, "law")
        for row in by_law[1:]:
            time = float(row["time[s]"])
            rise = POWER * LIFETIME * (1 - math.exp(-time / LIFETIME)) / CAPACITY
            self.assertAlmostEqual(float(row["mean[K]"]) - 293.15, rise, delta=1e-6 * rise)
        self.assertEqual(by_law, self.run_with(FORMULA, "formula"))

    def test_its_keys_are_checked_and_explained(self):
        self.write("own.toml", MATERIAL)
        for wrong, said in ((LAW.replace('50 s"', '-1 s"'), "lifetime"), (LAW.replace("lifetime", "lifetimes"), "lifetime"),
                            (LAW + '\npower = "1 W/m3"', "'power' does not belong"), ('law = "fading"', "decaying")):
            self.write("case.toml", CASE.replace("POWER", wrong))
            refused = solidus("check", ".", cwd=self.folder)
            self.assertEqual(refused.returncode, 1)
            self.assertIn(said, refused.stderr)
        self.assertIn("e-th part", self.done("explain", "thermal_condition.lifetime"))
