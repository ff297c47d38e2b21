"""Studies and comparisons, from the file to tables and pictures."""

import csv
import os
import signal
import subprocess
import time
import unittest

from program import PATIENCE, PROGRAM, ProgramTest, solidus

CASE = """
title = "A block cools"
[analysis]
kind = "plane_strain"
physics = "heat"
[mesh]
shape = "block"
element = "quad4"
[mesh.block]
size = ["40 mm", "20 mm"]
divisions = [8, 4]
[time]
end = "60 s"
step = "6 s"
[[body]]
name = "block"
material = "aluminium_alsi7mg"
initial_temperature = "700 degC"
[[thermal_condition]]
name = "air"
group = "x_max"
kind = "film"
coefficient = "3000 W/m2/K"
ambient = "20 degC"
[[probe]]
name = "T_far"
field = "temperature"
point = ["0 mm", "0 mm"]
unit = "degC"
[output]
every = "30 s"
"""
STUDY = """
case = "case.toml"
results = ["T_far[degC]"]
[[parameter]]
key = "thermal_condition.air.coefficient"
label = "film"
from = 1000
to = 4000
unit = "W/m2/K"
steps = 2
[[parameter]]
key = "time.step"
values = ["6 s", "no time"]
"""


def rows(file):
    with file.open(newline="") as table:
        return list(csv.DictReader(table))


class Study(ProgramTest):
    def test_failed_runs_are_data_and_two_runs_can_be_compared(self):
        self.write("case.toml", CASE)
        self.write("study.toml", STUDY)
        self.assertIn("4000 W/m2/K", self.done("study", "study.toml", "--dry-run"))
        self.write("slip.toml", STUDY.replace('"time.step"', '"time.stpe"'))
        slip = solidus("study", "slip.toml", "--dry-run", cwd=self.folder)
        self.assertEqual(slip.returncode, 1, slip.stdout)
        self.assertIn("did you mean 'step'", slip.stderr)
        said = self.done("study", "study.toml", "-o", "out", "-j", "2", env={"SOLIDUS_PROCESSES": "2"})
        self.assertIn("4 runs, 2 failed", said)
        self.assertRegex((self.folder / "out/run_1/log.txt").read_text(), r"^1 process of ")  # many runs have a core each
        table = rows(self.folder / "out/study.csv")
        self.assertEqual([row["run"] for row in table], ["run_1", "run_2", "run_3", "run_4"])
        self.assertEqual([row["film[W/m2/K]"] for row in table], ["1000.0", "1000.0", "4000.0", "4000.0"])
        for failed in (table[1], table[3]):
            self.assertIn("no time", failed["outcome"])
            self.assertEqual(failed["T_far[degC]"], "")
        self.assertGreater(float(table[0]["T_far[degC]"]), float(table[2]["T_far[degC]"]) + 1)
        self.assertLess(float(table[0]["block: solid fraction[1]"]), float(table[2]["block: solid fraction[1]"]))
        self.assertTrue((self.folder / "out/study_1.png").exists() or (self.folder / "out/study.png").exists())
        # Runs that have ended are kept.
        before = (self.folder / "out/run_1/run.json").stat().st_mtime_ns
        self.done("study", "study.toml", "-o", "out", "--restart")
        self.assertEqual((self.folder / "out/run_1/run.json").stat().st_mtime_ns, before)

        said = self.done("compare", "out/run_1", "out/run_3", "-o", "difference")
        self.assertIn("the meshes are the same", said)
        history = {row["column of history.csv"]: row for row in rows(self.folder / "difference/history.csv")}
        expected = float(table[2]["T_far[degC]"]) - float(table[0]["T_far[degC]"])
        far = history["T_far[degC]"]
        self.assertAlmostEqual(float(far["B"]) - float(far["A at the end of both"]), expected, places=9)
        fields = {row["field"]: row for row in rows(self.folder / "difference/fields.csv")}
        self.assertLess(float(fields["temperature"]["largest B - A"]), expected + 1e-9)
        self.assertTrue((self.folder / "difference/difference_temperature.png").exists())
        self.assertTrue((self.folder / "difference/history_degC.png").exists())

    def test_a_mistake_in_a_study_is_told_before_anything_runs(self):
        self.write("case.toml", CASE)
        for wrong, text in ((STUDY.replace("steps = 2", "stops = 2"), "unknown key 'stops' in a [[parameter]]"),
                            (STUDY.replace("steps = 2", ""), "needs 'steps' or 'values' in a grid"),
                            (STUDY.replace("air.coefficient", "air.coefficent"), "coefficient"),
                            (STUDY.replace("case.toml", "cases.toml"), "cases.toml")):
            self.write("study.toml", wrong)
            result = solidus("study", "study.toml", "-o", "out", cwd=self.folder)
            self.assertEqual(result.returncode, 1)
            self.assertIn(text, result.stderr)
            self.assertFalse((self.folder / "out").exists())

    def test_ctrl_c_stops_all_runs_with_a_checkpoint(self):
        self.write("case.toml", CASE.replace('end = "60 s"', 'end = "600000 s"'))
        self.write("study.toml", STUDY.replace('values = ["6 s", "no time"]', 'values = ["0.5 s"]'))
        study = subprocess.Popen([PROGRAM, "study", "study.toml", "-o", "out", "-j", "1"], cwd=self.folder, text=True,
                                 stdout=subprocess.PIPE, stderr=subprocess.PIPE, start_new_session=True)
        end = time.monotonic() + 60 * PATIENCE
        while not (self.folder / "out/run_1/checkpoint/state.h5").exists() and time.monotonic() < end:
            time.sleep(0.05)
        os.killpg(study.pid, signal.SIGINT)
        _, said = study.communicate(timeout=60 * PATIENCE)
        self.assertEqual(study.returncode, 130, said)
        self.assertIn("--restart goes on", said)
        self.assertTrue((self.folder / "out/run_1/checkpoint/state.h5").exists())
        self.assertIn("stopped as asked", (self.folder / "out/run_1/log.txt").read_text())
        self.assertFalse((self.folder / "out/run_2").exists())


if __name__ == "__main__":
    unittest.main()
