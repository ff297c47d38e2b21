"""Reads history.csv and steps.csv: columns by name, with their units.

    table = read_table("results/aluminium_cylinder/default/history.csv")
    table["time[s]"], table["T_center[degC]"], table.unit("T_center[degC]")
"""

import csv
from pathlib import Path

import numpy as np

from solidus_plots.vtu import ResultError


class Table(dict):
    """Header -> numbers; columns of text are left out. A header without a unit in brackets may hold either."""

    @staticmethod
    def name(header):
        return header.partition("[")[0]

    @staticmethod
    def unit(header):
        return header.partition("[")[2].rstrip("]")

    def by_unit(self):
        """Headers grouped by unit, time and mere numbers left out, in the order of the file."""
        groups = {}
        for header in self:
            if self.name(header) != "time" and "[" in header:
                groups.setdefault(self.unit(header), []).append(header)
        return groups

    def until(self, moment):
        """The rows up to a moment [s]; all of them without one."""
        if moment is None:
            return self
        return Table({header: values[self["time[s]"] <= moment] for header, values in self.items()})


def read_table(path, first="time[s]"):
    """`first`: what the first column must be; None: anything."""
    path = Path(path)
    if not path.exists():
        raise ResultError(f"{path}: there is no such file")
    with path.open(newline="") as file:
        rows = list(csv.reader(file))
    if not rows or (first is not None and rows[0][0] != first):
        raise ResultError(f"{path}: not a table of Solidus (its first column must be {first})")
    # A run that is still going on may end in half a row.
    whole = [row for row in rows[1:] if len(row) == len(rows[0])]
    table = Table()
    for index, header in enumerate(rows[0]):
        try:
            table[header] = np.array([float(row[index]) for row in whole])
        except ValueError:
            if "[" in header:
                raise
    return table
