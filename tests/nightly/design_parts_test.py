"""`solidus design` on ten parts: a design that is sound on a mesh of half the size, in less than twenty minutes of two cores, with
at most 0.8 of the metal of `--riser auto` where that is sound; on three of them no design of a grid is sound with less."""

import os
from pathlib import Path
import shutil
import sys
import unittest

sys.path.insert(0, str(Path(__file__).parent))

from design_parts import PARTS, least_of_grid, measured, row_of  # noqa: E402

SECONDS = 2 * 1200  # of processor time
OF_GUESS = 0.8  # metal of risers over that of --riser auto
OF_GRID = 1.05  # over the least of the grid


class DesignOfTenParts(unittest.TestCase):
    def test_each_is_sound_with_little_metal(self):
        root = Path(os.environ["SOLIDUS_FOLDER"]) / "design_parts"
        shutil.rmtree(root, ignore_errors=True)
        for part in PARTS:
            with self.subTest(part=part.name()):
                known = measured(part, root)
                print(row_of(known), flush=True)
                self.assertIsNotNone(known["chosen"], known["text"][-2000:])
                self.assertEqual(known["chosen"]["verdict"], "sound")
                self.assertLess(known["seconds"], SECONDS)
                metal, guess, least = known["chosen"]["risers[cm3]"], known["guess"], least_of_grid(known)
                if guess is not None and guess.sound():
                    self.assertLessEqual(metal, OF_GUESS * 1e-3 * guess.design.metal())
                if least is not None:
                    self.assertLessEqual(known["coarse"]["risers[cm3]"], OF_GRID * 1e-3 * least.design.metal())
                # A part that needs none gets none.
                if known["none"]["verdict"] == "sound":
                    self.assertEqual(metal, 0)


if __name__ == "__main__":
    unittest.main()
