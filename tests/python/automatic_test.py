"""The pictures that every run gets: what is drawn of which run, hot spots, curves that do not hide each other."""

from pathlib import Path
import tempfile
import unittest

from blocks import box, everything
import matplotlib.pyplot as plt
import numpy as np

from solidus_plots import automatic, hot_spots, moments, overview, style
from solidus_plots.cells import HEX
from solidus_plots.curves import _give_height, _panels, unit_groups
from solidus_plots.history import Table
from solidus_plots.moments import Moments
from solidus_plots.vtu import Grid

SIZE = (0.04, 0.02, 0.02)


def frozen(grid):
    """A casting whose right half froze last at (0.035, 0.01, 0.01), its left half at (0.005, 0.01, 0.01)."""
    distance = [np.linalg.norm(grid.points - point, axis=1) for point in ([0.035, 0.01, 0.01], [0.005, 0.01, 0.01])]
    time = np.maximum(100 - 4e3 * distance[0], 80 - 4e3 * distance[1])
    grid.point_data = {"temperature": 500 + time, "solid_fraction": np.ones(len(time)), "solidified_at": time,
                       "niyama": np.where(grid.points[:, 0] > 0.02, 500.0, 2000.0), "gap": 1e-4 * grid.points[:, 0],
                       "distortion": 0.01 * grid.points, "displacement": 0.01 * grid.points}
    grid.cell_data["von_mises"] = 1e6 * np.arange(1.0, 1 + len(grid.cell_types))
    grid.units = {"temperature": "K", "solid_fraction": "1", "solidified_at": "s", "niyama": "1", "gap": "m",
                  "distortion": "m", "displacement": "m", "von_mises": "Pa"}
    return grid


class Run(Moments):
    """One moment, not read from files."""

    def __init__(self, grid):
        super().__init__(np.array([grid.time]), [None], ["part"])
        self._grids[0] = grid


class HotSpots(unittest.TestCase):
    def test_the_hottest_spot_is_where_it_froze_last_or_is_least_solid(self):
        grid = frozen(box(HEX, SIZE, (8, 4, 4)))
        np.testing.assert_allclose(hot_spots.hottest(grid, everything(grid)), [0.035, 0.01, 0.01])
        solid = grid.point_data["solid_fraction"]
        solid[np.linalg.norm(grid.points - [0.01, 0.01, 0.01], axis=1) < 1e-9] = 0.2
        np.testing.assert_allclose(hot_spots.hottest(grid, everything(grid)), [0.01, 0.01, 0.01])

    def test_every_place_that_froze_after_its_surroundings_is_a_hot_spot(self):
        grid = frozen(box(HEX, SIZE, (8, 4, 4)))
        spots = hot_spots.all_of(grid, everything(grid))
        self.assertEqual([round(spot.value) for spot in spots], [100, 80])
        np.testing.assert_allclose(spots[1].point, [0.005, 0.01, 0.01])


