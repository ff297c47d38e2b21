"""The fields of one moment of a run, on their mesh."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np
from solidus_plots.vtu import Grid, read_fields

from .errors import SolidusError
from .shape_functions import ELEMENTS, locate

if TYPE_CHECKING:
    import meshio
    import pyvista


class Place:
    """Where a point lies in a mesh: found once, it serves the fields of all moments with that mesh."""

    def __init__(self, cell: int, nodes: np.ndarray, weights: np.ndarray) -> None:
        self.cell, self.nodes, self.weights = cell, nodes, weights


class Moment(Mapping[str, np.ndarray]):
    """Fields at one time: ``moment["temperature"]`` is an array, [node] or [element] and, of vectors and tensors, [component].

    Arrays are in SI units, read on first use, and kept; for a run on one process they are views of the unpacked file,
    without a copy.
    """

    def __init__(self, grid: Grid, bodies: list[str] | None = None, file: Path | None = None) -> None:
        self._grid, self._arrays = grid, {}
        #: names of the bodies; ``moment["body"]`` has their numbers
        self.bodies = bodies or []
        #: the file that it was read from, nothing where it comes from a simulation in this process
        self.file = file

    @classmethod
    def read(cls, file: str | Path, bodies: list[str] | None = None) -> "Moment":
        """Reads a ``.vtu``, or a ``.pvtu`` with its parts joined."""
        return cls(read_fields(file), bodies, Path(file))

    # The mesh

    @property
    def time(self) -> float:
        """[s]"""
        return self._grid.time

    @property
    def points(self) -> np.ndarray:
        """Coordinates of the nodes before deformation [node][3] [m]."""
        return self._grid.points

    @property
    def cells(self) -> dict[str, np.ndarray]:
        """Node numbers of the elements by shape: ``moment.cells["tri3"]`` is [element][node]."""
        return {element.name: self._grid.cells(number)[1] for number, element in ELEMENTS.items()
                if np.any(self._grid.cell_types == number)}

    def deformed(self, scale: float = 1.0) -> np.ndarray:
        """Coordinates of the nodes plus the displacement multiplied by a factor [node][3] [m]."""
        return self.points + scale * self["displacement"] if "displacement" in self else self.points

    # The fields

    def location(self, name: str) -> str:
        """``"nodes"`` or ``"elements"``. Raises ``KeyError`` with the nearest name."""
        if name in self._grid.point_data:
            return "nodes"
        if name in self._grid.cell_data:
            return "elements"
        import difflib

        near = difflib.get_close_matches(name, list(self), 1)
        raise KeyError(f"there is no field '{name}'; " + (f"did you mean '{near[0]}'? " if near else "")
                       + "one of: " + ", ".join(self))

    def __getitem__(self, name: str) -> np.ndarray:
        if name not in self._arrays:
            data = self._grid.point_data if self.location(name) == "nodes" else self._grid.cell_data
            self._arrays[name] = data[name]
        return self._arrays[name]

    def unit(self, name: str) -> str:
        """Unit of a field, ``"1"`` if dimensionless."""
        self.location(name)
        return self._grid.units.get(name, "1")

    def __iter__(self) -> Iterator[str]:
        yield from self._grid.point_data
        yield from self._grid.cell_data

    def __len__(self) -> int:
        return len(self._grid.point_data) + len(self._grid.cell_data)

    def _ipython_key_completions_(self) -> list[str]:
        return list(self)

    def __repr__(self) -> str:
        return (f"<Moment t = {self.time:g} s: {len(self.points)} nodes, {len(self._grid.cell_types)} elements; "
                f"{', '.join(self)}>")

    # Probes

    def place(self, point: Any, body: str | None = None) -> Place:
        """The element that contains a point of the undeformed bodies.

        Parameters
        ----------
        point:
            Two or three coordinates [m].
        body:
            The name of the body, where bodies touch.
        """
        where = np.zeros(3)
        given = np.asarray(point, float)
        if given.shape not in ((2,), (3,)):
            raise ValueError(f"a point has two or three coordinates, not the shape {given.shape}")
        where[:len(given)] = given
        best, least = None, np.inf
        for number, element in ELEMENTS.items():
            cells, nodes = self._grid.cells(number)
            if body is not None and cells.size:
                chosen = self["body"][cells] == self._number_of(body)
                cells, nodes = cells[chosen], nodes[chosen]
            if not cells.size or (element.dimension == 2 and where[2] != 0):
                continue
            found = locate(element, self.points[nodes][..., :element.dimension], where[:element.dimension])
            if found and found[2] < least:
                best, least = Place(int(cells[found[0]]), nodes[found[0]], found[1]), found[2]
        if best is None:
            low, high = self.points.min(0), self.points.max(0)
            raise SolidusError(f"no element{f' of {body}' if body else ''} holds the point {given.tolist()} m; the mesh lies "
                               f"between {low.tolist()} and {high.tolist()} m")
        return best

    def _number_of(self, body: str) -> int:
        if body not in self.bodies:
            raise KeyError(f"there is no body '{body}'; one of: {', '.join(self.bodies)}")
        return self.bodies.index(body)

    def probe(self, field: str, point: Any, body: str | None = None) -> Any:
        """The value of a field at a point: interpolated between nodes, or that of the element.

        ``point`` is one point, or an array of them [point][2 or 3]; or a :class:`Place`.
        """
        values = self[field]
        if not isinstance(point, Place):
            given = np.asarray(point, float)
            if given.ndim == 2:
                return np.array([self.probe(field, each, body) for each in given])
            point = self.place(point, body)
        if self.location(field) == "elements":
            return values[point.cell]
        return np.tensordot(point.weights, values[point.nodes], 1)

    # Other libraries

    def to_vtk(self) -> Any:
        """The moment as ``vtkUnstructuredGrid``. Needs VTK's Python module (Debian: python3-vtk9)."""
        try:
            import vtkmodules.vtkCommonDataModel as model
            from vtkmodules.util.numpy_support import numpy_to_vtk, numpy_to_vtkIdTypeArray
            from vtkmodules.vtkCommonCore import vtkPoints
        except ImportError as error:
            raise ImportError("to_vtk() needs VTK's Python module: apt install python3-vtk9, or pip install vtk") from error
        grid = model.vtkUnstructuredGrid()
        points = vtkPoints()
        points.SetData(numpy_to_vtk(np.ascontiguousarray(self.points), deep=True))
        grid.SetPoints(points)
        offsets = np.concatenate([[0], self._grid.offsets]).astype(np.int64)
        cells = model.vtkCellArray()
        cells.SetData(numpy_to_vtkIdTypeArray(offsets, deep=True),
                      numpy_to_vtkIdTypeArray(np.asarray(self._grid.connectivity, np.int64), deep=True))
        grid.SetCells(numpy_to_vtk(np.asarray(self._grid.cell_types, np.uint8), deep=True), cells)
        for name in self:
            array = numpy_to_vtk(np.ascontiguousarray(self[name]), deep=True)
            array.SetName(name)
            (grid.GetPointData() if self.location(name) == "nodes" else grid.GetCellData()).AddArray(array)
        return grid

    def to_pyvista(self) -> "pyvista.UnstructuredGrid":
        """The moment as pyvista's grid. Needs pyvista."""
        try:
            import pyvista
        except ImportError as error:
            raise ImportError("to_pyvista() needs pyvista: pip install pyvista") from error
        return pyvista.wrap(self.to_vtk())

    def to_meshio(self) -> "meshio.Mesh":
        """The moment as meshio's mesh. Needs meshio (Debian: python3-meshio)."""
        try:
            import meshio
        except ImportError as error:
            raise ImportError("to_meshio() needs meshio: apt install python3-meshio, or pip install meshio") from error
        blocks, order = [], []
        for number, element in ELEMENTS.items():
            cells, nodes = self._grid.cells(number)
            if cells.size:
                blocks.append((element.meshio, nodes))
                order.append(cells)
        fields = {name: self[name] for name in self}
        return meshio.Mesh(self.points, blocks,
                           point_data={n: v for n, v in fields.items() if self.location(n) == "nodes"},
                           cell_data={n: [v[cells] for cells in order] for n, v in fields.items()
                                      if self.location(n) == "elements"})
