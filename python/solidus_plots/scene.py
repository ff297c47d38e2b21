"""Surfaces of bodies in three dimensions: triangles with normals and edges, seen from somewhere, with light."""

from dataclasses import dataclass

import numpy as np

from solidus_plots.cells import boundary
from solidus_plots.cut import SIDES
from solidus_plots.raster import rasterise

CREASE = np.cos(np.radians(38.0))  # neighbours that turn by more make an edge
# Where light comes from (right, up, to the eye) and how strong it is; the rest comes from everywhere.
LIGHTS = (((-0.35, 0.65, 0.68), 0.48), ((0.75, -0.05, 0.65), 0.14))
AMBIENT = 0.56
HIDDEN = 4.0  # an edge is hidden by what lies so much nearer [pixels]; steep surfaces need some
NEAR = 0.01  # of the picture's longer side: so far behind what is seen a place still counts as seen


class Camera:
    """A parallel projection. `azimuth` counts from the first horizontal axis to the second (up z: from x to y),
    `elevation` above the horizon, both in degrees, to where the eye is."""

    def __init__(self, azimuth, elevation, up="z"):
        axis = "xyz".index(up)
        horizontal = np.eye(3)[[(axis + 1) % 3, (axis + 2) % 3]]
        a, e = np.radians(azimuth), np.radians(elevation)
        outwards = np.cos(a) * horizontal[0] + np.sin(a) * horizontal[1]
        self.eye = np.cos(e) * outwards + np.sin(e) * np.eye(3)[axis]
        self.right = -np.sin(a) * horizontal[0] + np.cos(a) * horizontal[1]
        self.up = np.cross(self.eye, self.right)

    def project(self, vectors):
        """[...][3] -> right, up, towards the eye."""
        return vectors @ np.stack([self.right, self.up, self.eye], axis=1)


@dataclass
class Surface:
    """Triangles to draw, with what they show."""

    points: np.ndarray  # [point][3] m
    levels: np.ndarray  # [point] above zero: cut away
    triangles: np.ndarray  # [triangle][3]
    cells: np.ndarray  # [triangle]
    normals: np.ndarray  # [triangle][3][3] at its corners
    sides: np.ndarray  # [triangle][3] whether the side opposite of the corner is an edge of a cell
    edges: np.ndarray  # [edge][2] points: where the surface bends sharply or ends
    values: np.ndarray  # [triangle][3] of the field at its corners; nan in bodies of plain colour

    def triangles_shown(self):
        """[triangle] whether it is not cut away altogether."""
        return (self.levels[self.triangles] <= 0.0).any(axis=1)

    def points_shown(self):
        """Points [m] of triangles that are not cut away."""
        used = np.zeros(len(self.points), bool)
        used[self.triangles] = True
        return self.points[used & (self.levels <= 0.0)]

    @staticmethod
    def join(parts):
        shift = np.cumsum([0] + [len(part.points) for part in parts[:-1]])
        arrays = {name: [getattr(part, name) for part in parts] for name in Surface.__dataclass_fields__}
        for name in ("triangles", "edges"):
            arrays[name] = [numbers + s for numbers, s in zip(arrays[name], shift)]
        return Surface(**{name: np.concatenate(found) for name, found in arrays.items()})


def outer(grid, cells, points, field, level=None):
    """The surface of the bodies of a mask, up to where a level at the nodes is zero. `points`: where the nodes
    are now [m]; `field`: "point_data" or "cell_data" and values."""
    body = grid.cell_data["body"]
    faces = boundary(grid, cells, body)
    place = faces.refined.extend(points)
    normals, edges = _normals(place, faces.nodes, body[faces.cells])
    levels = np.full(len(place), -1.0) if level is None else faces.refined.extend(level)
    return Surface(place, levels, faces.nodes, faces.cells, normals, faces.sides, edges,
                   _corner_values(field, faces.refined.extend, faces.nodes, faces.cells))


