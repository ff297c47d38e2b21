"""Pictures of the verification tests, from the tables that they leave.

    python3 -m solidus_plots.verification build/release/verification docs/verification/images

What is drawn is listed in verification.toml next to this file, one section a picture:

    title, x, y        words with units
    table              the table, where it is not called like the picture
    x_column           its abscissa, where that is not the first column
    curves             [column, label] or [column, label, column of the closed form]; a column without its unit.
                       "other:column" is one of another table, "column where name = value" has only those rows
    exact, exact_label column of one closed form for all curves; what closed forms are called in the legend
    level              [value, label] of a horizontal line
    kind               "lines" (the default); "order": logarithmic axes and the slope of the last two
                       points; "newton": residuals over iterations, and counts (label of their axis) next to them
    panels             [low, high] of the ordinate, of panels one above the other
    log                axes that are logarithmic: "x", "y", "xy"
    powers             { x = n }: the column holds a common logarithm, drawn is ten to the power of n times it; y too
    factor, relative   what values are multiplied by; true: values over the first one of each curve
    legend             a place as matplotlib calls it, "beside" or "below"
    markers, spread    false: lines only; true: points of all curves one after the other, where they lie on each other
    invert, ticks      true: the abscissa falls; its ticks

Closed forms are lines, what Solidus computes is marked; both have the same colour.
"""

import csv
from pathlib import Path
import re
import sys
import tomllib

from matplotlib.lines import Line2D
from matplotlib.ticker import FixedLocator, LogLocator, MaxNLocator, NullFormatter, NullLocator
import numpy as np

from solidus_plots import style
from solidus_plots.style import plt

DPI = 100
SIZE = (5.2, 3.4)  # [in]
MARKERS = "osD^vPX*"
POINTS = 40  # marked on a curve
SPREAD = 60  # on all curves together
KEYS = {"title", "x", "y", "table", "x_column", "curves", "exact", "exact_label", "level", "kind", "counts", "log",
        "powers", "panels", "legend", "markers", "spread", "factor", "relative", "invert", "ticks"}
KINDS = {"lines", "order", "newton"}


def read_pictures(path=Path(__file__).with_suffix(".toml")):
    """Sections of the file; a key that does nothing is a typo."""
    pictures = tomllib.loads(path.read_text())
    for name, picture in pictures.items():
        if unknown := picture.keys() - KEYS:
            raise ValueError(f"{path.name}: [{name}] has an unknown key {min(unknown)}")
        if picture.get("kind", "lines") not in KINDS:
            raise ValueError(f"{path.name}: [{name}] is of an unknown kind {picture['kind']}")
        if missing := {"title", "x", "y"} - picture.keys():
            raise ValueError(f"{path.name}: [{name}] needs {min(missing)}")
    return [{"name": name} | picture for name, picture in pictures.items()]


class Tables:
    """The tables of a folder."""

    def __init__(self, folder):
        self._folder, self._read = folder, {}

    def columns(self, table):
        """Texts of the table by the name of the column, without its unit."""
        if table not in self._read:
            with (self._folder / f"{table}.csv").open(newline="") as file:
                rows = [row for row in csv.reader(file) if row]
            if len(rows) < 3:
                raise ValueError(f"{table}.csv has fewer than two rows")
            headers, *rows = rows
            names = [re.sub(r"\[[^]]*\]$", "", header) for header in headers]
            self._read[table] = {name: np.array(cells) for name, cells in zip(names, zip(*rows))}
        return self._read[table]

    def values(self, table, x, column):
        """Abscissa (the first column where none is named) and values of a column."""
        other, _, rest = column.rpartition(":") if column not in self.columns(table) else ("", "", column)
        columns = self.columns(other or table)
        name, _, rows = rest.partition(" where ")
        chosen = slice(None)
        if rows:
            key, _, value = rows.partition(" = ")
            chosen = columns[key] == value
        return (columns[x or next(iter(columns))][chosen].astype(float), columns[name][chosen].astype(float))


def power(values, axis, picture):
    return 10.0 ** (picture["powers"][axis] * values) if axis in picture.get("powers", {}) else values


def points(picture, tables, column):
    """Abscissa and values of a column as they are drawn."""
    x, y = tables.values(picture.get("table", picture["name"]), picture.get("x_column"), column)
    y = picture.get("factor", 1) * y / (y[0] if picture.get("relative") else 1)
    return power(x, "x", picture), power(y, "y", picture)


def draw_order(axes, picture, tables):
    places = set()
    for index, (column, label) in enumerate(picture["curves"]):
        x, y = points(picture, tables, column)
        y = np.abs(y)
        order = np.log(y[-1] / y[-2]) / np.log(x[-1] / x[-2])
        axes.loglog(x, y, marker=MARKERS[index], markersize=4, linewidth=1.0, color=style.COLOURS[index],
                    label=f"{label}: " + f"{order:.2f}".replace("-", "−"))
        places.update(x)
    show_ticks(axes.xaxis, sorted(places), "{x:.3g}")
    show_parts_of_a_decade(axes)


def show_ticks(axis, places, form="{x:g}"):
    axis.set_major_locator(FixedLocator(places))
    axis.set_major_formatter(form)
    axis.set_minor_locator(NullLocator())


