"""Measured points and computed curves in one picture, with the deviation of each curve: [[measured]] of plots.toml.

The deviation is the root mean square over the points of a curve, computed minus measured, at the abscissa of the
point plus a shift that all curves share. `python3 -m solidus_plots.measured RESULTS_DIR` prints the shift that
makes the mean square over all points least, and the deviations that every curve would have with one of its own.
"""

import argparse
import csv
import json
from pathlib import Path
import sys

import numpy as np

from solidus_plots import style
from solidus_plots.history import Table, read_table
from solidus_plots.plots_file import find_spec, read_spec
from solidus_plots.style import plt
from solidus_plots.verb import sentence
from solidus_plots.vtu import ResultError

MARKERS = "osD^vPX*"


def read_points(path, x, y, each):
    """Points by the text in the column `each`: name -> (abscissa, value)."""
    if not path.exists():
        raise ResultError(f"{path}: there is no such file")
    with path.open(newline="") as file:
        rows = list(csv.reader(line for line in file if not line.startswith("#")))
    for header in (x, y, each):
        if header not in rows[0]:
            raise ResultError(f"{path}: no column {header}; it has {', '.join(rows[0])}")
    columns = [rows[0].index(header) for header in (each, x, y)]
    points = {}
    for row in rows[1:]:
        name, at, value = (row[column] for column in columns)
        points.setdefault(name, []).append((float(at), float(value)))
    return {name: np.array(list_).T for name, list_ in points.items()}


class Comparison:
    """One [[measured]]: what was measured, what is computed."""

    def __init__(self, spec, results, spec_file):
        history = read_table(results / "history.csv")
        missing = [line["column"] for line in spec["lines"] if line["column"] not in history]
        if missing:
            raise ResultError(f"plots.toml: measured '{spec['file']}': no column {missing[0]} in history.csv")
        travel = spec.get("travel")
        at = history["time[s]"] if travel is None else travel["from"] + travel["speed"] * history["time[s]"]
        order = np.argsort(at, kind="stable")
        self.at = at[order]
        self.y = spec["lines"][0]["column"]
        quantity = f"{spec.get('values', 'temperature')}[{Table.unit(self.y)}]"
        points = read_points(spec_file.parent / spec["table"], spec["x"], quantity, spec["each"])
        self.lines = []
        for line in spec["lines"]:
            if line["of"] not in points:
                raise ResultError(f"plots.toml: measured '{spec['file']}': no points of '{line['of']}' in "
                                  f"{spec['table']}; there are {', '.join(points)}")
            self.lines.append((line.get("label", line["of"]), points[line["of"]], history[line["column"]][order]))

    def deviation(self, line, shift):
        """Root mean square of computed − measured of a line."""
        _, (x, value), computed = line
        return float(np.sqrt(np.mean((np.interp(x + shift, self.at, computed) - value) ** 2)))

    def total(self, shift):
        squares = sum(len(line[1][0]) * self.deviation(line, shift) ** 2 for line in self.lines)
        return float(np.sqrt(squares / sum(len(line[1][0]) for line in self.lines)))

    def best_shift(self, reach=60.0, step=0.25, of=None):
        shifts = np.arange(-reach, reach + step, step)
        return float(min(shifts, key=self.total if of is None else lambda s: self.deviation(of, s)))


def draw(spec, results, spec_file, folder):
    """One [[measured]] of plots.toml."""
    comparison = Comparison(spec, results, spec_file)
    shift = spec.get("shift", 0.0)
    figure, axes = plt.subplots(figsize=(6.4, 4.2))
    low = min(line[1][0].min() for line in comparison.lines) + shift
    high = max(line[1][0].max() for line in comparison.lines) + shift
    margin = 0.03 * (high - low)
    shown = (comparison.at >= low - margin) & (comparison.at <= high + margin)
    for index, line in enumerate(comparison.lines):
        label, (x, value), computed = line
        colour = style.COLOURS[index % len(style.COLOURS)]
        axes.plot(comparison.at[shown], computed[shown], color=colour, linewidth=1.1,
                  label=f"{label}: {comparison.deviation(line, shift):.1f}")
        axes.plot(x + shift, value, linestyle="", marker=MARKERS[index % len(MARKERS)], markersize=3.2,
                  markerfacecolor="none", markeredgewidth=0.8, color=colour)
    unit = Table.unit(comparison.y)
    axes.set(xlabel=style.axis_label(spec.get("x_quantity", Table.name(spec["x"])), Table.unit(spec["x"])),
             ylabel=style.axis_label(spec.get("quantity", ""), unit))
    axes.set_title(spec.get("title", ""), loc="left")
    axes.set_xlim(low - margin, high + margin)
    axes.legend(title=f"computed (lines), measured: rms [{'K' if unit == 'degC' else unit}]", loc="best")
    return style.save(figure, folder, spec["file"], vector=True)


def main(arguments=None):
    parser = argparse.ArgumentParser(prog="solidus_plots.measured", description=__doc__.splitlines()[0])
    parser.add_argument("results", type=Path, metavar="RESULTS_DIR")
    parser.add_argument("--plots", type=Path, metavar="FILE", help="a plots.toml other than the case's own")
    options = parser.parse_args(arguments)
    try:
        spec_file = options.plots
        if spec_file is None:
            summary = json.loads((options.results / "summary.json").read_text())
            spec_file = find_spec(options.results, summary)
        for spec in read_spec(spec_file)[0].get("measured", []):
            comparison = Comparison(spec, options.results, spec_file)
            best, used = comparison.best_shift(), spec.get("shift", 0.0)
            print(f"{spec['file']}: shift {used:g}: {comparison.total(used):.2f} over all points; "
                  f"least with {best:g}: {comparison.total(best):.2f}")
            for line in comparison.lines:
                own = comparison.best_shift(of=line)
                print(f"  {line[0]}: {comparison.deviation(line, used):.2f}; with {best:g} "
                      f"{comparison.deviation(line, best):.2f}; own shift {own:g}: {comparison.deviation(line, own):.2f}")
    except (ResultError, OSError) as error:
        print(f"solidus_plots.measured: {sentence(error)}", file=sys.stderr)
        return 1
    return 0


if __name__ == "__main__":
    sys.exit(main())
