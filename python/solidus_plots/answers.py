"""The numbers of a run's summary under one name each, for tables of several runs."""

import json

from solidus_plots import fields
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


def _of_castings(castings):
    for name, casting in castings.items():
        if "solid_fraction" in casting:
            yield f"{name}: solid fraction[1]", casting["solid_fraction"]
        if "last_melt_froze" in casting:
            yield f"{name}: last melt froze[s]", casting["last_melt_froze"]["value[s]"]
        if "hottest_melt" in casting:
            yield f"{name}: hottest melt[degC]", casting["hottest_melt"]["value[K]"] - 273.15


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
    for name, casting in given.get("castings", {}).items():
        found[f"{name}: last melt froze[s]"] = _error_of(casting.get("last_melt_froze"), "s")
        found[f"{name}: hottest melt[degC]"] = _error_of(casting.get("hottest_melt"), "K")
    for contact, gap in given.get("largest_gaps", {}).items():
        found[f"largest gap of {contact}[mm]"] = _error_of(gap, "m", 1e3)
    found["largest distortion[mm]"] = _error_of(given.get("largest_distortion"), "m", 1e3)
    found["largest von Mises stress[MPa]"] = _error_of(given.get("largest_von_mises"), "Pa", 1e-6)
    found["pores, share of the casting[%]"] = _error_of(given.get("pores"), "1", 100.0)
    criteria = given.get("errors_of_criteria", {})
    for name, field in _criteria(summary).items():
        found[name] = _error_of(criteria.get(field.finding.split("[")[0]), "SI", field.factor)
    if of_parts := _niyama_of_parts(summary):
        found[of_parts[0]] = _error_of(of_parts[1], "K^0.5 s^0.5/m", 1e-3)
    return {name: band for name, band in found.items() if band is not None}


def places(summary):
    """Name as of answers() -> where the value was found [m], where the run states it."""
    given, found = summary.get("answers", {}), {}
    for name, casting in given.get("castings", {}).items():
        found[f"{name}: last melt froze[s]"] = casting.get("last_melt_froze")
        found[f"{name}: hottest melt[degC]"] = casting.get("hottest_melt")
    found["pools cut off[1]"] = given.get("pools_cut_off")
    for contact, gap in given.get("largest_gaps", {}).items():
        found[f"largest gap of {contact}[mm]"] = gap
    found["largest distortion[mm]"] = given.get("largest_distortion")
    found["largest von Mises stress[MPa]"] = given.get("largest_von_mises")
    found = {name: entry["at[m]"] for name, entry in found.items() if isinstance(entry, dict) and "at[m]" in entry}
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
    given, found = summary.get("answers", {}), {}
    found.update(_of_castings(given.get("castings", {})))
    if "yield" in given:
        found["yield[%]"] = 100.0 * given["yield"]
    if "pools_cut_off" in given:
        found["pools cut off[1]"] = given["pools_cut_off"]["number"]
    criteria = summary.get("criteria", {})
    for name, field in _criteria(summary).items():
        if field.finding in criteria:
            found[name] = field.factor * criteria[field.finding] + field.offset
    if of_parts := _niyama_of_parts(summary):
        found[of_parts[0]] = 1e-3 * of_parts[1]["value[K^0.5 s^0.5/m]"]
    for contact, gap in given.get("largest_gaps", {}).items():
        found[f"largest gap of {contact}[mm]"] = 1e3 * gap["value[m]"]
    if "largest_distortion" in given:
        found["largest distortion[mm]"] = 1e3 * given["largest_distortion"]["value[m]"]
    if "pores" in given:
        found["pores, share of the casting[%]"] = 100.0 * given["pores"]["share_of_casting"]
    if "largest_von_mises" in given:
        found["largest von Mises stress[MPa]"] = 1e-6 * given["largest_von_mises"]["value[Pa]"]
    return found
