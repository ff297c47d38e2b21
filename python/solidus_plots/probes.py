"""Where the points of a run's probes are: from the case.toml in its results folder."""

import tomllib

import numpy as np

from solidus_plots.vtu import ResultError

LENGTHS = {"m": 1.0, "cm": 1e-2, "mm": 1e-3, "um": 1e-6, "in": 0.0254}


def read_points(case_file):
    """Name -> point [3] m of the probes that have one, in the order of the case."""
    if not case_file.exists():
        return {}
    probes = tomllib.loads(case_file.read_text()).get("probe", [])
    return {probe["name"]: np.array([_length(x, probe["name"]) for x in probe["point"]]) for probe in probes
            if len(probe.get("point", [])) == 3}


def _length(text, name):
    number, _, unit = text.partition(" ")
    if unit not in LENGTHS:
        raise ResultError(f"case.toml: probe '{name}': the plots know lengths in {', '.join(LENGTHS)}, "
                          f"not '{unit}'")
    return float(number) * LENGTHS[unit]
