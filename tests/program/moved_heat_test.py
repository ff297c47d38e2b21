"""`[feeding] moves_heat`: metal that moves takes its heat along, balanced, on two processes and across a restart."""

import csv
import json
import sys
import unittest

from program import SOURCES, ProgramTest, solidus

sys.path.append(str(SOURCES / "tests/nightly"))

from feeding_castings import CASTINGS, case, geometry  # noqa: E402

ALONG = ("--set", "feeding.moves_heat=true")


class MovedHeat(ProgramTest):
    def setUp(self):
        super().setUp()
        plate = CASTINGS[0]
        self.write(f"{plate.name}.geo", geometry(plate))
        self.write("case.toml", case(plate).replace("1000 s", "100 s") + "[feeding]\n")

    def run_case(self, name, *words, processes="1"):
        self.done("run", "case.toml", "--heat-only", "--no-progress", "--processes", processes, "-o", name, *words)
        with (self.folder / name / "feeding.csv").open() as file:
            last = list(csv.DictReader(file))[-1]
        return json.loads((self.folder / name / "summary.json").read_text()), last

    def test_the_balances_close_and_the_pipe_is_deeper(self):
        still, before = self.run_case("still")
        moved, after = self.run_case("moved", *ALONG)
        self.assertLess(abs(float(after["balance_defect[1]"])), 1e-12)
        self.assertLess(moved["relative_energy_defect"], 1e-12)
        # As much is missing, but what has piped no longer draws heat from the metal below, which sinks longer.
        self.assertAlmostEqual(float(after["pipe[m3]"]) / float(before["pipe[m3]"]), 1, delta=0.01)
        self.assertGreater(moved["criteria"]["pipe_1_depth[m]"], 1.1 * still["criteria"]["pipe_1_depth[m]"])

    def test_two_processes_and_a_restart_give_the_same(self):
        one, _ = self.run_case("one", *ALONG)
        two, _ = self.run_case("two", *ALONG, processes="2")
        depth = [each["criteria"]["pipe_1_depth[m]"] for each in (one, two)]
        self.assertAlmostEqual(depth[0] / depth[1], 1, places=4)
        self.run_case("part", *ALONG, "--set", "time.end=600 s")
        self.done("run", "case.toml", "--heat-only", "--no-progress", "--processes", "1", "-o", "part", "--restart", *ALONG)
        self.assertEqual((self.folder / "part/history.csv").read_text(), (self.folder / "one/history.csv").read_text())

    def test_what_it_cannot_is_refused(self):
        result = solidus("run", "case.toml", "-o", "coupled", *ALONG, cwd=self.folder)
        self.assertEqual(result.returncode, 1)
        self.assertIn("metal moves in runs of heat alone", result.stderr)
        result = solidus("check", "case.toml", "--heat-only", *ALONG, "--set", "heat.integration=open", cwd=self.folder)
        self.assertEqual(result.returncode, 1)
        self.assertIn("the open rule cannot yet", result.stderr)
        result = solidus("check", "case.toml", "--heat-only", *ALONG, "--set", "criteria.follow=false", cwd=self.folder)
        self.assertEqual(result.returncode, 1)
        self.assertIn("no feeding is followed", result.stderr)
        result = solidus("check", str(SOURCES / "cases/riser_and_pipe"), "--heat-only", *ALONG, "--set",
                         'body.riser.material="nodular_iron"', cwd=self.folder)
        self.assertEqual(result.returncode, 1)
        self.assertIn("'casting' and 'riser' are of two materials", result.stderr)
        staged = case(CASTINGS[0]).replace('until = "solid"\nend = "60 min"\n', "")
        self.write("stages.toml", 'stage = [{name = "pour", duration = "9 s"}, {name = "cool", duration = "9 s"}]\n'
                   + staged + "[feeding]\nmoves_heat = true\n")
        result = solidus("check", "stages.toml", "--heat-only", cwd=self.folder)
        self.assertEqual(result.returncode, 1)
        self.assertIn("not with stages, shots or bodies that grow", result.stderr)


if __name__ == "__main__":
    unittest.main()
