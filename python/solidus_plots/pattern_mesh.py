"""The mesh of a drawing as the program writes it (.msh 2.2), with nodes that move: those of the casting as they are told, all others
along with them."""

from pathlib import Path

import numpy as np

from solidus_plots.cells import boundary
from solidus_plots.triangle_surface import Surface
from solidus_plots.vtu import ResultError

REACH = 0.35  # of the part's size: so far into the mould goes what no stretch of all of it tells


class DrawnMesh:
    """A .msh file of the program: nodes are numbered from one in their order."""

    def __init__(self, path):
        self.path = Path(path)
        text = self.path.read_text()
        head, rest = text.split("$Nodes\n", 1)
        nodes, self._tail = rest.split("$EndNodes", 1)
        self._head = head
        lines = nodes.split("\n", 1)
        self.points = np.array(lines[1].split(), float).reshape(-1, 4)[:, 1:]
        self._names = {int(number): name.strip().strip('"') for _, number, name in
                       (line.split(" ", 2) for line in head.split("$PhysicalNames\n")[1].splitlines()[1:] if line.startswith(tuple("0123")))}

    def nodes_of(self, group):
        """The nodes of a named group, from zero."""
        wanted = {str(number) for number, name in self._names.items() if name == group}
        found = set()
        for line in self._tail.split("$Elements\n", 1)[1].splitlines()[1:]:
            words = line.split()
            if len(words) > 5 and words[3] in wanted:
                found.update(words[5:])
        return np.array(sorted(int(word) - 1 for word in found), int)

    def write(self, path, points):
        """The same mesh with nodes elsewhere."""
        lines = [f"{i + 1} {x!r} {y!r} {z!r}" for i, (x, y, z) in enumerate(points.tolist())]
        Path(path).write_text("".join([self._head, "$Nodes\n", f"{len(lines)}\n", "\n".join(lines), "\n$EndNodes", self._tail]))


def skin(grid, cells):
    """Triangles of the skin of cells, and the function that brings values of nodes to their corners."""
    faces = boundary(grid, cells, np.zeros(len(grid.cell_types), int))
    return faces.nodes, faces.refined.extend


def affine(points, values):
    """The linear function of place that is nearest to values: a function, and its gradient [component][axis]."""
    middle = points.mean(axis=0)
    rows = np.hstack([np.ones((len(points), 1)), points - middle])
    fitted = np.linalg.lstsq(rows, values, rcond=1e-10)[0]
    return lambda places: fitted[0] + (places - middle) @ fitted[1:], fitted[1:].T


class Followers:
    """All nodes that are not the part's: they follow the linear function of its displacements, and near it the rest too."""

    def __init__(self, grid, cells, drawn, part_nodes, held_planes):
        """grid, cells: the part in its drawn shape; drawn [node][3]; held_planes: (axis, coordinate), whose nodes stay in them."""
        self._drawn, self._part = drawn, part_nodes
        triangles, extend = skin(grid, cells)
        self._extend, self._triangles = extend, triangles
        surface = Surface(extend(grid.points), triangles)
        self._others = np.setdiff1d(np.arange(len(drawn)), part_nodes)
        self._near = surface.nearest(drawn[self._others])
        size = np.ptp(drawn[part_nodes], axis=0).max()
        self._share = np.exp(-(np.abs(self._near.distance) / (REACH * size)) ** 2)
        # A node at the place of one of the part's goes exactly where that goes.
        self._share[np.abs(self._near.distance) < 1e-9 * size] = 1.0
        self._planes = [(axis, np.abs(drawn[self._others, axis] - at) < 1e-9 * size) for axis, at in held_planes]

    def displaced(self, of_part, at_grid):
        """All nodes, where those of the part are displaced by `of_part`; `at_grid`: the same at the nodes of its grid."""
        stretch, _ = affine(self._drawn[self._part], of_part)
        near = self._near.of(self._extend(at_grid), self._triangles)
        own = stretch(self._drawn[self._others])
        moved = own + self._share[:, None] * (near - stretch(self._near.place))
        for axis, in_plane in self._planes:
            moved[in_plane, axis] = 0.0
        points = self._drawn.copy()
        points[self._part] += of_part
        points[self._others] += moved
        return points


def held_planes(document, drawn_mesh, part_nodes):
    """Planes across an axis in which the case holds the part: (axis, coordinate) from its prescribed displacements."""
    planes, mine = [], np.zeros(len(drawn_mesh.points), bool)
    mine[part_nodes] = True
    names = ("ux", "uy", "uz")
    for condition in document.get("mechanical_condition", []):
        groups = condition.get("groups") or [condition.get("group", "")]
        if condition.get("kind") != "displacement":
            if condition.get("kind") == "plane" and any(mine[drawn_mesh.nodes_of(group)].any() for group in groups):
                raise ResultError(f"the condition '{condition.get('name')}' keeps a face of the part plane wherever it goes; a pattern is found "
                                  "for parts that are free or held in planes (kind = \"displacement\")")
            continue
        for group in groups:
            nodes = drawn_mesh.nodes_of(group)
            nodes = nodes[mine[nodes]]
            for axis in range(3):
                if nodes.size and condition.get(names[axis]) is not None:
                    coordinates = drawn_mesh.points[nodes, axis]
                    planes.append((axis, float(coordinates.mean()) if np.ptp(coordinates) < 1e-9 else None))
    return planes
