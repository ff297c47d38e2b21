"""Where the metal comes into a cavity of cubes and where the air leaves it: chosen faces of the skin."""

from dataclasses import dataclass

import numpy as np

from solidus_plots.vtu import ResultError

GOOD_SPEED = 0.5  # in the gate [m/s]: above it the front of aluminium folds its oxide in (J. Campbell, Castings, 2nd ed. 2003)
FAR = 4  # cubes from the skin, beyond which a place is none of a gate
FEW = 4  # cubes across a gate, below which its jet is coarse


@dataclass
class Gate:
    faces: np.ndarray  # numbers of faces of the skin
    direction: np.ndarray  # of the flow, the whole-number inward normal
    chosen: str  # how it came about, in words
    width: float  # of the gate as a square [m]


def pieces_of(triangles, size):
    """Points on triangles (nine numbers each) that are at most `size` apart."""
    points = []
    for triangle in np.asarray(triangles, float).reshape(-1, 3, 3):
        a, b, c = triangle
        n = int(np.ceil(max(np.linalg.norm(b - a), np.linalg.norm(c - a), np.linalg.norm(c - b)) / size)) + 1
        i, j = np.meshgrid(np.arange(n), np.arange(n))
        inside = i + j < n
        u, v = (i[inside] + 1 / 3) / n, (j[inside] + 1 / 3) / n
        points.append(a + u[:, None] * (b - a) + v[:, None] * (c - a))
    return np.concatenate(points) if points else np.zeros((0, 3))


