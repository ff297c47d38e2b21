"""Cuts and surfaces of volume cells against what is known of a box."""

import unittest

import numpy as np

from blocks import box, everything
from solidus_plots.cells import HEX, HEX_2, TET, TET_2, boundary
from solidus_plots.cut import Plane, cut, cut_where, isolines

SIZE = np.array([0.06, 0.04, 0.03])
KINDS = {"tet4": TET, "hex8": HEX, "tet10": TET_2, "hex20": HEX_2}
DIAGONAL = np.array([0.04, 0.06, 0.0]) / np.hypot(0.04, 0.06)  # normal to a plane through two opposite edges
ROUND_OFF = 1e-12  # of sums of some thousand terms


def area(corners):
    normals = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    return 0.5 * np.linalg.norm(normals, axis=1).sum()


class Cuts(unittest.TestCase):
    def setUp(self):
        self.grids = {name: box(kind, SIZE, (4, 3, 2), bodies=2) for name, kind in KINDS.items()}

    def check(self, plane, exact_area):
        for name, grid in self.grids.items():
            with self.subTest(cells=name):
                part = cut(grid, everything(grid), plane)
                points = part.at_points(grid.points)
                self.assertLess(np.abs(plane.distance(points)).max(), ROUND_OFF)
                self.assertAlmostEqual(area(points[part.triangles]) / exact_area, 1.0, delta=ROUND_OFF)

                def linear(x):
                    return 20.0 + x @ [100.0, -300.0, 200.0]

                error = np.abs(part.at_points(linear(grid.points)) - linear(points)).max()
                self.assertLess(error, 20 * ROUND_OFF)
                centres = points[part.triangles].mean(axis=1)
                self.assertTrue(((centres[:, 0] > 0.03) == (grid.cell_data["body"][part.cells] == 1)).all()
                                or plane.normal[0] == 1.0)

    def test_a_plane_across_cells_shows_the_whole_section_and_a_linear_field_exactly(self):
        self.check(Plane.axis("z", 0.011), SIZE[0] * SIZE[1])

    def test_a_plane_along_faces_shows_the_section_once(self):
        self.check(Plane.axis("z", 0.015), SIZE[0] * SIZE[1])
        self.check(Plane.axis("x", 0.03), SIZE[1] * SIZE[2])

    def test_both_ends_of_a_body_are_sections_too(self):
        self.check(Plane.axis("y", 0.0), SIZE[0] * SIZE[2])
        self.check(Plane.axis("y", SIZE[1]), SIZE[0] * SIZE[2])

    def test_an_end_is_met_up_to_the_digits_of_a_mesh_file(self):
        for offset in (-1e-11, 1e-11):
            part = cut(self.grids["tet4"], everything(self.grids["tet4"]), Plane.axis("z", offset))
            points = part.at_points(self.grids["tet4"].points)
            self.assertAlmostEqual(area(points[part.triangles]) / (SIZE[0] * SIZE[1]), 1.0, delta=1e-9)

    def test_an_oblique_plane_through_nodes_shows_the_whole_section(self):
        self.check(Plane.through([0.06, 0.0, 0.0], DIAGONAL), np.hypot(SIZE[0], SIZE[1]) * SIZE[2])

    def test_a_plane_beside_the_body_shows_nothing(self):
        for grid in self.grids.values():
            self.assertEqual(len(cut(grid, everything(grid), Plane.axis("z", -0.01)).triangles), 0)

    def test_an_oblique_plane_draws_lengths_and_angles_as_they_are(self):
        plane = Plane.through([0.01, 0.02, 0.0], [1.0, 2.0, -3.0])
        axes = np.stack([plane.right, plane.up, plane.normal])
        self.assertLess(np.abs(axes @ axes.T - np.eye(3)).max(), 1e-15)

    def test_outlines_close_each_body_and_mesh_lines_follow_the_cells(self):
        grid = self.grids["hex8"]  # 4 x 3 cells in two bodies of 2 x 3
        part = cut(grid, everything(grid), Plane.axis("z", 0.011))
        points = part.at_points(grid.points)

        def length(groups):
            ends = points[part.sides(groups)]
            return np.linalg.norm(ends[:, 1] - ends[:, 0], axis=1).sum()

        x, y = SIZE[:2]
        self.assertAlmostEqual(length(grid.cell_data["body"][part.cells]), 2 * (x + y) + y, delta=ROUND_OFF)
        self.assertAlmostEqual(length(part.cells), 4 * x + 5 * y, delta=ROUND_OFF)

    def test_lines_of_a_linear_field_are_straight_and_whole(self):
        grid = self.grids["tet4"]
        part = cut(grid, everything(grid), Plane.axis("z", 0.011))
        place = part.at_points(grid.points)[:, :2]
        line, = isolines(place, part.triangles, place[:, 0], 0.0331)
        self.assertGreater(len(line), 4)
        self.assertLess(np.abs(line[:, 0] - 0.0331).max(), ROUND_OFF)
        self.assertAlmostEqual(np.abs(np.diff(line[:, 1])).sum(), SIZE[1], delta=ROUND_OFF)

    def test_a_line_round_a_place_is_one_closed_line(self):
        grid = self.grids["tet4"]
        part = cut(grid, everything(grid), Plane.axis("z", 0.011))
        place = part.at_points(grid.points)[:, :2]
        distance = np.linalg.norm(place - np.array(SIZE[:2]) / 2, axis=1)
        line, = isolines(place, part.triangles, distance, 0.3 * SIZE[1])
        np.testing.assert_allclose(line[0], line[-1], atol=ROUND_OFF)

    def test_where_a_field_has_a_value_the_surface_is_closed_and_faces_where_it_is_larger(self):
        for name, kind in KINDS.items():
            with self.subTest(cells=name):
                grid = box(kind, [2.0, 2.0, 2.0], (12, 12, 12))
                part = cut_where(grid, everything(grid), np.linalg.norm(grid.points - 1.0, axis=1) - 0.7)
                corners = part.at_points(grid.points)[part.triangles] - 1.0
                volume = np.einsum("ij,ij->", corners[:, 0], np.cross(corners[:, 1], corners[:, 2])) / 6.0
                # Cells are 1/6 wide, their diagonal d = 0.29. A chord d of the sphere lies d^2 / (8 0.7) inside.
                inside = 0.29**2 / (8 * 0.7)
                self.assertAlmostEqual(volume / (4.0 / 3.0 * np.pi * 0.7**3), 1.0, delta=3 * inside / 0.7)
                self.assertEqual(len(part.sides(np.zeros(len(part.triangles), int))), 0)


