"""What docs/guide/versions.md promises: a case of every version since 0.1.0 runs with the program of today."""

import csv
import re
import unittest

from program import SOURCES, ProgramTest

RELEASES = SOURCES / "tests/releases"
VERSION = re.search(r"project\(solidus VERSION ([\d.]+)", (SOURCES / "CMakeLists.txt").read_text())[1]
# The case of 0.1.0 is one of the monograph's: ten seconds of it, on a coarse mesh.
SHORTENED = {"0.1.0": ["time.end=10 s", "mesh.cylinder_in_mould.element_size=3 mm", "mesh.cylinder_in_mould.mould_element_size=6 mm"]}


class Versions(ProgramTest):
    def last_row(self, version):
        """The end of a run of the version's case: the columns of its history."""
        options = [word for change in SHORTENED.get(version, []) for word in ("--set", change)]
        said = self.done("run", RELEASES / version, "-o", version, *options, timeout=600)
        self.assertIn(f"Results in {version}", said)
        with (self.folder / version / "history.csv").open() as file:
            return {name: float(value) for name, value in list(csv.DictReader(file))[-1].items()}

    def test_every_version_has_a_case(self):
        self.assertEqual({folder.name for folder in RELEASES.iterdir()},
                         {"0.1.0", *(page.stem for page in (SOURCES / "docs/releases").glob("[0-9]*.md"))})
        self.assertIn(VERSION, {folder.name for folder in RELEASES.iterdir()})

    def test_the_case_of_0_1_0_runs_as_it_was_written(self):
        last = self.last_row("0.1.0")
        self.assertEqual(last["time[s]"], 10)
        # The casting freezes from the mould inwards and has shrunk away from it.
        self.assertAlmostEqual(last["T_center[degC]"], 660, delta=2)
        self.assertTrue(550 < last["T_casting_surface[degC]"] < 655, last)
        self.assertTrue(250 < last["T_mould_surface[degC]"] < 450, last)
        self.assertTrue(0.5 < last["solid_fraction[1]"] < 1, last)
        self.assertTrue(0.002 < last["gap[mm]"] < 0.05, last)

    def test_the_case_of_0_2_0_runs_as_it_was_written(self):
        last = self.last_row("0.2.0")
        self.assertEqual(last["solid_fraction[1]"], 1)  # it ends when all is solid
        self.assertLess(last["time[s]"], 600)
        self.assertTrue(400 < last["T_middle[degC]"] < 577, last)


if __name__ == "__main__":
    unittest.main()
