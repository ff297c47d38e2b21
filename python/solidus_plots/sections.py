"""Plane sections through 3-D fields: [[sections]] of plots.toml."""

from dataclasses import dataclass

from matplotlib.collections import LineCollection
import numpy as np

from solidus_plots import moments, paint, style
from solidus_plots.annotations import mark
from solidus_plots.cut import Cut, Plane, cut, isolines
from solidus_plots.raster import rasterise
from solidus_plots.sheet import Sheet, badness, heading, wrap
from solidus_plots.vtu import Grid, ResultError

MM = 1e3  # sections are drawn in millimetres


def read_plane(entry):
    """A plane of plots.toml: { z = 20 } or { normal = [1, 1, 0], through = [0, 0, 0] }, in mm."""
    try:
        if len(entry) == 1 and next(iter(entry)) in "xyz":
            (name, position), = entry.items()
            return Plane.axis(name, position / MM), f"{name} = {position:g} mm"
        if set(entry) == {"normal", "through"} and len(entry["normal"]) == len(entry["through"]) == 3 \
                and any(entry["normal"]):
            plane = Plane.through(np.array(entry["through"], float) / MM, entry["normal"])
            normal, point = (", ".join(f"{x:g}" for x in entry[key]) for key in ("normal", "through"))
            return plane, f"normal ({normal}) through ({point}) mm"
    except (TypeError, ValueError):
        pass
    raise ResultError(f"plots.toml: {entry} is no plane; write {{ z = 20 }} (in mm) or "
                      "{ normal = [1, 1, 0], through = [0, 0, 0] }")


@dataclass
class Panel:
    """One moment in one plane, ready to draw."""

    grid: Grid
    part: Cut
    place: np.ndarray  # [point][2] mm, moved by the magnified displacement
    kind: str  # "point_data" or "cell_data"
    values: np.ndarray  # [point] or [triangle]

    def corners(self):
        """Values at the corners of triangles [triangle][3]."""
        if self.kind == "point_data":
            return self.values[self.part.triangles]
        return self.values[:, None].repeat(3, axis=1)


def _panel(grid, mask, plane, spec):
    part = cut(grid, mask, plane)
    points = part.at_points(grid.points)
    if spec.get("magnification", 0):
        points = points + spec["magnification"] * part.at_points(moments.displacement(grid))
    kind, values = moments.values(grid, spec, mask)
    values = part.at_points(values) if kind == "point_data" else values[part.cells]
    return Panel(grid, part, MM * plane.place(points), kind, values)


def frame_of(panels):
    """Lower and upper corner [mm] of what the panels of a plane show, with a margin."""
    places = np.concatenate([panel.place for panel in panels])
    low, high = places.min(axis=0), places.max(axis=0)
    margin = 0.02 * (high - low).max()
    return low - margin, high + margin


def _fill(axes, panel, frame, colours, shape):
    """The colours of the field."""
    low, high = frame
    pixels = (panel.place - [low[0], high[1]]) * [shape[1] / (high[0] - low[0]), -shape[0] / (high[1] - low[1])]
    picture = rasterise(np.column_stack([pixels, np.zeros(len(pixels))]), panel.part.triangles, shape)
    image = np.zeros((*shape, 4))
    image[picture.seen] = [*style.NO_VALUE, 1.0]
    values = picture.at_corners(panel.corners())
    rows, columns = (index[np.isfinite(values)] for index in np.nonzero(picture.seen))
    image[rows, columns, :3] = colours(values[np.isfinite(values)])
    axes.imshow(image, extent=(low[0], high[0], low[1], high[1]), interpolation="antialiased", aspect="equal")


def draw_panel(axes, panel, frame, colours, shape, mesh):
    """Colours and lines of a panel."""
    _fill(axes, panel, frame, colours, shape)
    place, part = panel.place, panel.part
    if panel.kind == "point_data":
        for value, look in [(value, paint.LINE) for value in colours.contours] + \
                [(level["value"], paint.named_line(level)) for level in colours.levels]:
            axes.add_collection(LineCollection(isolines(place, part.triangles, panel.values, value), **look))
    if mesh:
        lines = place[part.sides(part.cells)]
        axes.add_collection(LineCollection(lines, colors="black", linewidths=0.2, alpha=0.6))
    outline = place[part.sides(panel.grid.cell_data["body"][part.cells])]
    axes.add_collection(LineCollection(outline, capstyle="round", colors="black", linewidths=0.8))
    axes.grid(False)
    for side in ("left", "bottom"):
        axes.spines[side].set_visible(False)
    axes.tick_params(length=2, labelsize=7.5)
    axes.set(xlim=(frame[0][0], frame[1][0]), ylim=(frame[0][1], frame[1][1]))


