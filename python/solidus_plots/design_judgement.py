"""Whether the parts of a run of heat alone are sound: no pipe, no cavity, no sink and no pores above a limit."""

from dataclasses import dataclass, field
import json

import numpy as np

from solidus_plots import moments
from solidus_plots.hot_spots import centres
from solidus_plots.vtu import ResultError, read_collection, read_fields

HOLLOW = 0.1  # share of the room of a node that metal has left: from there on it is part of a hole
PLACE = 0.005  # of the part's volume: the place whose pores count together
TRIED = 300  # cells with the most pores, around which the densest place is looked for
APART = 0.15  # of the extent of the part: defects that are nearer are told as one


@dataclass
class Limits:
    holes: float  # of the part's volume, what pipes, cavities and sinks may take
    pores: float  # the largest share of pores at a place
    left: float  # of a riser's height, what has to be left between its pipe and its foot


@dataclass
class Defect:
    place: np.ndarray  # [3] m
    volume: float  # [m3] of holes and of pores above the limit


@dataclass
class Judgement:
    sound: bool
    reasons: list  # why it is not, in words
    holes: float  # in the parts [m3]
    pores: float  # the densest in the parts
    part: float  # volume of the parts [m3]
    metal: float  # of all that is poured [m3]
    left: float  # the least share of a riser that is left below its pipe; 1 without risers
    nodes: int
    defects: list = field(default_factory=list)  # the largest first


def cell_volumes(grid):
    """[cell] m3: tetrahedra; other cells are divided from their first node on."""
    x, volumes = grid.points, np.zeros(len(grid.cell_types))
    size = np.diff(grid.offsets, prepend=0)
    starts = grid.offsets - size
    for kind, corners in {10: [(0, 1, 2, 3)], 24: [(0, 1, 2, 3)], 12: HEXAHEDRON, 25: HEXAHEDRON,
                          13: PRISM, 26: PRISM}.items():
        cells = np.flatnonzero(grid.cell_types == kind)
        for four in corners if cells.size else []:
            a, b, c, d = (x[grid.connectivity[starts[cells] + corner]] for corner in four)
            volumes[cells] += np.abs(np.einsum("ij,ij->i", np.cross(b - a, c - a), d - a)) / 6
    return volumes


HEXAHEDRON = [(0, 1, 3, 4), (1, 2, 3, 6), (1, 3, 4, 6), (3, 4, 6, 7), (1, 4, 5, 6)]
PRISM = [(0, 1, 2, 3), (1, 2, 3, 4), (2, 3, 4, 5)]


def _means(grid, cells, values):
    """[of the cells of a mask] the mean of a field over the nodes of each."""
    size = np.diff(grid.offsets, prepend=0)
    return (np.add.reduceat(values[grid.connectivity], grid.offsets - size) / size)[cells]


def judge_run(folder, limits):
    """The judgement on a run that has ended. Throws ResultError where it says nothing of feeding."""
    summary = json.loads((folder / "summary.json").read_text())
    times, files = read_collection(folder / "fields.pvd")
    grid = read_fields(files[-1])
    if "emptied" not in grid.point_data:
        raise ResultError(f"{folder}: the run has no feeding; has the card of the alloy a change of volume?")
    castings = summary["answers"]["castings"]
    bodies = list(summary["mesh"]["bodies"])
    parts = [name for name, answer in castings.items() if not answer["riser"] and not answer["gating"]]
    risers = [name for name, answer in castings.items() if answer["riser"]]
    return judge(grid, [bodies.index(name) for name in parts], [bodies.index(name) for name in risers],
                 bodies, limits, 2 if summary.get("analysis", {}).get("kind", "solid") == "solid" else 1)


def judge(grid, parts, risers, bodies, limits, up):
    """parts, risers: numbers of bodies; up: the axis that points up."""
    volumes, body = cell_volumes(grid), grid.cell_data["body"]
    emptied = np.asarray(grid.point_data["emptied"])
    unfed = np.asarray(grid.point_data.get("unfed_pores", np.zeros_like(emptied)))
    pores = unfed + np.asarray(grid.point_data.get("gas_pores", np.zeros_like(emptied)))
    of_part = np.isin(body, parts)
    part = float(volumes[of_part].sum())
    hollow = _means(grid, of_part, emptied) * volumes[of_part]
    holes = float(hollow.sum())
    densest = densest_place(centres(grid)[of_part], volumes[of_part], _means(grid, of_part, pores))
    reasons = []
    if holes > limits.holes * part:
        reasons.append(f"holes of {1e6 * holes:.3g} cm3 in the part")
    if densest > limits.pores:
        reasons.append(f"pores of {100 * densest:.2g} % in the part")
    # What is left of each riser below the lowest place of its pipe.
    left = 1.0
    for riser in risers:
        own = moments.nodes_of(grid, body == riser)
        height = np.ptp(grid.points[own, up])
        gone = own[emptied[own] > HOLLOW]
        share = (grid.points[gone, up].min() - grid.points[own, up].min()) / height if gone.size else 1.0
        left = min(left, float(share))
        if share < limits.left:
            reasons.append(f"{100 * share:.0f} % of '{bodies[riser]}' are left below its pipe")
    above = _means(grid, of_part, np.where(pores > limits.pores, pores, 0.0)) * volumes[of_part]
    return Judgement(not reasons, reasons, holes, densest, part, float(volumes[np.isin(body, parts + risers)].sum()), left,
                     len(moments.nodes_of(grid, np.isin(body, parts + risers))),
                     _defects(grid, of_part, hollow + above))


def densest_place(points, volumes, pores):
    """The largest share of pores in a ball with PLACE of the volume: that of a single node grows as elements shrink."""
    if not len(points):
        return 0.0
    radius = (0.75 * PLACE * volumes.sum() / np.pi) ** (1 / 3)
    most = 0.0
    for middle in points[np.argsort(-pores, kind="stable")[:TRIED]]:
        near = np.linalg.norm(points - middle, axis=1) <= radius
        most = max(most, float(np.average(pores[near], weights=volumes[near])))
    return most


def _defects(grid, cells, amounts):
    """Places of holes and pores, those near a larger one counted to it."""
    middles = centres(grid)[cells]
    extent = float(np.ptp(middles, axis=0).max()) if len(middles) else 0.0
    found, open_cells = [], np.flatnonzero(amounts > 0)
    while open_cells.size and len(found) < 5:
        first = open_cells[amounts[open_cells].argmax()]
        near = np.linalg.norm(middles[open_cells] - middles[first], axis=1) <= APART * extent
        own = open_cells[near]
        found.append(Defect(np.average(middles[own], axis=0, weights=amounts[own]), float(amounts[own].sum())))
        open_cells = open_cells[~near]
    return sorted(found, key=lambda defect: -defect.volume)
