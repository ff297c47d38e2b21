"""Measured points and computed curves: shifts, deviations, what is wrong."""

from pathlib import Path
import tempfile
import unittest

from solidus_plots import measured, style
from solidus_plots.vtu import ResultError

SPEC = {"file": "measured", "table": "measured.csv", "each": "place", "x": "z[mm]",
        "travel": {"from": 100, "speed": -2.0},
        "lines": [{"column": "T_a[degC]", "of": "a"}, {"column": "T_b[degC]", "of": "b", "label": "second"}]}


class Measured(unittest.TestCase):
    def setUp(self):
        self._folder = tempfile.TemporaryDirectory()
        self.folder = Path(self._folder.name)
        # T_a = 3 z, T_b = 3 z + 10 at z = 100 - 2 t.
        rows = [f"{t},{3 * (100 - 2 * t)},{3 * (100 - 2 * t) + 10}" for t in range(0, 101)]
        (self.folder / "history.csv").write_text("time[s],T_a[degC],T_b[degC]\n" + "\n".join(rows) + "\n")
        # Measured 4 mm too low.
        points = [f"{name},{z - 4},{3 * z + off}" for name, off in (("a", 0), ("b", 10)) for z in range(-50, 51, 10)]
        (self.folder / "measured.csv").write_text("# by hand\nplace,z[mm],temperature[degC]\n" + "\n".join(points))

    def tearDown(self):
        self._folder.cleanup()

    def comparison(self, **more):
        return measured.Comparison(SPEC | more, self.folder, self.folder / "plots.toml")

    def test_deviation_and_best_shift(self):
        comparison = self.comparison()
        self.assertAlmostEqual(comparison.deviation(comparison.lines[0], 0), 12)
        self.assertAlmostEqual(comparison.deviation(comparison.lines[1], 4), 0)
        self.assertAlmostEqual(comparison.total(5), 3)
        self.assertAlmostEqual(comparison.best_shift(), 4)

    def test_picture(self):
        style.setup()
        files = measured.draw(SPEC | {"shift": 4.0}, self.folder, self.folder / "plots.toml", self.folder)
        self.assertTrue(all(Path(file).exists() for file in files))

    def test_what_is_wrong(self):
        for more, words in (({"table": "other.csv"}, "no such file"), ({"x": "y[mm]"}, "no column y"),
                            ({"lines": [{"column": "T_c[degC]", "of": "a"}]}, "no column T_c"),
                            ({"lines": [{"column": "T_a[degC]", "of": "c"}]}, "no points of 'c'")):
            with self.assertRaisesRegex(ResultError, words):
                self.comparison(**more)


if __name__ == "__main__":
    unittest.main()
