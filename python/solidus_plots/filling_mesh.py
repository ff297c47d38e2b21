"""The cubes of a cavity as a mesh of OpenFOAM (constant/polyMesh).

Cells are cubes of one edge along the axes: with other cells Debian's build of OpenFOAM 1912 rebuilds velocities wrongly
(docs/theory/filling.md). They are numbered along x first, then y, then z, which puts inner faces into the order that
OpenFOAM wants.
"""

from dataclasses import dataclass

import numpy as np

# The corners of the face of a cube towards each side, counter-clockwise seen from outside: offsets in cells.
SIDES = {
    (-1, 0, 0): ((0, 0, 0), (0, 0, 1), (0, 1, 1), (0, 1, 0)),
    (1, 0, 0): ((1, 0, 0), (1, 1, 0), (1, 1, 1), (1, 0, 1)),
    (0, -1, 0): ((0, 0, 0), (1, 0, 0), (1, 0, 1), (0, 0, 1)),
    (0, 1, 0): ((0, 1, 0), (0, 1, 1), (1, 1, 1), (1, 1, 0)),
    (0, 0, -1): ((0, 0, 0), (0, 1, 0), (1, 1, 0), (1, 0, 0)),
    (0, 0, 1): ((0, 0, 1), (1, 0, 1), (1, 1, 1), (0, 1, 1)),
}

HEADER = """FoamFile
{{
    version 2.0;
    format ascii;
    class {kind};
    location "{location}";
    object {name};
}}

"""


@dataclass
class Cubes:
    """A set of cubes of a grid. Lengths in m."""

    origin: np.ndarray  # of the grid: the lowest corner of the cube (0, 0, 0)
    edge: float
    cells: np.ndarray  # [cell][axis] whole numbers, sorted along x first

    def __post_init__(self):
        self._shape = self.cells.max(axis=0) + 3
        order = np.argsort(self._key(self.cells), kind="stable")
        self.cells = self.cells[order]
        self._keys = self._key(self.cells)

    def _key(self, cells):
        moved = cells + 1  # neighbours outside have numbers too
        return moved[..., 0] + self._shape[0] * (moved[..., 1] + self._shape[1] * moved[..., 2])

    def number(self, cells):
        """The numbers of cubes, -1 where there is none: [...][axis] -> [...]."""
        keys = self._key(cells)
        at = np.minimum(np.searchsorted(self._keys, keys), len(self._keys) - 1)
        return np.where(self._keys[at] == keys, at, -1)

    def centres(self):
        return self.origin + (self.cells + 0.5) * self.edge

    def volume(self):
        return len(self.cells) * self.edge ** 3

    def skin(self):
        """The faces of the skin: (cells, directions), directions as [face][axis]."""
        cells, directions = [], []
        for side in SIDES:
            outside = np.nonzero(self.number(self.cells + np.array(side)) < 0)[0]
            cells.append(outside)
            directions.append(np.tile(np.array(side), (len(outside), 1)))
        return np.concatenate(cells), np.concatenate(directions)


def corners_of(cubes, cells, directions):
    """The corners of faces in cells of the grid: [face][4][axis]."""
    offsets = np.zeros((len(cells), 4, 3), dtype=int)
    for side, corners in SIDES.items():
        chosen = (directions == np.array(side)).all(axis=1)
        offsets[chosen] = np.array(corners)
    return cubes.cells[cells][:, None, :] + offsets


def inner_faces(cubes):
    """(owners, neighbours, directions) in the order of OpenFOAM."""
    owners, neighbours, directions = [], [], []
    for axis in range(3):
        side = np.zeros(3, dtype=int)
        side[axis] = 1
        other = cubes.number(cubes.cells + side)
        inside = np.nonzero(other >= 0)[0]
        owners.append(inside)
        neighbours.append(other[inside])
        directions.append(np.tile(side, (len(inside), 1)))
    owners, neighbours, directions = map(np.concatenate, (owners, neighbours, directions))
    order = np.lexsort((neighbours, owners))
    return owners[order], neighbours[order], directions[order]


def labels(path, values, location="constant/polyMesh"):
    with path.open("w") as out:
        out.write(HEADER.format(kind="labelList", location=location, name=path.name))
        out.write(f"{len(values)}\n(\n")
        np.savetxt(out, values, fmt="%d")
        out.write(")\n")


def write_mesh(folder, cubes, patches):
    """Writes the mesh of cubes into the folder of a case.

    patches: [(name, kind, cells, directions)] that cover the skin, each face once. kind: "patch" or "wall".
    """
    target = folder / "constant" / "polyMesh"
    target.mkdir(parents=True, exist_ok=True)
    owners, neighbours, directions = inner_faces(cubes)
    n_inner = len(owners)
    cells = np.concatenate([owners] + [patch[2] for patch in patches])
    all_directions = np.concatenate([directions] + [patch[3] for patch in patches])
    corners = corners_of(cubes, cells, all_directions)
    points, faces = np.unique(corners.reshape(-1, 3), axis=0, return_inverse=True)
    faces = faces.reshape(-1, 4)
    with (target / "points").open("w") as out:
        out.write(HEADER.format(kind="vectorField", location="constant/polyMesh", name="points"))
        out.write(f"{len(points)}\n(\n")
        np.savetxt(out, cubes.origin + points * cubes.edge, fmt="(%.15g %.15g %.15g)")
        out.write(")\n")
    with (target / "faces").open("w") as out:
        out.write(HEADER.format(kind="faceList", location="constant/polyMesh", name="faces"))
        out.write(f"{len(faces)}\n(\n")
        np.savetxt(out, faces, fmt="4(%d %d %d %d)")
        out.write(")\n")
    labels(target / "owner", cells)
    labels(target / "neighbour", neighbours)
    start, entries = n_inner, []
    for name, kind, of_patch, _ in patches:
        entries.append(f"    {name}\n    {{\n        type {kind};\n        nFaces {len(of_patch)};\n        startFace {start};\n    }}\n")
        start += len(of_patch)
    (target / "boundary").write_text(HEADER.format(kind="polyBoundaryMesh", location="constant/polyMesh", name="boundary")
                                     + f"{len(patches)}\n(\n{''.join(entries)})\n")
