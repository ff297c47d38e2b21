"""Residual stress and distortion at the end of each stage of a run: after_stages.py RESULTS (with solidus_plots on PYTHONPATH)."""

from pathlib import Path
import sys
import tomllib

import numpy as np

from solidus_plots.vtu import read_collection, read_fields

UNITS = {"s": 1, "min": 60, "h": 3600}


def seconds(text):
    number, unit = text.split()
    return float(number) * UNITS[unit]


results = Path(sys.argv[1])
case = tomllib.loads((results / "case.toml").read_text())
times, files = read_collection(results / "fields.pvd")
end = 0.0
print(f"{'stage':<10} {'T[degC]':>8} {'von Mises[MPa]':>15} {'mean[MPa]':>10} {'distortion[mm]':>15}")
for stage in case["stage"]:
    end += seconds(stage["duration"])
    grid = read_fields(files[int(np.argmin(np.abs(times - end)))])
    stress, distortion = grid.cell_data["von_mises"], np.linalg.norm(grid.point_data["distortion"], axis=1)
    print(f"{stage['name']:<10} {grid.point_data['temperature'].max() - 273.15:8.1f} {1e-6 * stress.max():15.1f} {1e-6 * stress.mean():10.1f} "
          f"{1e3 * distortion.max():15.3f}")
