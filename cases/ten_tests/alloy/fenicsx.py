"""An alloy with a eutectic freezes, for DOLFINx: /usr/bin/python3 fenicsx.py. Heat content is counted from the solid at the eutectic."""
from pathlib import Path
import sys

import numpy as np

sys.path.insert(0, str(Path(__file__).resolve().parent.parent))
from freezing_dolfinx import Freezing

START, WALL, EUTECTIC, LIQUIDUS, RHO, C, LATENT = 660.0, 450.0, 570.0, 620.0, 2500.0, 1000.0, 390e3
LAST = RHO * 0.4 * LATENT  # what freezes at the eutectic [J/m3]
MUSH = RHO * (C + 0.6 * LATENT / (LIQUIDUS - EUTECTIC))
MOLTEN = LAST + MUSH * (LIQUIDUS - EUTECTIC)

bar = Freezing((0.1, 0.001), (100, 1), lambda x: x[0] < 1e-9, START, WALL,
               lambda t: (RHO * C * (np.minimum(t - EUTECTIC, 0) + np.maximum(t - LIQUIDUS, 0)) + np.where(t > EUTECTIC, LAST, 0)
                          + MUSH * np.maximum(0, np.minimum(t, LIQUIDUS) - EUTECTIC)),
               lambda h: (EUTECTIC + (np.minimum(h, 0) + np.maximum(h - MOLTEN, 0)) / (RHO * C)
                          + np.maximum(0, np.minimum(h, MOLTEN) - LAST) / MUSH),
               lambda h: np.where((h < 0) | (h > MOLTEN), 1 / (RHO * C), np.where(h > LAST, 1 / MUSH, 0)),
               lambda t: np.full_like(t, 150.0))
for step in range(1, 101):
    bar.advance(0.1)
    if step in (40, 100):
        bar.print_values([(i * 0.001, 0) for i in range(101)], step * 0.1)
