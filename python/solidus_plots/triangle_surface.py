"""Surfaces of triangles: nearest points with their side, by a tree of boxes that many points go down at once; STL files.

    surface = Surface(points, triangles)
    near = surface.nearest(places)      # near.distance is negative inside of a closed surface
"""

from dataclasses import dataclass
from pathlib import Path

import numpy as np

from solidus_plots.vtu import ResultError

LEAF = 8  # triangles in the last boxes
CHUNK = 20_000  # points that go down the tree together
MOST_PAIRS = 100_000  # of a point and a box, of up to eight triangles each, that are held at a time
TINY = 1e-12


@dataclass
class Nearest:
    """Of each point that was asked for."""

    triangle: np.ndarray  # [point]
    weights: np.ndarray  # [point][3] of the corners of that triangle
    place: np.ndarray  # [point][3] on the surface
    distance: np.ndarray  # [point] positive on the side to which the normals point

    def of(self, values, triangles):
        """Values at the points of the surface -> where the nearest places are."""
        return np.einsum("pc,pc...->p...", self.weights, values[triangles[self.triangle]])


class Surface:
    """Points [point][3], triangles [triangle][3] counter-clockwise seen from outside."""

    def __init__(self, points, triangles):
        if not len(triangles):
            raise ResultError("a surface without triangles has no nearest place")
        self.points, self.triangles = np.asarray(points, float), np.asarray(triangles)
        self._corners = self.points[self.triangles]
        cross = np.cross(self._corners[:, 1] - self._corners[:, 0], self._corners[:, 2] - self._corners[:, 0])
        self.normals = cross / np.maximum(np.linalg.norm(cross, axis=1), 1e-300)[:, None]
        self.areas = 0.5 * np.linalg.norm(cross, axis=1)
        self._build_tree()
        self._corner_normals, self._side_normals = self._angle_normals(), self._normals_of_sides()

    def extent(self):
        """The diagonal of the box around it."""
        return float(np.linalg.norm(np.ptp(self._corners.reshape(-1, 3), axis=0)))

    def volume(self):
        """Of what a closed surface encloses."""
        return float(np.einsum("ij,ij->i", self._corners[:, 0], np.cross(self._corners[:, 1], self._corners[:, 2])).sum() / 6)

    def _build_tree(self):
        """Triangles in an order in which every box of a level is a run of them; runs are halved along their longest side."""
        count = len(self.triangles)
        self._levels = max(0, int(np.ceil(np.log2(max(count / LEAF, 1)))))
        order, middles = np.arange(count), self._corners.mean(axis=1)
        bounds = np.array([0, count])
        for _ in range(self._levels):
            segment = np.repeat(np.arange(len(bounds) - 1), np.diff(bounds))
            low = np.minimum.reduceat(middles[order], bounds[:-1])
            high = np.maximum.reduceat(middles[order], bounds[:-1])
            key = middles[order, np.argmax(high - low, axis=1)[segment]]
            order = order[np.lexsort((key, segment))]
            halves = (bounds[:-1] + bounds[1:]) // 2
            bounds = np.sort(np.concatenate([bounds, halves]))
        self._order, self._bounds = order, bounds
        low, high = self._corners.min(axis=1)[order], self._corners.max(axis=1)[order]
        self._boxes = []
        for level in range(self._levels + 1):
            starts = bounds[:-1][::2 ** (self._levels - level)]
            self._boxes.append((np.minimum.reduceat(low, starts), np.maximum.reduceat(high, starts)))

    def _angle_normals(self):
        """Normals at the points, those of the triangles around weighted by their angles there."""
        sides = np.roll(self._corners, -1, axis=1) - self._corners
        sides /= np.maximum(np.linalg.norm(sides, axis=2), 1e-300)[..., None]
        angle = np.arccos(np.clip(-np.einsum("tci,tci->tc", sides, np.roll(sides, 1, axis=1)), -1, 1))
        weighted = (angle[..., None] * self.normals[:, None]).reshape(-1, 3)
        return np.stack([np.bincount(self.triangles.ravel(), weighted[:, axis], len(self.points)) for axis in range(3)], axis=1)

    def _normals_of_sides(self):
        """[triangle][3][3] the sum of the normals of both triangles at the side opposite of each corner."""
        ends = np.sort(self.triangles[:, [[1, 2], [2, 0], [0, 1]]], axis=2).reshape(-1, 2).astype(np.int64)
        _, side = np.unique(ends[:, 0] * (ends.max() + 1) + ends[:, 1], return_inverse=True)
        side, own = side.ravel(), np.repeat(self.normals, 3, axis=0)
        total = np.stack([np.bincount(side, own[:, axis]) for axis in range(3)], axis=1)
        return total[side].reshape(-1, 3, 3)

    def nearest(self, places, reach=np.inf):
        """The nearest places on the surface; of a point from which it is farther than `reach` the distance is infinite."""
        parts = [self._nearest(places[start:start + CHUNK], reach) for start in range(0, len(places), CHUNK)]
        if not parts:
            return Nearest(np.zeros(0, int), np.zeros((0, 3)), np.zeros((0, 3)), np.zeros(0))
        return Nearest(*(np.concatenate([getattr(part, name) for part in parts]) for name in Nearest.__dataclass_fields__))

    def _nearest(self, places, reach):
        """Pairs of a point and a box go down level by level; a box farther off than another is for sure is dropped. Points that all boxes are
        equally far from, as the centre of a ball is, have many pairs: then the points go in halves."""
        point, box = np.arange(len(places)), np.zeros(len(places), int)
        bound = (np.minimum(np.sqrt(self._bound(places)), reach) + TINY * np.abs(self._corners).max()) ** 2  # with room for rounding
        for level, (low, high) in enumerate(self._boxes):
            if level:
                point, box = np.repeat(point, 2), (2 * box[:, None] + [0, 1]).ravel()
            outside = np.maximum(np.maximum(low[box] - places[point], places[point] - high[box]), 0)
            least = np.einsum("ij,ij->i", outside, outside)
            kept = least <= bound[point]
            point, box = point[kept], box[kept]
            if len(point) > MOST_PAIRS and len(places) > 1:
                halves = [self._nearest(part, reach) for part in np.array_split(places, 2)]
                return Nearest(*(np.concatenate([getattr(half, name) for half in halves]) for name in Nearest.__dataclass_fields__))
        count = self._bounds[box + 1] - self._bounds[box]
        within = np.arange(count.sum()) - np.repeat(np.cumsum(count) - count, count)
        triangle = self._order[np.repeat(self._bounds[box], count) + within]
        point = np.repeat(point, count)
        weights = closest_weights(places[point], self._corners[triangle])
        found = np.einsum("pc,pci->pi", weights, self._corners[triangle])
        square = np.einsum("ij,ij->i", places[point] - found, places[point] - found)
        order = np.lexsort((triangle, square, point))
        reached, first = np.unique(point[order], return_index=True)
        first = order[first]
        near = self._signed(places[reached], triangle[first], weights[first], found[first], np.sqrt(square[first]))
        if len(reached) == len(places):
            return near
        all_of = Nearest(np.zeros(len(places), int), np.zeros((len(places), 3)), np.full((len(places), 3), np.nan), np.full(len(places), np.inf))
        for name in Nearest.__dataclass_fields__:
            getattr(all_of, name)[reached] = getattr(near, name)
        return all_of

    def _bound(self, places):
        """The square of a distance that is not less than the least one: to the triangles in the box into which each point goes by going to
        the nearer half."""
        box = np.zeros(len(places), int)
        for low, high in self._boxes[1:]:
            halves = 2 * box[:, None] + [0, 1]
            outside = np.maximum(np.maximum(low[halves] - places[:, None], places[:, None] - high[halves]), 0)
            box = halves[np.arange(len(places)), np.argmin(np.einsum("phi,phi->ph", outside, outside), axis=1)]
        square = np.full(len(places), np.inf)
        for step in range(int((self._bounds[box + 1] - self._bounds[box]).max())):
            number = np.minimum(self._bounds[box] + step, self._bounds[box + 1] - 1)
            triangle = self._order[number]
            found = np.einsum("pc,pci->pi", closest_weights(places, self._corners[triangle]), self._corners[triangle])
            square = np.minimum(square, np.einsum("ij,ij->i", places - found, places - found))
        return square

    def _signed(self, places, triangle, weights, found, distance):
        """The side by the normal of a triangle within it, of both triangles on a side, by angles at a corner."""
        touched = weights > 1e-9
        normal, corners = self.normals[triangle].copy(), touched.sum(axis=1)
        on_side = np.flatnonzero(corners == 2)
        normal[on_side] = self._side_normals[triangle[on_side], np.argmin(touched[on_side], axis=1)]
        at_corner = np.flatnonzero(corners == 1)
        normal[at_corner] = self._corner_normals[self.triangles[triangle[at_corner], np.argmax(touched[at_corner], axis=1)]]
        inside = np.einsum("ij,ij->i", places - found, normal) < 0
        return Nearest(triangle, weights, found, np.where(inside, -distance, distance))


