"""Small grids for the tests of the pictures: boxes of every kind of volume cell."""

import numpy as np

from solidus_plots.cells import HEX, HEX_2, TET_2
from solidus_plots.vtu import Grid

# Corners of a hexahedron and the mid nodes of its edges in VTK's order, in halves of its sides.
_CORNERS = [(0, 0, 0), (2, 0, 0), (2, 2, 0), (0, 2, 0), (0, 0, 2), (2, 0, 2), (2, 2, 2), (0, 2, 2)]
_EDGES = [(0, 1), (1, 2), (2, 3), (3, 0), (4, 5), (5, 6), (6, 7), (7, 4), (0, 4), (1, 5), (2, 6), (3, 7)]
_TETS = [(0, 1, 2, 6), (0, 2, 3, 6), (0, 3, 7, 6), (0, 7, 4, 6), (0, 4, 5, 6), (0, 5, 1, 6)]
_TET_EDGES = [(0, 1), (1, 2), (2, 0), (0, 3), (1, 3), (2, 3)]


def _mid(a, b):
    return tuple((np.array(a) + b) // 2)


def _patterns(kind):
    """The nodes of the cells of a hexahedron, in halves of its sides."""
    hexahedron = [*_CORNERS, *(_mid(_CORNERS[a], _CORNERS[b]) for a, b in _EDGES)]
    if kind in (HEX, HEX_2):
        return [hexahedron[: 8 if kind == HEX else 20]]
    tets = [[_CORNERS[i] for i in tet] for tet in _TETS]
    return [tet + ([_mid(tet[a], tet[b]) for a, b in _TET_EDGES] if kind == TET_2 else []) for tet in tets]


def box(kind, size, divisions, bodies=1):
    """A box from the origin with `size` [m]; its cells belong to `bodies` along x that share their nodes."""
    lattice = 2 * np.array(divisions) + 1
    steps = np.stack(np.meshgrid(*(np.arange(n) for n in divisions), indexing="ij"), axis=-1).reshape(-1, 3)
    rows, body = [], []
    for pattern in _patterns(kind):
        places = 2 * steps[:, None] + np.array(pattern)
        rows.append(np.ravel_multi_index(tuple(np.moveaxis(places, -1, 0)), lattice))
        body.append(steps[:, 0] * bodies // divisions[0])
    cells = np.concatenate(rows)
    used, connectivity = np.unique(cells, return_inverse=True)
    points = np.stack(np.unravel_index(used, lattice), axis=1) * (np.array(size) / (lattice - 1))
    count = len(cells)
    offsets = (1 + np.arange(count)) * cells.shape[1]
    return Grid(points, np.full(count, kind), offsets, connectivity.ravel(), {},
                {"body": np.concatenate(body)}, {}, 0.0)


def everything(grid):
    return np.ones(len(grid.cell_types), bool)
