"""Shape functions of the elements, in VTK's numbering of cells and nodes, and the search for the element at a point."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Callable

import numpy as np

Array = np.ndarray


def _triangle(order: int) -> Callable[[Array], Array]:
    def shapes(xi: Array) -> Array:
        r, s = xi[..., 0], xi[..., 1]
        t = 1 - r - s
        if order == 1:
            return np.stack([t, r, s], -1)
        return np.stack([t * (2 * t - 1), r * (2 * r - 1), s * (2 * s - 1), 4 * t * r, 4 * r * s, 4 * s * t], -1)

    return shapes


def _tetrahedron(order: int) -> Callable[[Array], Array]:
    def shapes(xi: Array) -> Array:
        r, s, u = xi[..., 0], xi[..., 1], xi[..., 2]
        t = 1 - r - s - u
        if order == 1:
            return np.stack([t, r, s, u], -1)
        corners = [v * (2 * v - 1) for v in (t, r, s, u)]
        return np.stack([*corners, 4 * t * r, 4 * r * s, 4 * s * t, 4 * t * u, 4 * r * u, 4 * s * u], -1)

    return shapes


# Corners and middles of edges of the square and the cube on [-1, 1], in VTK's order.
_SQUARE = np.array([(-1, -1), (1, -1), (1, 1), (-1, 1), (0, -1), (1, 0), (0, 1), (-1, 0)], float)
_CUBE = np.array([(-1, -1, -1), (1, -1, -1), (1, 1, -1), (-1, 1, -1), (-1, -1, 1), (1, -1, 1), (1, 1, 1), (-1, 1, 1),
                  (0, -1, -1), (1, 0, -1), (0, 1, -1), (-1, 0, -1), (0, -1, 1), (1, 0, 1), (0, 1, 1), (-1, 0, 1),
                  (-1, -1, 0), (1, -1, 0), (1, 1, 0), (-1, 1, 0)], float)


def _box(nodes: Array, order: int) -> Callable[[Array], Array]:
    """Linear and serendipity elements of the square and the cube."""
    dimension = nodes.shape[1]
    count = 2**dimension if order == 1 else len(nodes)

    def shapes(xi: Array) -> Array:
        values = []
        for node in nodes[:count]:
            along = 1 + xi * node  # [..., dimension]
            if order == 1:
                values.append(np.prod(along, -1) / 2**dimension)
            elif np.all(node != 0):
                values.append(np.prod(along, -1) * (np.sum(xi * node, -1) - (dimension - 1)) / 2**dimension)
            else:
                middle = node == 0
                values.append(np.prod(np.where(middle, 1 - xi**2, along), -1) / 2 ** (dimension - 1))
        return np.stack(values, -1)

    return shapes


@dataclass(frozen=True)
class Element:
    """A kind of cell.

    ``shapes`` takes reference coordinates [..., dimension] to the values of the shape functions [..., node]; ``simplex`` tells
    which reference cell it is, and ``name`` is the one that cases use.
    """

    name: str
    dimension: int
    nodes: int
    simplex: bool
    shapes: Callable[[Array], Array]
    meshio: str

    def slopes(self, xi: Array) -> Array:
        """dN/dxi [..., node, dimension]. Shape functions are at most cubic along an axis, and there only quadratic in each
        variable: central differences over a step of one half are exact."""
        columns = []
        for axis in range(self.dimension):
            step = np.zeros(self.dimension)
            step[axis] = 0.5
            columns.append(self.shapes(xi + step) - self.shapes(xi - step))
        return np.stack(columns, -1)

    def outside(self, xi: Array) -> Array:
        """How far points lie outside of the reference cell [...]; not positive inside."""
        if self.simplex:
            return np.maximum(np.max(-xi, -1), np.sum(xi, -1) - 1)
        return np.max(np.abs(xi), -1) - 1


#: by VTK's number
ELEMENTS = {
    5: Element("tri3", 2, 3, True, _triangle(1), "triangle"),
    22: Element("tri6", 2, 6, True, _triangle(2), "triangle6"),
    9: Element("quad4", 2, 4, False, _box(_SQUARE, 1), "quad"),
    23: Element("quad8", 2, 8, False, _box(_SQUARE, 2), "quad8"),
    10: Element("tet4", 3, 4, True, _tetrahedron(1), "tetra"),
    24: Element("tet10", 3, 10, True, _tetrahedron(2), "tetra10"),
    12: Element("hex8", 3, 8, False, _box(_CUBE, 1), "hexahedron"),
    25: Element("hex20", 3, 20, False, _box(_CUBE, 2), "hexahedron20"),
}

_TOLERANCE = 1e-8  # of reference coordinates: a point on a face belongs to both cells
_NEWTON = 30


def locate(element: Element, corners: Array, point: Array) -> tuple[int, Array, float] | None:
    """Finds the cell of one kind that holds a point.

    Parameters
    ----------
    corners:
        Coordinates of the nodes of each cell [cell][node][dimension].
    point:
        [dimension]

    Returns the number of the cell, the shape functions there, and how far outside the point lies in reference coordinates (at most
    a tolerance; the innermost cell is taken). Nothing where no cell holds it.
    """
    low, high = corners.min(1), corners.max(1)
    room = 0.1 * (high - low).max(1, keepdims=True)  # edges may bulge between their nodes
    candidates = np.flatnonzero(np.all((point >= low - room) & (point <= high + room), 1))
    if not candidates.size:
        return None
    nodes = corners[candidates]
    xi = np.full((len(candidates), element.dimension), 1 / (element.dimension + 1) if element.simplex else 0.0)
    with np.errstate(all="ignore"):
        for _ in range(_NEWTON):
            missing = point - np.einsum("cn,cnd->cd", element.shapes(xi), nodes)
            jacobian = np.einsum("cnd,cnr->cdr", nodes, element.slopes(xi))
            good = np.abs(np.linalg.det(jacobian)) > 0
            change = np.zeros_like(xi)
            change[good] = np.linalg.solve(jacobian[good], missing[good][..., None])[..., 0]
            xi = np.clip(xi + change, -3, 3)
            if np.abs(change).max() < 1e-13:
                break
        missing = point - np.einsum("cn,cnd->cd", element.shapes(xi), nodes)
        size = (high - low).max(1)[candidates]
        outside = np.where(np.linalg.norm(missing, axis=1) < 1e-9 * size, element.outside(xi), np.inf)
    best = int(np.argmin(outside))
    if not outside[best] <= _TOLERANCE:
        return None
    return int(candidates[best]), element.shapes(xi[best]), float(outside[best])
