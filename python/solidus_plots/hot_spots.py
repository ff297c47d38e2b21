"""Where a casting freezes last: the hottest spot and the others, from the fields of a moment."""

from dataclasses import dataclass

import numpy as np

from solidus_plots import moments

APART = 0.12  # hot spots nearer than this share of the extent are one
MOST = 5  # that are told


@dataclass
class Spot:
    point: np.ndarray  # [3] m
    value: float  # when it froze [s]; of one that has not, minus its solid fraction


def hottest(grid, cells):
    """The point [3] m of the cells of a mask that froze last, of melt the least solid one; without freezing the
    hottest one, without temperatures the one of the largest stress."""
    nodes, data = moments.nodes_of(grid, cells), grid.point_data
    if "solid_fraction" in data and data["solid_fraction"][nodes].min() < 1.0:
        solid = data["solid_fraction"][nodes]
        softest = nodes[solid == solid.min()]
        return grid.points[softest[data["temperature"][softest].argmax()]]
    if "solidified_at" in data and data["solidified_at"][nodes].max() >= 0.0:
        return grid.points[nodes[data["solidified_at"][nodes].argmax()]]
    if "temperature" in data:
        return grid.points[nodes[data["temperature"][nodes].argmax()]]
    if "von_mises" in grid.cell_data:
        return centres(grid)[np.where(cells, grid.cell_data["von_mises"], -np.inf).argmax()]
    return grid.points[nodes].mean(axis=0)


def all_of(grid, cells):
    """Nodes that froze later than every neighbour, the last first; those near a later one are no spots of their
    own."""
    if "solidified_at" not in grid.point_data:
        return []
    time = grid.point_data["solidified_at"]
    nodes = moments.nodes_of(grid, cells)
    # The latest of each cell, then of the cells round each node: a spot is the latest of its neighbours.
    size = np.diff(grid.offsets, prepend=0)
    starts = grid.offsets - size
    of_cell = np.maximum.reduceat(time[grid.connectivity], starts)
    latest = np.full(len(time), -np.inf)
    own = np.repeat(cells, size)
    np.maximum.at(latest, grid.connectivity[own], np.repeat(of_cell, size)[own])
    peaks = nodes[(time[nodes] >= 0.0) & (time[nodes] >= latest[nodes])]
    spots, extent = [], np.ptp(grid.points[nodes], axis=0).max()
    for node in peaks[np.argsort(-time[peaks], kind="stable")]:
        point = grid.points[node]
        if all(np.linalg.norm(point - spot.point) > APART * extent for spot in spots):
            spots.append(Spot(point, time[node]))
        if len(spots) == MOST:
            break
    return spots


def centres(grid):
    """[cell][3] m, means of the nodes."""
    size = np.diff(grid.offsets, prepend=0)
    return np.add.reduceat(grid.points[grid.connectivity], grid.offsets - size, axis=0) / size[:, None]