def closest_weights(places, corners):
    """Weights [pair][3] of the corners [pair][3][3] of a triangle at its place nearest to a point."""
    a, b, c = corners[:, 0], corners[:, 1], corners[:, 2]
    ab, ac, ap = b - a, c - a, places - a
    d00, d01, d11 = (np.einsum("ij,ij->i", x, y) for x, y in ((ab, ab), (ab, ac), (ac, ac)))
    d20, d21 = np.einsum("ij,ij->i", ap, ab), np.einsum("ij,ij->i", ap, ac)
    determinant = d00 * d11 - d01 * d01
    flat = determinant <= TINY * np.maximum(d00 * d11, 1e-300)
    safe = np.where(flat, 1, determinant)
    v, w = (d11 * d20 - d01 * d21) / safe, (d00 * d21 - d01 * d20) / safe
    weights = np.stack([1 - v - w, v, w], axis=1)
    outside = np.flatnonzero(flat | (weights < 0).any(axis=1))
    if outside.size:
        weights[outside] = _on_sides(places[outside], corners[outside])
    return weights


def _on_sides(places, corners):
    """The same for points whose nearest place is on a side."""
    best, square = np.zeros((len(places), 3)), np.full(len(places), np.inf)
    for i, j in ((0, 1), (1, 2), (2, 0)):
        along = corners[:, j] - corners[:, i]
        length = np.maximum(np.einsum("ij,ij->i", along, along), 1e-300)
        t = np.clip(np.einsum("ij,ij->i", places - corners[:, i], along) / length, 0, 1)
        away = places - corners[:, i] - t[:, None] * along
        nearer = np.einsum("ij,ij->i", away, away) < square
        square[nearer] = np.einsum("ij,ij->i", away, away)[nearer]
        weights = np.zeros((len(places), 3))
        weights[:, i], weights[:, j] = 1 - t, t
        best[nearer] = weights[nearer]
    return best


