"""Radiographs: room and missing metal along rays against closed forms, and nothing lost."""

from pathlib import Path
import tempfile
import unittest

from blocks import box, everything
import numpy as np

from solidus_plots import style, xray
from solidus_plots.cells import HEX, TET_2
from solidus_plots.moments import Moments
from solidus_plots.overview import Case
from solidus_plots.vtu import Grid

xray.PIXELS = 80  # quick
SIZE = (0.08, 0.05, 0.02)


def pored(shape):
    grid = box(shape, SIZE, (8, 5, 4))
    x, _, z = grid.points.T
    grid.point_data = {"emptied": 0.5 * z / SIZE[2], "gas_pores": 0.1 * x / SIZE[0]}
    grid.cell_data["pore_fraction"] = np.full(len(grid.cell_types), 0.05)
    return grid


class Films(unittest.TestCase):
    def test_a_block_is_as_thick_as_it_is_and_lacks_the_integral_of_its_holes(self):
        for shape in (HEX, TET_2):
            film = xray.film_of_solid(pored(shape), everything(pored(shape)), 2)
            self.assertEqual(film.names, ("x", "y"))
            np.testing.assert_allclose(film.metal, SIZE[2], rtol=1e-9)
            x = film.low[0] + film.pixel * (np.arange(film.metal.shape[1]) + 0.5)
            missing = SIZE[2] * (0.25 + 0.05 + 0.1 * x / SIZE[0])
            np.testing.assert_allclose(film.missing, np.tile(missing, (len(film.metal), 1)), rtol=1e-4)
            most, room, place = film.darkest()
            self.assertAlmostEqual(most, missing.max(), places=5)
            self.assertAlmostEqual(room, SIZE[2])
            self.assertAlmostEqual(place[0], x[-1])

    def test_it_is_taken_through_the_thinnest_side(self):
        grid = pored(HEX)
        film = xray.film(grid, everything(grid), True)
        np.testing.assert_allclose(film.metal.max(), SIZE[2])
        for name in grid.point_data:
            grid.point_data[name][:] = 0
        grid.cell_data["pore_fraction"][:] = 1e-5
        self.assertIsNone(xray.film(grid, everything(grid), True))

    def test_a_cylinder_is_seen_across_its_axis(self):
        radius, height, n = 0.03, 0.05, 12
        r, z = np.meshgrid(np.linspace(0, radius, n + 1), np.linspace(0, height, n + 1))
        points = np.stack([r.ravel(), z.ravel(), np.zeros(r.size)], axis=1)
        lower = (np.arange(n)[:, None] * (n + 1) + np.arange(n)).ravel()
        quads = np.stack([lower, lower + 1, lower + n + 2, lower + n + 1], axis=1)
        grid = Grid(points, np.full(len(quads), 9), 4 * np.arange(1, len(quads) + 1), quads.ravel(),
                    {"unfed_pores": np.full(r.size, 0.2)}, {"body": np.zeros(len(quads))})
        film = xray.film_of_revolution(grid, np.ones(len(quads), bool))
        columns = film.metal.shape[1]
        x = film.low[0] + film.pixel * (np.arange(columns) + 0.5)
        inside = np.abs(x) < 0.95 * radius
        np.testing.assert_allclose(film.metal[20, inside], 2 * np.sqrt(radius**2 - x[inside]**2), rtol=0.01)
        np.testing.assert_allclose(film.missing, 0.2 * film.metal, rtol=1e-9)
        volume = film.metal.sum() * film.pixel**2
        self.assertAlmostEqual(volume / (np.pi * radius**2 * height), 1, delta=0.01)

    def test_it_is_drawn(self):
        style.setup()
        grid = pored(HEX)
        run = Moments(np.array([grid.time]), [None], ["part"])
        run._grids[0] = grid
        with tempfile.TemporaryDirectory() as folder:
            files = xray.draw({"file": "xray", "title": "As on a radiograph", "times": [grid.time], "bodies": ["part"]},
                              run, Case("a case", True, ("x", "y"), np.zeros(3)), Path(folder))
            self.assertTrue(files and all(Path(file).exists() for file in files))


if __name__ == "__main__":
    unittest.main()
