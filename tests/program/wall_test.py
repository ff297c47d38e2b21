"""The wall of experiments: its page is that of what is kept, quick rows come out again, and mistakes in its files are reported."""

import json
import subprocess
import sys
import unittest
from pathlib import Path

from program import PROGRAM, SOURCES, ProgramTest

from solidus_docs import wall


class Wall(ProgramTest):
    def test_the_page_is_that_of_what_is_kept(self):
        self.assertEqual(wall.page(), (SOURCES / "docs/validation/wall.md").read_text())
        kept = json.loads((SOURCES / "docs/validation/wall.json").read_text())
        self.assertEqual(list(kept), list(wall.experiments()))
        self.assertGreaterEqual(len(kept), 8)

    def test_quick_rows_come_out_again(self):
        kept = json.loads((SOURCES / "docs/validation/wall.json").read_text())
        for name in ("contraction", "arm_spacing", "liquidus", "iron_density", "iron_expansion", "weld_cracking"):
            spec, program = wall.experiments()[name], wall.Program(PROGRAM)
            found = wall.COMPUTE[spec["kind"]](spec, program, Path(self.folder))
            for now, then in zip(found, kept[name]["values"], strict=True):
                with self.subTest(experiment=name, row=then["name"]):
                    self.assertAlmostEqual(now["computed"], then["computed"], delta=1e-3 * abs(then["computed"]))

    def test_a_width_lies_between_two_probes(self):
        history = {"T_0um[degC]": [20, 1800, 900], "T_25um[degC]": [20, 1400, 900], "T_37.5um[degC]": [20, 1200, 900], "time[s]": [0, 1, 2]}
        self.assertAlmostEqual(wall.width(history, 1300), 2 * 31.25)

    def test_what_is_lost_between_two_temperatures_is_between_rows(self):
        history = {"end[mm]": [0.0, -1.0, -3.0, -7.0], "T[degC]": [600, 500, 300, 100]}
        row = {"column": "fall of end[mm] from 550 to 200 of T[degC]"}
        self.assertAlmostEqual(wall.answer(row, history, 2), 2 * (5.0 - 0.5))
        with self.assertRaisesRegex(ValueError, r"'T\[degC\]' does not cool past 50 in the run"):
            wall.answer({"column": "fall of end[mm] from 550 to 50 of T[degC]"}, history, 1)
        with self.assertRaisesRegex(ValueError, "there is no column 'length'"):
            wall.answer({"column": "fall of length from 550 to 50 of T[degC]"}, history, 1)

    def test_a_property_of_a_card_is_a_number_or_between_two_rows_of_a_table(self):
        text = "  density                       7100 kg/m3\n  expansion                     of temperature [1/K]\n" \
               "                                     20 degC  1.05e-05\n                                    200 degC  1.17e-05\n  next  1 K\n"
        self.assertEqual(wall.property_of(text, "density", float("nan")), 7100)
        self.assertAlmostEqual(wall.property_of(text, "expansion", 110), 1.11e-5)
        with self.assertRaisesRegex(ValueError, "'expansion' of the card has no value at 300 degC"):
            wall.property_of(text, "expansion", 300)
        with self.assertRaisesRegex(ValueError, "the card has no number or table 'hardness'"):
            wall.property_of(text, "hardness", 20)

    def test_pairs_that_errors_cover_are_not_distinguished(self):
        rows = [{"name": name, "measured": value, "error": error} for name, value, error in (("a", 1, 0.1), ("b", 2, 0.5), ("c", 2.8, 0.5))]
        self.assertEqual([(low["name"], high["name"]) for low, high in wall.distinguished(rows)], [("a", "b"), ("a", "c")])

    def test_each_unit_has_its_own_figures(self):
        values = [{"unit": unit, "measured": 10.0, "error": 1.0, "computed": computed, "computed_error": 0.0}
                  for unit, computed in (("N", 12.0), ("mm", 10.5))]
        self.assertEqual(wall.summary(values), "2 N root mean square (20 % of the mean), +2 on average, 0.5 mm root mean square "
                                               "(5 % of the mean), +0.5 on average; 1 of 2 within both errors")

    def test_mistakes_are_said_with_their_file(self):
        file = self.write("experiment.toml", 'title = "a"\norder = 1\nkinds = "values"\n')
        with self.assertRaisesRegex(ValueError, "experiment.toml: 'kinds' is no key of an experiment"):
            wall.read_experiment(file)
        file.write_text('title = "a"\norder = 1\n')
        with self.assertRaisesRegex(ValueError, "experiment.toml: the key 'kind' is missing"):
            wall.read_experiment(file)
        file = self.write("measured.csv", "name,measured,error\na,1.0,much\n")
        with self.assertRaisesRegex(ValueError, "row 1: 'error' must be a number; found 'much'"):
            wall.read_measured(file)
        done = subprocess.run([sys.executable, "-m", "solidus_docs.wall", "nothing"], capture_output=True, text=True, cwd=SOURCES)
        self.assertEqual(done.returncode, 1)
        self.assertIn("there is no experiment 'nothing'; there are billet_aa6060", done.stderr)


if __name__ == "__main__":
    unittest.main()
