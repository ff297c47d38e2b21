"""Two runs side by side: python3 -m solidus_plots.compare FOLDER OTHER_FOLDER, as `solidus compare` does.

Tables of what the runs answer, of the columns of history.csv and of the fields at their last common moment, curves over
each other, and pictures of the difference of the fields; docs/guide/compare.md describes them.
"""

import argparse
import csv
from dataclasses import dataclass
from pathlib import Path
import sys

import matplotlib.pyplot as plt
import numpy as np

from solidus_plots import automatic, curves, fields, hot_spots, moments, overview, style
from solidus_plots.answers import answers, read_summary
from solidus_plots.cells import VOLUME
from solidus_plots.history import Table, read_table
from solidus_plots.mapping import Mapper, same_mesh
from solidus_plots.moments import Moments
from solidus_plots.verb import sentence
from solidus_plots.vtu import Grid, ResultError, read_collection, read_fields
from solidus_plots.vtu_writer import write_grid


@dataclass
class Run:
    """One of the two."""

    folder: Path
    name: str
    summary: dict
    history: Table

    @staticmethod
    def read(folder):
        summary = read_summary(folder)
        fields.declare(summary)
        return Run(folder, "", summary, read_table(folder / "history.csv"))

    @property
    def bodies(self):
        return list(self.summary.get("mesh", {}).get("bodies", {}))


def named(one, other):
    """Gives both runs the shortest names that tell them apart: the last parts of their folders."""
    parts = [run.folder.resolve().parts for run in (one, other)]
    length = next((n for n in range(1, max(map(len, parts))) if parts[0][-n:] != parts[1][-n:]), 1)
    one.name, other.name = ("/".join(part[-length:]) for part in parts)
    return one, other


# --- tables -------------------------------------------------------------------------------------------------

def answer_rows(one, other):
    """[name, value, other value, difference]; nothing where a run has no such answer."""
    first, second = answers(one.summary), answers(other.summary)
    for run, found in ((one, first), (other, second)):
        found["end of the run[s]"] = run.summary.get("end_time[s]")
        found["steps[1]"] = run.summary.get("steps")
        found["wall time[s]"] = run.summary.get("seconds", {}).get("run")
    rows = []
    for name in dict.fromkeys([*first, *second]):
        values = first.get(name), second.get(name)
        rows.append([name, *values, None if None in values else values[1] - values[0]])
    return rows


def history_rows(one, other):
    """[column, last value, other last value, largest difference, when [s], root mean square], over the time that both
    runs have; columns of one run alone are named with nothing behind them."""
    times, other_times = one.history["time[s]"], other.history["time[s]"]
    end = min(times[-1], other_times[-1])
    common = np.union1d(times[times <= end], other_times[other_times <= end])
    rows = []
    for header in dict.fromkeys([*one.history, *other.history]):
        if header == "time[s]":
            continue
        if header not in one.history or header not in other.history:
            missing = one.history if header in one.history else other.history
            rows.append([header, *((missing[header][-1], None) if missing is one.history else (None, missing[header][-1])),
                         None, None, None])
            continue
        first = np.interp(common, times, one.history[header])
        second = np.interp(common, other_times, other.history[header])
        difference = second - first
        at = int(np.abs(difference).argmax())
        span = np.gradient(common) if len(common) > 1 else np.ones(1)
        mean = float(np.sqrt((span * difference**2).sum() / span.sum()))
        rows.append([header, first[-1], second[-1], difference[at], common[at], mean])
    return rows


def _cell(value):
    if isinstance(value, str):
        return value.replace("K0.5 s0.5", "sqrt(K s)")  # as the program prints the unit of Niyama's criterion
    return "-" if value is None else f"{value:.5g}"


def as_text(header, rows):
    """Aligned columns: texts to the left, numbers to the right."""
    table = [header, *[[_cell(value) for value in row] for row in rows]]
    widths = [max(len(row[c]) for row in table) for c in range(len(header))]
    return "\n".join("  " + "  ".join(cell.ljust(width) if c == 0 else cell.rjust(width)
                                      for c, (cell, width) in enumerate(zip(row, widths))).rstrip() for row in table)


def write_csv(path, header, rows):
    with path.open("w", newline="") as file:
        writer = csv.writer(file)
        writer.writerow(header)
        writer.writerows([["" if value is None else value for value in row] for row in rows])


# --- fields -------------------------------------------------------------------------------------------------

