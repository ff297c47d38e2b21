"""What the program says of the fields of results: labels, units, marks for "no value", colours.

`fields.json` is what `solidus explain --fields --json` prints; a run brings the declarations of its own fields in its
summary, also of criteria that this list does not have:

    fields.declare(summary)
    fields.label("von_mises")     # "Von Mises stress"
"""

from dataclasses import dataclass
import json
from pathlib import Path

import numpy as np

COLOURS = {"sequential": "viridis", "hot": "inferno", "share": "cividis", "by_sign": "viridis"}


@dataclass(frozen=True)
class Field:
    """A field as its declaration in the program has it (quantities/quantity.hpp)."""

    name: str
    label: str
    unit: str  # SI; "K0.5 s0.5/m" of a root, where files say 1
    group: str
    worst: str  # "none", "least", "greatest"
    answer: str  # its worst value among the answers of a run; empty: it is none
    threshold: float | None  # beyond it, towards the worst end, a value is bad by the criterion itself
    no_value: float | None  # the mark for "nothing to say"
    colours: str
    compared: bool
    pictured: bool
    is_root: bool  # UDUNITS has no name for its unit
    shown: str  # the unit that people read
    factor: float
    offset: float

    def with_value(self, values):
        """Values as numbers, nan where the field says that there is none."""
        return values if self.no_value is None else np.where(values == self.no_value, np.nan, values)

    @property
    def unit_of_differences(self):
        """The unit that people read, but for one that is shifted: degC."""
        return self.unit if self.offset else self.shown

    @property
    def finding(self):
        """The worst value among the criteria of a summary, with its unit in SI: "niyama_min[K^0.5 s^0.5/m]"."""
        unit = self.unit.replace("K0.5 s0.5", "K^0.5 s^0.5")
        return f"{self.name}_{'min' if self.worst == 'least' else 'max'}" + ("" if unit == "1" else f"[{unit}]")


def _read(row):
    root = row.get("root_unit", "")
    return Field(row["name"], row["label"], root.replace("^", "") or row["unit"], row["group"], row["worst"],
                 row.get("answer", ""), row.get("threshold"), row.get("no_value"), row["colours"], row["compared"], row["pictured"], bool(root),
                 row["shown"]["unit"], row["shown"]["factor"], row["shown"]["offset"])


_DECLARED = json.loads((Path(__file__).parent / "fields.json").read_text(encoding="utf-8"))
_known = {row["name"]: _read(row) for row in _DECLARED["fields"]}
_UNITS, _SHOWN = _DECLARED["unit_names"], _DECLARED["units"]


def unit_text(unit):
    """A unit as people write it, "m²" for "m2"; one that the program does not name as it is."""
    named = _UNITS.get(unit)
    return named["text"] if named and named["text"] else unit


def measure(unit):
    """What a unit measures, for the axis of a curve: "Temperature"."""
    return _UNITS[unit]["measures"] if unit in _UNITS else "Value"


def to_shown(value, unit):
    """A value in SI in the unit in which people read it, and that unit."""
    shown = _SHOWN.get(unit)
    return (value, unit) if shown is None else (shown["factor"] * value + shown["offset"], shown["unit"])


def declare(summary):
    """Takes the declarations of a run's own fields."""
    _known.update({name: _read(row) for name, row in summary.get("fields", {}).items()})


def known():
    """All declared fields, in the order of the reference page."""
    return list(_known.values())


def find(name):
    """None for a name that is not declared."""
    return _known.get(name)


def label(name):
    return _known[name].label if name in _known else name.replace("_", " ").capitalize()


def unit(name, written):
    """The unit in SI of a field for which files say `written`."""
    return _known[name].unit if name in _known and _known[name].is_root else written


def colour_map(name, component, low, high):
    """The name of the colours of a field; tension and compression are told apart where both are there."""
    colours = _known[name].colours if name in _known else "sequential"
    if low < 0.0 < high and (component is not None or colours == "by_sign"):
        return "RdBu_r"
    return COLOURS[colours]


def conversion(si, wanted):
    """(factor, offset) from a unit in SI to one in which its values, or those of a field, are shown; None where none are."""
    if si in _SHOWN and _SHOWN[si]["unit"] == wanted:
        return _SHOWN[si]["factor"], _SHOWN[si]["offset"]
    return next(((field.factor, field.offset) for field in _known.values() if (field.unit, field.shown) == (si, wanted)), None)
