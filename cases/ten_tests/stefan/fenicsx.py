"""A pure metal freezes from a cold wall, for DOLFINx: /usr/bin/python3 fenicsx.py"""
from pathlib import Path
import sys

import numpy as np

sys.path.insert(0, str(Path(__file__).resolve().parent.parent))
from freezing_dolfinx import Freezing

START, WALL, MELT, RHO, LATENT = 720.0, 400.0, 660.0, 2500.0, 390e3

bar = Freezing((0.1, 0.001), (100, 1), lambda x: x[0] < 1e-9, START, WALL,
               lambda t: RHO * np.where(t < MELT, 1000 * (t - MELT), LATENT + 1100 * (t - MELT)),
               lambda h: MELT + np.minimum(h, 0) / (RHO * 1000) + np.maximum(h - RHO * LATENT, 0) / (RHO * 1100),
               lambda h: np.where(h < 0, 1 / (RHO * 1000), np.where(h > RHO * LATENT, 1 / (RHO * 1100), 0)),
               lambda t: np.where(t < MELT, 200.0, 90.0))
for step in range(1, 101):
    bar.advance(0.1)
    if step in (40, 100):
        bar.print_values([(i * 0.001, 0) for i in range(101)], step * 0.1)
