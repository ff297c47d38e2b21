"""What is written beside bodies in three dimensions: the directions of the axes, and lengths."""

import numpy as np

MM = 1e3
_ARROW = {"shrinkA": 0, "shrinkB": 0, "mutation_scale": 7}
_GREY = "#404040"


def triad(figure, camera):
    """The directions of the axes, in the lower left corner of a figure."""
    size = figure.get_size_inches()
    axes = figure.add_axes([0.02 / size[0], 0.02 / size[1], 0.75 / size[0], 0.75 / size[1]])
    axes.set(xlim=(-1.45, 1.45), ylim=(-1.45, 1.45))
    axes.axis("off")
    for direction, name in zip(camera.project(np.eye(3))[:, :2], "xyz"):
        length = np.hypot(*direction)
        if length > 0.12:  # not towards the eye
            arrow = {"arrowstyle": "-|>", "lw": 0.9, "color": "black", **_ARROW}
            axes.annotate("", direction, (0, 0), arrowprops=arrow)
            axes.text(*(direction * (1 + 0.3 / length)), name, ha="center", va="center", fontsize=8)


def dimensions(axes, camera, low, high):
    """The lengths of the box between two corners [m], beside its edges that lie outside in the picture."""
    corners = np.array([[(low, high)[i >> axis & 1][axis] for axis in range(3)] for i in range(8)])
    place = MM * camera.project(corners)[:, :2]
    extent = np.ptp(place, axis=0).max()
    for axis in range(3):
        edges = [(i, i | 1 << axis) for i in range(8) if not i >> axis & 1]
        along = place[edges[0][1]] - place[edges[0][0]]
        if np.hypot(*along) < 0.08 * extent:
            continue
        outwards = np.array([along[1], -along[0]]) / np.hypot(*along)
        if (outwards[0] < 0) if abs(outwards[1]) < 0.35 else (outwards[1] > 0):
            outwards = -outwards  # steep edges at the right, the others below
        edge = max(edges, key=lambda pair: (place[pair[0]] - place[0]) @ outwards)
        _dimension(axes, place[list(edge)], 0.05 * extent * outwards, f"{MM * (high - low)[axis]:.4g} mm")


def _dimension(axes, ends, offset, text):
    """A line with arrows beside an edge, with what it measures."""
    start, end = sorted(ends + offset, key=lambda point: point[0])
    for point in ends:
        axes.plot(*zip(point + 0.25 * offset, point + 1.25 * offset), color=_GREY, linewidth=0.5, clip_on=False)
    axes.annotate("", end, start, annotation_clip=False,
                  arrowprops={"arrowstyle": "<|-|>", "lw": 0.6, "color": _GREY, **_ARROW})
    angle = np.degrees(np.arctan2(end[1] - start[1], end[0] - start[0]))
    axes.text(*(0.5 * (start + end) + 0.55 * offset), text, rotation=angle, rotation_mode="anchor", ha="center",
              va="center", fontsize=8, bbox={"facecolor": "white", "edgecolor": "none", "pad": 0.5})
