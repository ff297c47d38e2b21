"""A conductance over the gap that opens in a casting is found at the cost of fifteen runs: the cylinder of
cases/aluminium_cylinder in its mould, eight points of h(gap) and an emissivity from three thermocouples, from a flat
start, without noise and with one of 0.5 K."""

import os
from pathlib import Path
import sys
import unittest

import numpy as np

SOURCES = Path(__file__).resolve().parents[2]
sys.path.insert(0, str(SOURCES / "python"))

from solidus_plots import calibrate  # noqa: E402
from solidus_plots.calibrate_file import read_calibration  # noqa: E402
from solidus_plots.calibrate_model import Model, probes_of, resolved_case  # noqa: E402
from solidus_plots.calibrate_readings import read_readings  # noqa: E402
from solidus_plots.calibrate_statistics import evaluate  # noqa: E402

CASE = """
include = "%s"
title = "A cylinder in its mould, with a top that radiates"
[[thermal_condition]]
name = "top"
group = "part_top"
kind = "radiation"
emissivity = 0.4
ambient = "25 degC"
[criteria]
follow = false
"""
UNKNOWNS = """
set = ['coupling.order="mechanics_first"']
coarse = ["mesh.cylinder_in_mould.element_size=3 mm", "mesh.cylinder_in_mould.mould_element_size=6 mm"]
[[observation]]
column = "T_center"
noise = 0.5
[[observation]]
column = "T_casting_surface"
noise = 0.5
[[observation]]
column = "T_mould_surface"
noise = 0.5
[[unknown]]
name = "h"
key = "contact.interface.heat.gap_conductance"
also = "contact.interface.heat.conductance"
of = "gap"
argument_unit = "mm"
at = [0, 0.005, 0.01, 0.02, 0.03, 0.045, 0.06, 0.08]
unit = "W/m2/K"
start = 1000
lower = 50
upper = 20000
[[unknown]]
name = "emissivity"
key = "thermal_condition.top.emissivity"
start = 0.6
upper = 1
"""
TRUE = np.array([2300, 2250, 2200, 1400, 1137.5, 743.75, 350, 325, 0.4])
COST = 15  # runs without derivatives


class Gap(unittest.TestCase):
    def setUp(self):
        self.folder = Path(os.environ["SOLIDUS_FOLDER"]) / "calibrate_gap"
        self.folder.mkdir(parents=True, exist_ok=True)
        self.case = self.folder / "case.toml"
        self.case.write_text(CASE % (SOURCES / "cases/aluminium_cylinder/case.toml"))
        (self.folder / "calibrate.toml").write_text(UNKNOWNS)
        # The readings of the table are replaced by computed ones; only their times count.
        lines = ["time[s],T_center[degC],T_casting_surface[degC],T_mould_surface[degC]"]
        lines += [f"{t},{300 + t},{301 + t},{200 + t}" for t in range(1, 91)]
        (self.folder / "measured.csv").write_text("\n".join(lines) + "\n")

    def test_it_is_found_at_the_cost_of_fifteen_runs(self):
        calibration = read_calibration(self.folder / "calibrate.toml")
        calibration.runs = COST
        words = [word for assignment in calibration.set for word in ("--set", assignment)]
        case = resolved_case(calibrate.resolve(str(self.case), words))
        readings = read_readings(calibration, self.folder / "measured.csv", probes_of(case), 90.0, lambda text: None)
        model = lambda name, words: Model(str(self.case), words, calibration, readings, self.folder / name, 1, True, True)
        before = calibrate.processor_seconds()
        truth = model("truth", words).predict(TRUE, False).values
        one = calibrate.processor_seconds() - before
        coarser = calibrate.check_coarse(str(self.case), words, calibration, case, readings, True)
        for noise in (0.0, 0.5):
            scatter = noise * np.random.default_rng(1).standard_normal(len(truth))
            at = 0
            for r in readings:
                r.values = truth[at:at + len(r.values)] + scatter[at:at + len(r.values)]
                at += len(r.values)
            before, fine = calibrate.processor_seconds(), model(f"noise_{noise}", words)
            found = calibrate.search_and_fit(fine, readings, calibration, print, model(f"coarse_{noise}", coarser))
            cost = (calibrate.processor_seconds() - before) / one
            off = np.log(found.theta / TRUE)
            print(f"noise {noise} K: the cost of {cost:.1f} runs, {fine.runs} runs and {fine.with_derivatives} of them with "
                  f"derivatives after the coarse ones; off by {np.round(off, 5)}", flush=True)
            self.assertTrue(found.converged, found.message)
            if noise == 0:
                self.assertLess(np.max(np.abs(off)), 1e-5)
            else:
                deviation = np.array([e.deviation for e in evaluate(found, model("", words).parameters, readings, 0.9).estimates])
                self.assertTrue(np.all((np.abs(off) < 0.02) | (np.abs(off) < 2.5 * deviation)), (off, deviation))
            self.assertLess(cost, COST)


if __name__ == "__main__":
    unittest.main()
