"""calibrate.toml: what is unknown, which column of the logger is which probe (docs/guide/calibrate.md)."""

from dataclasses import dataclass, field
from pathlib import Path
import tomllib

import numpy as np

from solidus_plots.vtu import ResultError

LOSSES = ("linear", "huber", "soft_l1", "cauchy")
KINDS = ("key", "card", "lag", "place", "clock")
KEYS = {"title", "set", "coarse", "confidence", "loss", "loss_scale", "runs", "derivatives", "logger", "observation", "unknown"}
LOGGER_KEYS = {"time", "time_unit", "begin", "each", "value", "travel", "until"}
OBSERVATION_KEYS = {"column", "probe", "unit", "noise", "lag", "from", "until", "every", "value", "bore"}
BORE_KEYS = {"diameter", "bead", "filling", "direction"}
UNKNOWN_KEYS = {"name", "kind", "key", "also", "unit", "start", "lower", "upper", "prior", "deviation", "scale", "of", "at",
                "argument_unit", "observations", "probe", "direction", "property"}


@dataclass
class Parameter:
    """One number to be found. `low` and `high` are its bounds, `prior` what is known of it beforehand."""

    name: str
    unit: str
    start: float
    low: float
    high: float
    logarithmic: bool
    prior: float | None = None
    deviation: float | None = None  # of the prior; of a logarithmic parameter that of the logarithm

    def label(self):
        return f"{self.name} [{self.unit}]" if self.unit else self.name


@dataclass
class Unknown:
    """What is to be found: one number, or the values of a table at given arguments."""

    name: str
    kind: str
    parameters: list
    key: str = ""
    also: list = field(default_factory=list)  # further keys that take the first value
    of: str = ""  # argument of the table: temperature, time, gap, pressure
    argument_unit: str = ""
    at: list = field(default_factory=list)
    observations: list = field(default_factory=list)  # columns that it is of; empty: all
    probe: str = ""
    direction: list = field(default_factory=list)
    place: list = field(default_factory=list)  # where the case has the probe, texts with units
    of_card: str = ""  # property of the material that `key` names
    material: str = ""  # that the case has there

    @property
    def unit(self):
        return self.parameters[0].unit


@dataclass
class Observation:
    column: str
    probe: str
    unit: str
    noise: float | None = None
    lag: float = 0.0
    since: float = -np.inf
    until: float = np.inf
    every: int = 1
    value: float | None = None  # a number at the end of the run in place of a column
    place: Unknown | None = None  # of the bead in its bore


def place_of_bead(diameter, bead, filling):
    """Standard deviation of the place that a bead reads, along the gradient, from the axis of a bore across the gradient.

    In a round hole of the conductivity k' in a metal of k with the gradient g far away the gradient is 2k/(k + k') g
    everywhere (H. S. Carslaw and J. C. Jaeger, Conduction of Heat in Solids, 2nd ed. 1959, chapter 16): a bead beside the axis reads
    what the metal without a hole has at that multiple of its distance. Anywhere in the hole alike, its centre is in a disc of
    the radius (diameter − bead)/2, whose standard deviation along a line is half of that.
    filling: k'/k.
    """
    return 2 / (1 + filling) * (diameter - bead) / 4


@dataclass
class Calibration:
    path: Path
    title: str
    unknowns: list
    observations: list  # empty: columns that are called as probes are
    set: list
    coarse: list  # assignments of runs that cost little, with which the search begins; empty: none
    confidence: float
    loss: str
    loss_scale: float
    runs: int | None  # at most; None: by how derivatives are found
    derivatives: str
    logger: dict

    def parameters(self):
        return [parameter for unknown in self.unknowns for parameter in unknown.parameters]


def _number(value):
    return isinstance(value, (int, float)) and not isinstance(value, bool)


