"""Curves against time: one picture per unit of history.csv, the pictures a case asks for, and the steps."""

import matplotlib.pyplot as plt
import numpy as np

from solidus_plots import style
from solidus_plots.history import Table
from solidus_plots.vtu import ResultError


def _axes(title, y_label):
    figure, axes = plt.subplots(figsize=(5.6, 3.6))
    axes.set(xlabel="Time [s]", ylabel=y_label)
    axes.set_title(title, loc="left")
    return figure, axes


def _legend(axes, count):
    if count > 5:
        axes.legend(loc="upper left", bbox_to_anchor=(1.01, 1.0), borderaxespad=0)
    else:
        axes.legend(loc="best")


def _by_size(history, headers):
    """Columns that would be flat lines beside the largest ones get a panel of their own."""
    peak = {header: np.abs(history[header]).max(initial=0.0) for header in headers}
    small = [header for header in headers if 0 < peak[header] < 0.03 * max(peak.values())]
    large = [header for header in headers if header not in small]
    return [large, small] if small else [large]


def unit_groups(history, folder):
    """Every column of history.csv, one picture per unit."""
    files = []
    for unit, headers in history.by_unit().items():
        quantity = style.QUANTITY.get(unit, "Value")
        panels = _by_size(history, headers)
        figure, axes = plt.subplots(len(panels), 1, figsize=(5.6, 1.2 + 2.4 * len(panels)), sharex=True,
                                    squeeze=False)
        for panel, members in zip(axes[:, 0], panels):
            for header in members:
                panel.plot(history["time[s]"], history[header], label=Table.name(header).replace("_", " "),
                           **style.line_style(headers.index(header)))
            panel.set_ylabel(style.axis_label(quantity, unit))
            panel.margins(x=0)
            _legend(panel, len(headers))
        axes[0, 0].set_title(f"History: {quantity.lower()}", loc="left")
        axes[-1, 0].set_xlabel("Time [s]")
        figure.align_ylabels()
        name = "".join(c if c.isalnum() else "_" for c in unit if c != "1") or "shares"
        files += style.save(figure, folder, f"history_{name}", vector=True)
    return files


def chosen(spec, history, others, folder):
    """One [[curves]] of plots.toml. `others` are the histories of variants to lay over, by their name."""
    headers = [line["column"] for line in spec["lines"]]
    missing = [header for header in headers if header not in history]
    if missing:
        raise ResultError(f"plots.toml: curves '{spec['file']}': no column {', '.join(missing)} in "
                          f"history.csv; "
                          f"it has {', '.join(history)}")
    units = {Table.unit(header) for header in headers}
    if len(units) > 1:
        raise ResultError(f"plots.toml: curves '{spec['file']}': columns of different units "
                          f"({', '.join(sorted(units))})")
    label = style.axis_label(spec.get("quantity", "Value"), units.pop())
    figure, axes = _axes(spec.get("title", ""), label)
    for index, line in enumerate(spec["lines"]):
        look = style.line_style(line.get("colour", index))
        label = line.get("label", line["column"])
        axes.plot(history["time[s]"], history[line["column"]], label=label, **look)
        for dash, (name, other) in enumerate(others.items()):
            if line["column"] in other:
                axes.plot(other["time[s]"], other[line["column"]], color=look["color"], linewidth=1.0,
                          linestyle=style.DASHES[1 + dash % 3], label=f"{label}, {name}")
    axes.margins(x=0)
    for mark in spec.get("levels", []):
        axes.axhline(mark["value"], color="#7f7f7f", linewidth=0.8, linestyle=(0, (5, 3)), zorder=0)
        axes.annotate(mark["label"], (1, mark["value"]), xycoords=("axes fraction", "data"), xytext=(0, 2),
                      textcoords="offset points", ha="right", va="bottom", **style.REMARK)
    for mark in spec.get("moments", []):
        axes.axvline(mark["value"], color="#7f7f7f", linewidth=0.8, linestyle=(0, (5, 3)), zorder=0)
        axes.annotate(mark["label"], (mark["value"], 1), xycoords=("data", "axes fraction"), xytext=(3, -2),
                      textcoords="offset points", ha="left", va="top", **style.REMARK)
    if len(spec["lines"]) > 1 or others:
        _legend(axes, len(spec["lines"]) * (1 + len(others)))
    return style.save(figure, folder, spec["file"], vector=True)


def steps(table, folder):
    """The size of the steps and the work they took."""
    phases = [(name, f"{name}_iterations[1]") for name in ("heat", "mechanics")]
    phases = [(name, header) for name, header in phases if table[header].any()]
    figure, (sizes, work) = plt.subplots(2, 1, figsize=(5.6, 4.4), sharex=True)
    sizes.step(table["time[s]"], table["dt[s]"], where="pre", color=style.COLOURS[0])
    sizes.set(ylabel="Step [s]")
    sizes.set_title("Steps", loc="left")
    sizes.set_ylim(bottom=0)
    cut = table["rejected[1]"] > 0
    if cut.any():
        sizes.plot(table["time[s]"][cut], table["dt[s]"][cut], "v", color=style.COLOURS[1], markersize=5,
                   label="after a cut")
        sizes.legend()
    for index, (name, header) in enumerate(phases):
        work.plot(table["time[s]"], table[header], marker=".", markersize=3, label=name,
                  **style.line_style(index))
    work.set(ylabel="Newton iterations", xlabel="Time [s]")
    work.set_ylim(bottom=0)
    work.set_xlim(0, table["time[s]"].max(initial=0.0) or None)
    if phases:
        work.legend()
    figure.align_ylabels()
    return style.save(figure, folder, "steps", vector=True)
