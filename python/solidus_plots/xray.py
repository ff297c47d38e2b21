"""A casting as on a radiograph: metal and missing metal, summed along the direction in which it is thinnest.

Missing is what fields of holes say: pipes and cavities (emptied), pores that melt did not feed (unfed_pores, pore_fraction)
and pores of gas (gas_pores). Along a ray the fields are linear in each tetrahedron, so its part is the length of the ray in it
times the value in the middle of that; with an axis of revolution rings of a fine raster are summed along their chords.
"""

from dataclasses import dataclass

import matplotlib.pyplot as plt
from matplotlib.tri import LinearTriInterpolator, Triangulation
import numpy as np

from solidus_plots import moments, style
from solidus_plots.cells import tetrahedra

MM = 1e3
WIRE = 5.0  # mm: the thickest that is laid on castings as an indicator is 3.2, with some room
PIXELS = 320  # along the longer side
LEAST = 1e-3  # of the thickness: less is not to be seen on any film
ABSORPTION = 2.0  # of the thickest metal: the film is darkest where there is least of it
CENTRE = np.array([0.50013, 0.49971])  # of a pixel: its ray runs in no face that two tetrahedra share
PAIRS = 4_000_000  # of rays and tetrahedra at a time


@dataclass
class Film:
    """What rays have met. Rows are heights, from below."""

    metal: np.ndarray  # [row][column] m of room of the casting
    missing: np.ndarray  # [row][column] m of it without metal
    low: np.ndarray  # [2] m of the first pixel's corner
    pixel: float  # m
    names: tuple  # of its axes

    def extent(self):
        rows, columns = self.metal.shape
        high = self.low + self.pixel * np.array([columns, rows])
        return MM * np.array([self.low[0], high[0], self.low[1], high[1]])

    def darkest(self):
        """Missing metal [m], the room along its ray [m], and its place [2] m, where most is missing."""
        row, column = np.unravel_index(self.missing.argmax(), self.missing.shape)
        place = self.low + self.pixel * (np.array([column, row]) + 0.5)
        return self.missing[row, column], self.metal[row, column], place


def holes(grid):
    """The share of the room without metal: at nodes, and what cells add."""
    def share(data, name, count):
        return data.get(name, np.zeros(count))

    nodes = len(grid.points)
    at_nodes = share(grid.point_data, "emptied", nodes) + share(grid.point_data, "unfed_pores", nodes)
    return (at_nodes + share(grid.point_data, "gas_pores", nodes),
            share(grid.cell_data, "pore_fraction", len(grid.cell_types)))


def _raster(points):
    """Corner [2] m, size of a pixel [m], rows and columns for points [point][2]."""
    low, high = points.min(axis=0), points.max(axis=0)
    pixel = (high - low).max() / PIXELS
    columns, rows = np.maximum(np.ceil((high - low) / pixel - 1e-9).astype(int), 1)
    return low, pixel, rows, columns


def _rays(corners, values, low, pixel, shape, metal, missing):
    """Adds tetrahedra, corners [n][4][3] with the ray along the last axis and values [n][4] of the field."""
    first = np.clip(np.floor((corners[:, :, :2].min(axis=1) - low) / pixel - 0.5).astype(int), 0, None)
    last = np.ceil((corners[:, :, :2].max(axis=1) - low) / pixel - 0.5).astype(int)
    last = np.minimum(last, np.array(shape)[::-1] - 1)
    span = np.maximum(last - first + 1, 0)
    count = span.prod(axis=1)
    owner = np.repeat(np.arange(len(corners)), count)
    within = np.arange(len(owner)) - np.repeat(np.cumsum(count) - count, count)
    column = first[owner, 0] + within % np.maximum(span[owner, 0], 1)
    row = first[owner, 1] + within // np.maximum(span[owner, 0], 1)
    matrix = np.concatenate([np.ones((len(corners), 1, 4)), corners.transpose(0, 2, 1)], axis=1)
    inverse = np.linalg.inv(matrix)  # [n][corner][1, x, y, z]: the share of a corner at a place
    place = low + pixel * (np.stack([column, row], axis=1) + CENTRE)
    part = inverse[owner]
    start = part[:, :, 0] + part[:, :, 1] * place[:, :1] + part[:, :, 2] * place[:, 1:]
    slope = part[:, :, 3]
    with np.errstate(divide="ignore", invalid="ignore"):
        crossing = -start / slope
    enters = np.where(slope > 0, crossing, np.where((slope == 0) & (start < 0), np.inf, -np.inf)).max(axis=1)
    leaves = np.where(slope < 0, crossing, np.inf).min(axis=1)
    meets = leaves > enters
    length, middle = (leaves - enters)[meets], ((leaves + enters) / 2)[meets]
    shares = start[meets] + slope[meets] * middle[:, None]
    np.add.at(metal, (row[meets], column[meets]), length)
    np.add.at(missing, (row[meets], column[meets]), length * (shares * values[owner[meets]]).sum(axis=1))


