"""The search of a pattern, where how a casting deforms is a formula: a ball and a plate whose inverse is known."""

from argparse import Namespace
import json
from pathlib import Path
import tempfile
import unittest

from blocks import box
import numpy as np

from solidus_plots import pattern
from solidus_plots.cells import HEX
from solidus_plots.pattern_mesh import Followers, affine
from solidus_plots.vtu import Grid, ResultError
from solidus_plots.vtu_writer import write_grid

SIZE = (0.1, 0.06, 0.02)
SHRINKAGE = 0.013
BEND = 0.4  # [1/m]


def msh(grid, groups):
    """A .msh as the program writes it. groups: name -> (dimension, type, [element][nodes])."""
    names = "".join(f'{dimension} {i + 1} "{name}"\n' for i, (name, (dimension, _, _)) in enumerate(groups.items()))
    lines = [f"{kind} 2 {i + 1} {i + 1} " + " ".join(str(n + 1) for n in nodes)
             for i, (_, kind, elements) in enumerate(groups.values()) for nodes in elements]
    return (f"$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$PhysicalNames\n{len(groups)}\n{names}$EndPhysicalNames\n$Nodes\n{len(grid.points)}\n"
            + "".join(f"{i + 1} {x!r} {y!r} {z!r}\n" for i, (x, y, z) in enumerate(grid.points.tolist()))
            + f"$EndNodes\n$Elements\n{len(lines)}\n" + "".join(f"{i + 1} {line}\n" for i, line in enumerate(lines)) + "$EndElements\n")


class Formula(pattern.Search):
    """A search whose runs are a formula of the pattern's nodes."""

    def __init__(self, folder, moves, conditions="", options=None):
        self.grid = box(HEX, SIZE, (6, 4, 2))
        faces = [nodes for nodes in self.grid.cells(HEX)[1]]
        left = np.flatnonzero(self.grid.points[:, 0] < 1e-12)
        (folder / "drawing.msh").write_text(msh(self.grid, {"part": (3, 5, faces), "left": (0, 15, left[:, None])}))
        (folder / "drawing.toml").write_text('title = "a"\n\n[analysis]\nkind = "solid"\n\n[mesh]\nfile = "x.step"\n\n[[mesh.size]]\nsize = 1\n\n'
                                             '[[body]]\nname = "part"\nrole = "automatic"\n' + conditions)
        self.moves = moves
        super().__init__(pattern.Case(folder), options or Namespace(runs=8, tolerance="1e-8 mm", body=None, restart=False))

    def _run(self, turn):
        folder = self.case.folder / f"run_{turn + 1}"
        folder.mkdir()
        place = self.points
        grid = Grid(place, self.grid.cell_types, self.grid.offsets, self.grid.connectivity,
                    {"displacement": self.moves(place), "node": np.arange(1, 1 + len(place))}, {"body": np.zeros(len(self.grid.cell_types), int)},
                    {"displacement": "m"}, 1.0)
        write_grid(folder / "last.vtu", grid)
        (folder / "fields.pvd").write_text('<VTKFile type="Collection"><Collection><DataSet timestep="1" part="0" file="last.vtu"/></Collection></VTKFile>')
        (folder / "summary.json").write_text(json.dumps({"mesh": {"bodies": {"part": 1}}, "answers": {}}))
        return folder


