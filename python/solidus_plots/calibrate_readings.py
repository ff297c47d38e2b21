"""What was measured, as the fit takes it: readings of each thermocouple at times of the case, with their noise."""

import csv
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from solidus_plots.history import Table
from solidus_plots.logger_table import LoggerTable, Column, read_logger, to_unit
from solidus_plots.vtu import ResultError

CLOSE = 1e-9  # of the time of the run: readings so close to its end are at it


@dataclass
class Readings:
    """Of one observation. Without `time`: one number at the end of the run."""

    name: str  # of the column
    header: str  # of history.csv
    lag: float  # [s]
    noise: float | None  # standard deviation, in the unit of the probe
    time: np.ndarray  # [s] of the case
    values: np.ndarray  # in the unit of the probe
    lines: np.ndarray

    @property
    def at_end(self):
        return len(self.time) == 0


def _long_tables(path, logger):
    """Column by column the readings of a table in which each row names its thermocouple; `travel` turns a place into a
    time, of thermocouples that move with a billet."""
    rows = [(number, line) for number, line in enumerate(path.read_text().splitlines(), 1) if not line.startswith("#")]
    table = [(number, next(csv.reader([line]))) for number, line in rows if line.strip()]
    header = table[0][1]
    each, value, at = logger["each"], logger.get("value"), logger.get("time", header[0])
    for name in (each, value, at):
        if name not in header:
            raise ResultError(f"{path}: no column '{name}'; it has {', '.join(header)} ([logger] each, value, time)")
    place = [header.index(name) for name in (each, at, value)]
    found = {}
    for number, cells in table[1:]:
        try:
            found.setdefault(cells[place[0]], []).append((float(cells[place[1]]), float(cells[place[2]]), number))
        except (ValueError, IndexError):
            raise ResultError(f"{path}:{number}: '{','.join(cells)}' has no numbers in '{at}' and '{value}'") from None
    travel = logger.get("travel")
    unit = Table.unit(value)
    tables = {}
    for name, readings in found.items():
        x, values, lines = (np.array(part) for part in zip(*readings))
        time = x if travel is None else (x - travel["from"]) / travel["speed"]
        order = np.argsort(time, kind="stable")
        tables[name] = LoggerTable(path, time[order], lines[order].astype(int), {name: Column(name, unit, values[order])})
    return tables


def _tables(calibration, path):
    """Name of a column -> the table that it is in."""
    logger = calibration.logger
    if "each" in logger:
        if not path.exists():
            raise ResultError(f"{path}: there is no such file")
        return _long_tables(path, logger)
    table = read_logger(path, logger.get("time"), logger.get("time_unit"))
    return {name: table for name in table.columns}


def _observed(calibration, tables, headers):
    """The observations of the file, or the columns that are called as probes are."""
    from solidus_plots.calibrate_file import Observation
    if calibration.observations:
        return calibration.observations
    names = {Table.name(header).lower(): Table.name(header) for header in headers}
    found = [Observation(column, names[column.lower()], "") for column in tables if column.lower() in names]
    if not found:
        raise ResultError(f"{calibration.path}: no column is called as a probe is: columns {', '.join(tables)}; probes "
                          f"{', '.join(names.values())}. [[observation]] with column and probe joins them")
    return found


def _series(observation, table, header, calibration, end, say):
    where = f"{calibration.path}: [[observation]] '{observation.column}'"
    column = table.column(observation.column)
    if column.dead:
        raise ResultError(f"{table.path}: column '{column.name}': {column.dead}; leave out its [[observation]]")
    if column.open_from is not None:
        say(f"{table.path}:{column.open_from}: column '{column.name}' has no readings from here on; those before are used")
    begin = float(calibration.logger.get("begin", 0.0))
    until = min(observation.until, float(calibration.logger.get("until", np.inf)))
    time = table.time - begin
    wanted = ~np.isnan(column.values) & (time >= max(0.0, observation.since)) & (time <= until)
    late = np.flatnonzero(wanted & (time > end * (1 + CLOSE)))
    if len(late) > 0:
        row = late[0]
        raise ResultError(f"{table.path}:{table.lines[row]}: {table.time[row]:g} s of the logger is {time[row]:g} s of the "
                          f"case, which ends at {end:g} s; [logger] begin and until, or time.end of the case")
    early = np.count_nonzero(~np.isnan(column.values) & (time < 0))
    if early > 0:
        say(f"column '{column.name}': {early} readings before the start of the case are left out")
    rows = np.flatnonzero(wanted)[::observation.every]
    if len(rows) == 0:
        raise ResultError(f"{where}: none of its readings lies within the {end:g} s of the case; [logger] begin is the time "
                          "of the logger at which the case starts")
    values = to_unit(column.values[rows], observation.unit or column.unit, Table.unit(header), where)
    return Readings(observation.column, header, observation.lag, observation.noise, np.minimum(time[rows], end), values,
                    table.lines[rows])


def read_readings(calibration, path, headers, end, say):
    """The readings of all observations. Throws ResultError.

    headers: of history.csv; end: of the case [s]; say(text) gets what a user should know.
    """
    path = Path(path)
    tables = _tables(calibration, path)
    by_name = {Table.name(header): header for header in headers}
    found = []
    for observation in _observed(calibration, tables, headers):
        if observation.probe not in by_name:
            raise ResultError(f"{calibration.path}: the case has no probe '{observation.probe}'; it has "
                              f"{', '.join(name for name in by_name if name != 'time')}")
        header = by_name[observation.probe]
        if observation.value is not None:
            found.append(Readings(observation.column, header, 0.0, observation.noise, np.array([]),
                                  np.array([observation.value]), np.array([0])))
            continue
        if observation.column not in tables:
            raise ResultError(f"{path}: no column '{observation.column}'; there are {', '.join(tables)}")
        found.append(_series(observation, tables[observation.column], header, calibration, end, say))
    used = {readings.name for readings in found}
    for name, table in tables.items():
        column = table.columns[name]
        if name not in used and column.dead:
            say(f"{table.path}: column '{name}' is not used: {column.dead}")
        elif name not in used:
            say(f"{table.path}: column '{name}' is not used")
    return found
