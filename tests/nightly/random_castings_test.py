"""What a user gets who sets nothing: castings by random numbers against steps an eighth as long."""

import os
from pathlib import Path
import sys
import unittest

sys.path.insert(0, str(Path(__file__).resolve().parents[1] / "program"))

import random_castings  # noqa: E402

SEED, COUNT = 1, 12
# How far off an answer may be [%], pores in points of the casting or as a share of themselves.
MOST = {"solid after": 2, "largest gap": 5, "largest distortion": 5}
PORES, SHARE_OF_PORES = 0.05, 0.1


class RandomCastings(unittest.TestCase):
    def test_default_steps_keep_their_word(self):
        folder = Path(os.environ["SOLIDUS_FOLDER"]) / "random_castings"
        for index in range(COUNT):
            drawn = random_castings.casting(SEED, index)
            with self.subTest(casting=drawn.name):
                found = random_castings.compare(os.environ["SOLIDUS_PROGRAM"], folder, drawn)
                print(random_castings.row(drawn, found), flush=True)
                for answer, most in MOST.items():
                    self.assertLess(abs(random_castings.difference(found, answer)), most, answer)
                pores = random_castings.difference(found, "pores")
                if pores is not None:
                    self.assertLess(abs(pores), max(PORES, SHARE_OF_PORES * found["answers"]["pores"][2]), "pores")


if __name__ == "__main__":
    unittest.main()
