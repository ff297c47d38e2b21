"""Cuts through cells of volume, by planes or where a field has a value: marching through linear tetrahedra.

    part = cut(grid, cells, Plane.axis("z", 0.02))
    part.place, part.triangles, part.at_nodes(grid.point_data["temperature"]), part.cells
"""

from dataclasses import dataclass, replace

import numpy as np

from solidus_plots.cells import Refined, tetrahedra

SIDES = [[1, 2], [2, 0], [0, 1]]  # of a triangle, opposite of its nodes
SNAP = 1e-7  # of the model's extent: nodes so close to a plane lie on it, whatever the mesh file's digits


@dataclass
class Plane:
    """Points with normal . (x - origin) = 0; `right` and `up` are its unit vectors in a drawing."""

    origin: np.ndarray  # [m]
    normal: np.ndarray
    right: np.ndarray
    up: np.ndarray
    names: tuple  # of the drawing's axes

    @staticmethod
    def axis(name, position):
        """Normal to an axis: z shows x-y, y shows x-z, x shows y-z."""
        index, (right, up) = "xyz".index(name), {"z": "xy", "y": "xz", "x": "yz"}[name]
        unit = np.eye(3)
        return Plane(position * unit[index], unit[index], unit["xyz".index(right)], unit["xyz".index(up)],
                     (right, up))

    @staticmethod
    def through(origin, normal):
        """Any plane; upwards is what comes nearest to z (to y for a horizontal plane)."""
        normal = np.asarray(normal, float) / np.linalg.norm(normal)
        up = np.array([0.0, 0.0, 1.0]) if abs(normal[2]) < 0.99 else np.array([0.0, 1.0, 0.0])
        up = up - (up @ normal) * normal
        up /= np.linalg.norm(up)
        return Plane(np.asarray(origin, float), normal, np.cross(up, normal), up, ("s", "t"))

    def distance(self, points):
        return (points - self.origin) @ self.normal

    def facing(self, eye):
        """The same plane with its normal towards an eye."""
        return self if self.normal @ eye >= 0.0 else replace(self, normal=-self.normal)

    def place(self, vectors):
        """The part of vectors [...][3] in the plane [...][2]; of points in an axis' plane: coordinates."""
        return np.stack([vectors @ self.right, vectors @ self.up], axis=-1)


