"""The skin of a part over and below a place, from the mesh of a run."""

import numpy as np

FACES = {10: [(0, 2, 1), (0, 1, 3), (1, 2, 3), (0, 3, 2)],
         12: [(0, 3, 2, 1), (4, 5, 6, 7), (0, 1, 5, 4), (1, 2, 6, 5), (2, 3, 7, 6), (3, 0, 4, 7)],
         13: [(0, 1, 2), (3, 5, 4), (0, 3, 4, 1), (1, 4, 5, 2), (2, 5, 3, 0)]}


class Surface:
    """Called with a place [mm]: the heights of the lowest and the highest skin there [mm], and the distance of the skin
    from it."""

    def __init__(self, grid, parts):
        """parts: numbers of the bodies."""
        points = 1e3 * grid.points
        self._skin = points[skin_nodes(grid, np.isin(grid.cell_data["body"], parts))]

    def __call__(self, place):
        place = np.asarray(place, float)
        radius = float(np.linalg.norm(self._skin - place, axis=1).min())
        aside = np.linalg.norm(self._skin[:, :2] - place[:2], axis=1)
        near = self._skin[aside <= max(radius, 1.5 * aside.min())]
        return float(near[:, 2].min()), float(near[:, 2].max()), radius


def skin_nodes(grid, cells):
    """Nodes of the faces that one cell of a mask has alone."""
    size = np.diff(grid.offsets, prepend=0)
    starts, faces = grid.offsets - size, []
    for kind, patterns in FACES.items():
        chosen = np.flatnonzero(cells & (grid.cell_types == kind))
        for pattern in patterns if chosen.size else []:
            face = grid.connectivity[starts[chosen][:, None] + np.array(pattern)]
            # A triangle has −1 in place of a fourth node.
            face = np.column_stack([face, np.full(len(face), -1)]) if face.shape[1] == 3 else face
            faces.append(np.sort(face, axis=1))
    rows, count = np.unique(np.concatenate(faces), axis=0, return_counts=True)
    return np.unique(rows[count == 1][rows[count == 1] >= 0])
