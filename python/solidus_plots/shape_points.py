"""Points of a measured surface, from a CSV file as measuring machines write it: any usual separator, decimal commas, a head or none."""

import re

import numpy as np

from solidus_plots.logger_table import _text
from solidus_plots.vtu import ResultError

LENGTHS = {"m": 1.0, "cm": 1e-2, "mm": 1e-3, "um": 1e-6, "µm": 1e-6, "in": 0.0254, "inch": 0.0254}
AXES = ("x", "y", "z")
FEWEST = 4


def unit_length(unit, where):
    """[m] of a unit. Throws ResultError."""
    if unit.lower() not in LENGTHS:
        raise ResultError(f"{where}: no unit of length '{unit}'; there are {', '.join(LENGTHS)}")
    return LENGTHS[unit.lower()]


def _number(cell, decimal):
    try:
        return float(cell.strip().strip('"').replace(",", ".") if decimal == "," else cell.strip().strip('"'))
    except ValueError:
        return None


def _rows(text, separator, decimal):
    """Lines of at least three numbers: (number of the line, numbers); and the last line before them."""
    rows, head = [], ""
    for number, line in enumerate(text.splitlines(), 1):
        cells = re.split(r"\s+", line.strip()) if separator == " " else line.rstrip().rstrip(separator).split(separator)
        values = [_number(cell, decimal) for cell in cells]
        if len(values) >= 3 and all(value is not None for value in values[:3]):
            rows.append((number, values))
        elif not rows and line.strip() and not line.lstrip().startswith("#"):
            head = line
        elif rows and line.strip():
            return rows, head, number
    return rows, head, None


def read_points(path, unit):
    """[point][3] m. Columns are x, y, z where a head names them, else the first three. `unit` holds where the head names none.
    Throws ResultError with the line."""
    text = _text(path)
    found = max(((separator, decimal, *_rows(text, separator, decimal)) for separator, decimal in
                 ((";", ","), (";", "."), ("\t", ","), ("\t", "."), (",", "."), (" ", ","), (" ", "."))),
                key=lambda one: len(one[2]))
    separator, decimal, rows, head, bad = found
    if bad is not None:
        raise ResultError(f"{path}:{bad}: no three numbers behind lines that have them")
    if len(rows) < FEWEST:
        raise ResultError(f"{path}: {len(rows)} lines with three coordinates; at least {FEWEST} points are needed")
    columns, scale = [0, 1, 2], unit_length(unit, "--unit")
    if head:
        columns, scale = _columns(path, re.split(r"\s+", head.strip()) if separator == " " else head.split(separator), scale)
    width = max(columns) + 1
    for number, values in rows:
        if len(values) < width or any(values[column] is None for column in columns):
            raise ResultError(f"{path}:{number}: a coordinate is missing")
    points = scale * np.array([[values[column] for column in columns] for _, values in rows])
    if not np.isfinite(points).all():
        raise ResultError(f"{path}:{rows[int(np.flatnonzero(~np.isfinite(points).all(axis=1))[0])][0]}: a coordinate is no number")
    return points


def _columns(path, names, scale):
    """Which columns are x, y, z by the head, and the length of its unit: "x[mm]", "X (mm)"."""
    columns = []
    for axis in AXES:
        own = [i for i, name in enumerate(names) if re.fullmatch(rf'"?\s*{axis}\s*([\[(/ ].*)?"?\s*', name, re.IGNORECASE)]
        if not own:
            return [0, 1, 2], scale
        columns.append(own[0])
        unit = re.search(r"[\[(]\s*([^\])]+?)\s*[\])]", names[own[0]])
        if unit:
            scale = unit_length(unit.group(1), path)
    return columns, scale
