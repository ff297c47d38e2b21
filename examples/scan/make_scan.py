"""Makes scan.csv of a run of cases/bracket: make_scan.py RESULTS. Points of the computed shape by chance, as a scanner would see them: turned
and shifted, with noise of 0.02 mm, a face that was ground down by 0.3 mm, and a speck of dust."""

from argparse import Namespace
from pathlib import Path
import sys

import numpy as np

from solidus_plots import compare_shape, shape_fit

surface, _ = compare_shape.shape_of(Path(sys.argv[1]), Namespace(nominal=False, body=None, unit="mm"))
rng = np.random.default_rng(5)
triangle = rng.choice(len(surface.triangles), 2500, p=surface.areas / surface.areas.sum())
points = np.einsum("pc,pci->pi", rng.dirichlet([1, 1, 1], 2500), surface.points[surface.triangles[triangle]])
depth = np.where(np.linalg.norm(points - [0.08, 0.04, 0.015], axis=1) < 0.012, -0.3e-3, 0.0)
points += (depth + rng.normal(0, 0.02e-3, 2500))[:, None] * surface.normals[triangle]
points[:12] += [0.004, 0.003, 0.006]
moved = 1e3 * shape_fit.small(np.radians([3.0, -8.0, 35.0]), np.array([0.2, -0.1, 0.05]), np.zeros(3))(points)
lines = ["X [mm];Y [mm];Z [mm]", *(";".join(f"{x:.3f}".replace(".", ",") for x in point) for point in moved)]
Path("scan.csv").write_text("\r\n".join(lines) + "\r\n", newline="")
