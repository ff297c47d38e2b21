"""Cells of volume: their faces, and how they are cut into linear tetrahedra. Numbers of nodes are VTK's.

Quadratic cells are cut along their mid nodes. A hexahedron gets a node in the middle of every face and one in
its own middle and is cut into a tetrahedron for each edge of each face, between this edge and both middles: no
diagonal is preferred, and neighbours fit together. A linear field stays linear, so everything made from these
tetrahedra is exact for it.
"""

from dataclasses import dataclass

import numpy as np

TET, HEX, TET_2, HEX_2 = 10, 12, 24, 25
VOLUME = (TET, HEX, TET_2, HEX_2)

_TET_EDGES = [(0, 1), (1, 2), (2, 0), (0, 3), (1, 3), (2, 3)]
_HEX_EDGES = [(0, 1), (1, 2), (2, 3), (3, 0), (4, 5), (5, 6), (6, 7), (7, 4), (0, 4), (1, 5), (2, 6), (3, 7)]
_TET_FACES = [(0, 2, 1), (0, 1, 3), (0, 3, 2), (1, 2, 3)]  # counter-clockwise seen from outside
_HEX_FACES = [(0, 3, 2, 1), (0, 1, 5, 4), (0, 4, 7, 3), (1, 2, 6, 5), (2, 3, 7, 6), (4, 5, 6, 7)]


def _with_mid_nodes(faces, edges, corners):
    """The nodes round each face with the mid nodes of its edges: corner, mid, corner, ..."""
    mid = {frozenset(edge): corners + i for i, edge in enumerate(edges)}
    return [sum(((a, mid[frozenset((a, b))]) for a, b in zip(face, face[1:] + face[:1])), ())
            for face in faces]


# The nodes round each face of a cell.
RINGS = {TET: _TET_FACES, HEX: _HEX_FACES,
         TET_2: _with_mid_nodes(_TET_FACES, _TET_EDGES, 4), HEX_2: _with_mid_nodes(_HEX_FACES, _HEX_EDGES, 8)}
# A face of six nodes: the triangles at its corners and the middle one; which of their sides (opposite of node
# 0, 1, 2) are the face's.
_TRI_2 = [((0, 1, 5), (False, True, True)), ((2, 3, 1), (False, True, True)),
          ((4, 5, 3), (False, True, True)), ((1, 3, 5), (False, False, False))]
# Corners, then the octahedron between the mid nodes, cut along 6-8.
_TET_2_PARTS = [(0, 4, 6, 7), (4, 1, 5, 8), (6, 5, 2, 9), (7, 8, 9, 3),
                (6, 8, 4, 5), (6, 8, 5, 9), (6, 8, 9, 7), (6, 8, 7, 4)]
# The weights of new nodes below are the shape functions there, of quadratic cells the serendipity ones.


class Refined:
    """Nodes of a grid and, behind them, new ones in the middle of faces and cells."""

    def __init__(self, count):
        self.count = count  # of nodes so far
        self._sets = []  # of each set of new ones: parents [node][k], weights [k]

    def extend(self, values):
        """Values at the nodes of the grid -> at all nodes."""
        new = [np.einsum("np...,p->n...", values[parents], weights) for parents, weights in self._sets]
        return np.concatenate([values, *new])

    def add(self, parents, weights):
        """New nodes from their parents [node][k] and the weights of these; their numbers."""
        self._sets.append((parents, np.asarray(weights, float)))
        self.count += len(parents)
        return np.arange(self.count - len(parents), self.count)

    def add_face_middles(self, rings):
        """Nodes in the middle of faces, of their rings [face][4 or 8]; both cells of a face share its node."""
        corners = rings if rings.shape[1] == 4 else rings[:, ::2]
        _, first, index = np.unique(_face_keys(corners), return_index=True, return_inverse=True)
        weights = np.full(4, 0.25) if rings.shape[1] == 4 else np.tile([-0.25, 0.5], 4)
        return self.add(rings[first], weights)[index]


