"""`solidus design`: a search of few runs from a part to a case that runs, and what it refuses."""

import csv
import json
import shutil
import tomllib
import unittest

from program import NIGHTLY, SOURCES, ProgramTest, solidus

PART = SOURCES / "tests/parts/dumbbell.step"
WORDS = ("--alloy", "aluminium_alsi7mg", "--fineness", "0.3", "--runs", "7", "-j", "2", "-o", "found")


class DesignTest(ProgramTest):
    def refusal(self, *arguments):
        result = solidus("design", *arguments, cwd=self.folder)
        self.assertEqual(result.returncode, 1, result.stdout)
        self.assertTrue(result.stderr.startswith("solidus design: "), result.stderr)
        self.assertLessEqual(result.stderr.strip().count("\n"), 1, result.stderr)  # what is allowed, on a line of its own
        return result.stderr

    @unittest.skipUnless(NIGHTLY, "a search of three runs takes two minutes: ./dev nightly")
    def test_two_balls_on_a_thin_bar_get_a_riser_each(self):
        text = self.done("design", str(PART), *WORDS, timeout=600)
        self.assertIn("no riser: holes of", text)
        self.assertIn("sound on a mesh of half the size too", text)
        found = self.folder / "found"
        case = tomllib.loads((found / "case/case.toml").read_text())
        left, right = sorted(float(riser["foot"][1].removesuffix(" mm")) for riser in case["mesh"]["riser"])
        self.assertAlmostEqual(left, -40, delta=2)
        self.assertAlmostEqual(right, 40, delta=2)
        self.assertIn("radiation", {condition["kind"] for condition in case["thermal_condition"]})
        self.assertIn("sleeve", {body["role"] for body in case["body"]})
        self.assertIn("MANIFOLD_SOLID_BREP", (found / "case/risers.step").read_text())
        with (found / "design.csv").open() as file:
            rows = list(csv.DictReader(file))
        self.assertLessEqual(len(rows), 7)
        chosen = json.loads((found / "design.json").read_text())["chosen"]
        self.assertEqual(next(row for row in rows if row["run"] == chosen)["verdict"], "sound")
        self.assertTrue((found / "design.png").exists())
        self.done("check", str(found / "case"), "--heat-only")
        ended = {file: file.stat().st_mtime_ns for file in found.glob("*/run.json")}
        self.done("design", str(PART), *WORDS, "--restart", timeout=600)
        self.assertEqual({file: file.stat().st_mtime_ns for file in found.glob("*/run.json")}, ended)

    def test_bad_input_is_refused_in_one_sentence(self):
        self.assertIn("what is cast?", self.refusal(str(PART)))
        self.assertIn("by its gate", self.refusal(str(PART), "--alloy", "aluminium_alsi9cu3", "--process", "high_pressure"))
        self.assertIn("--pores is a percentage", self.refusal(str(PART), "--alloy", "tin_bronze", "--pores", "-1"))
        self.assertIn("--runs is a whole number", self.refusal(str(PART), "--alloy", "tin_bronze", "--runs", "2"))
        self.assertIn("there is no such file", self.refusal("missing.step", "--alloy", "tin_bronze"))
        shutil.copytree(SOURCES / "cases/two_blocks", self.folder / "blocks")
        self.assertIn("is of no file", self.refusal("blocks"))
        # A folder with a case of somebody else is not written over.
        (self.folder / "mine/case").mkdir(parents=True)
        self.assertIn("not of an earlier search", self.refusal(str(PART), "--alloy", "tin_bronze", "-o", "mine"))


if __name__ == "__main__":
    unittest.main()
