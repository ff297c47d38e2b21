"""What `solidus calibrate` computes besides its runs: tables of loggers, the search, intervals, what readings cannot see."""

import math
from pathlib import Path
import tempfile
import unittest

import numpy as np

from solidus_plots.calibrate import outside_text
from solidus_plots.calibrate_file import Parameter, read_calibration
from solidus_plots.calibrate_fit import RunFailed, Search, fit
from solidus_plots.calibrate_model import Prediction, assignments, lagged
from solidus_plots.calibrate_readings import Readings, read_readings
from solidus_plots.calibrate_statistics import evaluate, named, quantile_of
from solidus_plots.logger_table import read_logger
from solidus_plots.vtu import ResultError

GERMAN = """\
Messung;Ofen 3;;;
Beginn;12.11.2026 23:59:58;;;
Uhrzeit;TC1;TC2;TC3;TC4
hh:mm:ss;°C;°C;°C;°C
23:59:58,0;699,5;20,1;24,0;9999
23:59:59,0;690,25;21,0;24,0;9999
00:00:00,0;681,0;22,5;24,0;9999
00:00:01,0;672,75;;24,0;9999
00:00:02,0;665,0;27,0;24,0;9999
"""


class Folder(unittest.TestCase):
    def setUp(self):
        self.temporary = tempfile.TemporaryDirectory()
        self.addCleanup(self.temporary.cleanup)
        self.folder = Path(self.temporary.name)

    def write(self, name, text):
        (self.folder / name).write_text(text, encoding="utf-8")
        return self.folder / name

    def refused(self, function, *arguments):
        with self.assertRaises(ResultError) as raised:
            function(*arguments)
        return str(raised.exception)


class Loggers(Folder):
    def test_semicolons_decimal_commas_and_a_clock_past_midnight_are_read(self):
        table = read_logger(self.write("ofen.csv", GERMAN))
        self.assertEqual((table.separator, table.decimal), (";", ","))
        self.assertEqual(list(table.time), [0, 1, 2, 3, 4])
        self.assertEqual(list(table.lines), [5, 6, 7, 8, 9])
        first = table.columns["TC1"]
        self.assertEqual(first.unit, "°C")
        self.assertEqual(list(first.values), [699.5, 690.25, 681.0, 672.75, 665.0])
        self.assertEqual(first.dead, "")
        self.assertTrue(math.isnan(table.columns["TC2"].values[3]))

    def test_dead_channels_are_named_with_their_lines(self):
        columns = read_logger(self.write("ofen.csv", GERMAN)).columns
        self.assertEqual(columns["TC3"].dead, "it says 24 from line 5 to 9: a dead channel")
        self.assertEqual(columns["TC4"].dead, "0 readings from line 5 on: an open circuit or no sensor")

    def test_large_numbers_are_readings_but_for_temperatures(self):
        rows = "\n".join(f"{3600 * hour},{500 - hour},{9000 + 1000 * hour},{9999 if hour > 3 else hour}" for hour in range(6))
        table = read_logger(self.write("t.csv", "time[s],TC1[degC],force[N],TC2[degC]\n" + rows + "\n"))
        self.assertEqual(table.time[-1], 18000)
        np.testing.assert_array_equal(table.columns["force"].values, 9000.0 + 1000 * np.arange(6))
        self.assertEqual(np.isnan(table.columns["TC2"].values).sum(), 2)

    def test_a_wire_that_breaks_has_readings_before(self):
        table = read_logger(self.write("t.csv", "time [min],A [degC]\n0,20\n1,30\n2,40\n3,OL\n4,OL\n"))
        self.assertEqual(list(table.time), [0, 60, 120, 180, 240])
        self.assertEqual((table.columns["A"].dead, table.columns["A"].open_from), ("", 5))

    def test_what_cannot_be_read_is_refused_with_its_line(self):
        self.assertIn("t.csv:4: the clock goes from 2 s to 1 s: time must rise",
                      self.refused(read_logger, self.write("t.csv", "time[s],A[K]\n0,1\n2,1\n1,1\n")))
        self.assertIn("t.csv:3: '12x' in the column 'A' is no number",
                      self.refused(read_logger, self.write("t.csv", "time[s],A[K]\n0,1\n2,12x\n3,1\n")))
        self.assertIn("t.csv:1: the unit of the time is not known",
                      self.refused(read_logger, self.write("t.csv", "time,A[K]\n0,1\n2,2\n3,1\n")))
        self.assertIn("no line has a time and a reading", self.refused(read_logger, self.write("t.csv", "hello\nworld\n")))