class Surfaces(unittest.TestCase):
    def test_the_surface_of_a_box_is_closed_and_faces_outwards(self):
        for name, kind in KINDS.items():
            with self.subTest(cells=name):
                grid = box(kind, SIZE, (4, 3, 2))
                faces = boundary(grid, everything(grid), grid.cell_data["body"])
                corners = faces.refined.extend(grid.points)[faces.nodes]
                x, y, z = SIZE
                self.assertAlmostEqual(area(corners) / (2 * (x * y + y * z + z * x)), 1.0, delta=ROUND_OFF)
                volume = np.einsum("ij,ij->", corners[:, 0], np.cross(corners[:, 1], corners[:, 2])) / 6.0
                self.assertAlmostEqual(volume / (x * y * z), 1.0, delta=ROUND_OFF)

    def test_bodies_that_share_nodes_have_surfaces_of_their_own(self):
        grid = box(TET, SIZE, (4, 3, 2), bodies=2)
        faces = boundary(grid, everything(grid), grid.cell_data["body"])
        x, y, z = SIZE
        self.assertAlmostEqual(area(faces.refined.extend(grid.points)[faces.nodes]),
                               2 * (x * y + y * z + z * x) + 2 * y * z, delta=ROUND_OFF)


if __name__ == "__main__":
    unittest.main()