class _Reader:
    def __init__(self, path):
        self.path = Path(path)

    def fail(self, text):
        raise ResultError(f"{self.path}: {text}")

    def known(self, table, keys, where):
        if not isinstance(table, dict):
            self.fail(f"{where} is a table")
        for key in sorted(set(table) - keys):
            self.fail(f"unknown key '{key}' {where}; there are {', '.join(sorted(keys))}")

    def number(self, table, key, where, default=None):
        value = table.get(key, default)
        if value is not None and not _number(value):
            self.fail(f"{where}: '{key}' is a number, not {value!r}")
        return None if value is None else float(value)

    def text(self, table, key, where, default=None):
        value = table.get(key, default)
        if not isinstance(value, str) or not value and default is None:
            self.fail(f"{where} needs '{key}', a text")
        return value

    def numbers(self, value, count, where, key):
        """One number for each of `count` points; a single one is that of all."""
        if _number(value):
            return [float(value)] * count
        if not isinstance(value, list) or len(value) != count or not all(map(_number, value)):
            self.fail(f"{where}: '{key}' is a number, or a list of {count} numbers")
        return [float(v) for v in value]

    def assignments(self, table, key):
        found = table.get(key, [])
        if not isinstance(found, list) or not all(isinstance(text, str) and "=" in text for text in found):
            self.fail(f"'{key}' is a list of assignments as after --set, such as \"time.step=2 s\"")
        return found

    def unknown(self, table):
        self.known(table, UNKNOWN_KEYS, "in an [[unknown]]")
        name = self.text(table, "name", "an [[unknown]]")
        where, kind = f"[[unknown]] '{name}'", table.get("kind", "key")
        if kind not in KINDS:
            self.fail(f"{where}: 'kind' is one of {', '.join(KINDS)}, not {kind!r}")
        needs = {"key": ("key", "start"), "card": ("key", "property", "start"), "place": ("probe", "direction"), "lag": ("start",), "clock": ()}[kind]
        for key in needs:
            if key not in table:
                self.fail(f"{where} needs '{key}'")
        at = table.get("at", [])
        if ("of" in table) != (len(at) > 0) or at and kind not in ("key", "card"):
            self.fail(f"{where}: the points of a table have 'of' (temperature, time, gap, pressure), 'at' and 'argument_unit'")
        if at and not (all(map(_number, at)) and all(a < b for a, b in zip(at, at[1:]))):
            self.fail(f"{where}: 'at' is a list of numbers that rise")
        parameters = self.parameters(table, name, where, kind, at)
        direction = self.direction(table, where) if kind == "place" else table.get("direction", [])
        also = table.get("also", [])
        return Unknown(name, kind, parameters, table.get("key", ""), [also] if isinstance(also, str) else also,
                       table.get("of", ""), table.get("argument_unit", ""), [float(a) for a in at],
                       table.get("observations", []), table.get("probe", ""), direction,
                       of_card=table.get("property", ""))

    def parameters(self, table, name, where, kind, at):
        count = max(len(at), 1)
        unit = table.get("unit", {"lag": "s", "clock": "s", "place": "mm"}.get(kind, ""))
        start = self.numbers(table.get("start", 0.0), count, where, "start")
        positive = all(value > 0 for value in start) and kind in ("key", "card", "lag") and "degC" not in unit
        scale = table.get("scale", "logarithmic" if positive else "linear")
        if scale not in ("linear", "logarithmic") or scale == "logarithmic" and not positive:
            self.fail(f"{where}: 'scale' is \"linear\", or \"logarithmic\" of values above zero")
        low = self.numbers(table.get("lower", -np.inf), count, where, "lower")
        high = self.numbers(table.get("upper", np.inf), count, where, "upper")
        priors = self.numbers(table["prior"], count, where, "prior") if "prior" in table else [None] * count
        deviation = self.number(table, "deviation", where)
        if (priors[0] is None) != (deviation is None):
            self.fail(f"{where}: a prior is a value, 'prior', and its standard deviation, 'deviation'")
        if deviation is not None and not deviation > 0:
            self.fail(f"{where}: 'deviation' is above zero")
        found = []
        for i in range(count):
            if not low[i] < start[i] < high[i]:
                self.fail(f"{where}: 'start' {start[i]:g} lies within the bounds {low[i]:g} to {high[i]:g}")
            of_log = deviation / priors[i] if deviation and scale == "logarithmic" else deviation
            label = f"{name} at {at[i]:g} {table.get('argument_unit', '')}".strip() if at else name
            found.append(Parameter(label, unit, start[i], low[i], high[i], scale == "logarithmic", priors[i], of_log))
        return found

    def observation(self, table):
        self.known(table, OBSERVATION_KEYS, "in an [[observation]]")
        probe = self.text(table, "probe", "an [[observation]]", table.get("column"))
        if probe is None:
            self.fail("an [[observation]] needs 'probe', a probe of the case, and 'column' of the measurements")
        where = f"[[observation]] '{probe}'"
        noise, every = self.number(table, "noise", where), table.get("every", 1)
        if noise is not None and not noise > 0:
            self.fail(f"{where}: 'noise' is a standard deviation above zero")
        if not isinstance(every, int) or every < 1:
            self.fail(f"{where}: 'every' is a whole number of readings, one at least")
        lag = self.number(table, "lag", where, 0.0)
        if lag < 0:
            self.fail(f"{where}: 'lag' is no less than zero")
        since, until = (self.number(table, key, where) for key in ("from", "until"))
        return Observation(table.get("column", probe), probe, table.get("unit", ""), noise, lag,
                           -np.inf if since is None else since, np.inf if until is None else until, every,
                           self.number(table, "value", where), self.bore(table, probe, where))

    def bore(self, table, probe, where):
        """The place of the bead in its bore, an unknown with a prior; nothing without a bore."""
        if "bore" not in table:
            return None
        bore, where = table["bore"], f"{where}: bore"
        self.known(bore, BORE_KEYS, "in 'bore' of an [[observation]]")
        diameter, bead, filling = (self.number(bore, key, where, default) for key, default in
                                   (("diameter", None), ("bead", 0.0), ("filling", 0.0)))
        if diameter is None or not 0 <= bead < diameter:
            self.fail(f"{where} has a 'diameter' in mm, larger than that of the 'bead'")
        if filling < 0:
            self.fail(f"{where}: 'filling' is the conductivity of what fills it over that of the metal, no less than zero")
        direction = self.direction(bore, where)
        deviation = place_of_bead(diameter, bead, filling)
        place = Parameter(f"place of {probe} in its bore", "mm", 0.0, -np.inf, np.inf, False, 0.0, deviation)
        return Unknown(place.name, "place", [place], probe=probe, direction=direction)

    def direction(self, table, where):
        direction = table.get("direction", [])
        if not (isinstance(direction, list) and 2 <= len(direction) <= 3 and all(map(_number, direction)) and any(direction)):
            self.fail(f"{where}: 'direction' is a list of two or three numbers")
        return direction