CALIBRATION = """
[logger]
begin = 1.0
[[observation]]
column = "TC1"
probe = "T"
noise = "no"
[[unknown]]
name = "h"
key = "thermal_condition.air.coefficient"
unit = "W/m2/K"
start = 100
"""


class Files(Folder):
    def calibration(self, text):
        return read_calibration(self.write("calibrate.toml", text))

    def test_what_is_wrong_is_refused_with_what_is_allowed(self):
        file = self.write("calibrate.toml", CALIBRATION)
        self.assertEqual(self.refused(read_calibration, file), f"{file}: [[observation]] 'T': 'noise' is a number, not 'no'")
        for change, message in (
                (("noise = \"no\"", "noice = 1"), "unknown key 'noice' in an [[observation]]; there are bore, column, every"),
                (("noise = \"no\"\n", ""), None),
                (("start = 100", "start = 100\nlower = 200"), "'start' 100 lies within the bounds 200 to inf"),
                (("start = 100", "start = 100\nprior = 90"), "a prior is a value, 'prior', and its standard deviation"),
                (("column =", "bore = { bead = 1 }\ncolumn ="), "bore has a 'diameter' in mm, larger than that of the 'bead'"),
                (("column =", "bore = { diameter = 2 }\ncolumn ="), "bore: 'direction' is a list of two or three numbers"),
                (("column =", "bore = { wide = 2 }\ncolumn ="), "unknown key 'wide' in 'bore' of an [[observation]]"),
                (("[[unknown]]", "bore = { diameter = 2, direction = [1, 0] }\n[[unknown]]\nname = \"depth\"\nkind = \"place\"\n"
                  "probe = \"T\"\ndirection = [1, 0]\n[[unknown]]"), "the place of 'T' is an [[unknown]] and that in its bore too"),
                (("[logger]", "coarse = \"time.step=2 s\"\n[logger]"), "'coarse' is a list of assignments as after --set"),
                (("start = 100", "start = 100\nat = [1, 2]"), "the points of a table have 'of'")):
            text = CALIBRATION.replace("noise = \"no\"\n", "") if "noise" not in change[0] else CALIBRATION
            file = self.write("calibrate.toml", text.replace(*change))
            if message is None:
                read_calibration(file)
            else:
                self.assertIn(message, self.refused(read_calibration, file))

    def test_readings_have_the_time_of_the_case_and_the_unit_of_the_probe(self):
        calibration = self.calibration(CALIBRATION.replace('noise = "no"\n', ""))
        said = []
        readings, = read_readings(calibration, self.write("ofen.csv", GERMAN), {"T[K]": {}}, 10.0, said.append)
        self.assertEqual(list(readings.time), [0, 1, 2, 3])
        np.testing.assert_allclose(readings.values, [963.4, 954.15, 945.9, 938.15])
        self.assertIn("column 'TC1': 1 readings before the start of the case are left out", said)
        self.assertTrue(any("'TC4' is not used: 0 readings" in text for text in said))

    def test_times_outside_of_the_run_and_dead_columns_are_refused(self):
        calibration = self.calibration(CALIBRATION.replace('noise = "no"\n', ""))
        table = self.write("ofen.csv", GERMAN)
        self.assertIn("ofen.csv:9: 4 s of the logger is 3 s of the case, which ends at 2.5 s",
                      self.refused(read_readings, calibration, table, {"T[K]": {}}, 2.5, print))
        dead = self.calibration(CALIBRATION.replace('noise = "no"\n', "").replace("TC1", "TC3"))
        self.assertIn("column 'TC3': it says 24 from line 5 to 9: a dead channel; leave out its [[observation]]",
                      self.refused(read_readings, dead, table, {"T[K]": {}}, 10.0, print))

    def test_a_table_of_unknowns_becomes_one_assignment(self):
        unknown, = self.calibration(CALIBRATION.replace('noise = "no"\n', "").replace(
            "start = 100", 'start = [1, 2]\nof = "gap"\nargument_unit = "mm"\nat = [0, 0.1]\nalso = ["contact.a.x"]')).unknowns
        self.assertEqual(assignments(unknown, [3.0, 4.5]), [
            'thermal_condition.air.coefficient={ of = "gap", argument_unit = "mm", unit = "W/m2/K", points = [[0.0, 3.0], '
            '[0.1, 4.5]] }', "contact.a.x=3.0 W/m2/K"])