def last_common(one, other):
    """The grids of both runs at the last moment that both have written; nothing where there is none."""
    files = []
    for run in (one, other):
        collection = run.folder / "fields.pvd"
        files.append(read_collection(collection) if collection.exists() else (np.zeros(0), []))
    (times, names), (other_times, other_names) = files
    for i in range(len(times) - 1, -1, -1):
        near = np.flatnonzero(np.abs(other_times - times[i]) <= 1e-6 * max(1.0, times[i]))
        if near.size:
            return read_fields(names[i]), read_fields(other_names[near[0]])
    return None


def _mapped(one, other, grid, other_grid):
    """How values of the other run come to the nodes and cells of the first: functions, and a word for it."""
    if same_mesh(grid, other_grid):
        return np.asarray, np.asarray, "the meshes are the same"
    pairs = [(one.bodies.index(name), other.bodies.index(name)) for name in one.bodies if name in other.bodies]
    if not pairs:
        raise ResultError("the runs have no body of the same name: their fields cannot be compared")
    centres, body = hot_spots.centres(grid), grid.cell_data["body"]
    at_nodes, at_cells = [], []
    for mine, theirs in pairs:
        cells = body == mine
        their_cells = other_grid.cell_data["body"] == theirs
        if not cells.any() or not their_cells.any():
            continue
        mapper = Mapper(other_grid, their_cells)
        nodes = moments.nodes_of(grid, cells)
        at_nodes.append((nodes, mapper.at(grid.points[nodes])))
        numbers = np.flatnonzero(cells)
        at_cells.append((numbers, mapper.at(centres[numbers]), their_cells))

    def to_nodes(values):
        found = np.full((len(grid.points), *values.shape[1:]), np.nan)
        for nodes, where in at_nodes:
            found[nodes] = where.of(values)
        return found

    def to_cells(values):  # by way of the nodes of the other mesh
        found = np.full((len(centres), *values.shape[1:]), np.nan)
        for numbers, where, cells in at_cells:
            found[numbers] = where.of(moments._at_nodes(other_grid, values, cells))
        return found

    return to_nodes, to_cells, "mapped from the other mesh: linear in its elements, element fields smoothed at its nodes"


def difference(one, other, grid, other_grid):
    """The grid of the first run with the other run's fields less its own, and how they were mapped."""
    to_nodes, to_cells, how = _mapped(one, other, grid, other_grid)
    result = Grid(grid.points, grid.cell_types, grid.offsets, grid.connectivity,
                  {}, {"body": grid.cell_data["body"]}, {}, grid.time)
    for field in (field for field in fields.known() if field.compared):
        name, unit = field.name, field.unit_of_differences
        for kind, mapped in (("point_data", to_nodes), ("cell_data", to_cells)):
            mine, theirs = getattr(grid, kind), getattr(other_grid, kind)
            if name not in mine or name not in theirs:
                continue
            written = fields.unit(name, grid.units[name])
            values = mapped(field.with_value(theirs[name])) - field.with_value(mine[name])
            if values.ndim > 1:
                values = np.linalg.norm(values, axis=1)
            getattr(result, kind)[name] = values if unit == written else style.convert(values, written, unit)
            result.units[name] = unit
    return result, how


def field_rows(grid):
    """[field, unit, largest difference, x, y, z of it [mm], root mean square over nodes or elements]."""
    rows, centres = [], hot_spots.centres(grid)
    for fields, points in ((grid.point_data, grid.points), (grid.cell_data, centres)):
        for name, values in fields.items():
            if name == "body":
                continue
            known = np.flatnonzero(np.isfinite(values))
            if not known.size:
                continue
            at = known[np.abs(values[known]).argmax()]
            rows.append([name, grid.units[name], values[at], *(1e3 * points[at]),
                         float(np.sqrt((values[known] ** 2).mean()))])
    return rows


# --- pictures -----------------------------------------------------------------------------------------------

def draw_history(one, other, folder):
    """Columns that both runs have, one picture per unit: lines of the first, dashes of the other."""
    files, clock = [], curves.Clock(np.concatenate([one.history["time[s]"], other.history["time[s]"]]))
    for unit, headers in one.history.by_unit().items():
        headers = [header for header in headers if header in other.history]
        if not headers:
            continue
        panels = curves._panels(one.history, headers)
        figure, axes = plt.subplots(len(panels), 1, figsize=(6.2, 1.2 + 2.6 * len(panels)), sharex=True, squeeze=False)
        for panel, lines in zip(axes[:, 0], panels):
            for index, members in enumerate(lines):
                colour = style.line_style(index)["color"]
                panel.plot(clock(one.history["time[s]"]), one.history[members[0]], color=colour,
                           label=curves._together(members))
                for header in members:
                    panel.plot(clock(other.history["time[s]"]), other.history[header], color=colour, linestyle="--",
                               linewidth=1.1)
            panel.set_ylabel(style.axis_label(fields.measure(unit), unit))
            panel.margins(x=0)
            panel.legend(**curves.BESIDE)
        axes[0, 0].set_title(f"{one.name} (lines), {other.name} (dashes)", loc="left", fontsize=9)
        axes[-1, 0].set_xlabel(clock.label)
        figure.align_ylabels()
        name = "".join(c if c.isalnum() else "_" for c in unit if c != "1") or "shares"
        files += style.save(figure, folder, f"history_{name}", vector=False)
    return files


