"""Pictures of a material point (solidus point): an overview of every curve, and what the point file asks for.

Measured points are drawn as circles in the colour of their curve. docs/guide/point.md describes [[picture]].
"""

import matplotlib.pyplot as plt
import numpy as np

from solidus_plots import fields, style
from solidus_plots.history import Table, read_table
from solidus_plots.vtu import ResultError

COMPONENTS = ("xx", "yy", "zz", "xy", "yz", "xz")


class Curve:
    def __init__(self, folder, entry, index):
        self.label = entry["label"]
        self.table = read_table(folder / entry["file"])
        self.measured = read_table(folder / entry["measured"], first=None) if "measured" in entry else None
        self.look = style.line_style(index)

    def column(self, name):
        return column_of(self.table, name)


def header_of(table, name):
    for header in table:
        if Table.name(header) == name:
            return header
    raise ResultError(f"no column {name} in the history")


def column_of(table, name):
    """As it is drawn: strains in percent."""
    values = table[header_of(table, name)]
    return 100 * values if "strain" in name else values


def words(table, name):
    """Axis label: stress_xx -> Stress xx [MPa]. A column with the name of a field has its label."""
    stem, _, component = name.rpartition("_")
    text = f"{fields.label(stem)} {component}" if component in COMPONENTS else fields.label(name)
    return style.axis_label(text, "%" if "strain" in name else Table.unit(header_of(table, name)))


def loaded_component(curves):
    """The component that carries most stress."""
    return max(COMPONENTS, key=lambda c: max(np.ptp(curve.column(f"stress_{c}")) for curve in curves))


def varies(curves, name, by):
    return any(np.ptp(curve.column(name)) > by for curve in curves)


def over_decades(curves):
    """Times read better on a logarithmic axis: steps that grow far beyond the first ones, or curves of very
    different duration."""
    steps = [np.diff(curve.column("time")) for curve in curves]
    ends = [curve.column("time")[-1] for curve in curves]
    return (any(step.size > 1 and step.max() > 1e3 * step.min() for step in steps)
            or max(ends) > 30 * min(ends))


def draw_lines(axes, curves, x, names, logarithmic=False):
    if logarithmic:
        axes.set_xscale("log")
    for curve in curves:
        shown = curve.column(x) > 0 if logarithmic else slice(None)
        for index, y in enumerate(names):
            look = dict(curve.look)
            if len(names) > 1:
                look["linestyle"] = style.DASHES[index % len(style.DASHES)]
            axes.plot(curve.column(x)[shown], curve.column(y)[shown], linewidth=1.3,
                      label=curve.label if len(names) == 1 else f"{curve.label}, {y.replace('_', ' ')}",
                      **look)
            measured = curve.measured
            if measured and all(any(Table.name(h) == n for h in measured) for n in (x, y)):
                axes.plot(column_of(measured, x), column_of(measured, y), "o", markersize=4,
                          markerfacecolor="white", markeredgewidth=1.2, color=look["color"], zorder=4,
                          label=f"{curve.label}, measured")
    table = curves[0].table
    axes.margins(x=0.02)
    if x == "temperature" and all(curve.column(x)[-1] < curve.column(x)[0] for curve in curves):
        axes.invert_xaxis()  # cooling runs from left to right
    axes.set_xlabel(words(table, x))
    axes.set_ylabel(words(table, names[0]))


def legend(figure, axes, columns):
    """Below the picture, where it hides nothing."""
    handles, labels = axes.get_legend_handles_labels()
    if len(labels) > 1:
        figure.legend(handles, labels, loc="upper center", bbox_to_anchor=(0.5, 0.0),
                      ncols=min(columns, len(labels)))


def overview(curves, title, folder):
    component = loaded_component(curves)
    stress, strain = f"stress_{component}", f"strain_{component}"
    hot = varies(curves, "temperature", 0.5)
    last = "temperature" if hot else "equivalent_plastic_strain"
    figure, panels = plt.subplots(2, 2, figsize=(8.4, 6.2))
    strained, decades = varies(curves, strain, 1e-12), over_decades(curves)
    draw_lines(panels[0, 0], curves, strain if strained else "temperature", [stress])
    draw_lines(panels[0, 1], curves, "time", [stress], decades)
    draw_lines(panels[1, 0], curves, "time", [last], decades)
    draw_lines(panels[1, 1], curves, "time", [strain if strained else "equivalent_plastic_strain"], decades)
    figure.suptitle(title, x=0.01, ha="left", fontsize=11)
    figure.tight_layout()
    legend(figure, panels[0, 0], 3)
    return style.save(figure, folder, "overview", vector=True)


def picture(spec, curves, folder):
    figure, axes = plt.subplots(figsize=(5.6, 3.8))
    draw_lines(axes, curves, spec["x"], spec["y"], "x" in spec["logarithmic"])
    if "y" in spec["logarithmic"]:
        axes.set_yscale("log")
    axes.set_title(spec["title"], loc="left")
    figure.tight_layout()
    legend(figure, axes, 2 if any(len(curve.label) > 12 for curve in curves) else 4)
    return style.save(figure, folder, spec["file"], vector=True)


def draw(results, summary):
    """Draws everything; returns the files written and what could not be drawn."""
    folder = results / "plots"
    folder.mkdir(exist_ok=True)
    curves = [Curve(results, entry, index) for index, entry in enumerate(summary["curves"])]
    files = overview(curves, summary["title"], folder)
    for spec in summary["pictures"]:
        files += picture(spec, curves, folder)
    return files, [f"{entry['name']} is not whole: {entry['reason']}" for entry in summary["curves"]
                   if not entry["finished"]]
