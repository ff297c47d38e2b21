"""Columns of a table over one of its columns, with a line for each value of another one: what repeats in
cycles, and profiles along a surface."""

from pathlib import Path

import matplotlib.pyplot as plt
from matplotlib.ticker import MaxNLocator
import numpy as np

from solidus_plots import columns, style
from solidus_plots.history import Table, read_table
from solidus_plots.vtu import ResultError


def _column(table, header, spec):
    if header not in table:
        raise ResultError(f"plots.toml: graphs '{spec['file']}': no column {header} in "
                          f"{spec.get('table', 'history.csv')}; it has {', '.join(table)}")
    return table[header]


def _label(header, spec, quantity=None):
    words = columns.label(header, Path(spec.get("table", "history.csv")).stem)
    return style.axis_label(quantity or (words[0].upper() + words[1:] if len(words) > 1 else words), Table.unit(header))


def _kept(table, spec):
    """The rows at which a column has at least a share of its largest value."""
    if "keep" not in spec:
        return np.ones(len(next(iter(table.values()))), bool)
    values = _column(table, spec["keep"]["column"], spec)
    return values >= spec["keep"].get("share", 0.5) * values.max(initial=0.0)


def _abscissa(table, spec):
    """The column of x; `part` counts within it: rows of number 3 lie between 2 and 3 by their share of the
    largest value of `part`."""
    x = _column(table, spec["x"], spec)
    if "part" not in spec:
        return x
    part = _column(table, spec["part"], spec)
    return x - 1 + part / (part.max(initial=0.0) or 1.0)


def draw(spec, results, folder):
    """One [[graphs]] of plots.toml."""
    table = read_table(results / spec.get("table", "history.csv"), first=None)
    x, kept = _abscissa(table, spec), _kept(table, spec)
    figure, axes = plt.subplots(figsize=(5.6, 3.6))
    lines = [(line["column"], line.get("label", line["column"])) for line in spec["lines"]]
    units = {Table.unit(header) for header, _ in lines}
    if len(units) > 1:
        raise ResultError(f"plots.toml: graphs '{spec['file']}': columns of different units "
                          f"({', '.join(sorted(units))})")
    count = 0
    if "each" in spec:
        of = _column(table, spec["each"], spec)
        values = [v for v in np.unique(of[kept]) if v in spec.get("values", [v])]
        colours = plt.get_cmap("viridis")(np.linspace(0, 0.9, max(len(values), 2)))
        for value, colour in zip(values, colours):
            rows = kept & (of == value)
            for index, (header, _) in enumerate(lines):
                axes.plot(x[rows], _column(table, header, spec)[rows], color=colour,
                          linestyle=style.DASHES[index % len(style.DASHES)],
                          label=f"{Table.name(spec['each'])} {value:g}" if index == 0 else None)
                count += index == 0
    else:
        for index, (header, label) in enumerate(lines):
            axes.plot(x[kept], _column(table, header, spec)[kept], label=label, **style.line_style(index))
        count = len(lines)
    axes.set(xlabel=_label(spec["x"], spec, spec.get("x_quantity")),
             ylabel=_label(lines[0][0], spec, spec.get("quantity")))
    axes.set_title(spec.get("title", ""), loc="left")
    axes.margins(x=0)
    if "part" in spec:
        axes.xaxis.set_major_locator(MaxNLocator(integer=True))
    if spec.get("from_zero", False):
        axes.set_ylim(bottom=0)
    if count > 1:
        axes.legend(**({"loc": "upper left", "bbox_to_anchor": (1.01, 1.0), "borderaxespad": 0}
                       if count > 3 else {"loc": "best"}))
    return style.save(figure, folder, spec["file"], vector=True)
