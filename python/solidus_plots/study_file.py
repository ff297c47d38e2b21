"""study.toml: a case, the values of some of its keys, and how they are combined (docs/guide/study.md)."""

from dataclasses import dataclass, field
import itertools
from pathlib import Path
import tomllib

import numpy as np

from solidus_plots.vtu import ResultError

METHODS = ("grid", "latin_hypercube")
KEYS = {"title", "case", "method", "samples", "seed", "set", "limit", "results", "parameter"}
PARAMETER_KEYS = {"key", "label", "values", "from", "to", "unit", "steps", "scale"}


@dataclass
class Parameter:
    """A key of the case and what it may be."""

    key: str
    label: str
    values: list  # as texts and numbers of a case file; of a range its steps
    low: float | None = None  # of a range, in `unit`
    high: float | None = None
    unit: str = ""
    logarithmic: bool = False

    def at(self, share):
        """The value at a share of the range from 0 to 1, or that entry of the list."""
        if self.low is None:
            return self.values[min(int(share * len(self.values)), len(self.values) - 1)]
        if self.logarithmic:
            return self.written(self.low * (self.high / self.low) ** share)
        return self.written(self.low + share * (self.high - self.low))

    def written(self, number):
        """As it is written in a case file."""
        number = float(f"{number:.6g}")
        return f"{number:g} {self.unit}" if self.unit else number

    def header(self):
        return f"{self.label}[{self.unit}]" if self.unit else self.label


@dataclass
class Study:
    path: Path
    title: str
    case: Path
    parameters: list
    runs: list  # of values, one for each parameter
    set: list = field(default_factory=list)
    limit: float | None = None  # [s] of wall time for one run
    results: list = field(default_factory=list)


def _fail(path, text):
    raise ResultError(f"{path}: {text}")


def _number(value):
    return isinstance(value, (int, float)) and not isinstance(value, bool)


def _known(path, table, keys, where):
    unknown = sorted(set(table) - keys)
    if unknown:
        _fail(path, f"unknown key '{unknown[0]}' {where}; there are {', '.join(sorted(keys))}")


def _parameter(path, table):
    if not isinstance(table, dict):
        _fail(path, "'parameter' is a list of tables; write [[parameter]]")
    _known(path, table, PARAMETER_KEYS, "in a [[parameter]]")
    key = table.get("key")
    if not isinstance(key, str) or not key:
        _fail(path, "a [[parameter]] lacks its 'key', for example \"body.part.initial_temperature\"")
    where, label = f"[[parameter]] '{key}'", table.get("label", key)
    if "values" in table:
        values = table["values"]
        if not isinstance(values, list) or not values or not all(isinstance(v, (str, bool)) or _number(v) for v in values):
            _fail(path, f"{where}: 'values' must be a list of texts or numbers")
        extra = sorted(set(table) & {"from", "to", "steps", "scale", "unit"})
        if extra:
            _fail(path, f"{where}: '{extra[0]}' belongs to a range; with 'values' the list is all")
        return Parameter(key, label, values), False
    low, high, unit = table.get("from"), table.get("to"), table.get("unit", "")
    if not (_number(low) and _number(high) and low < high):
        _fail(path, f"{where} needs 'values', or 'from' and 'to' as numbers in its 'unit', the first one smaller")
    scale, steps = table.get("scale", "linear"), table.get("steps", 0)
    if scale not in ("linear", "logarithmic"):
        _fail(path, f"{where}: 'scale' is \"linear\" or \"logarithmic\", not {scale!r}")
    if scale == "logarithmic" and low <= 0:
        _fail(path, f"{where}: a logarithmic range begins above zero")
    if not isinstance(steps, int) or isinstance(steps, bool) or steps < 0 or steps == 1:
        _fail(path, f"{where}: 'steps' must be a whole number of values, two at least")
    parameter = Parameter(key, label, [], float(low), float(high), unit, scale == "logarithmic")
    parameter.values = [parameter.at(share) for share in np.linspace(0.0, 1.0, steps)] if steps else []
    return parameter, steps == 0


def seconds(path, text):
    """"10 min" -> 600."""
    units = {"s": 1.0, "min": 60.0, "h": 3600.0}
    number, _, unit = str(text).partition(" ")
    try:
        value = float(number) * units[unit]
    except (ValueError, KeyError):
        _fail(path, f"'limit' is a time such as \"10 min\" (s, min, h), not {text!r}")
    if not value > 0:
        _fail(path, "'limit' must be above zero")
    return value


def latin_hypercube(parameters, samples, seed):
    """Each parameter has one value in each of `samples` equal parts of its range, in random order."""
    random = np.random.default_rng(seed)
    shares = [(random.permutation(samples) + random.random(samples)) / samples for _ in parameters]
    return [[parameter.at(share[run]) for parameter, share in zip(parameters, shares)] for run in range(samples)]


def read_study(path):
    """Throws ResultError with the file, what was found and what is allowed."""
    path = Path(path)
    if not path.exists():
        raise ResultError(f"{path}: there is no such file")
    try:
        table = tomllib.loads(path.read_text(encoding="utf-8-sig"))
    except (tomllib.TOMLDecodeError, UnicodeDecodeError) as error:
        raise ResultError(f"{path}: {error}") from error
    _known(path, table, KEYS, "at the top")
    case, method = table.get("case"), table.get("method", "grid")
    if not isinstance(case, str):
        _fail(path, "'case' names the case file or its folder, relative to the study")
    if method not in METHODS:
        _fail(path, f"'method' is one of {', '.join(METHODS)}, not {method!r}")
    read = [_parameter(path, entry) for entry in table.get("parameter", [])]
    if not read:
        _fail(path, "there is no [[parameter]]: nothing would differ from run to run")
    parameters = [parameter for parameter, _ in read]
    for key in ("set", "results"):
        if not isinstance(table.get(key, []), list) or not all(isinstance(entry, str) for entry in table.get(key, [])):
            _fail(path, f"'{key}' must be a list of texts")
    if method == "grid":
        open_ranges = [parameter.key for parameter, is_open in read if is_open]
        if open_ranges:
            _fail(path, f"[[parameter]] '{open_ranges[0]}' needs 'steps' or 'values' in a grid")
        for key in ("samples", "seed"):
            if key in table:
                _fail(path, f"'{key}' belongs to method = \"latin_hypercube\"")
        runs = [list(values) for values in itertools.product(*(parameter.values for parameter in parameters))]
    else:
        samples, seed = table.get("samples"), table.get("seed", 1)
        if not isinstance(samples, int) or isinstance(samples, bool) or samples < 2:
            _fail(path, "a Latin hypercube needs 'samples', a whole number of runs, two at least")
        if not isinstance(seed, int) or seed < 0:
            _fail(path, "'seed' must be a whole number")
        runs = latin_hypercube(parameters, samples, seed)
    return Study(path, table.get("title", path.stem), path.parent / case, parameters, runs, table.get("set", []),
                 seconds(path, table["limit"]) if "limit" in table else None, table.get("results", []))
