"""Curves against time: one picture per unit of history.csv, the pictures a case asks for, and the steps."""

import matplotlib.pyplot as plt
import numpy as np

from solidus_plots import columns, fields, style
from solidus_plots.history import Table
from solidus_plots.vtu import ResultError


class Clock:
    """The unit in which the times of a run are readable."""

    def __init__(self, seconds):
        last = seconds.max(initial=0.0)
        self.unit, self.factor = (("s", 1.0) if last > 0.5 or last <= 0 else ("ms", 1e3) if last > 1e-3 else
                                  ("µs", 1e6))
        self.label = f"Time [{self.unit}]"

    def __call__(self, seconds):
        return self.factor * seconds


def _axes(title, clock, y_label):
    figure, axes = plt.subplots(figsize=(5.6, 3.6))
    axes.set(xlabel=clock.label, ylabel=y_label)
    axes.set_title(title, loc="left")
    return figure, axes


# A legend too long to fit among the lines.
BESIDE = {"loc": "upper left", "bbox_to_anchor": (1.01, 1.0), "borderaxespad": 0}


MOST_LINES = 7  # in a panel
SMALL = 0.03  # share of the largest line of a panel below which another one would be flat
SAME = 0.004  # share of a panel's range within which lines hide each other


def _panels(history, headers):
    """Columns of a unit in panels in which none hides: lists of columns that are of one size, each a list of those
    that are the same line."""
    peak = {header: np.abs(history[header]).max(initial=0.0) for header in headers}
    left, panels = list(headers), []
    while left:
        largest = max(peak[header] for header in left)
        taken = [header for header in left if peak[header] >= SMALL * largest or peak[header] == 0.0]
        left = [header for header in left if header not in taken]
        values = np.concatenate([history[header] for header in taken])
        reach, lines = SAME * (np.ptp(values) if values.size else 0.0), []
        for header in taken:
            same = next((line for line in lines
                         if np.abs(history[line[0]] - history[header]).max(initial=0.0) <= reach), None)
            if same is not None:
                same.append(header)
            else:
                lines.append([header])
        count = -(-len(lines) // MOST_LINES)  # panels of about as many lines each
        size = -(-len(lines) // count)
        panels += [lines[start:start + size] for start in range(0, len(lines), size)]
    return panels


def _together(headers):
    """The name of a line that stands for several columns."""
    names = [columns.label(header) for header in headers]
    return " = ".join(names[:3]) + (f" = … ({len(names)})" if len(names) > 3 else "")


def _give_height(axes):
    """Draws flat what changes by less than a hundred-thousandth of its size: a mould that is warmer by 1e-7 K."""
    low, high = axes.get_ylim()
    size = max(abs(low), abs(high))
    if high - low < 1e-5 * size:
        axes.set_ylim(low - 0.05 * size, high + 0.05 * size)


def unit_groups(history, folder):
    """Every column of history.csv, one picture per unit; none of a unit of which nothing ever happens, as of the
    forces of contact where heat alone is computed."""
    files, clock = [], Clock(history["time[s]"])
    for unit, headers in history.by_unit().items():
        if not any(history[header].any() for header in headers):
            continue
        quantity = fields.measure(unit)
        panels = _panels(history, headers)
        figure, axes = plt.subplots(len(panels), 1, figsize=(5.6, 1.2 + 2.4 * len(panels)), sharex=True,
                                    squeeze=False)
        for panel, lines in zip(axes[:, 0], panels):
            for index, members in enumerate(lines):
                panel.plot(clock(history["time[s]"]), history[members[0]], label=_together(members),
                           **style.line_style(index))
            _give_height(panel)
            panel.set_ylabel(style.axis_label(quantity, unit))
            panel.margins(x=0)
            panel.legend(**BESIDE)
        axes[0, 0].set_title(f"History: {quantity.lower()}", loc="left")
        axes[-1, 0].set_xlabel(clock.label)
        figure.align_ylabels()
        name = "".join(c if c.isalnum() else "_" for c in unit if c != "1") or "shares"
        files += style.save(figure, folder, f"history_{name}", vector=True)
    return files


def _lay_over(axes, spec, clock, others):
    """The lines of other variants, thin over the pale ones of this variant, which set the limits of the axes:
    what leaves their height by more than half is cut off, a run that blew up for one."""
    left, right = axes.get_xlim()
    own = np.concatenate([line.get_ydata() for line in axes.get_lines()])
    low, high = own.min(), own.max()
    for line in axes.get_lines():
        line.set(linewidth=3.5, alpha=0.4)
    key = [plt.Line2D([], [], color="#404040", linewidth=3.5, alpha=0.4, label=spec.get("name", "this run"))]
    for dash, (name, other) in enumerate(others.items()):
        look = {"linewidth": 1.2, "linestyle": style.DASHES[1 + dash % 3]}
        for index, line in enumerate(spec["lines"]):
            if line["column"] in other:
                axes.plot(clock(other["time[s]"]), other[line["column"]], **look,
                          color=style.line_style(line.get("colour", index))["color"])
        key.append(plt.Line2D([], [], color="#404040", label=name, **look))
    bottom, top = axes.get_ylim()
    room = 0.5 * (high - low) or 1.0
    axes.set_xlim(left, right)
    axes.set_ylim(max(bottom, low - room), min(top, high + room))
    return key


def chosen(spec, history, others, folder):
    """One [[curves]] of plots.toml. `others` are the histories of variants to lay over, by their label."""
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
    history = history.until(spec.get("until"))
    others = {name: other.until(spec.get("until")) for name, other in others.items()}
    clock = Clock(history["time[s]"])
    label = style.axis_label(spec.get("quantity", "Value"), units.pop())
    figure, axes = _axes(spec.get("title", ""), clock, label)
    for index, line in enumerate(spec["lines"]):
        axes.plot(clock(history["time[s]"]), history[line["column"]], label=line.get("label", line["column"]),
                  **style.line_style(line.get("colour", index)))
    axes.margins(x=0)
    key = _lay_over(axes, spec, clock, others) if others else []
    for mark in spec.get("levels", []):
        axes.axhline(mark["value"], color="#7f7f7f", linewidth=0.8, linestyle=(0, (5, 3)), zorder=0)
        axes.annotate(mark["label"], (1, mark["value"]), xycoords=("axes fraction", "data"), xytext=(0, 2),
                      textcoords="offset points", ha="right", va="bottom", **style.REMARK)
    for mark in spec.get("moments", []):
        moment = clock(mark["value"])
        axes.axvline(moment, color="#7f7f7f", linewidth=0.8, linestyle=(0, (5, 3)), zorder=0)
        axes.annotate(mark["label"], (moment, 1), xycoords=("data", "axes fraction"), xytext=(3, -2),
                      textcoords="offset points", ha="left", va="top", **style.REMARK)
    if len(spec["lines"]) > 1 or others:
        handles = axes.get_legend_handles_labels()[0] + key
        axes.legend(handles=handles, **(BESIDE if others or len(handles) > 5 else {"loc": "best"}))
    return style.save(figure, folder, spec["file"], vector=True)


def steps(table, folder):
    """The size of the steps and the work they took."""
    phases = [(name, f"{name}_iterations[1]") for name in ("heat", "mechanics")]
    phases = [(name, header) for name, header in phases if table[header].any()]
    clock = Clock(table["time[s]"])
    time = clock(table["time[s]"])
    figure, (sizes, work) = plt.subplots(2, 1, figsize=(5.6, 4.4), sharex=True)
    sizes.step(time, clock(table["dt[s]"]), where="pre", color=style.COLOURS[0])
    sizes.set(ylabel=f"Step [{clock.unit}]")
    sizes.set_title("Steps", loc="left")
    sizes.set_ylim(bottom=0)
    tries = (("rejected[1]", "v", "after a rejected try"), ("shortened[1]", "1", "after a try shortened by its heat"))
    for index, (header, marker, label) in enumerate(tries, 1):
        if header not in table:  # shortened: tables of older programs
            continue
        cut = table[header] > 0
        if cut.any():
            sizes.plot(time[cut], clock(table["dt[s]"])[cut], marker, color=style.COLOURS[index], markersize=5, label=label)
            sizes.legend(loc="best")  # named, so that matplotlib does not warn a slow machine that it takes long
    for index, (name, header) in enumerate(phases):
        work.plot(time, table[header], marker=".", markersize=3, label=name,
                  **style.line_style(index))
    work.set(ylabel="Newton iterations", xlabel=clock.label)
    work.set_ylim(bottom=0)
    work.set_xlim(0, time.max(initial=0.0) or None)
    if phases:
        work.legend(loc="best")
    figure.align_ylabels()
    return style.save(figure, folder, "steps", vector=True)
