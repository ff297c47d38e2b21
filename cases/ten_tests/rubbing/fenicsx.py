"""Two bodies that rub, for DOLFINx: heat alone, for pressure and speed are given by the problem and the same everywhere. Trapezoidal
rule with steps of 0.01 s. /usr/bin/python3 fenicsx.py
"""
from pathlib import Path
import sys

import numpy as np

sys.path.insert(0, str(Path(__file__).resolve().parent.parent))
from bars_dolfinx import Body

FRICTION, CONDUCTANCE, START, STEP = 0.3 * 100e6 * 0.005, 20e3, 20.0, 0.01
SIZES = 1.1**np.arange(30)
DEPTHS = 0.02 * np.concatenate(([0], np.cumsum(SIZES))) / SIZES.sum()
ALONG = np.linspace(0, 0.1, 21)

upper = Body(ALONG, DEPTHS, 200.0, 2.5e6, START, lambda x: abs(x[1]) < 1e-12, theta=0.5, flow=FRICTION / 2)
lower = Body(ALONG, -DEPTHS[::-1], 40.0, 3.9e6, START, lambda x: abs(x[1]) < 1e-12, theta=0.5, flow=FRICTION / 2)
for step in range(1, 101):
    (a, b), (c, d) = upper.begin(STEP), lower.begin(STEP)
    # The flows into both bodies are half of the friction's heat less and plus h D, with the difference D of both surfaces.
    difference = (a - c + (b - d) * FRICTION / 2) / (1 + CONDUCTANCE * (b + d))
    up = upper.end(FRICTION / 2 - CONDUCTANCE * difference)
    down = lower.end(FRICTION / 2 + CONDUCTANCE * difference)
    if step in (50, 100):
        print(f"VALUE temperature 0.05 0 1 {step * STEP:g} {up:.10g}")
        print(f"VALUE temperature 0.05 0 -1 {step * STEP:g} {down:.10g}")
