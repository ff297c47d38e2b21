"""Freezing in a corner, for DOLFINx: /usr/bin/python3 fenicsx.py"""
from pathlib import Path
import sys

import numpy as np

sys.path.insert(0, str(Path(__file__).resolve().parent.parent))
from freezing_dolfinx import Freezing

START, WALL, MELT, RHO, C, LATENT = 630.0, 500.0, 600.0, 2500.0, 1000.0, 25e3

corner = Freezing((0.1, 0.1), (50, 50), lambda x: np.minimum(x[0], x[1]) < 1e-9, START, WALL,
                  lambda t: RHO * (C * (t - MELT) + np.where(t < MELT, 0, LATENT)),
                  lambda h: MELT + (np.minimum(h, 0) + np.maximum(h - RHO * LATENT, 0)) / (RHO * C),
                  lambda h: np.where((h < 0) | (h > RHO * LATENT), 1 / (RHO * C), 0),
                  lambda t: np.full_like(t, 150.0))
for step in range(60):
    corner.advance(0.1)
corner.print_values([(i * 0.002, i * 0.002) for i in range(51)], 6)