def _mark_probes(axes, plane, run, spec):
    """The probes asked for that lie in a plane."""
    names, points = run.probes(spec.get("probes", []))
    near = np.abs(plane.distance(points)) < 1e-3  # m
    if near.any():
        mark(axes, MM * plane.place(points[near]), [name for name, shown in zip(names, near) if shown])


def _rows(spec, frames, n_moments):
    """[row][column] (plane, moment) or None: planes across or down, whichever looks better; panels of one
    plane, or of one moment, are wrapped."""
    entries = [[(p, m) for m in range(n_moments)] for p in range(len(frames))]
    size = np.max([high - low for low, high in frames], axis=0)
    if len(frames) == 1 or n_moments == 1:
        return wrap([entry for row in entries for entry in row], spec.get("columns"), *size)
    if badness(n_moments, len(frames), *size) <= badness(len(frames), n_moments, *size):
        return entries
    return [list(column) for column in zip(*entries)]


def _same_plane(rows, r, c, other_r, other_c):
    """Whether a panel has a neighbour there that shows the same plane."""
    if not (0 <= other_r < len(rows) and 0 <= other_c < len(rows[0])) or rows[other_r][other_c] is None:
        return False
    return rows[r][c] is None or rows[r][c][0] == rows[other_r][other_c][0]


def draw(spec, run, folder):
    """One [[sections]] of plots.toml: a field in several planes at several moments with one colour bar."""
    grids = run.those_of(spec.get("times", ["last"]))
    times = style.time_texts([grid.time for grid in grids])
    planes = [read_plane(entry) for entry in spec["planes"]]
    panels = [[_panel(grid, run.body_mask(grid, spec.get("bodies")), plane, spec) for grid in grids]
              for plane, _ in planes]
    for row, (_, name) in zip(panels, planes):
        if not any(panel.place.size for panel in row):
            raise ResultError(f"plots.toml: '{spec['file']}': the plane {name} does not meet the bodies")
    shown = np.concatenate([panel.values for row in panels for panel in row])
    colours = paint.Paint(spec, moments.unit(grids[0], spec), shown)
    frames = [frame_of([panel for panel in row if panel.place.size]) for row in panels]
    sizes = [tuple(high - low) for low, high in frames]
    rows = _rows(spec, frames, len(grids))
    labelled = [[not _same_plane(rows, r, c, r + 1, c) for c in range(len(rows[0]))] for r in range(len(rows))]
    title = heading(spec, *([planes[0][1]] if len(planes) == 1 else []), *(times if len(times) == 1 else []))
    sheet = Sheet([[entry and sizes[entry[0]] for entry in row] for row in rows], title,
                  0.35 if len(planes) == 1 else 0.68, [0.68 if any(row) else 0.35 for row in labelled],
                  legend=colours.legend())
    for r, c in np.ndindex(len(rows), len(rows[0])):
        if rows[r][c] is None:
            continue
        (p, m), axes, (plane, name) = rows[r][c], sheet.axes[r][c], planes[rows[r][c][0]]
        draw_panel(axes, panels[p][m], frames[p], colours, sheet.pixels(sizes[p]), spec.get("mesh", False))
        _mark_probes(axes, plane, run, spec)
        axes.set_title(", ".join([name] * (len(planes) > 1) + [times[m]] * (len(times) > 1)), fontsize=9)
        left = not _same_plane(rows, r, c, r, c - 1)
        axes.tick_params(labelbottom=labelled[r][c], labelleft=left)
        axes.set_xlabel(f"{plane.names[0]} [mm]" if labelled[r][c] else "", labelpad=1.5)
        axes.set_ylabel(f"{plane.names[1]} [mm]" if left else "", labelpad=1.5)
    colours.bar(sheet.bar, panels[0][0].kind == "point_data")
    return style.save(sheet.figure, folder, spec["file"], vector=False)