def cap(grid, part, points, field, normal=None):
    """What a cut shows of the inside of bodies; a cut along a plane has its normal."""
    place, base, body = part.at_points(points), len(part.ends), grid.cell_data["body"][part.cells]
    sides = np.sort(part.triangles[:, SIDES], axis=2) @ [base, 1]
    mesh = np.isin(sides, part.sides(part.cells) @ [base, 1])
    normals = np.broadcast_to(normal, (len(part.triangles), 3, 3)) if normal is not None else \
        _normals(place, part.triangles, body)[0]
    return Surface(place, np.full(base, -1.0), part.triangles, part.cells, normals, mesh, part.sides(body),
                   _corner_values(field, part.at_points, part.triangles, part.cells))


def _corner_values(field, at_points, triangles, cells):
    kind, values = field
    return at_points(values)[triangles] if kind == "point_data" else values[cells][:, None].repeat(3, axis=1)


def _normals(place, triangles, bodies):
    """Normals at the corners, averaged over the triangles round a point that turn by less than a crease; and
    the creases [edge][2]."""
    corners = place[triangles]
    area = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    unit = area / np.maximum(np.linalg.norm(area, axis=1), 1e-300)[:, None]
    # All pairs of triangles at a point.
    order = np.argsort(triangles.ravel(), kind="stable")
    count = np.bincount(triangles.ravel(), minlength=len(place))
    start = np.cumsum(count) - count
    partners = count[triangles.ravel()[order]]
    first = np.repeat(order, partners)
    within = np.arange(len(first)) - np.repeat(np.cumsum(partners) - partners, partners)
    second = order[np.repeat(start[triangles.ravel()[order]], partners) + within]
    near = (np.einsum("ij,ij->i", unit[first // 3], unit[second // 3]) > CREASE)
    near &= bodies[first // 3] == bodies[second // 3]
    normals = np.stack([np.bincount(first[near], area[second[near] // 3, axis], triangles.size)
                        for axis in range(3)], axis=1).reshape(*triangles.shape, 3)
    normals = normals / np.maximum(np.linalg.norm(normals, axis=2), 1e-300)[..., None]
    return normals, _creases(triangles, unit, bodies)


def _creases(triangles, unit, bodies):
    """[edge][2] sides behind which the next triangle turns by a crease, or there is none of the same body."""
    sides = np.sort(triangles[:, SIDES], axis=2).reshape(-1, 2).astype(np.int64)
    base = sides.max(initial=0) + 1
    key = (sides[:, 0] * base + sides[:, 1]) * (bodies.max(initial=0) + 1) + np.repeat(bodies, 3)
    order = np.argsort(key, kind="stable")
    key, owner = key[order], order // 3
    same = key[1:] == key[:-1]
    turn = np.einsum("ij,ij->i", unit[owner[1:]], unit[owner[:-1]]) > CREASE
    smooth = np.zeros(len(key), bool)
    smooth[1:] |= same & turn
    smooth[:-1] |= same & turn
    return np.unique(sides[order[~smooth]], axis=0)


class View:
    """A surface seen by a camera within a frame (lower and upper corner, right and up, m), in pixels."""

    def __init__(self, surface, camera, frame, shape):
        self._surface, self._camera = surface, camera
        (low, high), place = frame, camera.project(surface.points)
        self._scale = shape[1] / (high[0] - low[0])
        self._origin = np.array([low[0], high[1], 0.0])
        pixels = (place - self._origin) * [self._scale, -self._scale, self._scale]
        self.picture = rasterise(pixels, surface.triangles, shape, surface.levels)
        self._pixels = pixels

    def sees(self, place):
        """Whether a place on the surface lies within the frame with nothing before it."""
        column, row, depth = (self._camera.project(np.asarray(place)) - self._origin) * [self._scale, -self._scale, self._scale]
        shape = self.picture.depth.shape
        if not (0 <= row < shape[0] and 0 <= column < shape[1]):
            return False
        return bool(depth > self.picture.depth[int(row), int(column)] - NEAR * max(shape))

    def values(self):
        """Of the field, in the pixels seen."""
        return self.picture.at_corners(self._surface.values)

    def cells(self):
        return self.picture.at_triangles(self._surface.cells)

    def light(self):
        """How bright the pixels seen are."""
        normals = self._camera.project(self.picture.at_corners(self._surface.normals))
        normals /= np.maximum(np.linalg.norm(normals, axis=1), 1e-12)[:, None]
        normals *= np.where(normals[:, 2:] < 0.0, -1.0, 1.0)  # both sides of a surface are lit
        return AMBIENT + sum(strength * np.maximum(normals @ direction, 0.0)
                             for direction, strength in LIGHTS)

    def mesh(self, width):
        """The pixels seen [pixel] on edges of cells, `width` pixels wide."""
        picture = self.picture
        numbers, weights = picture.triangle[picture.seen], picture.weights[picture.seen]
        corners = self._pixels[:, :2][self._surface.triangles[numbers]]
        sides = corners[:, [2, 0, 1]] - corners[:, [1, 2, 0]]
        twice_area = np.abs(sides[:, 0, 0] * sides[:, 1, 1] - sides[:, 0, 1] * sides[:, 1, 0])
        distance = weights * (twice_area[:, None] / np.maximum(np.linalg.norm(sides, axis=2), 1e-9))
        return (self._surface.sides[numbers] & (distance < max(0.55, 0.5 * width))).any(axis=1)

    def edges(self, width):
        """All pixels [row][column] on visible edges of bodies and on their outlines, `width` pixels wide."""
        edges = self._pixels[self._surface.edges]
        count = np.ceil(2.0 * np.abs(edges[:, 1, :2] - edges[:, 0, :2]).max(axis=1)).astype(int) + 1
        which = np.repeat(np.arange(len(edges)), count)
        share = (np.arange(len(which)) - np.repeat(np.cumsum(count) - count, count) + 0.5) / count[which]
        levels = self._surface.levels[self._surface.edges][which]
        drawn = levels[:, 0] + share * (levels[:, 1] - levels[:, 0]) <= 0.0
        which, share = which[drawn], share[drawn, None]
        place = edges[which, 0] + share * (edges[which, 1] - edges[which, 0])
        depth, shape, found = self.picture.depth, self.picture.depth.shape, self._outline(width)
        reach = int(np.ceil(0.5 * width))
        for down in range(-reach, reach + 1):
            for right in range(-reach, reach + 1):
                if np.hypot(down, right) > 0.5 * width:
                    continue
                column, row = np.floor(place[:, :2]).astype(int).T + [[right], [down]]
                inside = (row >= 0) & (row < shape[0]) & (column >= 0) & (column < shape[1])
                row, column = row[inside], column[inside]
                visible = place[inside, 2] > depth[row, column] - HIDDEN
                found[row[visible], column[visible]] = True
        return found

    def _outline(self, width):
        """Pixels next to which another surface lies much further away, or nothing."""
        depth = np.where(self.picture.seen, self.picture.depth, -1e9)
        far = 0.012 * max(depth.shape)
        edge = np.zeros(depth.shape, bool)
        for axis in (0, 1):
            before, here, after = (np.take(depth, range(s, depth.shape[axis] - 2 + s), axis=axis)
                                   for s in range(3))
            bend = np.minimum(before, after) < here - far  # nearer than a neighbour ...
            bend &= before + after - 2 * here < -far  # ... and no steep plane
            inner = [slice(None)] * 2
            inner[axis] = slice(1, -1)
            edge[tuple(inner)] |= bend
        for _ in range(max(0, round(0.7 * width) - 1)):
            edge[1:] |= edge[:-1].copy()
            edge[:, 1:] |= edge[:, :-1].copy()
        return edge