class Sensors(unittest.TestCase):
    def test_a_lag_of_first_order_has_its_closed_form_on_a_ramp_and_behind_a_kink(self):
        time, lag, slope = np.array([0.0, 1.0, 3.0, 4.0]), 1.7, -12.0
        ramp = 900 + slope * time
        np.testing.assert_allclose(lagged(time, ramp, lag), ramp - slope * lag * (1 - np.exp(-time / lag)), rtol=1e-13)
        kink = np.where(time < 2, ramp, ramp[1] + 0 * time)
        np.testing.assert_allclose(lagged(time, kink, lag)[2:], kink[1] + (lagged(time, ramp, lag)[1] - kink[1])
                                   * np.exp(-(time[2:] - 1.0) / lag), rtol=1e-13)


class Clocks(unittest.TestCase):
    def test_readings_that_a_clock_moves_out_of_the_run_are_counted(self):
        class Fast:
            def times(self, readings, theta):
                return readings.time + theta[0]
        readings = [Readings("T", "T[degC]", 0.0, None, np.array([0.5, 5.0, 9.5]), np.zeros(3), np.arange(3))]
        self.assertEqual(outside_text(Fast(), readings, [0.0], 10.0), "")
        self.assertIn("clock that was found: 1; they are compared", outside_text(Fast(), readings, [0.7], 10.0))
        self.assertIn("clock that was found: 1; they are compared", outside_text(Fast(), readings, [-0.7], 10.0))


class Lump:
    """A lump that cools, Θ = Θ_a + (Θ_0 − Θ_a) exp(−t/τ) with the rate 1/τ and the start for unknowns: a model whose
    derivatives are in closed form, in place of runs."""

    forward, dear = True, False

    def __init__(self, parameters, forward=True):
        self.parameters, self.forward, self.runs = parameters, forward, 0
        self.time = np.linspace(0.5, 30.0, 40)

    def in_runs(self):
        return range(len(self.parameters))

    def predict(self, theta, derivatives):
        self.runs += 1 + (0 if self.forward or not derivatives else len(theta))
        rate, start = theta[:2]
        decay = np.exp(-rate * self.time)
        slopes = [-self.time * (start - 20) * decay, decay] + [0 * decay] * (len(theta) - 2)
        return Prediction(20 + (start - 20) * decay, np.array(slopes).T if derivatives else None)


def parameter(name, start, prior=None, deviation=None, logarithmic=False, low=-np.inf, high=np.inf):
    return Parameter(name, "1/s", start, low, high, logarithmic, prior, deviation)


