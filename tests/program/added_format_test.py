"""A format of export and one of fields, each in one file of the tests, which no source, Python or page names, are wherever formats are."""

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


class WithAddedParts(ProgramTest):
    def solidus(self, *arguments):
        return subprocess.run([os.environ["SOLIDUS_WITH_ADDED_PARTS"], *arguments], cwd=self.folder, capture_output=True, text=True)

    def rows(self, file):
        with open(self.folder / file, newline="", encoding="utf-8") as table:
            return list(csv.DictReader(table))


class AddedFormat(WithAddedParts):
    def test_it_is_written(self):
        self.write("case.toml", CASE)
        self.done("run", "case.toml", "-o", "out", "--no-progress")
        written = self.solidus("export", "out", "--ranges", "ranges.csv")
        self.assertEqual((written.returncode, written.stdout), (0, "ranges.csv: ranges at 3 times\n"), written.stderr)
        rows = [row for row in self.rows("ranges.csv") if row["field"] == "temperature"]
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


class AddedFormatOfFields(WithAddedParts):
    def run_case(self, *arguments):
        ran = self.solidus("run", "case.toml", "-o", "out", "--no-progress", *arguments)
        self.assertEqual(ran.returncode, 0, ran.stderr)

    def test_a_run_writes_it_where_its_key_says_so_on_any_number_of_processes_and_takes_it_away_again(self):
        self.write("case.toml", CASE)
        self.run_case("--set", "output.extremes=true")
        rows = self.rows("out/extremes.csv")
        self.assertEqual([float(row["time[s]"]) for row in rows], [0, 10, 20])
        for which in ("least", "largest"):
            self.assertAlmostEqual(float(rows[0][f"temperature_{which}[K]"]), 473.15, 9)
        self.assertLess(float(rows[2]["temperature_least[K]"]), float(rows[1]["temperature_least[K]"]))
        self.assertTrue((self.folder / "out/fields.pvd").exists())
        self.run_case("--set", "output.extremes=true", "--processes", "2")
        for one, two in zip(rows, self.rows("out/extremes.csv"), strict=True):
            for name, value in one.items():
                self.assertAlmostEqual(float(two[name]), float(value), delta=1e-6 * max(1, abs(float(value))), msg=name)
        self.run_case()
        self.assertFalse((self.folder / "out/extremes.csv").exists())

    def test_a_continued_run_goes_on_with_it(self):
        self.write("case.toml", CASE)
        self.run_case("--set", "output.extremes=true")
        whole = (self.folder / "out/extremes.csv").read_bytes()
        self.run_case("--set", "output.extremes=true", "--set", "time.end=10 s")
        self.assertEqual(len(self.rows("out/extremes.csv")), 2)
        self.run_case("--set", "output.extremes=true", "--restart")
        self.assertEqual((self.folder / "out/extremes.csv").read_bytes(), whole)

    def test_its_key_is_explained_and_checked_as_others_are(self):
        shown = self.solidus("explain", "output").stdout
        self.assertLess(shown.index("extremes"), shown.index("vtkhdf"))
        shown = self.solidus("explain", "output.extremes").stdout
        self.assertIn("The least and largest value of each field at each output time", " ".join(shown.split()))
        self.assertIn("extremes", self.solidus("schema").stdout)
        self.write("case.toml", CASE.replace("[output]", "[output]\nextremes = 3"))
        refused = self.solidus("run", "case.toml", "-o", "out")
        self.assertEqual(refused.returncode, 1)
        self.assertIn("case.toml:16:12: 'extremes' is the number 3\n  expected true or false", refused.stderr)


if __name__ == "__main__":
    unittest.main()
