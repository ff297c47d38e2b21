"""A figure of panels to one scale, in rows and columns, with a colour bar at the right and a legend below."""

import matplotlib.pyplot as plt
import numpy as np

from solidus_plots.style import REMARK

WIDTH, HEIGHT = 10.0, 9.0  # largest size of a figure [in]
PANEL = 6.5  # largest side of a panel [in]
LEFT, TOP, BOTTOM = 0.75, 0.55, 0.45  # margins [in]
BAR, LEGEND, LINE = 1.1, 0.3, 0.17  # room for them, and for a line of the footer [in]
FINER = 1.6  # pixels of a picture per dot of the figure, each way
ASPECT = 1.4  # width over height that looks best


def badness(columns, rows, width, height):
    """How far a table of panels is from looking best."""
    return abs(np.log(columns * width / (rows * height) / ASPECT))


def wrap(entries, columns, width, height):
    """Rows of entries (None behind the last one), in as many columns as asked for or as look best."""
    if columns is None:
        columns = min(range(1, len(entries) + 1), key=lambda count: 0.3 * (-len(entries) % count)
                      + badness(count, -(-len(entries) // count), width, height))
    entries = entries + [None] * (-len(entries) % columns)
    return [entries[start:start + columns] for start in range(0, len(entries), columns)]


class Sheet:
    """`sizes`: [row][column] width and height of the panels in one unit (None: no panel there). `beside`: room
    between columns, `below`: below each row [in]. `footer`: lines of text at the lower edge."""

    def __init__(self, sizes, title, beside, below, bar=True, legend=(), footer=()):
        columns = range(len(sizes[0]))
        widths = np.array([max(row[c][0] for row in sizes if row[c]) for c in columns])
        heights = np.array([max(size[1] for size in row if size) for row in sizes])
        below = np.append(below[:-1], 0.0)
        right, bottom = BAR if bar else 0.1, BOTTOM + (LEGEND if legend else 0.0) + LINE * len(footer)
        across, along = LEFT + right + beside * (len(widths) - 1), TOP + bottom + below.sum()
        # Inches per unit of the sizes.
        self.scale = min((WIDTH - across) / widths.sum(), (HEIGHT - along) / heights.sum(),
                         PANEL / max(widths.max(), heights.max()))
        widths, heights = self.scale * widths, self.scale * heights
        self._size = (across + widths.sum(), along + heights.sum())
        self.figure = plt.figure(figsize=self._size)
        middle = 0.5 * (LEFT + self._size[0] - right)
        self.figure.suptitle(title, fontsize=10, va="top", x=middle / self._size[0], y=1 - 0.12 / self._size[1])
        if legend:
            self.figure.legend(handles=legend, ncol=len(legend), loc="lower center",
                               bbox_to_anchor=(middle / self._size[0], LINE * len(footer) / self._size[1]))
        for line, text in enumerate(reversed(footer)):
            self.figure.text(0.08 / self._size[0], (0.05 + LINE * line) / self._size[1], text, ha="left",
                             va="bottom", **REMARK)
        lefts = LEFT + np.cumsum(widths + beside) - widths - beside
        tops = self._size[1] - TOP - np.cumsum(heights + below) + heights + below
        self.axes = [[self._panel(lefts[c] + 0.5 * widths[c], tops[r], row[c]) for c in columns]
                     for r, row in enumerate(sizes)]
        if bar:
            height = min(self._size[1] - TOP - bottom, 4.0)
            lower = 0.5 * (self._size[1] - TOP + bottom - height)
            self.bar = self._axes(self._size[0] - right + 0.2, lower, 0.16, height)

    def _panel(self, middle, top, size):
        if size is None:
            return None
        width, height = self.scale * size[0], self.scale * size[1]
        return self._axes(middle - 0.5 * width, top - height, width, height)

    def _axes(self, left, bottom, width, height):
        return self.figure.add_axes([left / self._size[0], bottom / self._size[1], width / self._size[0],
                                     height / self._size[1]])

    def pixels(self, size):
        """Rows and columns of the picture in a panel, finer than the figure's dots so that edges are smooth."""
        dots = FINER * plt.rcParams["savefig.dpi"]
        return tuple(max(1, int(np.ceil(self.scale * side * dots))) for side in size[::-1])


def heading(spec, *remarks):
    """The title of a figure."""
    if spec.get("magnification", 0):
        remarks += (f"displacements × {spec['magnification']:g}",)
    return ", ".join(part for part in (spec.get("title", ""), *remarks) if part)
