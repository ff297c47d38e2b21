"""One field of a run on one sheet: the skin of the bodies and cuts through the hottest spot, or a whole plane
section, with the least and largest value, their places, alloy and case."""

from dataclasses import dataclass, field

from matplotlib.collections import LineCollection
import numpy as np

from solidus_plots import hot_spots, moments, paint, style
from solidus_plots.annotations import mark, triad
from solidus_plots.cells import Refined
from solidus_plots.cut import Cut, Plane, cut
from solidus_plots.scene import Camera, View
from solidus_plots.sections import MM, Panel, draw_panel, frame_of
from solidus_plots.sheet import Sheet, wrap
from solidus_plots.surfaces import frame_of as frame_of_surfaces
from solidus_plots.surfaces import image_of, surface_of
from solidus_plots.vtu import ResultError

NEAR = 0.02  # of the extent: spots so near to a cut are marked in it


@dataclass
class Case:
    """What every sheet of a run shares."""

    corner: str  # case and alloy
    solid: bool  # three-dimensional
    names: tuple  # of the axes of a plane section
    hottest: np.ndarray  # [3] m
    spots: list = field(default_factory=list)  # hot spots, the last first
    up: str = "z"


def _number(value):
    return f"{value:.4g}"


def _place(point, names):
    shown = ", ".join(_number(0.0 if abs(x) < 1e-9 else MM * x) for x in point[:len(names)])
    return f"({shown}) mm"


def _extremes(grid, mask, spec, names):
    """A line with the least and the largest value of the bodies shown, and where; where values are shown below a limit
    alone, with the least one: the largest would be the limit."""
    kind, found = moments.values(grid, {key: value for key, value in spec.items() if key != "smooth"}, mask)
    if kind == "point_data":
        where = moments.nodes_of(grid, mask)
        points = grid.points
    else:
        where, points = np.flatnonzero(mask), hot_spots.centres(grid)
    shown = where[np.isfinite(found[where])]
    if not shown.size:
        return "no value"
    everywhere, where = shown.size == where.size, shown
    unit = style.unit_text(moments.unit(grid, spec))
    unit = "" if unit in ("", "1") else f" {unit}"
    low, high = where[found[where].argmin()], where[found[where].argmax()]
    if found[low] == found[high] and everywhere:
        return f"{_number(found[low])}{unit} everywhere"
    least = f"least {_number(found[low])}{unit} at {_place(points[low], names)}"
    if "below" in spec:
        return least
    return f"largest {_number(found[high])}{unit} at {_place(points[high], names)},  {least}"


class _Skin:
    """A look at the surface of the bodies."""

    def __init__(self, name, grids, run, spec, camera):
        self.name, self._grids, self._spec, self.camera = name, grids, spec, camera
        self._surfaces = [surface_of(grid, run, spec, camera.eye) for grid in grids]
        self._frame = frame_of_surfaces(self._surfaces, camera)
        self.size = tuple(MM * (self._frame[1] - self._frame[0]))

    def values(self):
        return np.concatenate([surface.values[surface.triangles_shown()].ravel() for surface in self._surfaces])

    def draw(self, axes, moment, colours, shape, case):
        view = View(self._surfaces[moment], self.camera, self._frame, shape)
        image = image_of(view, self._grids[moment], colours, self._spec)
        extent = (MM * np.array(self._frame)).T.ravel()
        axes.imshow(image, extent=extent, interpolation="antialiased", aspect="equal")
        axes.axis("off")


