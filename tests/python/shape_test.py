"""Measured shapes: nearest places on a surface with their side, fits that find a known motion, STL and points of any hand."""

from argparse import Namespace
import json
from pathlib import Path
import tempfile
import tracemalloc
import unittest

from blocks import box, everything
import numpy as np

from solidus_plots import compare_shape, shape_fit
from solidus_plots.cells import HEX
from solidus_plots.pattern_mesh import skin
from solidus_plots.shape_points import read_points
from solidus_plots.triangle_surface import Surface, read_stl, write_stl
from solidus_plots.vtu import ResultError

SIZE = np.array([0.08, 0.05, 0.02])


def block(counts=(8, 5, 2)):
    """The skin of a box from the origin."""
    grid = box(HEX, tuple(SIZE), counts)
    triangles, extend = skin(grid, everything(grid))
    return compare_shape.used_surface(extend(grid.points), triangles)


def on_skin(surface, count, seed=2):
    """Points of the skin by chance."""
    rng = np.random.default_rng(seed)
    triangle = rng.choice(len(surface.triangles), count, p=surface.areas / surface.areas.sum())
    return np.einsum("pc,pci->pi", rng.dirichlet([1, 1, 1], count), surface.points[surface.triangles[triangle]])


class NearestPlaces(unittest.TestCase):
    def test_distances_to_a_box_are_those_of_the_formula_with_their_side(self):
        surface = block()
        self.assertAlmostEqual(surface.volume(), SIZE.prod(), delta=1e-18)
        places = np.random.default_rng(1).uniform(-0.5, 1.5, (600, 3)) * SIZE
        outside = np.linalg.norm(np.maximum(np.maximum(-places, places - SIZE), 0), axis=1)
        within = np.minimum(places, SIZE - places).min(axis=1)
        found = surface.nearest(places)
        np.testing.assert_allclose(found.distance, np.where(within > 0, -within, outside), rtol=0, atol=1e-15)
        np.testing.assert_allclose(found.of(surface.points, surface.triangles), found.place, rtol=0, atol=1e-15)

    def test_points_that_are_equally_far_from_everything_take_no_more_memory_and_what_is_beyond_a_reach_is_not_looked_for(self):
        # Points of a ball as a cloud, looked at from around its centre, from which all of them are as far: 1.8 million pairs, a gigabyte at once.
        ball = np.random.default_rng(3).normal(size=(30000, 3))
        ball *= 0.04 / np.linalg.norm(ball, axis=1)[:, None]
        cloud = Surface(ball, np.repeat(np.arange(len(ball))[:, None], 3, axis=1))
        centre = np.random.default_rng(4).normal(size=(3000, 3)) * 1e-9
        tracemalloc.start()
        near = cloud.nearest(centre[:60])
        most = tracemalloc.get_traced_memory()[1]
        tracemalloc.stop()
        exact = np.linalg.norm(ball[None] - centre[:60, None], axis=2).min(axis=1)
        np.testing.assert_allclose(np.abs(near.distance), exact, rtol=1e-12)
        far = cloud.nearest(np.concatenate([centre, ball[:5] * 1.01]), reach=0.03)
        self.assertTrue(np.isinf(far.distance[:-5]).all() and (np.abs(far.distance[-5:]) < 4.1e-4).all())
        self.assertLess(most, 6e8)

    def test_places_on_corners_edges_and_triangles_are_found_as_well_as_none(self):
        surface = block((2, 2, 2))
        self.assertLess(np.abs(surface.nearest(surface.points).distance).max(), 1e-15)
        self.assertEqual(len(surface.nearest(np.zeros((0, 3))).distance), 0)


class Fits(unittest.TestCase):
    def test_a_motion_is_found_from_anywhere_though_a_twentieth_of_the_points_is_wrong(self):
        surface = block()
        motion = shape_fit.small(np.array([0.5, -0.9, 1.3]), np.array([0.1, 2.0, 3.0]), np.zeros(3))
        true = on_skin(surface, 800)
        scan = motion(true)
        scan[:40] += 0.004
        fitted = shape_fit.best_fit(scan, surface)
        self.assertLess(np.abs(surface.nearest(fitted(motion(true))).distance).max(), 1e-7 * SIZE[0])

    def test_pairs_give_the_motion_that_made_them(self):
        points = np.random.default_rng(3).normal(size=(50, 3))
        motion = shape_fit.small(np.array([0.3, 2.0, -0.4]), np.array([1.0, 2.0, 3.0]), np.ones(3))
        found = shape_fit.of_pairs(points, motion(points))
        np.testing.assert_allclose(found(points), motion(points), atol=1e-14)
        self.assertAlmostEqual(found.angle(), np.degrees(np.linalg.norm([0.3, 2.0, -0.4])), places=9)


class Folder(unittest.TestCase):
    def setUp(self):
        temporary = tempfile.TemporaryDirectory()
        self.addCleanup(temporary.cleanup)
        self.folder = Path(temporary.name)

    def file(self, name, content):
        path = self.folder / name
        path.write_bytes(content if isinstance(content, bytes) else content.encode())
        return path


