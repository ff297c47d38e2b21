"""The ten tests of cases/ten_tests: right answers are those of their scripts, scores are what they say, and Solidus keeps its own."""

import csv
import importlib
import os
from pathlib import Path
import subprocess
import sys
import unittest

from program import PROGRAM, SOURCES, ProgramTest

TEN = SOURCES / "cases/ten_tests"
sys.path.insert(0, str(TEN))
score = importlib.import_module("score")

# Errors that the program has with its defaults, and a fifth more; a change that makes one smaller lowers its line.
BOUNDS = {"stefan": 1.1e-3, "alloy": 2.9e-3, "corner": 1.1e-3, "clamped_cube": 1e-6, "weiner_boley": 2.2e-2, "closing_gap": 1.5e-3,
          "plastic_work": 8.7e-3, "ring_on_core": 6.3e-4, "pipe": 1.7e-3, "rubbing": 1.5e-3}


def python(*arguments, cwd=TEN):
    return subprocess.run([sys.executable, *map(str, arguments)], cwd=cwd, capture_output=True, text=True,
                          env={**os.environ, "SOLIDUS_PROGRAM": PROGRAM})


class TenTests(ProgramTest):
    def test_right_answers_are_those_of_the_scripts(self):
        for test in score.TESTS:
            with self.subTest(test=test):
                extra = ["--coarse"] if test == "corner" else []
                done = python(TEN / test / "right.py", "--print", *extra)
                self.assertEqual(done.returncode, 0, done.stderr)
                found = list(csv.DictReader(done.stdout.splitlines()))
                kept = score.right(test)
                self.assertEqual([row["name"] for row in found], [row["name"] for row in kept])
                share = 1e-2 if extra else 1e-6  # grids that take half a second are off by 0.2 K
                for a, b in zip(found, kept):
                    self.assertAlmostEqual(float(a["value"]), float(b["value"]), delta=share * float(b["scale"]), msg=b["name"])

    def test_solidus_keeps_its_scores(self):
        done = python("run.py", "--code", "solidus", "-o", self.folder, "--keep", self.folder / "runs")
        self.assertEqual(done.returncode, 0, done.stderr)
        for test, bound in BOUNDS.items():
            with self.subTest(test=test):
                names = [row["name"] for row in score.right(test)]
                answer = score.read_answer(self.folder / "solidus" / f"{test}.csv", names)
                self.assertEqual(sorted(answer), sorted(names))
                self.assertLess(score.error_of(score.errors(test, answer)), bound)

    def test_scores_follow_their_rule(self):
        self.assertEqual([round(score.points(e), 6) for e in (0, 1e-3, 1e-2, 0.1, 1)], [10, 10, 5, 0, 0])
        right = {row["name"]: float(row["value"]) for row in score.right("pipe")}
        self.assertEqual(score.error_of(score.errors("pipe", right)), 0)
        volume = right.pop("volume")  # a number that is missing is wrong by its whole scale: one of five
        self.assertAlmostEqual(score.error_of(score.errors("pipe", right)), 0.2**0.5)
        self.assertAlmostEqual(score.error_of(score.errors("pipe", {**right, "volume": 1.01 * volume})), 0.01 * 0.2**0.5, places=6)

    def test_answers_that_are_no_answers_are_refused(self):
        for text, said in (("name,value\nT_10m,5\n", "'T_10m' is not asked for"), ("name,value\nT_10mm,x\n", "'x' is no number"),
                           ("name,value\nT_10mm,1\nT_10mm,2\n", "answered twice"), ("place,value\n", "must name the columns")):
            done = python("score.py", "corner", self.write("answer.csv", text))
            self.assertEqual(done.returncode, 1)
            self.assertIn(said, done.stderr)
        self.assertIn("there is no test 'corners'", python("score.py", "corners", "answer.csv").stderr)

    def test_both_formats_of_a_mesh_have_the_same_nodes(self):
        for test in score.TESTS:
            text = (TEN / test / "mesh.inp").read_text().splitlines()
            start = text.index("*NODE, NSET=all") + 1
            inp = [[float(x) for x in line.split(",")[1:]] for line in text[start:next(
                i for i in range(start, len(text)) if text[i].startswith("*"))]]
            lines = (TEN / test / "mesh.msh").read_text().splitlines()
            start = lines.index("$Nodes") + 2
            msh = [[float(x) for x in line.split()[1:]] for line in lines[start:start + int(lines[start - 1])]]
            self.assertEqual(inp, msh, test)

    def test_the_page_is_made_of_the_answers(self):
        done = python("page.py", "--check")
        self.assertEqual(done.returncode, 0, done.stderr)


if __name__ == "__main__":
    unittest.main()
