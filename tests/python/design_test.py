"""The search of `solidus design` with parts whose soundness is known, and what it reads off a run."""

from dataclasses import dataclass
import math
from pathlib import Path
import tempfile
import tomllib
import unittest

import numpy as np

from solidus_plots.design import new_words, parser, share
from solidus_plots.design_feeders import Chill, Design, Riser, chosen_risers
from solidus_plots.design_judgement import Defect, Judgement, Limits, cell_volumes, densest_place, judge
from solidus_plots.design_search import CLOSE, Search, chill_below
from solidus_plots.design_surface import Surface
from solidus_plots.vtu import Grid, ResultError


@dataclass
class HotSpot:
    """Sound where a riser over it is wide and high enough, or a chill lies below it."""

    x: float
    diameter: float  # [mm] that an open riser must have, of 1.1 diameters at least
    chilled: bool = False  # whether a chill does, too

    def fed(self, design):
        if self.chilled and any(chill.lowest[0] < self.x < chill.highest[0] for chill in design.chills):
            return True
        return any(abs(riser.foot[0] - self.x) < riser.diameter and riser.slender >= 1.1
                   and riser.diameter * (1.4 if riser.sleeve else 1.0) >= self.diameter for riser in design.risers)


@dataclass
class DeepPipe:
    """Sound where a riser over it is high enough, if it is as wide as it must be."""

    x: float
    diameter: float
    height: float

    def fed(self, design):
        return any(riser.diameter >= self.diameter and riser.slender * riser.diameter >= self.height for riser in design.risers)


@dataclass
class LowSpot:
    """Below a thin wall: only a riser next to it that is wide enough feeds it, whatever is above."""

    x: float
    diameter: float

    def fed(self, design):
        return any(riser.beside and abs(riser.foot[0] - self.x) < 5 and riser.diameter >= self.diameter
                   for riser in design.risers)


def beside(place, taken):
    """There is room in the direction of y, for a riser of 30 mm."""
    return place, 30.0, (0.0, 1.0, 20.0)


def search(spots, risers, *, sleeves=False, jobs=2, most=22):
    """The trial that is found in a part with these hot spots, and the search."""
    def evaluate(trials):
        for trial in trials:
            bad = [spot for spot in spots if not spot.fed(trial.design)]
            defects = [Defect(np.array([1e-3 * spot.x, 0.0, 0.0]), 1e-6) for spot in bad]
            trial.judgement = Judgement(not bad, ["a hole"] if bad else [], 1e-6 * len(bad), 0.0, 1e-3, 1e-3, 1.0, 1000,
                                        defects)

    found = Search(evaluate, lambda place: (-10.0, 10.0, 10.0), jobs, most, beside)
    return found.run(risers, sleeves), found


def riser(name, x, diameter):
    return Riser(name, (x, 0.0, 8.0), 2.0, diameter)


