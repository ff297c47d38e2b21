"""Colours of a field: its range, steps and lines, and the bar that explains them."""

from matplotlib.cm import ScalarMappable
from matplotlib.colors import BoundaryNorm, ListedColormap, Normalize
from matplotlib.lines import Line2D
from matplotlib.patheffects import Normal, Stroke
import matplotlib.pyplot as plt
import numpy as np

from solidus_plots import fields, style
from solidus_plots.vtu import ResultError

ROUND = [1, 2, 2.5, 5, 10]  # what round values are multiples of
LINE = {"colors": "white", "linewidths": 0.5, "alpha": 0.75}  # of contours
DASHES = ["solid", (0, (4, 2)), (0, (1, 1.5))]  # of the first, second, third level with a name
_CASING = [Stroke(linewidth=2.4, foreground="white"), Normal()]  # so that black lines show on dark colours


def named_line(level):
    return {"colors": "black", "linewidths": 1.1, "linestyles": [level["dash"]], "path_effects": _CASING}


class Paint:
    """`unit` of the values; `shown`: all of them (nan: none), for the range where a picture says none."""

    def __init__(self, spec, unit, shown):
        self._label = style.axis_label(spec.get("quantity", fields.label(spec["field"])), unit)
        shown = shown[np.isfinite(shown)]
        if not shown.size:
            raise ResultError(f"plots.toml: '{spec['file']}': the field has no value above {spec.get('above')}")
        low, high = shown.min(), shown.max()
        self.low, self.high = spec.get("range", (low, high))
        if not self.high > self.low:
            self.high = self.low + 1.0
        usual = fields.colour_map(spec["field"], spec.get("component"), self.low, self.high)
        name = spec.get("colours", usual)
        if name not in plt.colormaps():
            raise ResultError(f"plots.toml: no colours '{name}'; any of matplotlib's: viridis, inferno, "
                              "RdBu_r, ... (_r reverses them)")
        norm, colours = Normalize(self.low, self.high), plt.get_cmap(name)
        if name in ("inferno", "magma"):  # without the black in which edges vanish
            colours = ListedColormap(colours(np.linspace(0.16, 1.0, 256)))
        self._steps = None
        if "bands" in spec:
            round_values = plt.MaxNLocator(spec["bands"], steps=ROUND)
            self._steps = round_values.tick_values(self.low, self.high)
            norm = BoundaryNorm(self._steps, colours.N)
        self._mappable = ScalarMappable(norm, colours)
        self.levels = [{**level, "dash": DASHES[i % len(DASHES)]}  # lines with a name
                       for i, level in enumerate(spec.get("levels", []))]
        lines = spec.get("contours", 0 if self._steps is not None else 10)
        if isinstance(lines, int):  # about so many, at round values
            lines = plt.MaxNLocator(lines).tick_values(self.low, self.high) if lines > 0 else []
        self.contours = [line for line in lines if self.low < line < self.high]
        # What lies beyond a range asked for has the colour of its end; the bar says so with a triangle.
        self._extend = "neither" if "range" not in spec else {
            (False, False): "neither", (True, False): "min", (False, True): "max", (True, True): "both",
        }[low < self.low, high > self.high]

    def __call__(self, values):
        """[value] -> [value][3] red, green, blue from 0 to 1."""
        return self._mappable.to_rgba(np.clip(values, self.low, self.high))[..., :3]

    def bar(self, axes, with_contours):
        """Draws the bar into axes of its own."""
        bar = axes.figure.colorbar(self._mappable, cax=axes, extend=self._extend, extendfrac=0.03)
        bar.set_label(self._label)
        bar.outline.set_visible(False)
        if self._steps is None:
            bar.locator = plt.MaxNLocator(8, steps=ROUND)
            bar.update_ticks()
        else:
            bar.set_ticks(self._steps)
        if with_contours and self.contours:
            axes.hlines(self.contours, 0, 1, **LINE, transform=axes.get_yaxis_transform())
        for level in self.levels:
            if self.low <= level["value"] <= self.high:
                axes.hlines([level["value"]], 0, 1, **named_line(level), transform=axes.get_yaxis_transform())

    def legend(self):
        """Handles of the levels with a name."""
        return [Line2D([], [], color="black", linewidth=1.1, linestyle=level["dash"], label=level["label"])
                for level in self.levels if "label" in level]
