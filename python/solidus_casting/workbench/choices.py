"""What the page asks for before there is a case: alloy, process, risers, gating, chills, probes. They become the words of ``solidus new``."""

from __future__ import annotations

import math
from collections.abc import Mapping
from pathlib import Path
from typing import Any

from ..errors import InputError
from ..toml_text import document_text

Choices = dict[str, Any]

PROCESSES = {"sand": "Sand mould", "shell": "Investment shell", "gravity_die": "Gravity die", "high_pressure": "High-pressure die"}
ROLES = ("casting", "riser", "gating", "mould", "core", "chill", "sleeve", "die", "insulation")
RISERS = {"none": "None", "auto": "Chosen by rule", "placed": "As placed"}
_LENGTHS = ("diameter", "height", "neck_diameter", "neck_height", "sleeve")
_SECTIONS = ("gate_width", "gate_height", "gate_length", "runner_width", "runner_height", "foot_diameter", "top_diameter")  # of gating
_MOST = 200  # risers, gatings, chills or probes
_NOTHING: Choices = {"alloy": "", "process": "sand", "riser": "none", "symmetry": "", "fineness": 1.0, "unit": "", "roles": {}, "risers": [],
                     "chills": [], "gatings": [], "probes": [], "gate": None}


def defaults() -> Choices:
    return {name: value.copy() if isinstance(value, (dict, list)) else value for name, value in _NOTHING.items()}


def checked(given: Any) -> Choices:
    """The choices of a request or of a file, each of the right kind; lengths in metres. Raises :class:`InputError`."""
    if not isinstance(given, Mapping) or set(given) - set(_NOTHING):
        raise InputError("these are no choices of the page", ", ".join(_NOTHING))
    chosen = {**defaults(), **given}
    for name, allowed in (("process", tuple(PROCESSES)), ("riser", tuple(RISERS)), ("symmetry", ("", "x", "y", "z"))):
        if chosen[name] not in allowed:
            raise InputError(f"'{chosen[name]}' is no choice of {name}", ", ".join(filter(None, allowed)))
    chosen["alloy"], chosen["unit"] = _word(chosen["alloy"], "alloy"), _word(chosen["unit"], "unit")
    chosen["fineness"] = _number(chosen["fineness"], "fineness")
    if not isinstance(chosen["roles"], Mapping):
        raise InputError("roles are no table", "a role for each body")
    chosen["roles"] = {str(body): role for body, role in chosen["roles"].items() if role}
    for body, role in chosen["roles"].items():
        if role not in ROLES:
            raise InputError(f"'{role}' is no role of '{body}'", ", ".join(ROLES))
    chosen["risers"] = [_riser(entry, number) for number, entry in enumerate(_entries(chosen["risers"]), 1)]
    chosen["chills"] = [_chill(entry, number) for number, entry in enumerate(_entries(chosen["chills"]), 1)]
    chosen["gatings"] = [_gating(entry, number) for number, entry in enumerate(_entries(chosen["gatings"]), 1)]
    chosen["probes"] = [_probe(entry, number) for number, entry in enumerate(_entries(chosen["probes"]), 1)]
    chosen["gate"] = None if chosen["gate"] is None else _point(chosen["gate"], "gate")
    return chosen


def _word(given: Any, name: str) -> str:
    if not isinstance(given, str) or len(given) > 200 or not given.isprintable():
        raise InputError(f"{name}: {given!r} is no name")
    return given


def _number(given: Any, name: str) -> float:
    if isinstance(given, bool) or not isinstance(given, (int, float)) or not math.isfinite(given):
        raise InputError(f"{name}: {given!r} is no number")
    return float(given)


def _point(given: Any, name: str) -> list[float]:
    if not isinstance(given, list) or len(given) != 3:
        raise InputError(f"{name}: {given!r} is no place", "three coordinates in metres")
    return [_number(value, name) for value in given]


def _entries(given: Any) -> list[Mapping[str, Any]]:
    if not isinstance(given, list) or len(given) > _MOST or not all(isinstance(entry, Mapping) for entry in given):
        raise InputError("this is no list of things that are placed", f"at most {_MOST} tables")
    return given


def _name(entry: Mapping[str, Any], name: str) -> str:
    return _word(entry.get("name") or name, "name")