def read_calibration(path):
    """Throws ResultError with the file, what was found and what is allowed."""
    reader = _Reader(path)
    if not reader.path.exists():
        reader.fail("there is no such file: it says what is unknown (docs/guide/calibrate.md)")
    try:
        table = tomllib.loads(reader.path.read_text(encoding="utf-8-sig"))
    except (tomllib.TOMLDecodeError, UnicodeDecodeError) as error:
        reader.fail(error)
    reader.known(table, KEYS, "at the top")
    logger = table.get("logger", {})
    reader.known(logger, LOGGER_KEYS, "in [logger]")
    unknowns = [reader.unknown(entry) for entry in table.get("unknown", [])]
    if not unknowns:
        reader.fail("there is no [[unknown]]: nothing is to be found")
    observations = [reader.observation(entry) for entry in table.get("observation", [])]
    places = [o.place for o in observations if o.place is not None]
    for place in places:
        if any(u.kind == "place" and u.probe == place.probe for u in unknowns):
            reader.fail(f"the place of '{place.probe}' is an [[unknown]] and that in its bore too: add the deviation of the bead, "
                        f"{place.parameters[0].deviation:.3g} mm, to the one of the [[unknown]], as squares, and leave out 'bore'")
    unknowns += places
    names = [parameter.name for unknown in unknowns for parameter in unknown.parameters]
    for name in names:
        if names.count(name) > 1:
            reader.fail(f"two unknowns are called '{name}'")
    confidence, runs = table.get("confidence", 0.9), table.get("runs")
    if not (_number(confidence) and 0.5 <= confidence < 1):
        reader.fail("'confidence' is a share from 0.5 to less than 1")
    if runs is not None and (not isinstance(runs, int) or runs < 2):
        reader.fail("'runs' is a whole number, two at least")
    loss, derivatives = table.get("loss", "linear"), table.get("derivatives", "auto")
    if loss not in LOSSES:
        reader.fail(f"'loss' is one of {', '.join(LOSSES)}, not {loss!r}")
    if derivatives not in ("auto", "forward", "differences"):
        reader.fail(f"'derivatives' is one of auto, forward, differences, not {derivatives!r}")
    loss_scale = reader.number(table, "loss_scale", "at the top", 2.0)
    if not loss_scale > 0:
        reader.fail("'loss_scale' is above zero")
    return Calibration(reader.path, table.get("title", ""), unknowns, observations, reader.assignments(table, "set"),
                       reader.assignments(table, "coarse"), float(confidence), loss, loss_scale, runs, derivatives, logger)
