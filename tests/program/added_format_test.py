"""A format of export in one file of the tests, which no source, Python or page names, is wherever formats are."""

import csv
import os
import subprocess
import unittest

from program import ProgramTest

CASE = """
title = "A block that cools"
[analysis]
kind = "plane_strain"
physics = "heat"
[mesh]
shape = "block"
element = "quad4"
[mesh.block]
size = ["40 mm", "20 mm"]
divisions = [4, 2]
[time]
end = "20 s"
step = "5 s"
[output]
every = "10 s"
[[body]]
name = "block"
material = "steel_mould"
initial_temperature = "200 degC"
[[thermal_condition]]
name = "air"
group = "x_max"
kind = "film"
coefficient = "500 W/m2/K"
ambient = "20 degC"
"""


class AddedFormat(ProgramTest):
    def solidus(self, *arguments):
        return subprocess.run([os.environ["SOLIDUS_WITH_ADDED_PARTS"], *arguments], cwd=self.folder, capture_output=True, text=True)

    def test_it_is_written(self):
        self.write("case.toml", CASE)
        self.done("run", "case.toml", "-o", "out", "--no-progress")
        written = self.solidus("export", "out", "--ranges", "ranges.csv")
        self.assertEqual((written.returncode, written.stdout), (0, "ranges.csv: ranges at 3 times\n"), written.stderr)
        with open(self.folder / "ranges.csv", newline="", encoding="utf-8") as file:
            rows = [row for row in csv.DictReader(file) if row["field"] == "temperature"]
        self.assertEqual([float(row["time[s]"]) for row in rows], [0, 10, 20])
        self.assertEqual([float(rows[0][name]) for name in ("least", "largest")], [473.15, 473.15])
        self.assertLess(float(rows[2]["least"]), float(rows[1]["least"]))
        self.assertLess(float(rows[1]["least"]), 473.15)

    def test_it_has_its_place_in_help_completion_and_manual_page(self):
        shown = self.solidus("help", "export").stdout
        self.assertLess(shown.index("--vtkhdf FILE"), shown.index("--ranges FILE"))
        self.assertLess(shown.index("--ranges FILE"), shown.index("--med FILE"))
        self.assertIn("A table of the least and largest value of each field at each time", shown)
        for words in (("completion", "bash"), ("man",)):
            self.assertIn("--ranges", self.solidus(*words).stdout.replace("\\-", "-"), words)

    def test_it_is_refused_as_others_are(self):
        self.write("out/case.toml", CASE)
        for arguments, said in (((), "--calculix FILE, --abaqus FILE, --vtkhdf FILE, --ranges FILE or --med FILE"),
                                (("--ranges", "a", "--med", "b"), "export needs one format and the file to write"),
                                (("--ranges", "a", "--deformed"), "--deformed and --temperature-history are for --calculix and --abaqus"),
                                (("--ranges", "a"), "the folder has no fields.pvd")):
            refused = self.solidus("export", "out", *arguments)
            self.assertEqual(refused.returncode, 1)
            self.assertIn(said, refused.stderr)


if __name__ == "__main__":
    unittest.main()
