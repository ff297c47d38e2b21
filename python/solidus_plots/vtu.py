"""Reads the field files Solidus writes: .vtu (appended raw data in zlib blocks), .pvtu and .pvd.

    from solidus_plots.vtu import read_collection, read_fields
    times, files = read_collection("results/aluminium_cylinder/default/fields.pvd")
    grid = read_fields(files[-1])
    grid.point_data["temperature"], grid.units["temperature"]
"""

from collections.abc import Mapping
from dataclasses import dataclass, field
from functools import partial
import mmap
from pathlib import Path
import re
import struct
import xml.etree.ElementTree as ElementTree
import zlib

import numpy as np

HIDDEN_CELL = 32  # in vtkGhostType
NUMBER_TYPES = {"Float64": "f8", "Float32": "f4", "Int64": "i8", "Int32": "i4", "UInt8": "u1"}
# Corner triangles of VTK's plane cells; quadratic cells are drawn with their mid nodes.
TRIANGLES = {
    5: [(0, 1, 2)],
    9: [(0, 1, 2), (0, 2, 3)],
    22: [(0, 3, 5), (3, 1, 4), (5, 4, 2), (3, 4, 5)],
    23: [(0, 4, 7), (4, 1, 5), (5, 2, 6), (6, 3, 7), (4, 5, 7), (5, 6, 7)],
}
# Edges of VTK's plane cells as node sequences.
EDGES = {
    5: [(0, 1), (1, 2), (2, 0)],
    9: [(0, 1), (1, 2), (2, 3), (3, 0)],
    22: [(0, 3, 1), (1, 4, 2), (2, 5, 0)],
    23: [(0, 4, 1), (1, 5, 2), (2, 6, 3), (3, 7, 0)],
}


class ResultError(Exception):
    """The file is not there or is not one of ours; the text says which."""


class Arrays(Mapping):
    """Values by name, read when they are asked for: of a large run only what is drawn comes into memory."""

    def __init__(self, readers):
        self._readers = readers

    def __getitem__(self, name):
        return self._readers[name]()

    def __iter__(self):
        return iter(self._readers)

    def __len__(self):
        return len(self._readers)

    def taken(self, rows):
        """Some rows of each."""
        return Arrays({name: lambda name=name: self[name][rows] for name in self})


@dataclass
class Grid:
    """One moment. Arrays are in SI; `units` names the unit of each."""

    points: np.ndarray  # [node][3] m
    cell_types: np.ndarray  # VTK's numbers
    offsets: np.ndarray  # end of each cell in `connectivity`
    connectivity: np.ndarray
    point_data: dict = field(default_factory=dict)
    cell_data: dict = field(default_factory=dict)
    units: dict = field(default_factory=dict)
    time: float = 0.0

    def cells(self, vtk_type):
        """Numbers of the cells of this type, and their nodes as an array [cell][node]."""
        numbers = np.flatnonzero(self.cell_types == vtk_type)
        if not numbers.size:
            return numbers, np.zeros((0, 0), int)
        count = self.offsets[numbers[0]] - (self.offsets[numbers[0] - 1] if numbers[0] else 0)
        return numbers, self.connectivity[(self.offsets[numbers] - count)[:, None] + np.arange(count)]

    def triangles(self):
        """All plane cells cut into triangles: [triangle][3] nodes, and the cell each belongs to."""
        nodes, cells = [np.zeros((0, 3), int)], [np.zeros(0, int)]
        for vtk_type, pattern in TRIANGLES.items():
            numbers, corners = self.cells(vtk_type)
            for triangle in pattern if numbers.size else []:
                nodes.append(corners[:, triangle])
                cells.append(numbers)
        return np.concatenate(nodes), np.concatenate(cells)

    def edges(self, cells=None):
        """Edges of the plane cells, each once: [edge][node sequence] by its length, and a count of cells
        per edge (one: on the boundary of its body). `cells` is a mask of the cells to take."""
        found = {}
        for vtk_type, pattern in EDGES.items():
            numbers, nodes = self.cells(vtk_type)
            if cells is not None and numbers.size:
                nodes = nodes[cells[numbers]]
            for edge in pattern if nodes.size else []:
                for sequence in nodes[:, edge]:
                    key = (min(sequence[0], sequence[-1]), max(sequence[0], sequence[-1]))
                    found.setdefault(key, [sequence, 0])[1] += 1
        return [entry[0] for entry in found.values()], np.array([entry[1] for entry in found.values()])