class Sheets(unittest.TestCase):
    def setUp(self):
        style.setup()
        style.plt.rcParams["savefig.dpi"] = 60  # quick
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = Path(folder.name)

    def test_a_casting_gets_every_field_that_matters_without_plots_toml(self):
        run = Run(frozen(box(HEX, SIZE, (8, 4, 4))))
        summary = {"title": "A block", "variant": "default", "answers": {"castings": {"part": {}}}}
        history = {"time[s]": np.array([0.0]), "solid_fraction[1]": np.array([1.0])}
        case, sheets = automatic.plan(run, np.array([0.0]), summary, history, self.folder, {})
        self.assertEqual([sheet["field"] for sheet in sheets],
                         ["temperature", "solidified_at", "niyama", "gap", "distortion", "von_mises"])
        niyama = sheets[2]
        self.assertEqual(niyama["below"], 0.775)
        self.assertEqual(case.corner, "A block")
        for sheet in sheets:
            file, = overview.draw(sheet, run, case, self.folder)
            self.assertGreater(file.stat().st_size, 5_000, file)

    def test_marks_of_places_without_a_value_are_not_drawn_as_numbers(self):
        grid = frozen(box(HEX, SIZE, (8, 4, 4)))
        right = grid.points[:, 0] > 0.021
        grid.point_data["hardness"] = np.where(right, 150.0 + 1e3 * grid.points[:, 0], -1.0)
        grid.units["hardness"] = "1"
        kind, values = moments.values(grid, {"field": "hardness", "unit": "1"})
        self.assertEqual(kind, "point_data")
        np.testing.assert_array_equal(np.isfinite(values), right)
        self.assertGreater(np.nanmin(values), 150)
        self.assertIn("least 175", overview._extremes(grid, everything(grid), {"field": "hardness", "unit": "1"}, "xyz"))

    def test_criteria_of_a_die_are_drawn_of_the_die(self):
        grid = frozen(box(HEX, SIZE, (8, 4, 4)))
        cells = len(grid.cell_types)
        grid.cell_data["body"] = np.arange(cells) // (cells // 2)
        die = np.zeros(len(grid.points), bool)
        die[moments.nodes_of(grid, grid.cell_data["body"] == 1)] = True
        casting = np.zeros(len(grid.points), bool)
        casting[moments.nodes_of(grid, grid.cell_data["body"] == 0)] = True
        grid.point_data["shots_until_crack"] = np.where(die & ~casting, np.where(grid.points[:, 1] > 0.011, 1e8, 1e4), -1.0)
        grid.units["shots_until_crack"] = "1"
        run = Moments(np.array([0.0]), [None], ["part", "die"])
        run._grids[0] = grid
        summary = {"answers": {"castings": {"part": {}}}}
        history = {"time[s]": np.array([0.0]), "solid_fraction[1]": np.array([1.0])}
        case, sheets = automatic.plan(run, np.array([0.0]), summary, history, self.folder, {})
        life, = (sheet for sheet in sheets if sheet["field"] == "shots_until_crack")
        self.assertEqual(life["bodies"], ["die"])
        self.assertEqual(life["range"], [0, 2e5])  # lives of a hundred million shots say nothing
        self.assertIn(np.flatnonzero((grid.points == life["through"]).all(axis=1))[0], np.flatnonzero(die & ~casting))
        overview.draw(life, run, case, self.folder)
        corner = {**life, "through": grid.points[die].min(axis=0) - 1e-3}  # planes that miss the die are left out
        self.assertEqual(len(overview._views([grid], run, corner, case)), 1)
        overview.draw(corner, run, case, self.folder)

    def test_castings_that_have_left_are_shown_as_they_were_before(self):
        names, times = ["part", "die"], np.arange(6.0)  # poured at 0 and 3; away at 2 and 5
        grids = [frozen(box(HEX, SIZE, (8, 4, 4))) for _ in times]
        for time, grid in zip(times, grids):
            grid.time, cells = time, len(grid.cell_types)
            grid.cell_data["body"] = np.full(cells, 1) if time in (2, 5) else np.arange(cells) // (cells // 2)
        run = Moments(times, [None] * 6, names)
        run._grids.update(enumerate(grids))
        summary = {"answers": {"castings": {"part": {}}}}
        history = {"time[s]": times, "solid_fraction[1]": np.array([0, 0.5, 1, 0, 0.5, 1]),
                   "time_since_pouring[s]": np.array([0.0, 1, 2, 3, 1, 2])}
        _, sheets = automatic.plan(run, times, summary, history, self.folder, {})
        by_file = {sheet["file"]: sheet for sheet in sheets}
        self.assertEqual(by_file["overview_solidified_at"]["times"], [4.0])
        self.assertEqual(by_file["overview_temperature"]["times"], [4.0])  # of the second shot alone
        self.assertIn("before the casting leaves", by_file["overview_temperature_end"]["title"])

    def test_plane_bodies_are_shown_whole_and_gaps_along_their_rim(self):
        x, y = np.meshgrid(np.arange(5), np.arange(4), indexing="ij")
        points = 0.01 * np.stack([x, y, 0 * x], axis=-1).reshape(-1, 3)
        corner = np.array([4 * i + j for i in range(4) for j in range(3)])
        cells = corner[:, None] + [0, 4, 5, 1]
        grid = frozen(Grid(points, np.full(12, 9), 4 * (1 + np.arange(12)), cells.ravel(), {},
                           {"body": np.zeros(12, int)}, {}, 0.0))
        inside = (points[:, :2] > 0.001).all(axis=1) & (points[:, 0] < 0.039) & (points[:, 1] < 0.029)
        grid.point_data["gap"] = np.where(inside, 1.0, 1e-4)  # an inner node has no gap: its value must not be shown
        run = Run(grid)
        history = {"time[s]": np.array([0.0]), "solid_fraction[1]": np.array([1.0])}
        case, sheets = automatic.plan(run, np.array([0.0]), {}, history, self.folder, {})
        self.assertFalse(case.solid)
        gap, = (sheet for sheet in sheets if sheet["field"] == "gap")
        view, = overview._views([grid], run, gap, case)
        np.testing.assert_allclose(view.values(), np.full(14, 0.1))  # mm
        for sheet in sheets:
            overview.draw(sheet, run, case, self.folder)

    def test_least_and_largest_values_are_told_with_their_places(self):
        grid = frozen(box(HEX, SIZE, (8, 4, 4)))
        text = overview._extremes(grid, everything(grid), {"field": "solidified_at"}, "xyz")
        self.assertTrue(text.startswith("largest 100 s at (35, 10, 10) mm"), text)
        text = overview._extremes(grid, everything(grid), {"field": "von_mises", "unit": "MPa"}, "xyz")
        self.assertIn("least 1 MPa at (2.5, 2.5, 2.5) mm", text)
        text = overview._extremes(grid, everything(grid), {"field": "niyama", "below": 0.775}, "xyz")
        self.assertEqual(text, "least 0.5 √(K s)/mm at (25, 0, 0) mm")
        grid.point_data["niyama"] = np.full(len(grid.points), 500.0)
        text = overview._extremes(grid, everything(grid), {"field": "niyama", "below": 0.775}, "xyz")
        self.assertEqual(text, "0.5 √(K s)/mm everywhere")

    def test_values_that_lie_between_the_cuts_do_not_end_a_picture(self):
        grid = frozen(box(HEX, SIZE, (8, 4, 4)))
        inside = np.linalg.norm(grid.points - [0.015, 0.005, 0.005], axis=1) < 1e-6
        self.assertEqual(inside.sum(), 1)
        grid.point_data["niyama"] = np.where(inside, 500.0, 2000.0)
        run = Run(grid)
        history = {"time[s]": np.array([0.0]), "solid_fraction[1]": np.array([1.0])}
        case, sheets = automatic.plan(run, np.array([0.0]), {}, history, self.folder, {})
        niyama, = (sheet for sheet in sheets if sheet["field"] == "niyama")
        file, = overview.draw(niyama, run, case, self.folder)
        self.assertGreater(file.stat().st_size, 5_000)


