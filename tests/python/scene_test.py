"""The z-buffer and the shaded picture against shapes whose outline is known."""

import unittest

import numpy as np

from blocks import box, everything
from solidus_plots.cells import HEX, TET
from solidus_plots.cut import Plane, cut
from solidus_plots.raster import rasterise
from solidus_plots.scene import Camera, Surface, View, cap, outer

SHAPE = (400, 400)


def sphere(radius, middle, around=120):
    """Points and triangles of a sphere of pixels."""
    u, v = np.meshgrid(np.linspace(0, 2 * np.pi, 2 * around + 1), np.linspace(0, np.pi, around + 1),
                       indexing="ij")
    points = np.stack([np.cos(u) * np.sin(v), np.sin(u) * np.sin(v), np.cos(v)], axis=-1).reshape(-1, 3)
    i, j = np.meshgrid(np.arange(2 * around), np.arange(around), indexing="ij")
    a = (i * (around + 1) + j).ravel()
    b = a + around + 1
    triangles = np.concatenate([np.stack([a, b, a + 1], axis=1), np.stack([a + 1, b, b + 1], axis=1)])
    return radius * points + middle, triangles


class Raster(unittest.TestCase):
    def test_a_sphere_covers_its_circle_and_shows_its_near_side(self):
        radius = 150.0
        points, triangles = sphere(radius, [200.0, 200.0, 0.0])
        picture = rasterise(points, triangles, SHAPE)
        # A pixel more or less along a thousandth of the outline; the polygon is (pi / 240)^2 / 6 smaller.
        self.assertAlmostEqual(picture.seen.sum() / (np.pi * radius**2), 1.0, delta=1e-3)
        rows, columns = np.nonzero(picture.seen)
        inside = radius**2 - (rows + 0.5 - 200) ** 2 - (columns + 0.5 - 200) ** 2
        flat = inside > 0.1 * radius**2  # where the surface is not steep
        depth = picture.depth[picture.seen]
        self.assertLess(np.abs(depth[flat] - np.sqrt(inside[flat])).max(), 0.002 * radius)

    def test_what_lies_above_a_plane_is_cut_away(self):
        points, triangles = sphere(150.0, [200.0, 200.0, 0.0])
        whole = rasterise(points, triangles, SHAPE)
        half = rasterise(points, triangles, SHAPE, levels=points[:, 0] - 200.0)
        self.assertEqual(half.seen[:, 200:].sum(), 0)
        self.assertTrue((half.seen[:, :200] == whole.seen[:, :200]).all())

    def test_weights_give_back_a_linear_field_and_neighbours_leave_no_gap(self):
        points = np.array([[10.0, 10, 0], [390, 30, 0], [370, 380, 0], [20, 350, 0]])
        triangles = np.array([[0, 1, 2], [0, 2, 3]])
        picture = rasterise(points, triangles, SHAPE)
        rows, columns = np.nonzero(picture.seen)
        field = picture.at_corners((points @ [2.0, -3.0, 0.0])[triangles])
        exact = 2.0 * (columns + 0.5) - 3.0 * (rows + 0.5)
        self.assertLess(np.abs(field - exact).max(), 1e-3)  # weights in single precision
        self.assertTrue((np.diff(picture.seen.astype(int), axis=1) != 0).sum(axis=1).max() <= 2)

    def test_the_order_of_triangles_does_not_matter(self):
        points, triangles = sphere(100.0, [200.0, 200.0, 0.0], around=20)
        first = rasterise(points, triangles, SHAPE)
        second = rasterise(points, triangles[::-1], SHAPE)
        self.assertTrue((first.depth == second.depth).all())


class Scenes(unittest.TestCase):
    def setUp(self):
        self.grid = box(HEX, [1.0, 1.0, 1.0], (3, 3, 3))
        self.field = ("point_data", self.grid.points @ [1.0, 2.0, 3.0])

    def view(self, surface, camera):
        return View(surface, camera, ([-2.0, -2.0], [2.0, 2.0]), SHAPE)

    def test_a_cube_seen_along_its_diagonal_covers_a_regular_hexagon(self):
        camera = Camera(45.0, np.degrees(np.arctan(np.sqrt(0.5))))
        view = self.view(outer(self.grid, everything(self.grid), self.grid.points, self.field), camera)
        # Sides of 0.82: half a pixel of 1/100 along six of them is 1.5 % of the area, on average zero.
        self.assertAlmostEqual(view.picture.seen.sum() / 100.0**2, np.sqrt(3.0), delta=5e-3)

    def test_a_cube_seen_from_the_front_has_its_axes_where_they_belong(self):
        for up, azimuth, right in (("z", -90.0, 0), ("y", 0.0, 0), ("x", 0.0, 2)):
            camera = Camera(azimuth, 0.0, up)
            self.assertLess(np.abs(camera.right - np.eye(3)[right]).max(), 1e-15)
            self.assertLess(np.abs(camera.up - np.eye(3)["xyz".index(up)]).max(), 1e-15)

    def test_places_on_the_near_sides_of_a_cube_are_seen_and_others_not(self):
        view = self.view(outer(self.grid, everything(self.grid), self.grid.points, self.field), Camera(-90.0, 0.0))  # the eye is at -y
        self.assertTrue(view.sees([0.4, 0.0, 0.6]))
        self.assertFalse(view.sees([0.4, 1.0, 0.6]))
        self.assertFalse(view.sees([0.4, 0.5, 0.6]))
        self.assertFalse(view.sees([9.0, 0.0, 0.6]), "outside of the frame")

    def test_a_cube_cut_open_shows_the_field_inside(self):
        camera = Camera(-90.0, 0.0)  # the eye is at -y
        plane = Plane.axis("y", 0.5).facing(camera.eye)
        cells, points = everything(self.grid), self.grid.points
        clipped = Surface.join([outer(self.grid, cells, points, self.field, plane.distance(points)),
                                cap(self.grid, cut(self.grid, cells, plane), points, self.field, plane.normal)])
        view = self.view(clipped, camera)
        rows, columns = np.nonzero(view.picture.seen)
        x, z = (columns + 0.5) / 100.0 - 2.0, 2.0 - (rows + 0.5) / 100.0
        exact = x + 2 * 0.5 + 3 * z
        self.assertLess(np.abs(view.values() - exact).max(), 1e-5)  # weights in single precision

    def test_edges_of_a_cube_are_edges_and_a_sphere_of_cells_has_none(self):
        surface = outer(self.grid, everything(self.grid), self.grid.points, self.field)
        self.assertEqual(len(surface.edges), 12 * 3)  # twelve edges of three cells
        ball = box(TET, [1.0, 1.0, 1.0], (8, 8, 8))
        centred = 2.0 * ball.points - 1.0
        reach = np.abs(centred).max(axis=1) / np.maximum(np.linalg.norm(centred, axis=1), 1e-12)
        place = centred * reach[:, None]
        surface = outer(ball, everything(ball), place, ("cell_data", ball.cell_data["body"]))
        self.assertEqual(len(surface.edges), 0)
        directions = surface.points[surface.triangles]
        directions /= np.linalg.norm(directions, axis=2)[..., None]
        # Averaged over the cells round a point normals lie within a few degrees of the sphere's.
        cosines = np.einsum("tci,tci->tc", surface.normals, directions)
        self.assertGreater(cosines.min(), np.cos(np.radians(12.0)))


if __name__ == "__main__":
    unittest.main()
