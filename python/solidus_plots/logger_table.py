"""A table of measurements as a logger writes it: header lines, any usual separator, decimal comma, its own clock.

    table = read_logger("furnace.csv")
    table.time, table.columns["TC1"].values, table.columns["TC1"].unit, table.lines

Numbers of lines are kept for messages. Cells that are no reading (empty, "OL", 9999 ...) are NaN. A column is dead where
it says the same all the time, or hardly anything.
"""

from dataclasses import dataclass, field
from datetime import datetime
from pathlib import Path
import re

import numpy as np

from solidus_plots.vtu import ResultError

SEPARATORS = (";", "\t", ",", "|")
NOTHING = {"", "-", "--", "---", "nan", "n/a", "na", "ol", "open", "over", "ovld", "err", "error", "fault", "#nv", "null",
           "inf", "-inf", "+inf", "burnout"}
OPEN_CIRCUIT = 9000.0  # temperatures from here on are what loggers write for a broken wire (9999, 32767)
OVERFLOW = 1e30  # numbers from here on are what instruments write for no reading, whatever they measure (9.9e37)
LEAST_READINGS = 3
SECONDS = {"ms": 1e-3, "s": 1.0, "sec": 1.0, "min": 60.0, "h": 3600.0, "d": 86400.0}
DAY = 86400.0
MOMENTS = ("%Y-%m-%d %H:%M:%S", "%Y-%m-%dT%H:%M:%S", "%d.%m.%Y %H:%M:%S", "%d/%m/%Y %H:%M:%S", "%Y/%m/%d %H:%M:%S")
TEMPERATURES = {"degc": "degC", "°c": "degC", "c": "degC", "celsius": "degC", "grad c": "degC", "k": "K", "kelvin": "K",
                "degf": "degF", "°f": "degF", "f": "degF"}


@dataclass
class Column:
    name: str
    unit: str  # as it is written there; empty: the table does not say
    values: np.ndarray
    dead: str = ""  # why nothing can be learnt from it
    open_from: int | None = None  # line from which on it has no reading


@dataclass
class LoggerTable:
    path: Path
    time: np.ndarray  # [s], of the logger's clock; of a clock with dates or hours since its first line
    lines: np.ndarray  # number of the line of each row
    columns: dict = field(default_factory=dict)
    separator: str = ","
    decimal: str = "."

    def column(self, name):
        """Throws ResultError where there is no such column."""
        if name not in self.columns:
            raise ResultError(f"{self.path}: no column '{name}'; there are {', '.join(self.columns)}")
        return self.columns[name]


def _fail(path, line, text):
    raise ResultError(f"{path}:{line}: {text}" if line else f"{path}: {text}")


def _text(path):
    if not Path(path).exists():
        raise ResultError(f"{path}: there is no such file")
    data = Path(path).read_bytes()
    if b"\0" in data[:4096] and data[:2] not in (b"\xff\xfe", b"\xfe\xff"):
        raise ResultError(f"{path}: this is no table of text")
    for encoding in ("utf-16",) if data[:2] in (b"\xff\xfe", b"\xfe\xff") else ("utf-8-sig", "cp1252", "latin-1"):
        try:
            return data.decode(encoding)
        except UnicodeDecodeError:
            continue
    raise ResultError(f"{path}: neither UTF-8 nor Latin text")


def _number(cell, decimal):
    """A number, NaN where the cell says that there is none; None where it is a text."""
    text = cell.strip().strip('"').strip()
    if text.lower() in NOTHING:
        return np.nan
    if decimal == ",":
        if "." in text:
            return None
        text = text.replace(",", ".")
    try:
        value = float(text)
    except ValueError:
        return None
    return value if abs(value) < OVERFLOW else np.nan