def draw_fields(one, other, grid, difference_grid, folder):
    """Pictures of the differences, as the overviews of a run."""
    run = Moments(np.array([grid.time]), [None], one.bodies)
    run._grids[0] = difference_grid
    cast = automatic.castings(run, one.summary, grid)
    if not run.body_mask(grid, cast).any():  # castings that have left the die: what is still there
        cast = [body for body in run.bodies if run.body_mask(grid, [body]).any()]
    mask = run.body_mask(grid, cast)
    kind = automatic.read_case(one.folder).get("analysis", {}).get("kind", "solid")
    case = overview.Case(f"{other.name} less {one.name}", bool(np.isin(grid.cell_types, VOLUME).any()),
                         ("r", "z") if kind == "axisymmetric" else ("x", "y"), hot_spots.hottest(grid, mask))
    files = []
    for name in [field.name for field in fields.known() if field.compared and field.pictured]:
        values = difference_grid.point_data.get(name, difference_grid.cell_data.get(name))
        if values is None:
            continue
        shown = values[moments.nodes_of(grid, mask)] if name in difference_grid.point_data else values[mask]
        largest = np.abs(shown[np.isfinite(shown)]).max(initial=0.0)
        if largest == 0.0:
            continue
        signed = shown[np.isfinite(shown)].min() < 0.0
        spec = {"file": f"difference_{name}", "field": name, "times": ["last"], "bodies": cast, "contours": 0,
                "title": f"Difference of {fields.label(name)}", "quantity": "Difference",
                "range": [-largest if signed else 0.0, largest], "colours": "RdBu_r" if signed else "viridis"}
        files += overview.draw({**spec, "skin_alone": name == "gap"}, run, case, folder)
    return files


def compare(folder, other_folder, output, pictures=True):
    """Writes tables and pictures; prints the tables. The files written."""
    one, other = named(Run.read(folder), Run.read(other_folder))
    output = output or folder / f"compare_{other.name.replace('/', '_')}"
    output.mkdir(parents=True, exist_ok=True)
    style.setup()
    print(f"A  {one.folder}: {one.summary.get('title', '')}, {one.summary.get('outcome', '')}\n"
          f"B  {other.folder}: {other.summary.get('title', '')}, {other.summary.get('outcome', '')}\n")
    rows, header = answer_rows(one, other), ["answer", "A", "B", "B - A"]
    print(as_text(header, rows))
    write_csv(output / "answers.csv", header, rows)
    rows, header = history_rows(one, other), ["column of history.csv", "A at the end of both", "B",
                                              "largest B - A", "at [s]", "rms"]
    print("\n" + as_text(header, rows))
    write_csv(output / "history.csv", header, rows)
    files = [output / "answers.csv", output / "history.csv"]
    grids = last_common(one, other)
    if grids is None:
        print("\n  fields: no moment at which both runs wrote them")
    else:
        changed, how = difference(one, other, *grids)
        rows, header = field_rows(changed), ["field", "unit", "largest B - A", "x [mm]", "y [mm]", "z [mm]", "rms"]
        print(f"\n  fields at {changed.time:g} s, {how}\n" + as_text(header, rows))
        write_csv(output / "fields.csv", header, rows)
        write_grid(output / "difference.vtu", changed)
        files += [output / "fields.csv", output / "difference.vtu"]
        if pictures:
            files += draw_fields(one, other, grids[0], changed, output)
    if pictures:
        files += draw_history(one, other, output)
    return output, files


def main(arguments=None):
    parser = argparse.ArgumentParser(prog="solidus compare", description=__doc__.splitlines()[0])
    parser.add_argument("folder", type=Path, metavar="FOLDER")
    parser.add_argument("other", type=Path, metavar="OTHER_FOLDER")
    parser.add_argument("--output", type=Path)
    parser.add_argument("--no-plots", action="store_true")
    options = parser.parse_args(arguments)
    try:
        output, files = compare(options.folder, options.other, options.output, not options.no_plots)
    except (ResultError, OSError, ValueError) as error:
        print(f"solidus compare: {sentence(error)}", file=sys.stderr)
        return 1
    print(f"\n{len(files)} files in {output}")
    return 0


if __name__ == "__main__":
    sys.exit(main())
