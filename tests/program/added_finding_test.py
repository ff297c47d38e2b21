"""A finding in one file of the tests, which no source, Python or page names, is wherever findings are."""

import json
import os
import subprocess
import unittest

from program import ProgramTest

CASE = """
title = "A strip on a steel mould"
[analysis]
kind = "plane_strain"
physics = "heat"
[mesh]
shape = "two_blocks"
element = "quad4"
[mesh.two_blocks]
lower = ["40 mm", "20 mm"]
lower_divisions = [8, 4]
upper = ["40 mm", "{height} mm"]
upper_divisions = [40, 4]
[time]
end = "3 s"
step = "0.1 s"
[[body]]
name = "upper"
material = "aluminium_alsi7mg"
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
conductance = "{conductance} W/m2/K"
gap_law = "constant"
"""
SAID = "the walls of 'upper' are 1.45 mm thick in the mean: melt freezes on its way; 3 mm and more in sand"


class AddedFinding(ProgramTest):
    def solidus(self, *arguments):
        return subprocess.run([os.environ["SOLIDUS_WITH_ADDED_PARTS"], *arguments], cwd=self.folder, capture_output=True, text=True)

    def write_case(self, height, conductance="2000"):
        self.write("case.toml", CASE.format(height=height, conductance=conductance))

    def test_a_run_and_check_say_it(self):
        self.write_case(1.5)
        checked = self.solidus("check", "case.toml")
        self.assertEqual(checked.returncode, 0, checked.stderr)
        self.assertIn(SAID, checked.stderr + checked.stdout)
        run = self.solidus("run", "case.toml", "-o", "results", "--no-progress")
        self.assertEqual(run.returncode, 0, run.stderr)
        warnings = json.loads((self.folder / "results/summary.json").read_text())["warnings"]
        self.assertTrue(any(SAID in warning for warning in warnings), warnings)

    def test_nothing_is_said_of_thicker_walls(self):
        self.write_case(10)
        self.assertNotIn("the walls of", self.solidus("check", "case.toml").stderr)

    def test_it_has_its_place_among_the_others(self):
        self.write_case(1.5, conductance="2000000")
        said = self.solidus("check", "case.toml", "--set", 'time.step="2 s"').stderr
        self.assertLess(said.index("conducts 2e+06 W/m2/K"), said.index("the walls of"))
        self.assertLess(said.index("the walls of"), said.index("freezes within some"))

    def test_the_page_and_the_list_have_its_row(self):
        row = "| thin walls | a body that is poured has 2 V/A below 2 mm | warning |"
        page = self.solidus("explain", "--findings", "--manual").stdout
        self.assertIn(row, page[page.index("## What is poured"):page.index("## Mesh")])
        self.assertIn("thin walls: a body that is poured has 2 V/A below 2 mm (warning)",
                      self.solidus("explain", "--findings", "what is poured").stdout)


if __name__ == "__main__":
    unittest.main()
