"""What the plots read of field files."""

from pathlib import Path
import tempfile
import unittest

from field_files import write
from solidus_plots.vtu import ResultError, read_collection, read_fields


class Files(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = Path(folder.name)
        self.points = [[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0]]

    def test_a_file_gives_back_what_was_written_with_its_units(self):
        write(self.folder / "a.vtu", self.points, [[0, 1, 2], [0, 2, 3]], [5, 6, 7, 8], [300.0, 310, 320, 330])
        grid = read_fields(self.folder / "a.vtu")
        self.assertEqual(grid.time, 12.5)
        self.assertEqual(grid.point_data["temperature"].tolist(), [300, 310, 320, 330])
        self.assertEqual(grid.cell_data["stress"][1].tolist(), [6, 7, 8, 9, 10, 11])
        self.assertEqual((grid.units["temperature"], grid.units["stress"]), ("K", "Pa"))
        self.assertEqual(sorted(grid.cell_data), ["body", "element", "stress"])

    def test_cells_of_bodies_that_have_left_are_not_there(self):
        write(self.folder / "a.vtu", self.points, [[0, 1, 2], [0, 2, 3]], [5, 6, 7, 8], [300.0, 310, 320, 330],
              hidden=[32, 0])
        grid = read_fields(self.folder / "a.vtu")
        self.assertEqual(grid.connectivity.tolist(), [0, 2, 3])
        self.assertEqual(grid.cell_data["stress"].tolist(), [[6, 7, 8, 9, 10, 11]])

    def test_parts_of_several_processes_are_joined_at_their_nodes(self):
        write(self.folder / "p0.vtu", self.points[:3], [[0, 1, 2]], [5, 6, 7], [300.0, 310, 320])
        others = [self.points[i] for i in (0, 2, 3)]
        write(self.folder / "p1.vtu", others, [[0, 1, 2]], [5, 7, 8], [300.0, 320, 330])
        (self.folder / "a.pvtu").write_text(
            '<VTKFile><P><Piece Source="p0.vtu"/><Piece Source="p1.vtu"/></P></VTKFile>')
        grid = read_fields(self.folder / "a.pvtu")
        self.assertEqual(grid.point_data["temperature"].tolist(), [300, 310, 320, 330])
        self.assertEqual(grid.connectivity.tolist(), [0, 1, 2, 0, 2, 3])
        self.assertEqual(len(grid.edges()[0]), 5)

    def test_a_collection_lists_the_bodies_only(self):
        (self.folder / "f.pvd").write_text(
            '<VTKFile><Collection><DataSet timestep="1.5" part="0" file="a.vtu"/>'
            '<DataSet timestep="1.5" part="1" file="s.vtu"/></Collection></VTKFile>')
        times, files = read_collection(self.folder / "f.pvd")
        self.assertEqual((times.tolist(), files), ([1.5], [self.folder / "a.vtu"]))

    def test_other_files_are_named(self):
        (self.folder / "a.vtu").write_text("")
        (self.folder / "b.vtu").write_text("solid")
        for name, text in (("a", "not a field file"), ("b", "not a field file"), ("c", "no such file")):
            with self.subTest(name=name), self.assertRaisesRegex(ResultError, text):
                read_fields(self.folder / f"{name}.vtu")


if __name__ == "__main__":
    unittest.main()
