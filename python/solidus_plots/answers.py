"""The numbers of a run's summary under one name each, for tables of several runs."""

import json

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


def answers(summary):
    """Name with unit -> number: what the run answers and what its criteria found, in the units of its terminal."""
    given, found = summary.get("answers", {}), {}
    found.update(_of_castings(given.get("castings", {})))
    if "pools_cut_off" in given:
        found["pools cut off[1]"] = given["pools_cut_off"]["number"]
    criteria = summary.get("criteria", {})
    for name, key, factor in (("longest local solidification time[s]", "local_solidification_time_max[s]", 1.0),
                              ("largest arm spacing[um]", "secondary_arm_spacing_max[m]", 1e6),
                              ("least Niyama[K0.5 s0.5/mm]", "niyama_min[K^0.5 s^0.5/m]", 1e-3),
                              ("largest porosity[%]", "shrinkage_porosity_max", 100.0)):
        if key in criteria:
            found[name] = factor * criteria[key]
    for contact, gap in given.get("largest_gaps", {}).items():
        found[f"largest gap of {contact}[mm]"] = 1e3 * gap["value[m]"]
    if "largest_distortion" in given:
        found["largest distortion[mm]"] = 1e3 * given["largest_distortion"]["value[m]"]
    if "largest_von_mises" in given:
        found["largest von Mises stress[MPa]"] = 1e-6 * given["largest_von_mises"]["value[Pa]"]
    return found
