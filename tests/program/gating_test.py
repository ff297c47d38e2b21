"""Gating that `solidus new` makes: one body of sprue, runner and ingate, from its sizes to the answers of the run."""

import math
import unittest

from program import SOURCES, ProgramTest, solidus

# At the thin end of the plate, 10 mm high: half a millimetre within it, the runner level, the sprue upright.
GATING = """[[gating]]
name = "gating_1"
gate = ["149.5 mm", "30 mm", "5 mm"]
gate_size = ["20 mm", "8 mm"]
gate_length = "12 mm"
runner_size = ["16 mm", "16 mm"]
sprue = ["215 mm", "30 mm", "90 mm"]
foot_diameter = "12 mm"
top_diameter = "20 mm"
"""


def frustum(height, first, second):
    return math.pi * height / 3 * (first**2 + first * second + second**2)


class Gating(ProgramTest):
    def new(self, *words):
        self.write("gating.toml", GATING)
        return solidus("new", str(SOURCES / "tests/parts/stepped_plate.step"), "--alloy", "aluminium_alsi7mg", "--process", "sand",
                       "--gating", "gating.toml", "--fineness", "0.6", "-o", "case", *words, cwd=self.folder)

    def test_is_a_body_whose_mass_is_that_of_its_sizes(self):
        made = self.new()
        self.assertEqual(made.returncode, 0, made.stderr)
        self.assertIn("MANIFOLD_SOLID_BREP", (self.folder / "case/risers.step").read_text())
        self.done("run", "case", "--heat-only", "--no-progress", "-o", "out", timeout=300)
        castings = self.summary(self.folder / "out")["answers"]["castings"]
        gating = castings["gating_1"]
        self.assertTrue(gating["gating"])
        # Ingate without what lies in the plate, runner to behind the sprue, sprue above the runner [cm3].
        volume = 1e-3 * (20 * 8 * 11.5 + 16 * 16 * (65.5 + 8 - 12) + frustum(89, 6, 10) - frustum(16, 6, 6 + 4 * 16 / 89))
        plate = castings["casting"]
        self.assertAlmostEqual(gating["mass[kg]"] / plate["mass[kg]"] / (volume / 195), 1, delta=0.02)
        # The thin gating freezes before the plate, whose thickest step is 35 mm high.
        self.assertLess(gating["last_melt_froze"]["value[s]"], plate["last_melt_froze"]["value[s]"])

    def test_of_a_runner_that_misses_the_sprue_is_refused(self):
        self.write("gating.toml", GATING.replace('["215 mm", "30 mm", "90 mm"]', '["150 mm", "30 mm", "90 mm"]'))
        made = solidus("new", str(SOURCES / "tests/parts/stepped_plate.step"), "--alloy", "aluminium_alsi7mg", "--process", "sand",
                       "--gating", "gating.toml", "-o", "case", cwd=self.folder)
        self.assertEqual(made.returncode, 1, made.stdout)
        self.assertIn("gating.toml", made.stderr)


if __name__ == "__main__":
    unittest.main()