class Curves(unittest.TestCase):
    def panels(self, **lines):
        return _panels(Table({name: np.array(values, float) for name, values in lines.items()}), list(lines))

    def test_lines_of_other_sizes_get_panels_of_their_own(self):
        self.assertEqual(self.panels(a=[0, 1000], b=[0, 20], c=[0, 0.1], d=[500, 0]),
                         [[["a"], ["d"]], [["b"]], [["c"]]])

    def test_lines_that_hide_each_other_are_one_with_both_names(self):
        self.assertEqual(self.panels(a=[0, 1000], b=[0, 1001], c=[0, 500]), [[["a", "b"], ["c"]]])

    def test_no_panel_has_more_lines_than_one_can_tell_apart(self):
        panels = self.panels(**{f"T_{i}": [20, 100 + 50 * i] for i in range(15)})
        self.assertEqual([len(panel) for panel in panels], [5, 5, 5])

    def test_what_does_not_change_is_flat(self):
        _, axes = plt.subplots()
        axes.plot([20, 20 + 8e-7])
        _give_height(axes)
        self.assertTrue(axes.get_ylim()[0] < 19.5 and axes.get_ylim()[1] > 20.5)
        _, axes = plt.subplots()
        axes.plot([20, 21])
        _give_height(axes)
        self.assertTrue(19.5 < axes.get_ylim()[0] < 20)

    def test_a_unit_of_which_all_stays_zero_gets_no_picture(self):
        history = Table({"time[s]": np.array([0.0, 1.0]), "T_max[degC]": np.array([700.0, 690.0]),
                         "contact_force[N]": np.zeros(2)})
        with tempfile.TemporaryDirectory() as folder:
            unit_groups(history, Path(folder))
            self.assertEqual(sorted(file.name for file in Path(folder).glob("*.png")), ["history_degC.png"])


if __name__ == "__main__":
    unittest.main()