def film_of_solid(grid, cells, axis):
    """Along x, y or z (0, 1, 2) of a mesh in three dimensions."""
    parts = tetrahedra(grid, cells)
    at_nodes, of_cells = holes(grid)
    points = parts.refined.extend(grid.points)
    values = parts.refined.extend(at_nodes)[parts.nodes] + of_cells[parts.cells][:, None]
    across = [(axis + 1) % 3, (axis + 2) % 3] if axis != 1 else [0, 2]
    corners = points[parts.nodes][:, :, [*across, axis]]
    sides = corners[:, 1:] - corners[:, :1]
    solid = np.abs(np.linalg.det(sides)) > 0
    corners, values = corners[solid], values[solid]
    low, pixel, rows, columns = _raster(corners[:, :, :2].reshape(-1, 2))
    metal, missing = np.zeros((rows, columns)), np.zeros((rows, columns))
    size = np.prod(np.ptp(corners[:, :, :2], axis=1) / pixel + 2, axis=1)
    for chunk in np.split(np.arange(len(corners)), np.searchsorted(np.cumsum(size), np.arange(PAIRS, size.sum(), PAIRS))):
        _rays(corners[chunk], values[chunk], low, pixel, (rows, columns), metal, missing)
    return Film(metal, missing, low, pixel, tuple("xyz"[i] for i in across))


def film_of_revolution(grid, cells):
    """Across the axis of an axisymmetric mesh, both halves."""
    triangles, owners = grid.triangles()
    shown = cells[owners]
    triangles, owners = triangles[shown], owners[shown]
    at_nodes, of_cells = holes(grid)
    used = np.unique(triangles)
    radius = grid.points[used, 0].max()
    bottom, top = grid.points[used, 1].min(), grid.points[used, 1].max()
    pixel = max(2 * radius, top - bottom) / PIXELS
    half, rows = max(int(np.ceil(radius / pixel)), 1), max(int(np.ceil((top - bottom) / pixel)), 1)
    r, z = pixel * (np.arange(half) + 0.5), bottom + pixel * (np.arange(rows) + 0.5)
    shape = Triangulation(grid.points[:, 0], grid.points[:, 1], triangles)
    place = np.meshgrid(r, z)
    inside = shape.get_trifinder()(*place)
    share = LinearTriInterpolator(shape, at_nodes)(*place).filled(0.0) + np.where(inside >= 0, of_cells[owners][inside], 0)
    edge = np.arange(half + 1.0) ** 2
    chord = 2 * pixel * np.diff(np.sqrt(np.maximum(edge[None, :] - (np.arange(half)[:, None] + 0.5) ** 2, 0)), axis=1)
    room = np.where(inside >= 0, 1.0, 0.0)
    metal, missing = room @ chord.T, (room * share) @ chord.T
    both = [np.concatenate([side[:, ::-1], side], axis=1) for side in (metal, missing)]
    return Film(both[0], both[1], np.array([-half * pixel, bottom]), pixel, ("r", "z"))


def film(grid, cells, solid):
    """Through the least of the casting's three sides; nothing where no hole is to be seen on it."""
    if solid:
        points = grid.points[moments.nodes_of(grid, cells)]
        made = film_of_solid(grid, cells, int(np.ptp(points, axis=0).argmin()))
    else:
        made = film_of_revolution(grid, cells)
    missing, metal, _ = made.darkest()
    return made if missing > LEAST * max(metal, 1e-12) else None


def draw(spec, run, case, folder):
    """The film and what is missing on it, side by side, of the last moment."""
    grid = run.at(spec["times"][-1])
    made = film(grid, run.body_mask(grid, spec.get("bodies")), case.solid)
    if made is None:
        return []
    rows, columns = made.metal.shape
    width = min(max(4.2 * columns / rows, 1.6), 5.2)
    figure, (left, right) = plt.subplots(1, 2, figsize=(2 * width + 1.4, width * rows / columns + 1.3), sharey=True,
                                         constrained_layout=True)
    there = made.metal > 0
    dark = np.exp(-ABSORPTION * (made.metal - made.missing) / made.metal.max())
    look = {"origin": "lower", "extent": made.extent(), "interpolation": "nearest"}
    left.imshow(dark, cmap="gray_r", vmin=np.exp(-ABSORPTION), vmax=1.0, **look)
    colours = right.imshow(np.where(there, MM * made.missing, np.nan), cmap="viridis", **look)
    for axes, title in ((left, "as on a film"), (right, "missing metal")):
        axes.set_title(title, fontsize=8.5)
        axes.set_xlabel(f"{made.names[0]} [mm]")
        axes.grid(False)
        axes.set_aspect("equal")
    left.set_ylabel(f"{made.names[1]} [mm]")
    bar = figure.colorbar(colours, ax=right, pad=0.015, aspect=32, shrink=0.92)
    bar.set_label("Missing metal [mm]")
    bar.outline.set_visible(False)
    missing, metal, place = made.darkest()
    across = f"{made.names[0]} = {MM * place[0]:.4g}, {made.names[1]} = {MM * place[1]:.4g} mm"
    figure.suptitle(spec["title"], fontsize=10)
    wire = f", as a wire of {MM * missing:.2g} mm would show" if MM * missing < WIRE else ""
    figure.supxlabel(f"most is missing at {across}: {MM * missing:.3g} of {MM * metal:.3g} mm{wire}\n{case.corner}", fontsize=7.5, color=style.REMARK["color"])
    return style.save(figure, folder, spec["file"], vector=False)