class SearchTest(unittest.TestCase):
    def test_a_part_that_is_sound_gets_no_riser_after_one_run(self):
        best, all_of = search([], (riser("riser", 0, 60),))
        self.assertEqual(best.design, Design())
        self.assertEqual(len(all_of.trials), 1)

    def test_the_size_is_found_within_what_counts_as_one(self):
        for needed in (31.0, 44.0, 57.0, 90.0):
            best, all_of = search([HotSpot(0, needed)], (riser("riser", 0, 60),))
            self.assertTrue(best.sound())
            self.assertGreaterEqual(best.design.risers[0].diameter, needed)
            self.assertLess(best.design.risers[0].diameter, needed * CLOSE)
            self.assertLessEqual(len(all_of.trials), 22)

    def test_one_run_at_a_time_finds_the_same(self):
        best, _ = search([HotSpot(0, 44.0)], (riser("riser", 0, 60),), jobs=1)
        self.assertLess(best.design.risers[0].diameter, 44.0 * CLOSE)

    def test_risers_are_no_higher_than_they_have_to_be(self):
        best, _ = search([HotSpot(0, 44.0)], (riser("riser", 0, 60),))
        self.assertEqual(best.design.risers[0].slender, 1.2)

    def test_risers_are_slim_where_their_height_counts(self):
        best, all_of = search([DeepPipe(0, 30.0, 75.0)], (riser("riser", 0, 60),))
        self.assertGreater(best.design.risers[0].slender, 2)
        # 30 mm would do with a height of 75 mm: 53 cm3.
        self.assertLess(best.design.metal(), 1.25 * math.pi / 4 * 30 ** 2 * 75)
        self.assertLessEqual(len(all_of.trials), 22)

    def test_sleeves_save_metal(self):
        spots, risers = [HotSpot(0, 44.0)], (riser("riser", 0, 60),)
        self.assertLess(search(spots, risers, sleeves=True)[0].design.metal(), 0.5 * search(spots, risers)[0].design.metal())

    def test_a_riser_that_nothing_needs_is_left_out(self):
        best, _ = search([HotSpot(0, 44.0)], (riser("riser_1", 0, 60), riser("riser_2", 200, 50)))
        self.assertEqual([one.name for one in best.design.risers], ["riser_1"])

    def test_a_chill_takes_the_place_of_a_riser_where_it_does(self):
        best, _ = search([HotSpot(0, 44.0), HotSpot(200, 40.0, chilled=True)],
                         (riser("riser_1", 0, 60), riser("riser_2", 200, 50)))
        self.assertEqual([one.name for one in best.design.risers], ["riser_1"])
        self.assertEqual(len(best.design.chills), 1)

    def test_each_riser_gets_a_size_of_its_own(self):
        best, _ = search([HotSpot(0, 50.0), HotSpot(200, 30.0)], (riser("riser_1", 0, 60), riser("riser_2", 200, 60)))
        first, second = best.design.risers
        self.assertLess(second.diameter, 0.9 * first.diameter)
        self.assertGreaterEqual(first.diameter, 50.0)

    def test_a_hole_beside_all_risers_gets_one_of_its_own(self):
        best, _ = search([HotSpot(0, 50.0), HotSpot(300, 50.0)], (riser("riser", 0, 60),))
        self.assertTrue(best.sound())
        self.assertEqual(len(best.design.risers), 2)
        self.assertAlmostEqual(best.design.risers[1].foot[0], 300)

    def test_what_no_riser_above_feeds_gets_one_beside_it(self):
        for needed in (20.0, 28.0):
            best, all_of = search([HotSpot(0, 50.0), LowSpot(0, needed)], (riser("riser", 0, 60),))
            self.assertTrue(best.sound())
            self.assertEqual([bool(one.beside) for one in best.design.risers], [False, True])
            self.assertLess(best.design.risers[1].diameter, 1.25 * needed)
            self.assertLessEqual(len(all_of.trials), 22)

    def test_what_nothing_feeds_is_told(self):
        best, all_of = search([HotSpot(0, 1e6)], (riser("riser", 0, 60),))
        self.assertIsNone(best)
        self.assertLessEqual(len(all_of.trials), 22)

    def test_there_are_never_more_runs_than_allowed(self):
        for most in (1, 2, 3, 5, 8):
            _, all_of = search([HotSpot(0, 50.0), HotSpot(200, 30.0)], (riser("riser_1", 0, 60), riser("riser_2", 200, 60)),
                               most=most)
            self.assertLessEqual(len(all_of.trials), most)


