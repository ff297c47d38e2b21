"""The numbers of a run's summary under one name each, for tables of several runs."""

import json

from solidus_plots import columns, fields
from solidus_plots.vtu import ResultError


def read_summary(folder):
    """summary.json of a folder of results. Throws ResultError."""
    file = folder / "summary.json"
    if not file.exists():
        raise ResultError(f"{folder}: there is no summary.json; a run that ended, or was stopped, leaves one")
    try:
        return json.loads(file.read_text())
    except (json.JSONDecodeError, UnicodeDecodeError) as error:
        raise ResultError(f"{file}: not a summary of Solidus ({error})") from error


def _told(given):
    """The answers that a summary has, as their declarations order them, but all of a casting before those of the next: (name with unit, row,
    what the summary says of it: a number, or an object with the number). A row of None is the place of the criteria."""
    def one(row, entry, of=""):
        if entry is not None:
            yield f"{row['label'].replace('{}', of)}[{row['shown']['unit']}]", row, entry

    for name, casting in given.get("castings", {}).items():
        for row in columns.ANSWERS:
            if row["of"] == "casting":
                yield from one(row, casting.get(row["name"]), name)
    for row in columns.ANSWERS:
        if row["of"] == "run":
            yield from one(row, given.get(row["name"]))
        elif row["of"] == "contact":
            for name, entry in given.get(row["name"], {}).items():
                yield from one(row, entry, name)
        elif row["of"] == "criteria":
            yield "", None, None


def _number(row, entry):
    """The number of an answer in the unit in which it is shown."""
    if isinstance(entry, dict):
        entry = entry[row["number"] if row["number"] in entry else f"{row['number']}[{row['unit']}]"]
    return row["shown"]["factor"] * entry + row["shown"]["offset"]


def _error_of(entry, unit, factor=1.0):
    """The error by step and mesh that is written next to a value, a half width; nothing where there is none."""
    error = entry.get(f"error[{unit}]") if isinstance(entry, dict) else None
    return None if error is None else factor * error


def _niyama_of_parts(summary):
    """The least Niyama value of the parts, with its name as of answers(): the criterion itself follows risers and gating too, whose low
    values harm nobody. Nothing where the run tells none of single castings."""
    castings = summary.get("answers", {}).get("castings", {}).values()
    found = [c["least_niyama"] for c in castings if "least_niyama" in c and not c.get("riser") and not c.get("gating")]
    least = min(found, key=lambda entry: entry["value[K^0.5 s^0.5/m]"], default=None)
    return None if least is None else ("least Niyama[K0.5 s0.5/mm]", least)


def _criteria(summary):
    """The criteria whose worst value is an answer, under its name with the unit."""
    fields.declare(summary)
    return {f"{field.answer}[{field.shown}]": field for field in fields.known() if field.answer}


def bands(summary):
    """Name as of answers() -> half width of the error of step and mesh, where the run states it."""
    given, found = summary.get("answers", {}), {}
    for name, row, entry in _told(given):
        if row is None:
            criteria = given.get("errors_of_criteria", {})
            for answer, field in _criteria(summary).items():
                found[answer] = _error_of(criteria.get(field.finding.split("[")[0]), "SI", field.factor)
            if of_parts := _niyama_of_parts(summary):
                found[of_parts[0]] = _error_of(of_parts[1], "K^0.5 s^0.5/m", 1e-3)
        else:
            found[name] = _error_of(entry, row["unit"], row["shown"]["factor"])
    return {name: band for name, band in found.items() if band is not None}


def places(summary):
    """Name as of answers() -> where the value was found [m], where the run states it."""
    found = {name: entry["at[m]"] for name, row, entry in _told(summary.get("answers", {}))
             if isinstance(entry, dict) and "at[m]" in entry and row["name"] != "pores"}
    criteria = summary.get("criteria", {})
    for name, field in _criteria(summary).items():
        where = criteria.get(f"{field.finding.split('[')[0]}_at[m]")
        if where is not None:
            found[name] = where
    if (of_parts := _niyama_of_parts(summary)) and "at[m]" in of_parts[1]:
        found[of_parts[0]] = of_parts[1]["at[m]"]
    return found


def answers(summary):
    """Name with unit -> number: what the run answers and what its criteria found, in the units of its terminal."""
    found, criteria = {}, summary.get("criteria", {})
    for name, row, entry in _told(summary.get("answers", {})):
        if row is not None:
            found[name] = _number(row, entry)
            continue
        for answer, field in _criteria(summary).items():
            if field.finding in criteria:
                found[answer] = field.factor * criteria[field.finding] + field.offset
        if of_parts := _niyama_of_parts(summary):
            found[of_parts[0]] = 1e-3 * of_parts[1]["value[K^0.5 s^0.5/m]"]
    return found