def _riser(entry: Mapping[str, Any], number: int) -> dict[str, Any]:
    name = _name(entry, f"riser_{number}")
    sizes = {key: _number(entry[key], f"{name}: {key}") for key in _LENGTHS if entry.get(key)}
    beside = {"neck_to": _point(entry["neck_to"], f"{name}: neck_to")} if entry.get("neck_to") is not None else {}
    return {"name": name, "foot": _point(entry.get("foot"), f"{name}: foot"), **sizes, **beside}


def _gating(entry: Mapping[str, Any], number: int) -> dict[str, Any]:
    name = _name(entry, f"gating_{number}")
    sizes = {key: _number(entry.get(key), f"{name}: {key}") for key in _SECTIONS}
    return {"name": name, **sizes, **{key: _point(entry.get(key), f"{name}: {key}") for key in ("gate", "sprue")}}


def _chill(entry: Mapping[str, Any], number: int) -> dict[str, Any]:
    name = _name(entry, f"chill_{number}")
    return {"name": name, **{corner: _point(entry.get(corner), f"{name}: {corner}") for corner in ("lowest", "highest")}}


def _probe(entry: Mapping[str, Any], number: int) -> dict[str, Any]:
    name = _name(entry, f"T_{number}")
    return {"name": name, "point": _point(entry.get("point"), f"{name}: point")}


def millimetres(metres: float) -> str:
    return f"{round(1e3 * metres, 4):g} mm"


def place_text(point: list[float]) -> list[str]:
    return [millimetres(value) for value in point]


def feeders_text(choices: Choices) -> str:
    """The file of risers and chills that ``new --riser FILE`` reads."""
    risers = [{"name": riser["name"], "foot": place_text(riser["foot"]),
               **{key: millimetres(riser[key]) for key in _LENGTHS if key in riser},
               **({"neck_to": place_text(riser["neck_to"])} if "neck_to" in riser else {})} for riser in choices["risers"]]
    chills = [{"name": chill["name"], "lowest": place_text(chill["lowest"]), "highest": place_text(chill["highest"])}
              for chill in choices["chills"]]
    return document_text({name: entries for name, entries in (("riser", risers), ("chill", chills)) if entries})


def gating_text(choices: Choices) -> str:
    """The file of gating that ``new --gating FILE`` reads."""
    entries = [{"name": g["name"], "gate": place_text(g["gate"]), "gate_size": [millimetres(g["gate_width"]), millimetres(g["gate_height"])],
                "gate_length": millimetres(g["gate_length"]), "runner_size": [millimetres(g["runner_width"]), millimetres(g["runner_height"])],
                "sprue": place_text(g["sprue"]), **{key: millimetres(g[key]) for key in ("foot_diameter", "top_diameter")}}
               for g in choices["gatings"]]
    return document_text({"gating": entries} if entries else {})


def files(choices: Choices) -> dict[str, str]:
    """The files that ``solidus new`` reads what was placed from, by their names in the folder of the page."""
    return {"feeders.toml": feeders_text(choices), "gating.toml": gating_text(choices)}


def words(choices: Choices, part: Path, own: Path, folder: Path) -> list[str]:
    """The words behind ``solidus new``. With the sign between them: a value may begin with a dash."""
    if not choices["alloy"]:
        raise InputError("what is cast?", "an alloy of the list")
    found = [f"--alloy={choices['alloy']}", f"--process={choices['process']}", f"--fineness={choices['fineness']:g}",
             f"--output={folder}"]
    found += [f"--{name}={choices[name]}" for name in ("symmetry", "unit") if choices[name]]
    if choices["riser"] == "auto":
        found.append("--riser=auto")
    elif choices["riser"] == "placed" and (choices["risers"] or choices["chills"]):
        found.append(f"--riser={own / 'feeders.toml'}")
    if choices["gatings"]:
        found.append(f"--gating={own / 'gating.toml'}")
    if choices["gate"] is not None:
        found.append("--gate=" + ", ".join(f"{1e3 * value:.6g} mm" for value in choices["gate"]))
    found += [f"--as={body}={role}" for body, role in choices["roles"].items()]
    return [*found, str(part)]