class FeedersTest(unittest.TestCase):
    def test_the_file_has_what_the_design_has(self):
        design = Design((Riser("riser_1", (1.0, 2.0, 3.0), 2.0, 40.0, 1.5, 0.7, True), riser("riser_2", 90, 30)),
                        (Chill("chill_1", (0, 0, -9), (5, 5, 0)),))
        document = tomllib.loads(design.toml())
        first, second = document["riser"]
        self.assertEqual(first["foot"], ["1 mm", "2 mm", "3 mm"])
        self.assertEqual((first["height"], first["neck_height"], first["neck_diameter"], first["sleeve"]),
                         ("62 mm", "6 mm", "28 mm", "8 mm"))
        self.assertEqual(second["height"], "57 mm")  # it ends where the first one does
        self.assertEqual(document["chill"][0]["highest"], ["5 mm", "5 mm", "0 mm"])

    def test_risers_far_below_the_highest_are_closed(self):
        high = Riser("high", (0, 0, 200.0), 2.0, 40.0)
        self.assertEqual(Design((high, riser("low", 90, 30))).heights(), [62.0, 47.0])

    def test_tops_of_risers_are_the_same_to_the_last_digit(self):
        design = Design((Riser("one", (0, 0, 8.977), 6.109, 28.0), Riser("two", (0, 80, 9.246), 5.864, 28.0))).scaled(0.349)
        tops = [float(riser["foot"][2].removesuffix(" mm")) + float(riser["height"].removesuffix(" mm"))
                for riser in tomllib.loads(design.toml())["riser"]]
        self.assertAlmostEqual(tops[0], tops[1], places=9)

    def test_metal_is_that_of_the_cylinders_above_the_part(self):
        self.assertAlmostEqual(Design((riser("riser", 0, 40.0),)).metal(), math.pi * 400 * 60)
        narrow = Riser("riser", (0, 0, 8.0), 2.0, 40.0, neck=0.5)
        self.assertAlmostEqual(Design((narrow,)).metal(), math.pi * 400 * 56 + math.pi * 100 * 4)

    def test_a_riser_beside_the_part_stands_off_by_its_own_size(self):
        one = Riser("side", (10.0, 0.0, 5.0), 0.0, 40.0, neck=0.5, beside=(1.0, 0.0, 20.0))
        for size in (1.0, 0.5):
            design = Design((one,)).scaled(size)
            entry = tomllib.loads(design.toml())["riser"][0]
            self.assertEqual(entry["neck_to"], ["10 mm", "0 mm", "5 mm"])
            x, y, z = (float(value.removesuffix(" mm")) for value in entry["foot"])
            self.assertAlmostEqual(x, 10 + 20 + 0.65 * 40 * size)
            self.assertEqual(y, 0)
            self.assertAlmostEqual(z, 5 - 0.35 * 40 * size)
            self.assertEqual(entry["neck_diameter"], f"{20 * size:g} mm")
            self.assertNotIn("neck_height", entry)
            self.assertAlmostEqual(design.metal(), math.pi * (20 * size) ** 2 * (1.5 + 0.15 / 4) * 40 * size)
            self.assertTrue(any(change.startswith("mesh.riser.side.foot=") for change in design.settings()))

    def test_the_risers_of_a_new_case_are_read(self):
        with tempfile.TemporaryDirectory() as folder:
            case = Path(folder) / "case.toml"
            case.write_text('[mesh]\nfile = "part.step"\n[[mesh.riser]]\nname = "riser"\nfoot = ["1 mm", "2 mm", "3 mm"]\n'
                            'diameter = "40 mm"\nheight = "62 mm"\nneck_height = "2 mm"\n')
            self.assertEqual(chosen_risers(case), (Riser("riser", (1.0, 2.0, 3.0), 2.0, 40.0),))

    def test_a_chill_lies_below_the_part(self):
        chill = chill_below(np.array([10.0, 0.0, 5.0]), -2.0, 10.0, 1)
        self.assertEqual(chill.lowest, (0.0, -10.0, -14.0))
        self.assertGreater(chill.highest[2], -2.0)


def two_cubes():
    """A cube of 10 mm, the part, and one on top of it, the riser."""
    points = np.array([[x, y, z] for z in (0, 1, 2) for y in (0, 1) for x in (0, 1)], float) * 0.01
    lower = [0, 1, 3, 2, 4, 5, 7, 6]
    connectivity = np.array([*lower, *(node + 4 for node in lower)])
    return Grid(points, np.array([12, 12]), np.array([8, 16]), connectivity,
                {"emptied": np.zeros(12), "unfed_pores": np.zeros(12)}, {"body": np.array([0, 1])}, {}, 0.0)