class Files(Folder):
    def test_stl_is_written_and_read_in_millimetres(self):
        surface = block()
        write_stl(self.folder / "a.stl", surface.points, surface.triangles)
        again = read_stl(self.folder / "a.stl", 1e-3)
        self.assertEqual(len(again.triangles), len(surface.triangles))
        self.assertAlmostEqual(again.volume() / surface.volume(), 1, places=6)

    def test_stl_as_text_is_read_and_mistakes_are_named(self):
        text = "solid a\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\r\nvertex 1 0 0\nvertex 0 1 0\nendloop\nendfacet\nendsolid\n"
        self.assertAlmostEqual(read_stl(self.file("t.stl", text), 1.0).areas[0], 0.5)
        for content, words in ((b"", "no STL"), ("solid a\nvertex 0 0\nvertex", "no three numbers|within a triangle"), (text.replace("1 0 0", "0 0 0"), "no triangle"),
                               (text.replace("1 0 0", "nan 0 0"), "is no number")):
            with self.subTest(words=words), self.assertRaisesRegex(ResultError, words):
                read_stl(self.file("b.stl", content), 1.0)

    def test_points_of_windows_with_decimal_commas_and_heads_are_read(self):
        wanted = np.array([[0.0015, 0.002, 0.003], [0.001, 0.002, -0.003], [0, 0, 0], [1, 1, 1]])
        semicolons = "X [mm];Y [mm];Z [mm];Name\r\n1,5;2,0;3;a\r\n1;2;-3;b\r\n0;0;0;c\r\n1000;1e3;1000,0;d\r\n"
        for content, unit in ((semicolons, "mm"), (("\ufeff" + semicolons), "m"), (semicolons.encode("utf-16"), "m"),
                              ("1.5,2,3\n1,2,-3\n0,0,0\n1000,1000,1000\n", "mm"), ("# scan\n1.5 2 3\n1 2 -3\n0 0 0\n1000 1000 1000\n", "mm"),
                              ("no,z[m],y[m],x[m]\n1,3e-3,2e-3,1.5e-3\n2,-3e-3,2e-3,1e-3\n3,0,0,0\n4,1,1,1\n", "mm"),
                              ("1,5\t2,0\t3,0\r\n1,0\t2\t-3\r\n0\t0\t0\r\n1000\t1000\t1000\r\n", "mm")):
            with self.subTest(content=content[:25]):
                np.testing.assert_allclose(read_points(self.file("p.csv", content), unit), wanted, atol=1e-15)

    def test_mistakes_in_points_have_their_line(self):
        good = "1,2,3\n4,5,6\n7,8,9\n1,2,4\n"
        for content, words in (("x\n", "0 lines"), (good + "1,b,2\n3,4,5\n", r"p\.csv:5: no three numbers"), (good.replace("9", "nan"), "no number"),
                               ("x[furlong],y,z\n" + good, "no unit of length 'furlong'")):
            with self.subTest(words=words), self.assertRaisesRegex(ResultError, words):
                read_points(self.file("p.csv", content), "mm")


class Comparison(Folder):
    def test_a_bump_of_a_scan_that_lies_elsewhere_is_found_with_its_place_and_height(self):
        surface = block()
        write_stl(self.folder / "nominal.stl", surface.points, surface.triangles)
        scan = on_skin(surface, 3000)
        bump = np.linalg.norm(scan - [0.02, 0.03, SIZE[2]], axis=1) < 0.010
        top = bump & (np.abs(scan[:, 2] - SIZE[2]) < 1e-12)
        scan[top, 2] += 0.0003
        moved = shape_fit.small(np.array([0.02, -0.01, 0.7]), np.array([0.01, 0.02, 0.03]), np.zeros(3))(scan)
        lines = "x[mm];y[mm];z[mm]\r\n" + "".join(";".join(f"{1e3 * c:.7f}".replace(".", ",") for c in p) + "\r\n" for p in moved)
        self.file("scan.csv", lines)
        options = Namespace(measured=str(self.folder / "scan.csv"), shape=str(self.folder / "nominal.stl"), nominal=False, as_placed=False, body=None,
                            unit="mm", output=str(self.folder / "out"))
        text = "\n".join(compare_shape.compare(options))
        found = json.loads((self.folder / "out/shape.json").read_text())
        self.assertAlmostEqual(found["largest[m]"], 0.0003, delta=2e-6)
        self.assertAlmostEqual(found["worst"][0]["deviation[m]"], 0.0003, delta=2e-6)
        self.assertAlmostEqual(found["least[m]"], 0, delta=2e-6)
        # A box lies over itself in four ways: places count from its middle.
        place = np.abs(np.array(found["worst"][0]["at[m]"]) - SIZE / 2)
        self.assertLess(np.linalg.norm(place - np.abs([0.02, 0.03, SIZE[2] + 0.0003] - SIZE / 2)), 0.0105)
        self.assertIn("3000 points", text)
        for name in ("deviations.csv", "deviations.png", "profiles.png"):
            self.assertTrue((self.folder / "out" / name).exists(), name)

    def test_a_shape_that_is_not_there_is_told(self):
        options = Namespace(measured="a", shape=str(self.folder / "none"), nominal=False, as_placed=False, body=None, unit="mm", output=None)
        with self.assertRaisesRegex(ResultError, "neither a folder of results nor an STL"):
            compare_shape.compare(options)


if __name__ == "__main__":
    unittest.main()
