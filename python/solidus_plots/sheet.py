"""A figure of panels that are drawn to one scale, in rows and columns, with a colour bar at the right and a legend below."""

import matplotlib.pyplot as plt
import numpy as np

WIDTH, HEIGHT = 10.0, 9.0  # largest size of a figure [in]
PANEL = 6.5  # largest side of a panel [in]
FINER = 1.6  # pixels of a picture per dot of the figure, each way
WANTED_ASPECT = 1.5  # width over height of a figure


def arrange(count, columns, width, height):
    """Panels of which `columns` belong side by side: how many columns look best when they may be wrapped."""
    return min(range(1, count + 1), key=lambda n: abs(np.log(n * width / (-(-count // n) * height) / WANTED_ASPECT))
               + 0.3 * (-count % n)) if columns is None else columns


class Sheet:
    """`sizes`: [row][column] width and height of the panels in one unit (None: no panel there). `gaps`: [in] between
    columns, and below each row."""

    def __init__(self, sizes, title, gaps, bar=True, legend=()):
        shape, (between, below) = (len(sizes), len(sizes[0])), gaps
        below = below[:-1]
        widths = [max(row[c][0] for row in sizes if row[c]) for c in range(shape[1])]
        heights = [max(size[1] for size in row if size) for row in sizes]
        left, right, top, bottom = 0.75, 1.1 if bar else 0.1, 0.55, 0.45 if not legend else 0.75
        across = WIDTH - left - right - between * (shape[1] - 1)
        along = HEIGHT - top - bottom - sum(below)
        self.scale = min(across / sum(widths), along / sum(heights), PANEL / max(*widths, *heights))  # [in] per unit
        size = (left + right + between * (shape[1] - 1) + self.scale * sum(widths),
                top + bottom + sum(below) + self.scale * sum(heights))
        self.figure = plt.figure(figsize=size)
        if legend:
            self.figure.legend(handles=legend, ncol=len(legend), loc="lower center",
                               bbox_to_anchor=(0.5 * (left + size[0] - right) / size[0], 0.0))
        self.figure.suptitle(title, fontsize=10, x=0.5 * (left + size[0] - right) / size[0], y=1 - 0.12 / size[1],
                             va="top")
        self.axes = [[None] * shape[1] for _ in sizes]
        y = size[1] - top
        for r, row in enumerate(sizes):
            x = left
            for c, panel in enumerate(row):
                if panel:
                    w, h = self.scale * panel[0], self.scale * panel[1]
                    box = (x + 0.5 * (self.scale * widths[c] - w), y - h, w, h)
                    self.axes[r][c] = self.figure.add_axes([box[0] / size[0], box[1] / size[1], w / size[0],
                                                            h / size[1]])
                x += self.scale * widths[c] + between
            y -= self.scale * heights[r] + (below[r] if r < len(below) else 0.0)
        if bar:
            height = min(size[1] - top - bottom, 4.0)
            middle = 0.5 * (size[1] - top + bottom)
            self.bar = self.figure.add_axes([(size[0] - right + 0.2) / size[0], (middle - 0.5 * height) / size[1],
                                             0.16 / size[0], height / size[1]])

    def pixels(self, size):
        """Rows and columns of the picture of a panel, finer than the figure's dots so that edges are smooth."""
        dots = FINER * plt.rcParams["savefig.dpi"]
        return tuple(max(1, int(np.ceil(self.scale * side * dots))) for side in size[::-1])