def read_fields(path):
    """Reads a .vtu, or a .pvtu with all its parts: nodes that parts share are joined."""
    path = Path(path)
    if path.suffix != ".pvtu":
        return _read_part(path)
    root = _parse(path, path.read_bytes() if path.exists() else None)
    parts = [_read_part(path.parent / piece.get("Source")) for piece in root.iter("Piece")]
    return _join([part for part in parts if part.cell_types.size] or parts[:1])


def read_collection(path):
    """The times [s] and the files of a .pvd, the bodies only (part 0)."""
    path = Path(path)
    root = _parse(path, path.read_bytes() if path.exists() else None)
    sets = [entry for entry in root.iter("DataSet") if entry.get("part", "0") == "0"]
    times = np.array([float(entry.get("timestep")) for entry in sets])
    return times, [path.parent / entry.get("file") for entry in sets]


def _parse(path, text):
    if text is None:
        raise ResultError(f"{path}: there is no such file")
    try:
        return ElementTree.fromstring(text)
    except ElementTree.ParseError as error:
        raise ResultError(f"{path}: not a result file of Solidus ({error})") from error


def _read_part(path):
    if not path.exists():
        raise ResultError(f"{path}: there is no such file")
    with path.open("rb") as file:
        content = mmap.mmap(file.fileno(), 0, access=mmap.ACCESS_READ) if path.stat().st_size else b""
    head = re.search(rb'<AppendedData encoding="raw">\s*_', content)
    if head is None:
        raise ResultError(f"{path}: not a field file of Solidus (no appended data)")
    root = _parse(path, content[: head.start()] + b"</VTKFile>")
    order = "<" if root.get("byte_order") == "LittleEndian" else ">"
    piece, units = root.find("UnstructuredGrid/Piece"), {}

    def section(name):
        for element in piece.find(name):
            unit = element.find("InformationKey")
            units[element.get("Name")] = "1" if unit is None else unit.text.strip()
        return Arrays({element.get("Name"): partial(read, element) for element in piece.find(name)})

    def read(element):
        number = order + NUMBER_TYPES[element.get("type")]
        values = _decode(content, head.end() + int(element.get("offset")), number)
        components = int(element.get("NumberOfComponents", "1"))
        return values.reshape(-1, components) if components > 1 else values

    point_data, cell_data, cells = section("PointData"), section("CellData"), section("Cells")
    time = root.find("UnstructuredGrid/FieldData/DataArray[@Name='TimeValue']")
    return _without_hidden(Grid(section("Points")["Points"], cells["types"], cells["offsets"],
                                cells["connectivity"], point_data, cell_data, units,
                                0.0 if time is None else float(time.text)))


def _without_hidden(grid):
    """The grid without the cells of bodies that have left; their nodes stay, without a cell."""
    if "vtkGhostType" not in grid.cell_data:
        return grid
    shown = (grid.cell_data["vtkGhostType"] & HIDDEN_CELL) == 0
    counts = np.diff(grid.offsets, prepend=0)
    return Grid(grid.points, grid.cell_types[shown], np.cumsum(counts[shown]),
                grid.connectivity[np.repeat(shown, counts)], grid.point_data,
                grid.cell_data.taken(shown), grid.units, grid.time)


def _decode(content, start, number):
    """[blocks][bytes of a block][bytes of a shorter last block or 0][compressed bytes ...][blocks ...]"""
    order = number[0]
    blocks = struct.unpack_from(order + "Q", content, start)[0]
    sizes = struct.unpack_from(f"{order}{blocks}Q", content, start + 24)
    position, raw = start + 24 + 8 * blocks, []
    for size in sizes:
        raw.append(zlib.decompress(content[position : position + size]))
        position += size
    return np.frombuffer(b"".join(raw), number)


def _join(parts):
    """One grid of the parts of all processes; the numbers of the input tell which nodes are the same."""
    if len(parts) == 1:
        return parts[0]
    numbers = np.concatenate([part.point_data["node"] for part in parts])
    _, first, index = np.unique(numbers, return_index=True, return_inverse=True)
    connectivity, offsets, nodes, entries = [], [], 0, 0
    for part in parts:
        connectivity.append(index[nodes + part.connectivity])
        offsets.append(entries + part.offsets)
        nodes += len(part.points)
        entries += len(part.connectivity)

    def stack(name, take):
        return np.concatenate([getattr(part, name) for part in parts])[take]

    def stacked(kind):
        return Arrays({name: lambda name=name: np.concatenate([getattr(part, kind)[name] for part in parts])
                       for name in getattr(parts[0], kind)})

    return Grid(stack("points", first), stack("cell_types", slice(None)), np.concatenate(offsets),
                np.concatenate(connectivity), stacked("point_data").taken(first), stacked("cell_data"),
                parts[0].units, parts[0].time)
