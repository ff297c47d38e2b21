"""The intervals of `solidus calibrate` hold the truth as often as they say: a hundred seeds of noise of 0.5 K on the thermocouples
of examples/thermocouples, eight points of a conductance and an emissivity."""

import os
from pathlib import Path
import sys
import unittest

import numpy as np

SOURCES = Path(__file__).resolve().parents[2]
sys.path.insert(0, str(SOURCES / "python"))

from solidus_plots import calibrate  # noqa: E402
from solidus_plots.calibrate_file import read_calibration  # noqa: E402
from solidus_plots.calibrate_fit import Search, fit  # noqa: E402
from solidus_plots.calibrate_model import Model, probes_of, resolved_case  # noqa: E402
from solidus_plots.calibrate_readings import read_readings  # noqa: E402
from solidus_plots.calibrate_statistics import evaluate  # noqa: E402

EXAMPLE = SOURCES / "examples/thermocouples"
TRUE = np.array([600, 680, 800, 1000, 1350, 1800, 2300, 2700, 0.28])
NOISE = 0.5
SEEDS = int(os.environ.get("SOLIDUS_SEEDS", "100"))


class Intervals(unittest.TestCase):
    def test_they_hold_the_truth_in_nine_of_ten(self):
        calibration = read_calibration(EXAMPLE / "calibrate.toml")
        case = resolved_case(calibrate.resolve(str(EXAMPLE), []))
        readings = read_readings(calibration, EXAMPLE / "logger.csv", probes_of(case), calibrate.end_of(case), lambda text: None)
        parameters = calibration.parameters()
        model = Model(str(EXAMPLE), [], calibration, readings, Path(os.environ["SOLIDUS_FOLDER"]) / "calibrate", 1, True)
        truth = model.predict(TRUE, True)
        sigma = np.full(len(truth.values), NOISE)
        held, runs = np.zeros(len(parameters)), 0
        for seed in range(SEEDS):
            measured = truth.values + NOISE * np.random.default_rng(seed).standard_normal(len(truth.values))
            model.runs = 0
            search = Search(model, measured, sigma, 15)
            # The search begins at the truth: where it ends does not hang on that, and it takes fewer runs.
            search.known[tuple(search.scaled(TRUE))] = truth
            found = fit(search, start=search.scaled(TRUE))
            self.assertTrue(found.converged, found.message)
            runs += model.runs
            estimates = evaluate(found, parameters, readings, 0.9).estimates
            held += [e.low <= true <= e.high for e, true in zip(estimates, TRUE)]
        print("\n" + "\n".join(f"{p.name:16} {share:.0f} of {SEEDS}" for p, share in zip(parameters, held)))
        print(f"all {100 * held.sum() / held.size / SEEDS:.1f} %, {runs / SEEDS:.1f} runs a seed", flush=True)
        self.assertTrue(0.87 <= held.sum() / held.size / SEEDS <= 0.93, held)
        self.assertTrue(np.all(held >= 0.8 * SEEDS), held)


if __name__ == "__main__":
    unittest.main()