class _Section:
    """A plane of the bodies: a cut, or all of them where they are plane themselves."""

    def __init__(self, name, grids, run, spec, plane, whole):
        self.name, self.plane, self._panels = name, plane, []
        for grid in grids:
            mask = run.body_mask(grid, spec.get("bodies"))
            part = _whole(grid, mask) if whole else cut(grid, mask, plane)
            kind, found = moments.values(grid, spec, mask)
            values = part.at_points(found) if kind == "point_data" else found[part.cells]
            self._panels.append(Panel(grid, part, MM * plane.place(part.at_points(grid.points)), kind, values))
        filled = [panel for panel in self._panels if panel.place.size]
        if not filled:
            raise ResultError(f"the plane {name} does not meet the bodies")
        self._frame = frame_of(filled)
        self.size = tuple(self._frame[1] - self._frame[0])

    def values(self):
        return np.concatenate([panel.values for panel in self._panels])

    def draw(self, axes, moment, colours, shape, case):
        draw_panel(axes, self._panels[moment], self._frame, colours, shape, False)
        axes.tick_params(labelsize=6.5)
        axes.set_xlabel(f"{self.plane.names[0]} [mm]", fontsize=7.5, labelpad=1)
        axes.set_ylabel(f"{self.plane.names[1]} [mm]", fontsize=7.5, labelpad=1)
        reach = NEAR * max(self.size) / MM
        near = [(str(rank + 1), spot.point) for rank, spot in enumerate(case.spots)
                if abs(self.plane.distance(spot.point)) <= reach]
        if near:
            mark(axes, np.array([MM * self.plane.place(point) for _, point in near]), [name for name, _ in near])
        elif abs(self.plane.distance(case.hottest)) <= reach:
            x, y = MM * self.plane.place(case.hottest)
            axes.plot([x], [y], "+", markersize=8, markeredgewidth=2.6, color="white", zorder=8)
            axes.plot([x], [y], "+", markersize=7, markeredgewidth=1.1, color="black", zorder=9)


class _Rim:
    """The boundary of plane bodies, coloured by what it carries: a gap has no inside."""

    WIDTH = 4.0  # of the line [pt]

    def __init__(self, grids, run, spec, plane):
        self.name, self.plane, self._lines, self._values = "", plane, [], []
        for grid in grids:
            mask = run.body_mask(grid, spec.get("bodies"))
            kind, found = moments.values(grid, spec, mask)
            if kind != "point_data":
                raise ResultError(f"'{spec['field']}' is a field of elements; a rim shows those of nodes")
            edges, count = grid.edges(mask)
            pieces = [pair for edge, once in zip(edges, count == 1) if once for pair in zip(edge, edge[1:])]
            nodes = np.array(pieces).reshape(-1, 2)
            self._lines.append(MM * plane.place(grid.points[nodes]))
            self._values.append(found[nodes].mean(axis=1))
        corners = np.concatenate(self._lines).reshape(-1, 2)
        margin = 0.04 * np.ptp(corners, axis=0).max()
        self._frame = corners.min(axis=0) - margin, corners.max(axis=0) + margin
        self.size = tuple(self._frame[1] - self._frame[0])

    def values(self):
        return np.concatenate(self._values)

    def draw(self, axes, moment, colours, shape, case):
        lines = self._lines[moment]
        axes.add_collection(LineCollection(lines, colors=colours(self._values[moment]), linewidths=self.WIDTH))
        axes.add_collection(LineCollection(lines, colors="black", linewidths=0.4))
        low, high = self._frame
        axes.set(xlim=(low[0], high[0]), ylim=(low[1], high[1]), aspect="equal")
        axes.grid(False)
        axes.tick_params(length=2, labelsize=6.5)
        axes.set_xlabel(f"{self.plane.names[0]} [mm]", fontsize=7.5, labelpad=1)
        axes.set_ylabel(f"{self.plane.names[1]} [mm]", fontsize=7.5, labelpad=1)


def _whole(grid, mask):
    """All plane cells of a mask as a cut that goes through every node."""
    triangles, cells = grid.triangles()
    taken = mask[cells]
    nodes = np.arange(len(grid.points))
    used, triangles = np.unique(triangles[taken], return_inverse=True)
    return Cut(np.stack([nodes[used]] * 2, axis=1), np.zeros(len(used)), triangles.reshape(-1, 3), cells[taken],
               Refined(len(grid.points)))


