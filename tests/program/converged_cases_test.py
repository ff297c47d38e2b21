"""Coupled cases of the project with the steps that the program chooses, against their converged values."""

import unittest

import castings_with_errors as castings
from program import NIGHTLY, SOURCES, ProgramTest

# How far off an answer may be, as a share of itself; pores in points of the casting [%].
MOST = {"solid after": 0.02, "largest gap": 0.05, "largest distortion": 0.05}
PORES = 0.1
# By case its settings and converged values [s, µm, µm, %]. Those of the wheel have a thirtieth of the error of temperature
# and a sixth of the share of the skin by default, those of the bracket with larger elements a sixteenth and a quarter, those
# of the bracket itself a quarter of both (docs/verification/defaults.md).
WHEEL = ("wheel_in_die", ["cycle.1.repeat=1"], {"solid after": 161.3, "largest gap": 387.0, "largest distortion": 476.7})
BRACKET = ("bracket_from_step", [], {"solid after": 147.2, "largest gap": 73.5, "largest distortion": 86.6, "pores": 5.287})
COARSE_BRACKET = ("bracket_from_step", ["mesh.size.1.size=8 mm", "mesh.size.1.smallest=8 mm", "mesh.size.2.size=20 mm"],
                  {"solid after": 143.9, "largest gap": 73.89, "largest distortion": 87.9, "pores": 5.28})


class ConvergedCases(ProgramTest):
    def check(self, case, settings, converged):
        options = [part for setting in settings for part in ("--set", setting)]
        self.done("run", str(SOURCES / "cases" / case), *options, "--no-progress", "-o", "results", timeout=600)
        found = castings.answers(self.summary(self.folder / "results"))
        for answer, value in converged.items():
            with self.subTest(answer=answer, found=found[answer], converged=value):
                most = PORES if answer == "pores" else MOST[answer] * value
                self.assertAlmostEqual(found[answer][0], value, delta=most)

    def test_a_shot_of_the_wheel(self):
        self.check(*WHEEL)

    def test_the_bracket_of_the_guide(self):
        self.check(*(BRACKET if NIGHTLY else COARSE_BRACKET))


if __name__ == "__main__":
    unittest.main()