@dataclass
class Cut:
    """Triangles of a cut. Its points lie on edges of tetrahedra, each is there once."""

    ends: np.ndarray  # [point][2] nodes of `refined`
    share: np.ndarray  # [point] of the second end
    triangles: np.ndarray  # [triangle][3] points
    cells: np.ndarray  # [triangle] the cell it is a part of
    refined: Refined

    def at_points(self, values):
        """Values at the nodes of the grid -> at the points of the cut; exact along the edges."""
        ends = self.refined.extend(values)[self.ends]
        share = self.share.reshape(-1, *[1] * (ends.ndim - 2))
        return (1 - share) * ends[:, 0] + share * ends[:, 1]

    def sides(self, groups):
        """Sides of triangles [side][2] that one triangle of its group has alone. `groups`: a number for each
        triangle; with bodies these are their outlines, with cells the lines of the mesh."""
        sides = np.sort(self.triangles[:, SIDES].reshape(-1, 2), axis=1).astype(np.int64)
        base = len(self.ends) + 1
        flat, group = sides[:, 0] * base + sides[:, 1], np.repeat(groups, 3)
        order = np.lexsort((group, flat))
        flat, group = flat[order], group[order]
        new = np.ones(len(flat) + 1, bool)
        new[1:-1] = (flat[1:] != flat[:-1]) | (group[1:] != group[:-1])
        alone = np.unique(flat[new[:-1] & new[1:]])
        return np.stack([alone // base, alone % base], axis=1)


def cut(grid, cells, plane):
    """Cuts the volume cells of a mask. A plane along faces shows the cells below it, against its normal; at the
    lower end of the cells those above."""
    extent = np.ptp(grid.points, axis=0).max(initial=0.0)
    level = plane.distance(grid.points)
    level[np.abs(level) < SNAP * extent] = 0.0
    used = grid.connectivity[np.repeat(cells, np.diff(grid.offsets, prepend=0))]
    return cut_where(grid, cells, -level if used.size and level[used].min() >= 0.0 else level)


def cut_where(grid, cells, level):
    """Cuts the volume cells of a mask where values at the nodes pass zero. Triangles are counter-clockwise seen
    from where the values are positive."""
    owner = np.repeat(np.arange(len(grid.cell_types)), np.diff(grid.offsets, prepend=0))
    above = (level >= 0.0)[grid.connectivity]
    count = np.bincount(owner, weights=above, minlength=len(cells))
    size = np.diff(grid.offsets, prepend=0)
    parts = tetrahedra(grid, cells & (count > 0) & (count < size))
    part = _march(parts, parts.refined.extend(level))
    nodes = parts.refined.extend(grid.points)
    uphill = (nodes[part.ends[:, 0]] - nodes[part.ends[:, 1]])[part.triangles].sum(axis=1)
    corners = part.at_points(grid.points)[part.triangles]
    normals = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    wrong = np.einsum("ij,ij->i", normals, uphill) < 0.0
    part.triangles[wrong] = part.triangles[wrong, ::-1]
    return part


def _march(parts, level):
    nodes, cells = parts.nodes, parts.cells
    above = level[nodes] >= 0.0
    order = np.argsort(~above, axis=1, kind="stable")  # those above first
    nodes, count = np.take_along_axis(nodes, order, axis=1), above.sum(axis=1)
    # For one, two and three nodes above: the edges (above, below) round the cut.
    rounds = {1: [(0, 1), (0, 2), (0, 3)], 2: [(0, 2), (0, 3), (1, 3), (1, 2)], 3: [(0, 3), (1, 3), (2, 3)]}
    corners, owners = [np.zeros((0, 3, 2), int)], [np.zeros(0, int)]
    for number, edges in rounds.items():
        crossed = count == number
        ring = nodes[crossed][:, edges]  # [tetrahedron][corner][end]
        for last in range(2, len(edges)):
            corners.append(ring[:, [0, last - 1, last]])
            owners.append(cells[crossed])
    corners, owners = np.concatenate(corners), np.concatenate(owners)
    first, second = level[corners[..., 0]], level[corners[..., 1]]
    corners[..., 1] = np.where(first == 0.0, corners[..., 0], corners[..., 1])  # the node itself
    key = corners[..., 0].astype(np.int64) * parts.refined.count + corners[..., 1]
    _, where, points = np.unique(key, return_index=True, return_inverse=True)
    points = points.reshape(key.shape)
    area = (points[:, 0] != points[:, 1]) & (points[:, 1] != points[:, 2]) & (points[:, 2] != points[:, 0])
    share = np.zeros(len(where))
    first, second = first.ravel()[where], second.ravel()[where]
    np.divide(first, first - second, out=share, where=first > 0.0)
    return Cut(corners.reshape(-1, 2)[where], share, points[area], owners[area], parts.refined)


def isolines(place, triangles, values, level):
    """Lines [line][point][2] along which values at the points of plane triangles have a level, each through as many
    triangles as it crosses: what is drawn in dashes has to be in one piece."""
    above = values[triangles] >= level
    crossed = above.any(axis=1) & ~above.all(axis=1)
    nodes, above = triangles[crossed], above[crossed]
    alone = np.argmax(above == (above.sum(axis=1) == 1)[:, None], axis=1)  # the node on its side of the line
    tip = np.take_along_axis(nodes, alone[:, None], axis=1)
    others = np.stack([nodes[np.arange(len(nodes)), (alone + shift) % 3] for shift in (1, 2)], axis=1)
    share = (level - values[tip]) / (values[others] - values[tip])
    points = place[tip] + share[..., None] * (place[others] - place[tip])
    sides = np.sort(np.stack([np.broadcast_to(tip, others.shape), others], axis=-1), axis=-1)
    return [np.array(line) for line in _joined(sides.tolist(), points)]


def _joined(sides, points):
    """Pieces [piece][2 ends] whose ends lie on the same sides of triangles, joined to lines of points."""
    ends = [[tuple(side) for side in piece] for piece in sides]
    at = {}
    for piece, pair in enumerate(ends):
        for side in pair:
            at.setdefault(side, []).append(piece)
    free, lines = set(range(len(ends))), []

    def follow(piece, end):
        """The points beyond an end of a piece, as far as one piece after the other joins on."""
        found = []
        while True:
            side = ends[piece][end]
            piece = next((other for other in at[side] if other in free), None)
            if piece is None:
                return found
            free.remove(piece)
            end = 1 - ends[piece].index(side)
            found.append(points[piece][end])

    for piece in range(len(ends)):
        if piece in free:
            free.remove(piece)
            ahead = follow(piece, 1)
            lines.append(follow(piece, 0)[::-1] + [*points[piece]] + ahead)
    return lines