def near(cavity, triangles):
    """Marks the faces of the skin that lie at triangles of the drawing."""
    edge, centres = cavity.cubes.edge, cavity.face_centres()
    points, marked = pieces_of(triangles, 0.5 * edge), np.zeros(len(centres), bool)
    low, high = points.min(axis=0) - edge, points.max(axis=0) + edge
    inside = np.flatnonzero(((centres >= low) & (centres <= high)).all(axis=1))
    for part in np.array_split(inside, max(1, len(inside) * len(points) // 4_000_000)):
        if len(part):
            marked[part] = np.linalg.norm(centres[part][:, None] - points, axis=2).min(axis=1) < 0.87 * edge
    return marked


def one_side(cavity, marked):
    """Of marked faces those of the direction that most have."""
    directions, counts = np.unique(cavity.directions[marked], axis=0, return_counts=True)
    side = directions[counts.argmax()]
    return np.flatnonzero(marked & (cavity.directions == side).all(axis=1)), -side


def square(cavity, place, width, side=None):
    """The faces of one direction within a square around the face that is nearest to a place."""
    centres, edge = cavity.face_centres(), cavity.cubes.edge
    distance = np.linalg.norm(centres - place, axis=1)
    if side is not None:
        distance = np.where((cavity.directions == side).all(axis=1), distance, np.inf)
    first = int(distance.argmin())
    direction = cavity.directions[first]
    away = np.abs(centres - centres[first])
    within = (away <= 0.5 * width + 1e-6 * edge).all(axis=1) & (away @ np.abs(direction) < 0.1 * edge)
    return np.flatnonzero(within & (cavity.directions == direction).all(axis=1)), -direction


def thickest_low_place(cavity, up):
    """A place on the skin of the lower third whose wall is thick: the one from which most cubes lie inward."""
    cubes, depth = cavity.cubes, np.zeros(len(cavity.faces))
    cells, going = cubes.cells[cavity.faces], np.ones(len(cavity.faces), bool)
    for _ in range(int(cubes.cells.max()) + 1):
        cells = cells - cavity.directions
        going &= cubes.number(cells) >= 0
        if not going.any():
            break
        depth += going
    heights = cavity.face_centres() @ up
    low, high = heights.min(), heights.max()
    # Metal that enters sideways or from below does not fall; a face that looks up is no gate of the lower third.
    fit = (heights <= low + 0.35 * (high - low)) & (cavity.directions @ up < 0.5)
    # A place amid many faces of its direction is wide enough for a gate.
    centres, edge = cavity.face_centres(), cavity.cubes.edge
    score = np.full(len(depth), -np.inf)
    for side in np.unique(cavity.directions[fit], axis=0):
        chosen = np.flatnonzero(fit & (cavity.directions == side).all(axis=1))
        for face in chosen[np.argsort(-depth[chosen])][:200]:
            away = np.abs(centres[chosen] - centres[face])
            flat = away @ np.abs(side) < 0.1 * edge
            score[face] = min((flat & (away.max(axis=1) <= 2.1 * edge)).sum(), 25) + 0.2 * min(depth[face], 20)
    return centres[int(score.argmax())], cavity.directions[int(score.argmax())]


def gate_of(cavity, filling, gating, up, flow):
    """The gate of a cavity. gating: numbers of the bodies with this role; flow: of the metal [m3/s]. Throws ResultError."""
    if "gate" in filling:
        marked = near(cavity, filling["gate"])
        if not marked.any():
            raise ResultError("the faces of the gate do not lie on the skin of what is cast: gate in [filling]")
        faces, direction = one_side(cavity, marked)
        return Gate(faces, direction, "as given", cavity.cubes.edge * len(faces) ** 0.5)
    width = filling.get("gate_width") or max(FEW * cavity.cubes.edge, (flow / GOOD_SPEED) ** 0.5)
    if filling.get("gate_at"):
        place, side, chosen = np.array(filling["gate_at"]), None, "at the given place"
        away = np.linalg.norm(cavity.face_centres() - place, axis=1).min()
        if away > FAR * cavity.cubes.edge:
            raise ResultError(f"the gate is {1e3 * away:.3g} mm away from the skin of what is cast: gate_at in [filling], a point near it")
    else:
        free = np.flatnonzero(np.isin(cavity.body[cavity.faces], gating) & (cavity.directions @ up > 0.5))
        if len(free):
            centres = cavity.face_centres()[free]
            top = centres[np.abs(centres @ up - (centres @ up).max()) < 0.5 * cavity.cubes.edge]
            place, side, chosen = top.mean(axis=0), None, "on top of the gating, chosen by the program"
        else:
            place, side = thickest_low_place(cavity, up)
            chosen = "at a low place of the thickest wall, chosen by the program"
    faces, direction = square(cavity, place, width, side)
    return Gate(faces, direction, chosen, cavity.cubes.edge * len(faces) ** 0.5)


def ceilings(cavity, ups):
    """Faces under which rising metal would shut air in: all that look up in a position of the mould."""
    return np.flatnonzero(np.max([cavity.directions @ up for up in ups], axis=0) > 0.5)


def vents_of(cavity, filling, ups, gate):
    """The faces of all vents, none of them of the gate, the highest one last; and how they came about, in words. ups: the upward
    directions of the mould on its way."""
    up = ups[-1]
    if filling.get("vents"):
        marked = [near(cavity, group) for group in filling["vents"]]
        if not all(group.any() for group in marked):
            raise ResultError("the faces of a vent do not lie on the skin of what is cast: vents in [filling]")
        found, words = np.flatnonzero(np.any(marked, axis=0)), "the vents that are given"
    else:
        found, words = ceilings(cavity, ups), "all ceilings, chosen by the program"
    found = np.setdiff1d(found, gate.faces)
    if not len(found):
        # A gate that is all of the top leaves the way out to the faces around it.
        heights = cavity.face_centres() @ up
        found = np.setdiff1d(np.flatnonzero(heights > heights.max() - 1.1 * cavity.cubes.edge), gate.faces)
        if not len(found):
            raise ResultError("the air finds no way out of the cavity: the gate is all of its top; a smaller gate_width, or vents")
        words = "the faces around the gate"
    return found[np.argsort(cavity.face_centres()[found] @ up, kind="stable")], words


def by_body(cavity, faces):
    """Faces by the body that they touch: {body: faces}; NO_BODY: free ones."""
    return {int(body): faces[cavity.touches[faces] == body] for body in np.unique(cavity.touches[faces])}


def walls_of(cavity, gate, vents):
    """The faces that are left, by the body that they touch."""
    return by_body(cavity, np.setdiff1d(np.arange(len(cavity.faces)), np.concatenate([gate.faces, vents])))
