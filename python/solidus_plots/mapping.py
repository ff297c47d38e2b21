"""Fields of one mesh at points of another: linear in the simplices that the other mesh's cells are cut into.

    found = Mapper(grid, cells).at(points)      # a mask of cells of the same body
    found.of(grid.point_data["temperature"])    # [point], nan where the body is not
"""

from dataclasses import dataclass

import numpy as np

from solidus_plots.cells import VOLUME, tetrahedra

OUTSIDE = 0.05  # a point so far outside, as a share of a simplex, still belongs to it: curved skins are cut straight
CHUNK = 2_000_000  # pairs of points and simplices looked at together


@dataclass
class Found:
    """Where points lie."""

    nodes: np.ndarray  # [point][corner] of the simplex
    weights: np.ndarray  # [point][corner]
    inside: np.ndarray  # [point]
    extend: object  # values at the nodes of the grid -> at all nodes of the simplices

    def of(self, values):
        all_nodes = self.extend(values)
        mapped = np.einsum("pc,pc...->p...", self.weights, all_nodes[self.nodes])
        mapped[~self.inside] = np.nan
        return mapped


class Mapper:
    """The cells of a mask, sorted into boxes."""

    def __init__(self, grid, cells):
        if np.isin(grid.cell_types[cells], VOLUME).any():
            parts = tetrahedra(grid, cells)
            self._nodes, self._extend = parts.nodes, parts.refined.extend
            self._points = parts.refined.extend(grid.points)
        else:
            triangles, owners = grid.triangles()
            self._nodes, self._extend, self._points = triangles[cells[owners]], np.asarray, grid.points[:, :2]
        self._dimension = self._nodes.shape[1] - 1
        corners = self._points[self._nodes]
        self._origin = corners[:, 0]
        self._inverse = np.linalg.inv((corners[:, 1:] - corners[:, :1]).transpose(0, 2, 1))
        low, high = corners.min(axis=1), corners.max(axis=1)
        margin = OUTSIDE * (high - low).max(axis=1, keepdims=True)
        low, high = low - margin, high + margin
        self._low = low.min(axis=0)
        self._size = np.maximum(np.median((high - low).max(axis=1)), 1e-300)
        self._count = np.floor((high.max(axis=0) - self._low) / self._size).astype(np.int64) + 1
        first, last = self._box(low), self._box(high)
        span = last - first + 1
        owner = np.repeat(np.arange(len(first)), span.prod(axis=1))
        within = np.arange(len(owner)) - np.repeat(np.cumsum(span.prod(axis=1)) - span.prod(axis=1), span.prod(axis=1))
        boxes = np.zeros((len(owner), self._dimension), np.int64)
        for axis in range(self._dimension):
            within, boxes[:, axis] = np.divmod(within, span[owner, axis])
        number = self._number(boxes + first[owner])
        order = np.argsort(number, kind="stable")
        self._simplices = owner[order]
        self._starts = np.searchsorted(number[order], np.arange(self._count.prod() + 1))

    def _box(self, points):
        return np.clip(np.floor((points - self._low) / self._size).astype(np.int64), 0, self._count - 1)

    def _number(self, boxes):
        return np.ravel_multi_index(tuple(boxes.T), tuple(self._count))

    def at(self, points):
        points = points[:, :self._dimension]
        corners = self._dimension + 1
        nodes = np.zeros((len(points), corners), np.int64)
        weights, best = np.zeros((len(points), corners)), np.full(len(points), -np.inf)
        number = self._number(self._box(points))
        count = self._starts[number + 1] - self._starts[number]
        step = max(1, CHUNK // max(1, int(count.max(initial=1))))
        for start in range(0, len(points), step):
            part = slice(start, start + step)
            which = np.repeat(np.arange(len(points))[part], count[part])
            before = np.repeat(np.cumsum(count[part]) - count[part], count[part])
            simplex = self._simplices[self._starts[number[which]] + np.arange(len(which)) - before]
            share = np.einsum("pij,pj->pi", self._inverse[simplex], points[which] - self._origin[simplex])
            share = np.column_stack([1.0 - share.sum(axis=1), share])
            least = share.min(axis=1)
            order = np.argsort(least, kind="stable")  # the last one of a point, the best, stays
            which, simplex, share, least = which[order], simplex[order], share[order], least[order]
            nodes[which], weights[which], best[which] = self._nodes[simplex], share, least
        return Found(nodes, weights, best >= -OUTSIDE, self._extend)


def same_mesh(one, other):
    """Whether two grids have the same nodes and cells in the same order."""
    if len(one.points) != len(other.points) or not np.array_equal(one.cell_types, other.cell_types):
        return False
    extent = np.ptp(one.points, axis=0).max(initial=0.0)
    return np.array_equal(one.connectivity, other.connectivity) and \
        np.abs(one.points - other.points).max(initial=0.0) <= 1e-9 * extent