def show_parts_of_a_decade(axes):
    low, high = axes.get_ylim()
    if high < 30 * low:
        axes.yaxis.set_major_locator(LogLocator(subs=(1, 2, 5)))
        axes.yaxis.set_major_formatter("{x:g}")
        axes.yaxis.set_minor_formatter(NullFormatter())


def draw_lines(axes, picture, tables):
    curves, word, closed = picture["curves"], picture.get("exact_label", "closed form"), []
    for index, (column, label, *partner) in enumerate(curves):
        colour = style.COLOURS[index % len(style.COLOURS)]
        if partner:
            axes.plot(*points(picture, tables, partner[0]), color=colour, linewidth=1.0)
            closed = [Line2D([], [], color="0.3" if len(curves) > 1 else colour, linewidth=1.0, label=word)]
        x, y = points(picture, tables, column)
        lined = not partner and not picture.get("spread")
        if picture.get("spread"):
            step = max(1, len(x) // SPREAD)
            marked = (index * step, len(curves) * step)
        else:
            step = max(1, len(x) // POINTS)
            marked = (index * step // len(curves), step)
        axes.plot(x, y, color=colour, linewidth=1.0, linestyle=style.DASHES[index % len(style.DASHES)] if lined else "",
                  marker=MARKERS[index % len(MARKERS)] if picture.get("markers", True) else "", markersize=4,
                  markevery=marked, markerfacecolor="white", markeredgewidth=0.9, label=label)
    if "exact" in picture:
        closed = axes.plot(*points(picture, tables, picture["exact"]), color="black", linewidth=0.9, label=word,
                           zorder=1.9)
    if "level" in picture:
        value, text = picture["level"]
        axes.axhline(value, color="black", linewidth=0.8, linestyle=(0, (4, 3)), label=text or None, zorder=1.5)
    for axis in picture.get("log", ""):
        axes.set(**{f"{axis}scale": "log"})
    if "y" in picture.get("log", ""):
        show_parts_of_a_decade(axes)
    return [entry for entry in closed if entry not in axes.lines]


def draw_newton(axes, picture, tables):
    """Residuals over iterations, and next to them how many contact points changed their status."""
    columns = tables.columns(picture.get("table", picture["name"]))
    iterations, residuals, changes = (values.astype(float) for values in columns.values())
    counts = axes.twinx()
    counts.bar(iterations, changes, width=0.5, color="0.85", zorder=1)
    counts.set_ylabel(picture["counts"])
    counts.yaxis.set_major_locator(MaxNLocator(integer=True))
    counts.grid(False)
    counts.spines["right"].set_visible(True)
    axes.set_zorder(counts.get_zorder() + 1)
    axes.patch.set_visible(False)
    axes.semilogy(iterations, residuals, "o-", markersize=4, linewidth=1.2, color=style.COLOURS[0])
    axes.xaxis.set_major_locator(MaxNLocator(integer=True))


def put_legend(axes, picture, more):
    handles = axes.get_legend_handles_labels()[0] + more
    if len(handles) < 2 and picture.get("kind") != "order":
        return
    place = picture.get("legend", "best")
    where = {"beside": {"loc": "upper left", "bbox_to_anchor": (1.01, 1.0), "borderaxespad": 0},
             "below": {"loc": "upper center", "bbox_to_anchor": (0.5, -0.17), "borderaxespad": 0, "ncols": 2}}
    axes.legend(handles=handles, title="with the slope at the end" if picture.get("kind") == "order" else None,
                title_fontsize=8, **where.get(place, {"loc": place}))


DRAWN = {"lines": draw_lines, "order": draw_order, "newton": draw_newton}


def draw(picture, tables, folder):
    panels = picture.get("panels", [None])
    figure, rows = plt.subplots(len(panels), 1, figsize=(SIZE[0], SIZE[1] * (1 + 0.3 * (len(panels) - 1))), sharex=True,
                                squeeze=False)
    for axes, limits in zip(rows[:, 0], panels):
        more = DRAWN[picture.get("kind", "lines")](axes, picture, tables) or []
        axes.set(ylabel=picture["y"], ylim=limits)
        if "ticks" in picture:
            show_ticks(axes.xaxis, picture["ticks"])
    if picture.get("invert"):
        axes.invert_xaxis()
    axes.set_xlabel(picture["x"])
    rows[0, 0].set_title(picture["title"], loc="left")
    put_legend(axes if picture.get("legend") == "below" else rows[0, 0], picture, more)
    path = folder / f"{picture['name']}.png"
    figure.savefig(path, dpi=DPI)
    plt.close(figure)
    return path


def main():
    if len(sys.argv) != 3:
        raise SystemExit(__doc__)
    tables, folder = Path(sys.argv[1]), Path(sys.argv[2])
    if not tables.is_dir():
        raise SystemExit(f"{tables}: there is no such folder; run the verification tests first")
    folder.mkdir(parents=True, exist_ok=True)
    style.setup()
    problems = []
    tables = Tables(tables)
    for picture in read_pictures():
        try:
            print(draw(picture, tables, folder))
        except (OSError, KeyError, ValueError) as problem:
            problems.append(f"{picture['name']} is not drawn: {problem!r}")
    if problems:
        raise SystemExit("\n".join(problems))


if __name__ == "__main__":
    main()
