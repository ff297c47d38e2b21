"""What is written next to bodies in three dimensions: the directions of the axes, and lengths."""

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
    """The lengths of the box between two corners [m], next to its edges that lie outside in the picture."""
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
    """A line with arrows next to an edge, with what it measures."""
    start, end = sorted(ends + offset, key=lambda point: point[0])
    for point in ends:
        axes.plot(*zip(point + 0.25 * offset, point + 1.25 * offset), color=_GREY, linewidth=0.5, clip_on=False)
    axes.annotate("", end, start, annotation_clip=False,
                  arrowprops={"arrowstyle": "<|-|>", "lw": 0.6, "color": _GREY, **_ARROW})
    angle = np.degrees(np.arctan2(end[1] - start[1], end[0] - start[0]))
    axes.text(*(0.5 * (start + end) + 0.55 * offset), text, rotation=angle, rotation_mode="anchor", ha="center",
              va="center", fontsize=8, bbox={"facecolor": "white", "edgecolor": "none", "pad": 0.5})


def mark(axes, places, labels):
    """Points [point][2] with their names next to them, where these cover other points and names least."""
    (left, right), (bottom, top) = axes.get_xlim(), axes.get_ylim()
    point = (right - left) / (72 * axes.figure.get_size_inches()[0] * axes.get_position().width)
    axes.plot(*np.transpose(places), "o", markersize=4.5, color="white", markeredgecolor="black", zorder=8,
              linestyle="none")
    taken = [(x - 3 * point, y - 3 * point, x + 3 * point, y + 3 * point) for x, y in places]
    for (x, y), label in zip(places, labels):
        width, height = 4.6 * point * len(label), 9 * point
        corners = [(x + right * point - (width if right < 0 else 0.0), y + up * point - 0.5 * height)
                   for right, up in _BESIDE]
        boxes = [(low, down, low + width, down + height) for low, down in corners]
        box = min(boxes, key=lambda box: sum(_overlap(box, other) for other in taken)
                  + 10 * (width * height - _overlap(box, (left, bottom, right, top))))
        taken.append(box)
        middle = (0.5 * (box[0] + box[2]), 0.5 * (box[1] + box[3]))
        axes.annotate(label, (x, y), middle, fontsize=7, ha="center", va="center", zorder=9,
                      bbox={"facecolor": "white", "edgecolor": "none", "pad": 0.6, "alpha": 0.8},
                      arrowprops={"arrowstyle": "-", "lw": 0.5, "shrinkA": 0, "shrinkB": 2})


# Where labels may begin next to their points, right and up [pt].
_BESIDE = [(right, up) for reach in (7, 16, 28) for up in (0, reach, -reach) for right in (reach, -reach)]


def _overlap(a, b):
    return max(min(a[2], b[2]) - max(a[0], b[0]), 0.0) * max(min(a[3], b[3]) - max(a[1], b[1]), 0.0)