class JudgementTest(unittest.TestCase):
    limits = Limits(1e-4, 0.01, 0.1)

    def judged(self, grid):
        return judge(grid, [0], [1], ["casting", "riser"], self.limits, 2)

    def test_volumes_of_cells(self):
        np.testing.assert_allclose(cell_volumes(two_cubes()), 1e-6)

    def test_a_part_without_holes_is_sound(self):
        judged = self.judged(two_cubes())
        self.assertTrue(judged.sound)
        self.assertAlmostEqual(judged.part, 1e-6)
        self.assertAlmostEqual(judged.metal, 2e-6)

    def test_a_hole_in_the_part_is_found_with_its_place(self):
        grid = two_cubes()
        grid.point_data["emptied"][:4] = 0.5
        judged = self.judged(grid)
        self.assertFalse(judged.sound)
        self.assertAlmostEqual(judged.holes, 0.25e-6)
        np.testing.assert_allclose(judged.defects[0].place, [0.005, 0.005, 0.005])

    def test_pores_count_above_their_limit_alone(self):
        grid = two_cubes()
        grid.point_data["unfed_pores"][:] = 0.009
        self.assertTrue(self.judged(grid).sound)
        grid.point_data["gas_pores"] = np.full(12, 0.002)
        self.assertFalse(self.judged(grid).sound)

    def test_the_densest_place_is_a_ball_and_no_single_cell(self):
        points = np.stack(np.meshgrid(*3 * [np.arange(20.0)]), axis=-1).reshape(-1, 3)
        volumes, pores = np.ones(8000), np.zeros(8000)
        pores[0] = 1.0
        self.assertLess(densest_place(points, volumes, pores), 0.2)
        pores[np.linalg.norm(points - 10, axis=1) < 5] = 0.3
        self.assertAlmostEqual(densest_place(points, volumes, pores), 0.3)
        self.assertEqual(densest_place(points[:0], volumes[:0], pores[:0]), 0.0)

    def test_a_pipe_down_to_the_foot_is_not_sound_though_the_part_is(self):
        grid = two_cubes()
        grid.point_data["emptied"][8:] = 1.0
        self.assertTrue(self.judged(grid).sound)
        grid.point_data["emptied"][4:8] = 0.2
        self.assertIn("0 % of 'riser' are left below its pipe", self.judged(grid).reasons)

    def test_the_skin_over_and_below_a_place(self):
        low, high, radius = Surface(two_cubes(), [0])([0.0, 0.0, 4.0])
        self.assertEqual((low, high), (0.0, 10.0))
        self.assertAlmostEqual(radius, math.sqrt(75))  # of the middle of the cube, whose skin has nodes at its corners alone

    def test_a_place_beside_the_part_is_the_nearest_that_is_free(self):
        surface = Surface(two_cubes(), [0])
        place, diameter, where = surface.beside([4.0, 4.0, 6.0], [])
        np.testing.assert_allclose(place, [5, 5, 5])
        self.assertAlmostEqual(diameter, 1.2 * 0.45 * math.sqrt(75) / 0.214)
        self.assertEqual(where, (1.0, 0.0, 5.0))
        self.assertEqual(surface.beside([5, 5, 5], [(25.0, 5.0, 5.0, 0.0)])[2], (0.0, 1.0, 5.0))
        # A riser that begins above it is in no way.
        self.assertEqual(surface.beside([5, 5, 5], [(25.0, 5.0, 5.0, 100.0)])[2], (1.0, 0.0, 5.0))
        self.assertIsNone(surface.beside([5, 5, 5], [(5.0, 5.0, 500.0, 0.0)]))


class OptionsTest(unittest.TestCase):
    def words(self, *given):
        return new_words(parser().parse_args(given))

    def test_what_the_part_is_made_of_goes_to_new(self):
        part, words = self.words("part.step", "--alloy=tin_bronze", "--as=a=core")
        self.assertEqual(part, Path("part.step"))
        self.assertEqual(words, ["--alloy", "tin_bronze", "--process", "sand", "--as", "a=core"])

    def test_a_case_says_what_it_was_made_of(self):
        with tempfile.TemporaryDirectory() as folder:
            case = Path(folder) / "case.toml"
            case.write_text('title = "part of tin_bronze, shell"\n[mesh]\nfile = "part.step"\nunit = "mm"\n'
                            '[[body]]\nname = "a"\nrole = "casting"\nmaterial = "tin_bronze"\n')
            part, words = self.words(folder)
            self.assertEqual(part, Path(folder) / "part.step")
            self.assertEqual(words, ["--alloy", "tin_bronze", "--process", "shell", "--unit", "mm"])

    def test_what_cannot_be_is_refused(self):
        with self.assertRaisesRegex(ResultError, "what is cast"):
            self.words("part.step")
        with self.assertRaisesRegex(ResultError, "by its gate"):
            self.words("part.step", "--alloy=x", "--process=high_pressure")
        for text in ("0", "-1", "much", "60"):
            with self.assertRaisesRegex(ResultError, "percentage"):
                share(text, "pores", 50)


if __name__ == "__main__":
    unittest.main()