class Fits(unittest.TestCase):
    TRUE = np.array([0.1, 680.0])

    def found(self, noise=0.0, seed=0, forward=True, loss="linear", stated=False, further=(), start=(0.03, 600.0), spoil=None):
        parameters = [parameter("rate", start[0], logarithmic=True, low=0.0), parameter("start", start[1]), *further]
        model = Lump(parameters, forward)
        truth = Lump(parameters).predict(np.concatenate([self.TRUE, np.ones(len(further))]), False).values
        measured = truth + noise * np.random.default_rng(seed).standard_normal(len(truth))
        if spoil:
            measured[spoil] += 200
        sigma = np.full(len(measured), noise if stated else 1.0)
        found = fit(Search(model, measured, sigma, 60), loss)
        readings = [Readings("T", "T[degC]", 0.0, noise if stated else None, model.time, measured, np.arange(len(measured)))]
        return found, evaluate(found, parameters, readings, 0.9)

    def test_without_noise_the_truth_is_found_in_few_runs(self):
        found, _ = self.found()
        np.testing.assert_allclose(found.theta, self.TRUE, rtol=1e-8)
        self.assertTrue(found.converged)
        self.assertLessEqual(found.runs, 10)

    def test_a_point_at_which_a_run_fails_makes_the_step_shorter(self):
        model = Lump([parameter("rate", 0.03, logarithmic=True, low=0.0), parameter("start", 600.0)])
        measured, whole, refused = model.predict(self.TRUE, False).values, model.predict, []

        def predict(theta, derivatives):
            if abs(np.log(theta[0] / 0.03)) > 0.3 and not refused:
                refused.append(theta)
                raise RunFailed("the run in here failed")
            return whole(theta, derivatives)
        model.predict = predict
        found = fit(Search(model, measured, np.ones(len(measured)), 60))
        np.testing.assert_allclose(found.theta, self.TRUE, rtol=1e-6)
        self.assertEqual(len(refused), 1)

    def test_a_rough_search_stays_where_readings_still_feel_the_unknowns(self):
        model = Lump([parameter("rate", 0.03, logarithmic=True, low=0.0), parameter("start", 600.0)])
        coarse = fit(Search(model, np.full(len(model.time), 680.0), np.ones(len(model.time)), 60), rough=True)
        self.assertAlmostEqual(coarse.theta[0], 0.03 * np.exp(-1.5), delta=1e-12)
        search = Search(model, model.predict(self.TRUE, False).values, np.ones(len(model.time)), 60)
        np.testing.assert_allclose(fit(search, start=search.scaled(coarse.theta)).theta, self.TRUE, rtol=1e-6)

    def test_updated_derivatives_find_it_too(self):
        found, _ = self.found(forward=False)
        np.testing.assert_allclose(found.theta, self.TRUE, rtol=1e-6)
        self.assertLessEqual(found.runs, 25)

    def test_intervals_hold_the_truth_as_often_as_they_say(self):
        for stated in (False, True):
            held = np.zeros(2)
            for seed in range(400):
                _, statistics = self.found(noise=3.0, seed=seed, stated=stated, start=(0.09, 660.0))
                held += [e.low <= true <= e.high for e, true in zip(statistics.estimates, self.TRUE)]
            # 400 seeds know a share of 0.9 to 0.015; three times that.
            self.assertTrue(np.all(np.abs(held / 400 - 0.9) < 0.045), held)

    def test_an_outlier_rules_squares_and_not_a_robust_loss(self):
        squares, _ = self.found(noise=0.3, spoil=5)
        robust, _ = self.found(noise=0.3, spoil=5, loss="cauchy")
        self.assertGreater(abs(squares.theta[0] / 0.1 - 1), 0.008)
        self.assertLess(abs(robust.theta[0] / 0.1 - 1), 0.001)
        self.assertLess(robust.weights[5], 0.01)

    def test_what_no_reading_depends_on_is_refused_unless_a_prior_says_it(self):
        with self.assertRaises(ResultError) as raised:
            self.found(noise=1.0, further=[parameter("blind", 1.0)])
        self.assertIn("no reading depends on 'blind'", str(raised.exception))
        _, statistics = self.found(noise=1.0, further=[parameter("blind", 1.0, prior=1.0, deviation=0.2)])
        self.assertAlmostEqual(statistics.estimates[2].deviation, 0.2, delta=1e-6)
        self.assertEqual([list(shares) for _, shares in statistics.unseen], [["blind"]])

    def test_a_value_at_its_bound_says_so(self):
        model = Lump([parameter("rate", 0.2, logarithmic=True, low=0.15), parameter("start", 600.0)])
        measured = model.predict(self.TRUE, False).values
        found = fit(Search(model, measured, np.ones(len(measured)), 40))
        readings = [Readings("T", "T[degC]", 0.0, None, model.time, measured, np.arange(len(measured)))]
        rate, start = evaluate(found, model.parameters, readings, 0.9).estimates
        self.assertTrue(rate.at_bound and not start.at_bound)
        self.assertAlmostEqual(rate.value, 0.15)

    def test_unknowns_that_weigh_alike_keep_their_order(self):
        self.assertEqual(list(named(np.array([0.1, 0.7, -0.7 - 1e-12]), ["a", "b", "c"]))[:2], ["b", "c"])
        self.assertEqual(list(named(np.array([0.1, -0.7 - 1e-12, 0.7]), ["a", "b", "c"]))[:2], ["b", "c"])

    def test_quantiles_are_those_of_student(self):
        # Student (1908) as tabulated by Abramowitz and Stegun, table 26.10.
        for freedom, quantile, within in ((1, 6.314, 1e-3), (2, 2.920, 1e-3), (3, 2.353, 3e-3), (5, 2.015, 1e-3),
                                          (10, 1.812, 1e-3), (30, 1.697, 1e-3), (None, 1.645, 1e-3)):
            self.assertAlmostEqual(quantile_of(0.9, freedom), quantile, delta=within)


if __name__ == "__main__":
    unittest.main()