def _moment(cell, decimal):
    """Seconds of a clock or a calendar, None where the cell is neither."""
    text = cell.strip().strip('"').strip()
    text, _, fraction = text.replace(",", ".").partition(".") if text.count(".") != 2 and text.count(".") != 3 else (
        text[:19], "", text[20:] if len(text) > 19 else "")
    share = float(f"0.{fraction}") if fraction.isdigit() else 0.0
    match = re.fullmatch(r"(\d{1,2}):(\d{2})(?::(\d{2}))?", text)
    if match:
        hours, minutes, seconds = (int(part or 0) for part in match.groups())
        return 3600.0 * hours + 60.0 * minutes + seconds + share
    for pattern in MOMENTS:
        try:
            return (datetime.strptime(text, pattern) - datetime(2000, 1, 1)).total_seconds() + share
        except ValueError:
            continue
    return None


def _is_data(cells, decimal):
    """Whether a row is one of readings: two cells, the first a number or a moment, no text behind it."""
    if len(cells) < 2:
        return False
    first = _number(cells[0], decimal)
    if (first is None or np.isnan(first)) and _moment(cells[0], decimal) is None:
        return False
    return any(_number(cell, decimal) is not None for cell in cells[1:])


def _format(lines):
    """Separator and decimal sign with which most rows are readings of the same number of columns."""
    best = (0, 0, ",", ".")
    for separator in SEPARATORS:
        for decimal in (".",) if separator == "," else (".", ","):
            rows = [line.split(separator) for _, line in lines]
            data = [row for row in rows if _is_data(row, decimal)]
            numbers = sum(_number(cell, decimal) is not None for row in data for cell in row)
            best = max(best, (numbers, len(data), separator, decimal), key=lambda found: found[:2])
    return best


def _name_and_unit(cell):
    """"TC1 [°C]" -> ("TC1", "°C")."""
    text = cell.strip().strip('"').strip()
    match = re.fullmatch(r"(.*?)\s*[\[(]([^\])]*)[\])]\s*", text)
    return (match.group(1).strip(), match.group(2).strip()) if match else (text, "")


def _header(lines, first, separator, width):
    """Names and units of the columns, from the lines above the first reading."""
    above = [[cell.strip().strip('"').strip() for cell in line.split(separator)] for _, line in lines[:first]]
    above = [cells for cells in above if len(cells) in (width, width + 1) and sum(map(bool, cells)) > 1]
    units = [""] * width
    known = set(SECONDS) | set(TEMPERATURES)
    is_unit = lambda cell: cell.strip("[]()").lower() in known | {"mm", "n", "kn", "um", "µm", "mpa", "bar", "-", ""}
    if len(above) > 1 and all(is_unit(cell) for cell in above[-1][1:width]):
        units = [cell.strip("[]()") for cell in above.pop()[:width]]
    names = above[-1][:width] if above else []
    names += [f"column {number + 1}" for number in range(len(names), width)]
    both = [_name_and_unit(name) for name in names]
    return [name or f"column {number + 1}" for number, (name, _) in enumerate(both)], [
        unit or of_row for (_, unit), of_row in zip(both, units)]


def _rising(path, time, lines, of_day):
    """Time that rises; a clock that shows hours goes on behind midnight. Throws ResultError with the line."""
    if of_day:
        for row in np.flatnonzero(np.diff(time) < -DAY / 2):
            time[row + 1:] += DAY
    back = np.flatnonzero(np.diff(time) <= 0)
    if len(back) > 0:
        row = back[0] + 1
        _fail(path, lines[row], f"the clock goes from {time[row - 1]:g} s to {time[row]:g} s: time must rise")
    return time


def _judge(column, lines):
    """Finds out whether a column is dead, and from where on its wire is broken."""
    there = np.flatnonzero(~np.isnan(column.values))
    if len(there) < LEAST_READINGS:
        column.dead = f"{len(there)} readings from line {lines[0]} on: an open circuit or no sensor"
    elif np.ptp(column.values[there]) == 0:
        column.dead = f"it says {column.values[there][0]:g} from line {lines[there[0]]} to {lines[there[-1]]}: a dead channel"
    elif there[-1] + 1 < len(lines):
        column.open_from = int(lines[there[-1] + 1])


