"""The cavity of a case as cubes: which cubes are metal, of which body, and what each face of their skin touches.

A point of the raster lies in a body where an element of it holds the point. A cube is metal where half of its points or more
are; then the edge of the cubes is scaled by a few per cent at most, so that their volume is that of the drawing.
"""

from dataclasses import dataclass, field

import numpy as np

from solidus_plots.cells import tetrahedra
from solidus_plots.filling_mesh import Cubes
from solidus_plots.vtu import ResultError

SAMPLES = 3  # points of the raster along the edge of a cube
PIECE = 2_000_000  # points that are looked at together
NO_BODY = -1


@dataclass
class Cavity:
    cubes: Cubes
    body: np.ndarray  # [cube] number of the body that is cast
    faces: np.ndarray  # [face of the skin] the cube
    directions: np.ndarray  # [face][axis]
    touches: np.ndarray  # [face] number of the body outside, NO_BODY where there is none
    area: np.ndarray  # [face] of the drawing's skin that it stands for [m2]
    scale: float = 1.0  # by which the edge was changed
    true_area: float = 0.0
    volumes: dict = field(default_factory=dict)  # of bodies that are cast, as drawn [m3]

    def face_centres(self):
        return self.cubes.centres()[self.faces] + 0.5 * self.cubes.edge * self.directions


def tetrahedra_of(grid):
    """Corners [tetrahedron][4][axis] and the body of each."""
    cut = tetrahedra(grid, np.ones(len(grid.cell_types), bool))
    points = cut.refined.extend(grid.points)
    return points[cut.nodes], np.asarray(grid.cell_data["body"])[cut.cells].astype(int)


def volumes_of(corners):
    edges = corners[:, 1:] - corners[:, :1]
    return np.abs(np.linalg.det(edges)) / 6


def raster(corners, bodies, origin, pitch, shape):
    """The body at each point of a raster, NO_BODY where there is none: [x][y][z]. Points are in the middle of cells of `pitch`."""
    found = np.full(shape, NO_BODY, dtype=np.int32)
    low = np.ceil((corners.min(axis=1) - origin) / pitch - 0.5 - 1e-9).astype(int).clip(0)
    high = np.minimum(np.floor((corners.max(axis=1) - origin) / pitch - 0.5 + 1e-9).astype(int), np.array(shape) - 1)
    counts = np.prod((high - low + 1).clip(0), axis=1)
    chosen = np.flatnonzero(counts)
    ends = np.cumsum(counts[chosen])
    start = 0
    while start < len(chosen):
        # As many tetrahedra together as have some million points in their boxes.
        before = ends[start - 1] if start else 0
        stop = max(start + 1, int(np.searchsorted(ends, before + PIECE)))
        mark(found, chosen[start:stop], corners, bodies, low, high, counts, origin, pitch)
        start = stop
    return found


