"""The skin of a part over and below a place, from the mesh of a run."""

import numpy as np

from solidus_plots.design_feeders import SIDE_GAP, SLENDER
from solidus_plots.hot_spots import centres

CLIMBS = 8  # at most, from a hole to the middle of the thick place around it
BLOCK = 0.45  # modulus of a block of metal over the radius of the largest ball in it
DIRECTIONS = 16  # in which a riser next to the part is looked for
FACES = {10: [(0, 2, 1), (0, 1, 3), (1, 2, 3), (0, 3, 2)],
         12: [(0, 3, 2, 1), (4, 5, 6, 7), (0, 1, 5, 4), (1, 2, 6, 5), (2, 3, 7, 6), (3, 0, 4, 7)],
         13: [(0, 1, 2), (3, 5, 4), (0, 3, 4, 1), (1, 4, 5, 2), (2, 5, 3, 0)]}


class Surface:
    """Called with a place [mm]: the heights of the lowest and the highest skin there [mm], and the radius of the largest
    ball of metal that holds the place, or is near it."""

    def __init__(self, grid, parts):
        """parts: numbers of the bodies."""
        points, cells = 1e3 * grid.points, np.isin(grid.cell_data["body"], parts)
        self._skin = points[skin_nodes(grid, cells)]
        self._metal = 1e3 * centres(grid)[cells]

    def __call__(self, place):
        place = np.asarray(place, float)
        aside = np.linalg.norm(self._skin[:, :2] - place[:2], axis=1)
        near = self._skin[aside <= max(self._depth(place[None])[0], 1.5 * aside.min())]
        return float(near[:, 2].min()), float(near[:, 2].max()), self.thickest(place)[1]

    def _depth(self, places):
        """[place] distance from the skin."""
        return np.array([np.linalg.norm(self._skin - place, axis=1).min() for place in places])

    def thickest(self, place):
        """The middle of the largest ball of metal around a place or near it, and its radius [mm]: a hole lies at the top
        of what froze last, not in its middle."""
        place = np.asarray(place, float)
        for _ in range(CLIMBS):
            radius = self._depth(place[None])[0]
            near = self._metal[np.linalg.norm(self._metal - place, axis=1) <= 2.5 * radius]
            depths = self._depth(near) if len(near) else np.zeros(1)
            if depths.max() <= 1.05 * radius:
                break
            place = near[depths.argmax()]
        return place, float(self._depth(place[None])[0])

    def beside(self, place, taken):
        """A riser next to the part for a place [mm]: the place in the part that its neck leads to, its diameter, x and y of
        the level direction to it and the way along it to the skin; nothing where there is no room.

        taken: x, y, radius and lowest height of upright cylinders that it must not touch."""
        place, radius = self.thickest(place)
        # 1.2 times the modulus of a block, between those of a ball, a third of its radius, and a plate, over 0.214.
        diameter = max(1.2 * BLOCK * radius / 0.214, 2.0)
        found = []
        for i in range(DIRECTIONS):
            angle = 2 * np.pi * i / DIRECTIONS
            along = np.array([np.cos(angle), np.sin(angle)])
            offset = self._skin[:, :2] - place[:2]
            way, aside = offset @ along, np.abs(offset @ np.array([-along[1], along[0]]))
            # The skin that the neck goes through lies level with the place and ahead of it.
            ahead = (way > 0) & (aside <= 0.7 * radius) & (np.abs(self._skin[:, 2] - place[2]) <= 0.7 * radius)
            if not ahead.any():
                continue
            reach = float(way[ahead].max())
            axis = place[:2] + (reach + (SIDE_GAP + 0.5) * diameter) * along
            # The part may neither stand in the riser nor above it.
            standing = np.linalg.norm(self._skin[:, :2] - axis, axis=1) < (0.5 + 0.5 * SIDE_GAP) * diameter
            if (standing & (self._skin[:, 2] > place[2] - diameter)).any():
                continue
            top = place[2] + SLENDER * diameter
            if any(low < top and np.hypot(x - axis[0], y - axis[1]) < 0.55 * diameter + 1.1 * other
                   for x, y, other, low in taken):
                continue
            found.append((round(reach, 3), i, (round(float(along[0]), 6), round(float(along[1]), 6), round(reach, 3))))
        return (place, diameter, min(found)[2]) if found else None


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