def _views(grids, run, spec, case):
    if not case.solid:
        plane = Plane(np.zeros(3), np.eye(3)[2], np.eye(3)[0], np.eye(3)[1], case.names)
        if spec.get("skin_alone"):
            return [_Rim(grids, run, spec, plane)]
        return [_Section("", grids, run, spec, plane, True)]
    around = [_Skin("skin", grids, run, spec, Camera(-60, 25, case.up))]
    if spec.get("skin_alone"):
        return around + [_Skin("from behind and below", grids, run, spec, Camera(120, -25, case.up))]
    through = spec.get("through", case.hottest)
    for axis in "xyz":
        place = through["xyz".index(axis)]
        try:
            around.append(_Section(f"{axis} = {_number(MM * place)} mm", grids, run, spec, Plane.axis(axis, place), False))
        except ResultError:
            if "through" not in spec:
                raise
            # A place on an outer face: by rounding the plane may miss the bodies there.
    return around


def draw(spec, run, case, folder):
    """One sheet. `spec` is that of [[sections]], with `skin_alone`: no cuts; `through`: the point of the cuts [m], else the
    hot spot; `hot_spots`: they are marked; `timeless`: of the whole run; `remark`: a line below."""
    grids = run.those_of(spec["times"])
    times = style.time_texts([grid.time for grid in grids])
    views = _views(grids, run, spec, case)
    masks = [run.body_mask(grid, spec.get("bodies")) for grid in grids]
    shown = np.concatenate([view.values() for view in views])
    if not np.isfinite(shown).any():  # all values lie between the cuts: the line below says where
        plain = {key: value for key, value in spec.items() if key != "smooth"}
        shown = np.concatenate([moments.values(grid, plain, mask)[1] for grid, mask in zip(grids, masks)])
    colours = paint.Paint({"contours": 8, **spec}, moments.unit(grids[0], spec), shown)
    entries = [(view, moment) for moment in range(len(grids)) for view in views]
    if len(grids) == 1 or len(views) == 1:
        rows = wrap(entries, None, *np.max([view.size for view in views], axis=0))
    else:
        rows = [entries[start:start + len(views)] for start in range(0, len(entries), len(views))]
    names = "xyz" if case.solid else case.names
    timeless = spec.get("timeless", False)  # of the whole run
    footer = [("" if timeless else f"{time}: ") + _extremes(grid, mask, spec, names)
              for grid, mask, time in zip(grids, masks, times)]
    if spec.get("hot_spots") and case.spots:
        footer.append("hot spots: " + ";  ".join(f"{rank + 1}: {_number(spot.value)} s at {_place(spot.point, names)}"
                                                 for rank, spot in enumerate(case.spots)))
    elif case.solid and not spec.get("skin_alone"):
        footer.append(f"+: {_place(spec.get('through', case.hottest), names)}, through which the cuts go")
    footer += [spec["remark"]] if "remark" in spec else []
    footer.append(case.corner)
    title = spec["title"] + (f", {times[0]}" if len(times) == 1 and not timeless else "")
    # Narrow panels get room for their titles.
    least = 0.22 * max(view.size[0] for view in views)
    sheet = Sheet([[entry and (max(entry[0].size[0], least), entry[0].size[1]) for entry in row] for row in rows], title, 0.55, [0.62] * len(rows),
                  legend=colours.legend(), footer=footer)
    marks = case if spec.get("hot_spots") else Case(case.corner, case.solid, case.names, spec.get("through", case.hottest), [], case.up)
    for axes_row, row in zip(sheet.axes, rows):
        for axes, entry in zip(axes_row, row):
            if entry is None:
                continue
            view, moment = entry
            view.draw(axes, moment, colours, sheet.pixels(view.size), marks)
            first = len(times) > 1 and view is views[0]  # the moment is written over the first view of its row
            axes.set_title(", ".join([view.name] * bool(view.name) + [times[moment]] * first), fontsize=8.5)
    colours.bar(sheet.bar, bool(colours.contours))
    return style.save(sheet.figure, folder, spec["file"], vector=False)