def read_logger(path, time_column=None, time_unit=None):
    """Throws ResultError with the line for what cannot be read.

    time_column: its name; the first one. time_unit: where the table does not say it.
    """
    path = Path(path)
    lines = [(number, line) for number, line in enumerate(_text(path).splitlines(), 1)
             if line.strip() and not line.lstrip().startswith("#")]
    found, _, separator, decimal = _format(lines)
    if found == 0:
        _fail(path, lines[0][0] if lines else 0, "no line has a time and a reading, separated by ; , or tabs")
    rows = [(number, line.rstrip(separator + " ").split(separator)) for number, line in lines]
    first = next(i for i, (_, cells) in enumerate(rows) if _is_data(cells, decimal))
    width = max(len(cells) for _, cells in rows[first:])
    names, units = _header(lines, first, separator, width)
    for name in names:
        if names.count(name) > 1:
            _fail(path, lines[first][0], f"two columns are called '{name}'")
    if time_column is not None and time_column not in names:
        _fail(path, 0, f"no column '{time_column}'; there are {', '.join(names)}")
    clock = names.index(time_column) if time_column is not None else 0
    times, numbers, kept, of_day = [], [], [], False
    for line, cells in rows[first:]:
        cells = cells + [""] * (width - len(cells))
        moment = _moment(cells[clock], decimal)
        value = moment if moment is not None else _number(cells[clock], decimal)
        if value is None or np.isnan(value):
            _fail(path, line, f"'{cells[clock].strip()}' in the column '{names[clock]}' is no time")
        of_day |= moment is not None and moment < DAY
        times.append((value, moment is not None))
        read = [_number(cell, decimal) for cell in cells]
        numbers.append([np.nan if value is None else value for value in read])
        wrong = [i for i, value in enumerate(read) if value is None and i != clock]
        if wrong:
            _fail(path, line, f"'{cells[wrong[0]].strip()}' in the column '{names[wrong[0]]}' is no number "
                              f"(decimal sign '{decimal}', separator {separator!r})")
        kept.append(line)
    lines_of = np.array(kept)
    time = np.array([value for value, _ in times])
    if times[0][1]:
        time = _rising(path, time, lines_of, of_day)
        time = time - time[0]
    else:
        unit = (time_unit or units[clock] or "").lower()
        if unit not in SECONDS:
            _fail(path, lines[first - 1][0] if first else 0, f"the unit of the time is not known ({unit or 'none is stated'})"
                  f"; calibrate.toml: [logger] time_unit, one of {', '.join(SECONDS)}")
        time = _rising(path, time * SECONDS[unit], lines_of, False)
    values = np.array(numbers, dtype=float)
    table = LoggerTable(path, time, lines_of, separator=separator, decimal=decimal)
    for number, name in enumerate(names):
        if number == clock:
            continue
        if not units[number] or units[number].lower() in TEMPERATURES:  # a force of 9999 N is a reading
            values[np.abs(values[:, number]) >= OPEN_CIRCUIT, number] = np.nan
        column = Column(name, units[number], values[:, number])
        _judge(column, lines_of)
        table.columns[name] = column
    return table


def to_unit(values, unit, wanted, where):
    """Readings in the unit of a probe. Throws ResultError for what is no such unit."""
    unit = TEMPERATURES.get(unit.strip().lower(), unit.strip())
    if unit == wanted:
        return values
    to_kelvin = {"degC": lambda t: t + 273.15, "K": lambda t: t, "degF": lambda t: (t + 459.67) / 1.8}
    from_kelvin = {"degC": lambda t: t - 273.15, "K": lambda t: t, "degF": lambda t: 1.8 * t - 459.67}
    if unit in to_kelvin and wanted in from_kelvin:
        return from_kelvin[wanted](to_kelvin[unit](values))
    scales = [{"m": 1.0, "mm": 1e-3, "um": 1e-6, "µm": 1e-6}, {"N": 1.0, "kN": 1e3}, {"s": 1.0, "min": 60.0, "h": 3600.0},
              {"Pa": 1.0, "MPa": 1e6, "bar": 1e5}]
    for scale in scales:
        if unit in scale and wanted in scale:
            return values * scale[unit] / scale[wanted]
    if not unit:
        raise ResultError(f"{where}: the table has no unit for it; say unit = \"{wanted}\" if that is what it is in")
    raise ResultError(f"{where}: it is in '{unit}', and the probe is in '{wanted}'")