def _face_keys(corners):
    """A number for each set of corners: of its three smallest, which no two faces of a mesh share."""
    smallest = np.sort(corners, axis=1)[:, :3].astype(np.int64)
    base = smallest.max(initial=0) + 1
    _, pair = np.unique(smallest[:, 0] * base + smallest[:, 1], return_inverse=True)
    return pair * base + smallest[:, 2]


@dataclass
class Tetrahedra:
    nodes: np.ndarray  # [tetrahedron][4] of `refined`
    cells: np.ndarray  # [tetrahedron] the cell it is a part of
    refined: Refined


def tetrahedra(grid, cells):
    """The volume cells of a mask cut into linear tetrahedra."""
    refined = Refined(len(grid.points))
    nodes, owners = [np.zeros((0, 4), int)], [np.zeros(0, int)]
    for vtk_type, numbers, corners in _volume_cells(grid, cells):
        if vtk_type == TET:
            parts = [corners]
        elif vtk_type == TET_2:
            parts = [corners[:, part] for part in _TET_2_PARTS]
        else:
            parts = _fans(refined, vtk_type, corners)
        nodes += parts
        owners += [numbers] * len(parts)
    return Tetrahedra(np.concatenate(nodes), np.concatenate(owners), refined)


def _volume_cells(grid, cells):
    for vtk_type in VOLUME:
        numbers, nodes = grid.cells(vtk_type)
        taken = cells[numbers]
        if taken.any():
            yield vtk_type, numbers[taken], nodes[taken]


def _fans(refined, vtk_type, nodes):
    """Tetrahedra between the middle of hexahedra, that of a face and an edge (quadratic: half) of the face."""
    centre = refined.add(nodes, np.full(8, 0.125) if vtk_type == HEX else np.repeat([-0.25, 0.25], [8, 12]))
    rings = nodes[:, RINGS[vtk_type]]  # [cell][face][node]
    middles = refined.add_face_middles(rings.reshape(-1, rings.shape[2])).reshape(rings.shape[:2])
    return [np.stack([rings[:, face, a], rings[:, face, a - 1], middles[:, face], centre], axis=1)
            for face in range(rings.shape[1]) for a in range(rings.shape[2])]


@dataclass
class Faces:
    """The surface of bodies as triangles, counter-clockwise seen from outside."""

    nodes: np.ndarray  # [triangle][3] of `refined`
    cells: np.ndarray  # [triangle] the cell behind it
    sides: np.ndarray  # [triangle][3] whether the side opposite of node 0, 1, 2 lies on an edge of the cell
    refined: Refined


def boundary(grid, cells, bodies):
    """The faces of the cells of a mask that no other cell of the same body shares. `bodies`: of each cell."""
    by_size = {}
    for vtk_type, numbers, nodes in _volume_cells(grid, cells):
        rings = nodes[:, RINGS[vtk_type]]
        by_size.setdefault(rings.shape[2], []).append(
            (rings.reshape(-1, rings.shape[2]), np.repeat(numbers, rings.shape[1])))
    refined = Refined(len(grid.points))
    parts = [(np.zeros((0, 3), int), np.zeros(0, int), np.zeros((0, 3), bool))]
    for size, found in by_size.items():
        rings, owners = (np.concatenate(arrays) for arrays in zip(*found))
        key = _face_keys(rings if size < 6 else rings[:, ::2]) * (bodies.max() + 1) + bodies[owners]
        _, first, count = np.unique(key, return_index=True, return_counts=True)
        alone = np.sort(first[count == 1])
        parts += _face_triangles(refined, rings[alone], owners[alone])
    return Faces(*(np.concatenate(arrays) for arrays in zip(*parts)), refined)


def _face_triangles(refined, rings, owners):
    """(nodes, cells, sides) of the triangles of faces, in sets."""
    if rings.shape[1] in (3, 6):
        pattern = [((0, 1, 2), (True, True, True))] if rings.shape[1] == 3 else _TRI_2
        return [(rings[:, nodes], owners, np.tile(sides, (len(rings), 1))) for nodes, sides in pattern]
    middles = refined.add_face_middles(rings)
    sides = np.tile([False, False, True], (len(rings), 1))
    return [(np.stack([rings[:, a - 1], rings[:, a], middles], axis=1), owners, sides)
            for a in range(rings.shape[1])]