class Patterns(unittest.TestCase):
    def setUp(self):
        temporary = tempfile.TemporaryDirectory()
        self.addCleanup(temporary.cleanup)
        self.folder = Path(temporary.name)

    def test_a_body_that_shrinks_has_a_pattern_that_is_larger_by_the_inverse(self):
        held = '\n[[mechanical_condition]]\nname = "l"\ngroup = "left"\nkind = "displacement"\nux = "0 mm"\n'
        search = Formula(self.folder, lambda x: -SHRINKAGE * x, held)
        self.assertTrue(search.run())
        drawn = search.mesh.points
        self.assertLess(np.abs(search.points - drawn / (1 - SHRINKAGE)).max(), 1e-6 * SHRINKAGE * SIZE[0])
        axes, rest = pattern.contraction(search)
        np.testing.assert_allclose(axes, SHRINKAGE, rtol=1e-9)
        self.assertLess(rest, 1e-12)

    def test_a_plate_that_warps_and_lies_anywhere_has_a_pattern_that_is_bent_against_it(self):
        def moves(x):
            # It shrinks, is bent about y by its own length, and ends up elsewhere.
            return -SHRINKAGE * x + np.stack([0 * x[:, 0] + 0.001, 0 * x[:, 0], 0.5 * BEND * x[:, 0] ** 2 + 0.002], axis=1)
        search = Formula(self.folder, moves)
        self.assertTrue(search.run())
        cast = search.points + moves(search.points)
        distances = [np.linalg.norm(points[:, None] - points[None], axis=2) for points in (cast, search.mesh.points)]
        self.assertLess(np.abs(distances[0] - distances[1]).max(), 1e-10)  # but for a motion the casting is the drawing
        lines = pattern.write(search, True)
        self.assertIn("contraction from pattern to casting: x 1.3", lines[0])
        found = json.loads((self.folder / "pattern.json").read_text())
        self.assertTrue(found["met"])
        self.assertGreater(found["left_by_scales[m]"], 1e-5)
        for name in ("pattern.msh", "pattern.vtu", "pattern_part.stl", "pattern.png"):
            self.assertTrue((self.folder / name).exists(), name)

    def test_a_shape_that_runs_away_ends_the_search_in_words(self):
        search = Formula(self.folder, lambda x: 3.0 * x * (1 + 10 * x))
        with self.assertRaisesRegex(pattern.RunFailed, "does not bring the casting nearer"):
            search.run()

    def test_the_case_of_a_run_has_the_mesh_and_nothing_else_of_the_drawing(self):
        search = Formula(self.folder, lambda x: 0 * x)
        text = search.case.with_mesh("/a/b.msh", {"part": "riser"})
        self.assertIn('[mesh]\nfile = "/a/b.msh"\nunit = "m"\n', text)
        self.assertNotIn("x.step", text)
        self.assertNotIn("mesh.size", text)
        self.assertIn('role = "riser"', text)

    def test_nodes_of_the_mould_go_with_the_part_and_stay_in_planes_that_hold_it(self):
        grid = box(HEX, SIZE, (6, 4, 2))
        others = np.array([[0.0, 0.03, 0.05], [0.1, 0.06, 0.02], [0.5, 0.3, 0.1]])
        drawn = np.concatenate([grid.points, others])
        nodes = np.arange(len(grid.points))
        followers = Followers(grid, np.ones(len(grid.cell_types), bool), drawn, nodes, [(0, 0.0)])
        moved = followers.displaced(SHRINKAGE * grid.points, SHRINKAGE * grid.points) - drawn
        np.testing.assert_allclose(moved, SHRINKAGE * drawn, atol=1e-12)
        own = 1e-3 * np.sin(30 * grid.points)
        moved = followers.displaced(own, own) - drawn
        np.testing.assert_allclose(moved[nodes], own, atol=1e-15)
        np.testing.assert_allclose(moved[len(nodes) + 1], 1e-3 * np.sin(30 * others[1]), atol=1e-12)  # at a corner of the part
        self.assertEqual(moved[len(nodes), 0], 0.0)

    def test_lengths_and_bodies_that_are_none_are_told(self):
        for text in ("5", "-1 mm", "0 mm", "1 parsec", "a mm"):
            with self.subTest(text=text), self.assertRaisesRegex(ResultError, "a length above zero"):
                pattern.length(text)
        self.assertAlmostEqual(pattern.length("0.05 mm"), 5e-5)
        search = Formula(self.folder, lambda x: 0 * x, options=Namespace(runs=1, tolerance=None, body="none", restart=False))
        with self.assertRaisesRegex(ResultError, "no body 'none'; there are part"):
            search.run()

    def test_a_linear_function_is_found(self):
        points = np.random.default_rng(1).normal(size=(30, 3))
        gradient = np.arange(9.0).reshape(3, 3)
        function, found = affine(points, points @ gradient.T + 1)
        np.testing.assert_allclose(found, gradient, atol=1e-12)
        np.testing.assert_allclose(function(np.zeros((1, 3))), 1, atol=1e-12)

    def test_a_case_in_the_plane_is_refused_before_it_runs(self):
        with tempfile.TemporaryDirectory() as name:
            Path(name, "drawing.msh").write_text(msh(box(HEX, SIZE, (1, 1, 1)), {}))
            Path(name, "drawing.toml").write_text('title = "a"\n\n[analysis]\nkind = "plane_strain"\n\n[mesh]\nfile = "x.msh"\n')
            with self.assertRaises(ResultError) as raised:
                pattern.Search(pattern.Case(Path(name)), None)
            self.assertIn("analysis.kind = \"plane_strain\"", str(raised.exception))


if __name__ == "__main__":
    unittest.main()
