"""A small z-buffer: which triangle is seen in each pixel, and where in it; colours are made from that.

Parallel projection, so weights are linear in the pixel. A million triangles take a few seconds.
"""

from dataclasses import dataclass

import numpy as np

CHUNK = 1_000_000  # candidate pixels looked at together


@dataclass
class Picture:
    """What is seen. Rows count downwards."""

    triangle: np.ndarray  # [row][column] -1 where nothing is seen
    weights: np.ndarray  # [row][column][3] of the triangle's nodes
    depth: np.ndarray  # [row][column] of what is seen, larger is nearer

    @property
    def seen(self):
        return self.triangle >= 0

    def at_corners(self, values):
        """Values at the corners of triangles [triangle][3](...) -> in the pixels seen [pixel](...)."""
        numbers = self.triangle[self.seen]
        weights = self.weights[self.seen].T.reshape(3, -1, *[1] * (values.ndim - 2))
        return sum(weights[node] * values[numbers, node] for node in range(3))

    def at_triangles(self, values):
        """Values of triangles -> in the pixels seen."""
        return values[self.triangle[self.seen]]


def rasterise(points, triangles, shape, levels=None):
    """Draws triangles of points [point][3]: column and row (pixel (0, 0) has its middle at (0.5, 0.5)), depth.
    With `levels` at the points what lies above zero is cut away. `shape`: rows, columns."""
    picture = Picture(np.full(shape, -1, np.int32), np.zeros((*shape, 3), np.float32),
                      np.full(shape, -np.inf))
    flat = Picture(picture.triangle.reshape(-1), picture.weights.reshape(-1, 3), picture.depth.reshape(-1))
    corners = points[triangles]
    low = np.ceil(corners[..., :2].min(axis=1) - 0.5).astype(np.int64).clip(0)
    high = np.floor(corners[..., :2].max(axis=1) - 0.5).astype(np.int64).clip(max=np.subtract(shape, 1)[::-1])
    size = (high - low + 1).clip(0)
    with np.errstate(divide="ignore", invalid="ignore"):
        to_weights = _weights_of_pixels(corners)
    drawn = (size.prod(axis=1) > 0) & np.isfinite(to_weights).all(axis=(0, 1))
    taken = np.flatnonzero(drawn)
    ends = np.cumsum(size[taken].prod(axis=1))
    start = 0
    while start < len(taken):
        before = ends[start - 1] if start else 0
        stop = max(start + 1, int(np.searchsorted(ends, before + CHUNK, side="right")))
        _draw(flat, taken[start:stop], low, size, to_weights, corners[..., 2], shape[1],
              None if levels is None else levels[triangles])
        start = stop
    return picture


def _weights_of_pixels(corners):
    """[node][3][triangle]: the weight of a node is (column, row, 1) times this."""
    x, y = corners[..., 0].T, corners[..., 1].T
    following, last = [1, 2, 0], [2, 0, 1]
    slopes = np.stack([y[following] - y[last], x[last] - x[following],
                       x[following] * y[last] - x[last] * y[following]], axis=1)
    return slopes / slopes[:, 2].sum(axis=0)


def _draw(flat, numbers, low, size, to_weights, depths, columns, levels):
    count = size[numbers].prod(axis=1)
    which = np.repeat(numbers.astype(np.int32), count)
    before = (np.cumsum(count) - count).astype(np.int32)
    within = np.arange(len(which), dtype=np.int32) - np.repeat(before, count)
    row, column = np.divmod(within, size[:, 0].astype(np.int32)[which])
    row += low[:, 1].astype(np.int32)[which]
    column += low[:, 0].astype(np.int32)[which]
    weights = []
    for node in range(3):  # each throws away what lies outside
        x, y, constant = to_weights[node]
        weight = (column + 0.5) * x[which] + (row + 0.5) * y[which] + constant[which]
        inside = np.flatnonzero(weight >= -1e-9)
        which, row, column = which[inside], row[inside], column[inside]
        weights = [earlier[inside] for earlier in weights] + [weight[inside]]
    weights = np.stack(weights, axis=1)
    pixel, depth = row * columns + column, (weights * depths[which]).sum(axis=1)
    seen = depth > flat.depth[pixel]
    if levels is not None:
        seen &= (weights * levels[which]).sum(axis=1) <= 0.0
    pixel, depth, weights, which = pixel[seen], depth[seen], weights[seen], which[seen]
    order = np.argsort(depth, kind="stable")  # of several in one pixel the last one, the nearest, stays
    pixel = pixel[order]
    flat.depth[pixel], flat.triangle[pixel] = depth[order], which[order]
    flat.weights[pixel] = weights[order]
