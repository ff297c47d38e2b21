"""The errors that a run states of its answers against runs with half the element and an eighth of the step: they must hold the
truth in 17 of 20 and be no more than four times the error in the median."""

import os
from pathlib import Path
import statistics
import sys
import unittest

sys.path.insert(0, str(Path(__file__).resolve().parents[1] / "program"))

import castings_with_errors as castings  # noqa: E402


class StatedErrors(unittest.TestCase):
    def test_of_all_castings(self):
        folder = Path(os.environ["SOLIDUS_FOLDER"]) / "answer_errors"
        by_answer = {}
        for name in castings.NAMES:
            for answer, value, stated, error in castings.stated(os.environ["SOLIDUS_PROGRAM"], folder, name):
                print(f"{name:20} {answer:20} {value:9.4g} ± {stated:8.2g}, off by {error:8.2g}{'' if stated >= error else ' *'}", flush=True)
                by_answer.setdefault(answer, []).append((stated, error))
        for answer, pairs in by_answer.items():
            held = sum(stated >= error for stated, error in pairs)
            ratio = statistics.median(stated / max(error, 1e-12) for stated, error in pairs)
            print(f"{answer}: held in {held} of {len(pairs)}, {ratio:.2g} times the error in the median", flush=True)
        pairs = [pair for of_answer in by_answer.values() for pair in of_answer]
        self.assertGreaterEqual(sum(stated >= error for stated, error in pairs), 0.85 * len(pairs))
        self.assertLessEqual(statistics.median(stated / max(error, 1e-12) for stated, error in pairs), 4)


if __name__ == "__main__":
    unittest.main()
