"""Pictures of plane and axisymmetric sections: fields as colour maps, and deformed meshes."""

import matplotlib.pyplot as plt
from matplotlib.artist import Artist
from matplotlib.collections import LineCollection
from matplotlib.transforms import ScaledTranslation
from matplotlib.tri import Triangulation
import numpy as np

from solidus_plots import fields, moments, style
from solidus_plots.vtu import ResultError

MM = 1e3  # sections are drawn in millimetres


def _plane(grid):
    """A plane grid as it is; of a 3-D one says what to write instead."""
    if not grid.triangles()[0].size:
        raise ResultError("plots.toml: [[maps]] and [[deformed]] are for plane meshes; in three dimensions "
                          "there are [[sections]] and [[surfaces]]")
    return grid


def _place(grid, magnification, side=1.0):
    """Nodes in the drawing plane [mm], moved by their magnified displacement; side -1: the mirror image."""
    place = grid.points[:, :2].copy()
    if magnification and "displacement" in grid.point_data:
        place += magnification * grid.point_data["displacement"][:, :2]
    return MM * place * [side, 1.0]


def _outline(grid, mask, place, mirror):
    """The boundary of the bodies; with a mirror image the axis is no boundary."""
    sequences, counts = grid.edges(mask)
    inside = np.full(len(place), mirror) & (np.abs(grid.points[:, 0]) < 1e-9 * np.ptp(grid.points[:, 0]))
    return [place[sequence] for sequence, count in zip(sequences, counts)
            if count == 1 and not inside[sequence].all()]


def _frame(axes, places):
    """Shows what is drawn with a small margin; nodes of bodies that are left out do not count."""
    low = np.min([place.min(axis=0) for place in places], axis=0)
    high = np.max([place.max(axis=0) for place in places], axis=0)
    margin = 0.02 * (high - low).max()
    axes.set_xlim(low[0] - margin, high[0] + margin)
    axes.set_ylim(low[1] - margin, high[1] + margin)


def _note(spec):
    factor = spec.get("magnification", 0)
    return f"displacements × {factor:g}" if factor else ""


def _bare(axes, mirror):
    axes.set_aspect("equal")
    axes.grid(False)
    axes.set_xlabel("r [mm]" if mirror else "x [mm]")
    for side in ("left", "bottom"):
        axes.spines[side].set_visible(False)
    axes.tick_params(length=2, labelsize=7.5)
    if mirror:  # the radius is positive on both sides of the axis
        axes.xaxis.set_major_formatter(lambda x, _: f"{abs(x):g}")


def _crosses(level, values, triangles):
    shown = values[triangles]
    return shown.min() < level < shown.max()


def _layers(contours):
    """The artists that a contour plot consists of: one of each level before matplotlib 3.8, since then one of all."""
    return [contours] if isinstance(contours, Artist) else contours.collections


