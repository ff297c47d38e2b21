"""Plane sections through 3-D fields: [[sections]] of plots.toml."""

from dataclasses import dataclass

from matplotlib.collections import LineCollection
import numpy as np

from solidus_plots import moments, paint, style
from solidus_plots.cut import Cut, Plane, cut, isolines
from solidus_plots.raster import rasterise
from solidus_plots.sheet import Sheet, arrange
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
        return self.values[self.part.triangles] if self.kind == "point_data" else self.values[:, None].repeat(3, 1)


def _panel(grid, mask, plane, spec):
    part = cut(grid, mask, plane)
    points = part.at_points(grid.points)
    if spec.get("magnification", 0):
        points = points + spec["magnification"] * part.at_points(moments.displacement(grid))
    kind, values = moments.values(grid, spec, mask)
    values = part.at_points(values) if kind == "point_data" else values[part.cells]
    return Panel(grid, part, MM * plane.place(points), kind, values)


def _frame(panels):
    """Lower and upper corner [mm] of what the panels of a plane show, with a margin."""
    places = np.concatenate([panel.place for panel in panels])
    low, high = places.min(axis=0), places.max(axis=0)
    margin = 0.02 * (high - low).max()
    return low - margin, high + margin


def _draw(axes, panel, frame, colours, shape, spec):
    low, high = frame
    place, triangles = panel.place, panel.part.triangles
    pixels = (place - [low[0], high[1]]) * [shape[1] / (high[0] - low[0]), -shape[0] / (high[1] - low[1])]
    picture = rasterise(np.column_stack([pixels, np.zeros(len(pixels))]), triangles, shape)
    image = np.zeros((*shape, 4))
    image[picture.seen] = [*style.NO_VALUE, 1.0]
    values = picture.at_corners(panel.corners())
    rows, columns = (index[np.isfinite(values)] for index in np.nonzero(picture.seen))
    image[rows, columns, :3] = colours(values[np.isfinite(values)])
    axes.imshow(image, extent=(low[0], high[0], low[1], high[1]), interpolation="antialiased", aspect="equal")

    def lines(sides, **look):
        axes.add_collection(LineCollection(place[sides], capstyle="round", **look))

    if panel.kind == "point_data":
        for level in colours.contours:
            axes.add_collection(LineCollection(isolines(place, triangles, panel.values, level), **paint.LINE))
        for level in colours.levels:
            axes.add_collection(LineCollection(isolines(place, triangles, panel.values, level["value"]),
                                               **paint.named_line(level)))
    if spec.get("mesh", False):
        lines(panel.part.sides(panel.part.cells), colors="black", linewidths=0.2, alpha=0.6)
    lines(panel.part.sides(panel.grid.cell_data["body"][panel.part.cells]), colors="black", linewidths=0.8)
    axes.grid(False)
    for side in ("left", "bottom"):
        axes.spines[side].set_visible(False)
    axes.tick_params(length=2, labelsize=7.5)
    axes.set_xlim(low[0], high[0])
    axes.set_ylim(low[1], high[1])


def draw(spec, run, folder):
    """One [[sections]] of plots.toml: a field in several planes at several moments with one colour bar."""
    grids = run.those_of(spec.get("times", ["last"]))
    planes = [read_plane(entry) for entry in spec["planes"]]
    panels = [[_panel(grid, run.body_mask(grid, spec.get("bodies")), plane, spec) for grid in grids]
              for plane, _ in planes]
    for row, (_, name) in zip(panels, planes):
        if not any(panel.part.triangles.size for panel in row):
            raise ResultError(f"plots.toml: sections '{spec['file']}': the plane {name} does not meet the bodies")
    shown = np.concatenate([panel.values for row in panels for panel in row])
    colours = paint.Paint(spec, moments.unit(grids[0], spec), shown)
    frames = [_frame([panel for panel in row if panel.place.size]) for row in panels]
    places = _places(spec, frames, len(grids))
    sizes = [[None if entry is None else tuple(frames[entry[0]][1] - frames[entry[0]][0]) for entry in row]
             for row in places]
    remarks, times = [spec.get("title", "")], style.time_texts([grid.time for grid in grids])
    if len(planes) == 1:
        remarks.append(planes[0][1])
    if len(grids) == 1:
        remarks.append(times[0])
    if spec.get("magnification", 0):
        remarks.append(f"displacements × {spec['magnification']:g}")
    below = [[entry is not None and r + 1 < len(places) and places[r + 1][c] is not None
              and places[r + 1][c][0] == entry[0] for c, entry in enumerate(row)] for r, row in enumerate(places)]
    sheet = Sheet(sizes, ", ".join(part for part in remarks if part),
                  (0.35 if len(planes) == 1 else 0.68, [0.35 if all(row) else 0.68 for row in below]),
                  legend=colours.legend())
    for r, row in enumerate(places):
        for c, entry in enumerate(row):
            if entry is None:
                continue
            (p, m), axes = entry, sheet.axes[r][c]
            panel, (plane, name) = panels[p][m], planes[p]
            _draw(axes, panel, frames[p], colours, sheet.pixels(sizes[r][c]), spec)
            heading = [text for several, text in ((len(planes) > 1, name), (len(grids) > 1, times[m])) if several]
            axes.set_title(", ".join(heading), fontsize=9)
            left = c > 0 and row[c - 1] is not None and row[c - 1][0] == p
            axes.tick_params(labelbottom=not below[r][c], labelleft=not left)
            axes.set_xlabel("" if below[r][c] else f"{plane.names[0]} [mm]", labelpad=1.5)
            axes.set_ylabel("" if left else f"{plane.names[1]} [mm]", labelpad=1.5)
    colours.bar(sheet.bar, panels[0][0].kind == "point_data")
    return style.save(sheet.figure, folder, spec["file"], vector=False)


def _places(spec, frames, moments_shown):
    """[row][column] (plane, moment) or None: planes across or down, whichever fills a page better; panels of one
    plane, or of one moment, are wrapped."""
    entries = [[(p, m) for m in range(moments_shown)] for p in range(len(frames))]
    size = np.max([high - low for low, high in frames], axis=0)
    if len(frames) > 1 and moments_shown > 1:
        across = abs(np.log(moments_shown * size[0] / (len(frames) * size[1]) / 1.3))
        down = abs(np.log(len(frames) * size[0] / (moments_shown * size[1]) / 1.3))
        return entries if across <= down else [list(column) for column in zip(*entries)]
    flat = [entry for row in entries for entry in row]
    columns = arrange(len(flat), spec.get("columns"), *size)
    flat += [None] * (-len(flat) % columns)
    return [flat[start:start + columns] for start in range(0, len(flat), columns)]