def read_stl(path, scale):
    """A surface in metres of an STL file, binary or text; points at one place are joined. Throws ResultError."""
    data = Path(path).read_bytes()
    count = int.from_bytes(data[80:84], "little") if len(data) >= 84 else -1
    if len(data) == 84 + 50 * count and count > 0:
        records = np.frombuffer(data, np.dtype([("n", "<f4", 3), ("v", "<f4", (3, 3)), ("a", "<u2")]), count, 84)
        corners = records["v"].astype(float)
    else:
        corners = _text_triangles(path, data)
    if not np.isfinite(corners).all():
        raise ResultError(f"{path}: a coordinate is no number")
    points, index = np.unique(corners.reshape(-1, 3), axis=0, return_inverse=True)
    triangles = index.reshape(-1, 3)
    real = (triangles[:, 0] != triangles[:, 1]) & (triangles[:, 1] != triangles[:, 2]) & (triangles[:, 2] != triangles[:, 0])
    if not real.any():
        raise ResultError(f"{path}: no triangle has an area")
    return Surface(scale * points, triangles[real])


def _text_triangles(path, data):
    words = data.decode("latin-1").split()
    if not words or words[0].lower() != "solid":
        raise ResultError(f"{path}: this is no STL file, binary or text")
    at = [i for i, word in enumerate(words) if word.lower() == "vertex"]
    try:
        corners = np.array([[float(word) for word in words[i + 1:i + 4]] for i in at])
    except ValueError as error:
        raise ResultError(f"{path}: a vertex has no three numbers ({error})") from error
    if not len(corners) or corners.shape[1] != 3 or len(corners) % 3:
        raise ResultError(f"{path}: the file ends within a triangle, or has none")
    return corners.reshape(-1, 3, 3)


def write_stl(path, points, triangles, scale=1e3, name="Solidus, mm"):
    """A binary STL file of points in metres; in millimetres by default."""
    corners = scale * points[triangles]
    records = np.zeros(len(triangles), np.dtype([("n", "<f4", 3), ("v", "<f4", (3, 3)), ("a", "<u2")]))
    normal = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    records["n"] = normal / np.maximum(np.linalg.norm(normal, axis=1), 1e-300)[:, None]
    records["v"] = corners
    Path(path).write_bytes(name.encode("ascii", "replace")[:80].ljust(80) + len(triangles).to_bytes(4, "little") + records.tobytes())
