"""Field files as Solidus writes them (src/results/vtu.cpp, vtk_data.cpp), written here by some lines of Python.
"""

from pathlib import Path
import struct
import tempfile
import unittest
import zlib

import numpy as np

from solidus_plots.vtu import ResultError, read_collection, read_fields

TYPES = {"f8": "Float64", "i8": "Int64", "i4": "Int32", "u1": "UInt8"}


class Writer:
    """Appended raw data: zlib blocks of at most `BLOCK` bytes behind their sizes."""

    BLOCK = 64

    def __init__(self):
        self.data = b""

    def array(self, name, values, unit=""):
        raw = np.ascontiguousarray(values).tobytes()
        blocks = [raw[start:start + self.BLOCK] for start in range(0, len(raw), self.BLOCK)]
        packed = [zlib.compress(block) for block in blocks]
        head = struct.pack("<3Q", len(blocks), self.BLOCK, len(raw) % self.BLOCK)
        components = values.shape[1] if values.ndim > 1 else 1
        label = f'<InformationKey name="UNITS_LABEL" location="vtkDataArray">{unit}</InformationKey>' if unit else ""
        element = (f'<DataArray type="{TYPES[values.dtype.str[1:]]}" Name="{name}" format="appended" '
                   f'NumberOfComponents="{components}" offset="{len(self.data)}">{label}</DataArray>')
        self.data += head + struct.pack(f"<{len(packed)}Q", *map(len, packed)) + b"".join(packed)
        return element


def write(path, points, nodes, numbers, temperature, hidden=None):
    """Triangles `nodes` [cell][3]; `hidden`: of vtkGhostType, of each cell."""
    writer, count = Writer(), len(nodes)
    cells = [writer.array("element", np.arange(count, dtype="i8")),
             writer.array("stress", np.arange(6.0 * count).reshape(count, 6), "Pa")]
    if hidden is not None:
        cells.append(writer.array("vtkGhostType", np.array(hidden, "u1")))
    body = (f'<PointData>{writer.array("node", np.array(numbers, "i8"))}'
            f'{writer.array("temperature", np.array(temperature, "f8"), "K")}</PointData>'
            f'<CellData>{"".join(cells)}</CellData>'
            f'<Points>{writer.array("Points", np.array(points, "f8"))}</Points>'
            f'<Cells>{writer.array("connectivity", np.array(nodes, "i8").ravel())}'
            f'{writer.array("offsets", 3 * (1 + np.arange(count, dtype="i8")))}'
            f'{writer.array("types", np.full(count, 5, "u1"))}</Cells>')
    text = (f'<VTKFile type="UnstructuredGrid" byte_order="LittleEndian"><UnstructuredGrid><FieldData>'
            f'<DataArray Name="TimeValue">12.5</DataArray></FieldData><Piece>{body}</Piece></UnstructuredGrid>'
            f'<AppendedData encoding="raw">\n_')
    path.write_bytes(text.encode() + writer.data + b"\n</AppendedData></VTKFile>")


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
        self.assertEqual(sorted(grid.cell_data), ["element", "stress"])

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