def field_maps(spec, section, folder):
    """One [[maps]] of plots.toml: the same field at several times with one colour bar."""
    grids = [_plane(grid) for grid in section.those_of(spec.get("times", ["last"]))]
    unit, mirror = spec.get("unit", ""), spec.get("mirror", False)
    masks = [section.body_mask(grid, spec.get("bodies")) for grid in grids]
    low, high = moments.limits(grids, masks, spec)
    margin = 1e-9 * max(abs(low), abs(high))  # the largest value belongs to the top colour
    levels, lines = np.linspace(low - margin, high + margin, 65), spec.get("contours", 10)
    if isinstance(lines, int):  # about so many, at round values
        lines = [line for line in plt.MaxNLocator(max(lines, 1)).tick_values(low, high) if low < line < high]
    nodes = moments.nodes_of(grids[0], masks[0])
    extent = np.ptp(grids[0].points[nodes, :2], axis=0) * [2 if mirror else 1, 1]
    height = 4.2
    width = min(max(height * extent[0] / extent[1], 1.3), 5.0)
    figure, panels = plt.subplots(1, len(grids), figsize=((width + 0.35) * len(grids) + 0.9, height + 0.6),
                                  sharex=True, sharey=True, squeeze=False, constrained_layout=True)
    colours, places = None, []
    for axes, grid, mask in zip(panels[0], grids, masks):
        triangles, cells = grid.triangles()
        triangles, cells = triangles[mask[cells]], cells[mask[cells]]
        kind, values = moments.values(grid, spec)
        for side in (1.0, -1.0) if mirror else (1.0,):
            place = _place(grid, spec.get("magnification", 0), side)
            places.append(place[moments.nodes_of(grid, mask)])
            shape = Triangulation(place[:, 0], place[:, 1], triangles)
            look = {"cmap": fields.colour_map(spec["field"], None, 0.0, 0.0)}
            if kind == "point_data":
                shown = np.clip(values, low, high)
                colours = axes.tricontourf(shape, shown, levels=levels, **look)
                for layer in _layers(colours):  # no hairlines between the levels
                    layer.set(edgecolor="face", linewidth=0.2)
                crossed = [line for line in lines if places[-1].size and _crosses(line, values, triangles)]
                if crossed:
                    axes.tricontour(shape, values, levels=crossed, colors="white", linewidths=0.5, alpha=0.75)
            else:
                colours = axes.tripcolor(shape, facecolors=values[cells], vmin=low, vmax=high, **look)
            outline = _outline(grid, mask, place, mirror)
            axes.add_collection(LineCollection(outline, colors="black", linewidths=0.7, zorder=5))
        _bare(axes, mirror)
        axes.set_title(section.heading(grid.time))
    _frame(panels[0][0], places)
    panels[0][0].set_ylabel("z [mm]" if mirror else "y [mm]")
    bar = figure.colorbar(colours, ax=panels[0].tolist(), pad=0.015, aspect=32, shrink=0.92)
    bar.set_label(style.axis_label(spec.get("quantity", fields.label(spec["field"])), unit))
    bar.outline.set_visible(False)
    bar.locator = plt.MaxNLocator(8)
    bar.update_ticks()
    if len(lines) and kind == "point_data":
        bar.ax.hlines(lines, *bar.ax.get_xlim(), colors="white", linewidths=0.5, alpha=0.75)
    title = ", ".join(part for part in (spec.get("title", ""), _note(spec)) if part)
    figure.suptitle(title, fontsize=10)
    return style.save(figure, folder, spec["file"], vector=False)


def deformed_mesh(spec, section, folder):
    """One [[deformed]] of plots.toml: the mesh as it was, and moved by its magnified displacements."""
    grid, mirror = _plane(section.at(spec.get("time", "last"))), spec.get("mirror", False)
    if "displacement" not in grid.point_data:
        raise ResultError("plots.toml: a deformed mesh needs the field displacement")
    factor = spec.get("magnification", 1)
    figure, axes = plt.subplots(figsize=(4.6, 5.6), constrained_layout=True)
    bodies = spec.get("bodies") or section.bodies
    handles = []
    for index, name in enumerate(bodies):
        mask, colour = section.body_mask(grid, [name]), style.COLOURS[index % len(style.COLOURS)]
        before = _place(grid, 0, -1.0 if mirror else 1.0)
        after = _place(grid, factor)
        sequences, _ = grid.edges(mask)
        if mirror:  # the original mesh on the left of the axis, the deformed one on the right
            axes.add_collection(LineCollection([before[s] for s in sequences], colors=colour, linewidths=0.3,
                                               alpha=0.6))
            axes.add_collection(LineCollection(_outline(grid, mask, before, mirror), colors=colour,
                                               linewidths=1.0))
        axes.add_collection(LineCollection(_outline(grid, mask, _place(grid, 0), mirror), colors="#7f7f7f",
                                           linewidths=0.7))
        axes.add_collection(LineCollection([after[s] for s in sequences], colors=colour, linewidths=0.35,
                                           alpha=0.75))
        outline = LineCollection(_outline(grid, mask, after, mirror), colors=colour, linewidths=1.1,
                                 label=name)
        handles.append(axes.add_collection(outline))
    axes.autoscale_view()
    _bare(axes, mirror)
    axes.set_ylabel("z [mm]" if mirror else "y [mm]")
    axes.set_title(spec.get("title", "Deformed mesh") + f" at {grid.time:g} s, displacements × {factor:g}")
    below = axes.transAxes + ScaledTranslation(0, -0.5, figure.dpi_scale_trans)  # half an inch: under the label
    axes.legend(handles=handles, loc="upper center", bbox_to_anchor=(0.5, 0), bbox_transform=below,
                ncol=len(handles))
    if mirror:
        for x, text, side in ((0.02, "original", "left"), (0.98, "deformed", "right")):
            axes.text(x, 0.985, text, transform=axes.transAxes, ha=side, va="top", **style.REMARK)
    return style.save(figure, folder, spec["file"], vector=False)