def mark(found, chosen, corners, bodies, low, high, counts, origin, pitch):
    """Marks the points of the raster that lie in some tetrahedra."""
    owner = np.repeat(chosen, counts[chosen])
    within = np.arange(len(owner)) - np.repeat(np.cumsum(counts[chosen]) - counts[chosen], counts[chosen])
    size = (high - low + 1)[owner]
    index = low[owner] + np.stack([within % size[:, 0], within // size[:, 0] % size[:, 1], within // (size[:, 0] * size[:, 1])], axis=1)
    point = origin + (index + 0.5) * pitch
    # Barycentric coordinates; flat tetrahedra hold nothing.
    edges = (corners[chosen, 1:] - corners[chosen, :1]).transpose(0, 2, 1)
    sound = np.abs(np.linalg.det(edges)) > 0
    inverse = np.zeros_like(edges)
    inverse[sound] = np.linalg.inv(edges[sound])
    inverse[~sound] = np.inf
    place = np.repeat(np.arange(len(chosen)), counts[chosen])
    with np.errstate(invalid="ignore"):
        share = np.einsum("nij,nj->ni", inverse[place], point - corners[owner, 0])
        inside = (share >= -1e-9).all(axis=1) & (share.sum(axis=1) <= 1 + 1e-9)
    found[tuple(index[inside].T)] = bodies[owner[inside]]


def skin_triangles(corners):
    """The triangles that belong to one tetrahedron alone: [triangle][3][axis]. Corners at one place are one, whatever their
    number in the mesh is."""
    points = corners.reshape(-1, 3)
    extent = np.ptp(points, axis=0).max()
    _, number = np.unique(np.round(points / (1e-7 * extent)).astype(np.int64), axis=0, return_inverse=True)
    number = number.reshape(-1, 4)
    faces = np.concatenate([number[:, list(side)] for side in ((1, 2, 3), (0, 2, 3), (0, 1, 3), (0, 1, 2))])
    places = np.concatenate([corners[:, list(side)] for side in ((1, 2, 3), (0, 2, 3), (0, 1, 3), (0, 1, 2))])
    _, first, count = np.unique(np.sort(faces, axis=1), axis=0, return_index=True, return_counts=True)
    return places[first[count == 1]]


def areas_of(triangles):
    return 0.5 * np.linalg.norm(np.cross(triangles[:, 1] - triangles[:, 0], triangles[:, 2] - triangles[:, 0]), axis=1)


def true_areas(cubes, faces, directions, triangles):
    """The area of the drawing's skin that each face of cubes stands for [m2]; together they are the whole skin.

    The skin is cut into pieces smaller than a cube; around each cube the area of the pieces in it and its neighbours goes by
    that of the faces there.
    """
    pieces = triangles
    while len(pieces) < 4_000_000:
        longest = np.linalg.norm(pieces - np.roll(pieces, 1, axis=1), axis=2).max(axis=1)
        large = longest > cubes.edge
        if not large.any():
            break
        a, b, c = pieces[large].transpose(1, 0, 2)
        ab, bc, ca = 0.5 * (a + b), 0.5 * (b + c), 0.5 * (c + a)
        pieces = np.concatenate([pieces[~large], *(np.stack(part, axis=1) for part in ((a, ab, ca), (ab, b, bc), (ca, bc, c), (ab, bc, ca)))])
    shape = cubes.cells.max(axis=0) + 5
    centres = cubes.centres()[faces] + 0.5 * cubes.edge * directions

    def around(places, areas):
        """Areas summed over a block of three cubes about each place of the grid."""
        index = np.floor((places - cubes.origin) / cubes.edge).astype(int).clip(-2, shape - 3) + 2
        total = np.zeros(shape)
        np.add.at(total, tuple(index.T), areas)
        for axis in range(3):
            padded = np.concatenate([total.take([0], axis) * 0, total, total.take([0], axis) * 0], axis=axis)
            n = total.shape[axis]
            total = sum(padded.take(range(k, k + n), axis) for k in range(3))
        return total, index

    drawn, _ = around(pieces.mean(axis=1), areas_of(pieces))
    own = np.full(len(faces), cubes.edge ** 2)
    stairs, index = around(centres - 0.5 * cubes.edge * directions, own)
    ratio = drawn[tuple(index.T)] / stairs[tuple(index.T)]
    whole = areas_of(triangles).sum()
    area = own * np.clip(ratio, 0.3, 1.5)
    return area * whole / area.sum()


def majority(bodies, candidates):
    """Of points [..][point] the body of the candidates that most are of, NO_BODY where none is of one."""
    counts = np.stack([(bodies == body).sum(axis=-1) for body in candidates], axis=-1)
    return np.where(counts.max(axis=-1) > 0, np.array(candidates)[counts.argmax(axis=-1)], NO_BODY), counts.sum(axis=-1)


def largest_piece(cells):
    """Marks the cubes of the largest set that hangs together by faces."""
    cubes = Cubes(np.zeros(3), 1.0, cells)
    label = np.arange(len(cells))
    neighbours = [cubes.number(cubes.cells + np.eye(3, dtype=int)[axis]) for axis in range(3)]
    while True:
        before = label.copy()
        for other in neighbours:
            has = np.flatnonzero(other >= 0)
            least = np.minimum(label[has], label[other[has]])
            np.minimum.at(label, has, least)
            np.minimum.at(label, other[has], least)
        label = label[label]
        if (label == before).all():
            break
    names, counts = np.unique(label, return_counts=True)
    return cubes.cells[label == names[counts.argmax()]], len(cells) - counts.max()


def cavity_of(grid, poured, edge):
    """The cavity of a mesh as cubes of about this edge [m]. poured: numbers of the bodies that are cast. Throws ResultError."""
    corners, bodies = tetrahedra_of(grid)
    metal = np.isin(bodies, poured)
    if not metal.any():
        raise ResultError("the mesh holds no element of a body that is cast")
    low, high = corners[metal].min(axis=(0, 1)), corners[metal].max(axis=(0, 1))
    # Cubes that fit the box of the metal as well as cubes can: the box is in the middle of its grid.
    counts = np.maximum(np.round((high - low) / edge), 1).astype(int)
    origin = 0.5 * (low + high) - 0.5 * counts * edge - 2 * edge
    counts = counts + 4
    pitch = edge / SAMPLES
    found = raster(corners, bodies, origin, pitch, tuple(counts * SAMPLES))
    blocks = found.reshape(counts[0], SAMPLES, counts[1], SAMPLES, counts[2], SAMPLES).transpose(0, 2, 4, 1, 3, 5)
    samples = blocks.reshape(*counts, SAMPLES ** 3)
    body, share = majority(samples, poured)
    cells = np.argwhere(share >= 0.5 * SAMPLES ** 3)
    if not len(cells):
        raise ResultError(f"cubes of {1e3 * edge:.3g} mm are too large for the walls of the casting: a smaller cell_size in [filling], "
                          "or more cells")
    cells, lost = largest_piece(cells)
    volume = volumes_of(corners[metal])
    if lost * edge ** 3 > 0.02 * volume.sum():
        raise ResultError(f"with cubes of {1e3 * edge:.3g} mm parts of the casting do not hang together: a smaller cell_size in [filling], "
                          "or more cells")
    cubes = Cubes(origin, edge, cells)
    faces, directions = cubes.skin()
    touches = outside_of(samples, cubes, faces, directions, [b for b in np.unique(bodies) if b not in poured])
    triangles = skin_triangles(corners[metal])
    cavity = Cavity(cubes, body[tuple(cubes.cells.T)], faces, directions, touches, true_areas(cubes, faces, directions, triangles),
                    true_area=areas_of(triangles).sum(),
                    volumes={int(b): volumes_of(corners[bodies == b]).sum() for b in poured})
    # The edge is scaled about the middle, so that the cubes have the volume of the drawing.
    cavity.scale = (volume.sum() / cubes.volume()) ** (1 / 3)
    middle = 0.5 * (low + high)
    cubes.origin, cubes.edge = middle + cavity.scale * (cubes.origin - middle), cavity.scale * cubes.edge
    return cavity


def outside_of(samples, cubes, faces, directions, candidates):
    """The body behind each face of the skin, from the points of the next cube that are nearest to it."""
    if not candidates:
        return np.full(len(faces), NO_BODY)
    touches = np.full(len(faces), NO_BODY)
    points = samples.reshape(*samples.shape[:3], SAMPLES, SAMPLES, SAMPLES)
    for side in np.unique(directions, axis=0):
        chosen = np.flatnonzero((directions == side).all(axis=1))
        beyond = points[tuple((cubes.cells[faces[chosen]] + side).T)]
        axis = int(np.flatnonzero(side)[0])
        # From the layer at the face on to the one behind it, until a body is found: a skin that bulges lies beyond the first.
        for layer in range(SAMPLES):
            at = layer if side[axis] > 0 else SAMPLES - 1 - layer
            open_ = touches[chosen] == NO_BODY
            touches[chosen[open_]] = majority(beyond.take(at, axis=1 + axis)[open_].reshape(-1, SAMPLES ** 2), candidates)[0]
    return touches


def edge_for(grid, poured, cells):
    """The edge of cubes of which the metal is made of about so many [m]."""
    corners, bodies = tetrahedra_of(grid)
    return (volumes_of(corners[np.isin(bodies, poured)]).sum() / cells) ** (1 / 3)
