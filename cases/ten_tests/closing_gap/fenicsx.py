"""A gap that closes and conducts, for DOLFINx: heat by backward Euler in steps of 500 s, and what the bars grow by from their mean
temperatures, since nu = 0 and their sides are free. Flow and gap of a step are found together by bisection of the gap; where the bars
overlap without it, they touch, and the excess is pressed back. /usr/bin/python3 fenicsx.py
"""
from pathlib import Path
import sys

import numpy as np

sys.path.insert(0, str(Path(__file__).resolve().parent.parent))
from bars_dolfinx import Body

LENGTH, GAP, COLD, STEP = 0.1, 1e-4, 20.0, 500.0
GAS, CLOSED = 0.05, 5000.0
LEFT_E, LEFT_ALPHA, RIGHT_E, RIGHT_ALPHA = 70e9, 23e-6, 200e9, 12e-6

left = Body(np.linspace(0, LENGTH, 21), np.linspace(0, 0.01, 3), 200.0, 2.5e6, COLD, lambda x: x[0] > LENGTH - 1e-9,
            lambda x: x[0] < 1e-9)
right = Body(np.linspace(LENGTH + GAP, 2 * LENGTH + GAP, 21), np.linspace(0, 0.01, 4), 40.0, 3.9e6, COLD,
             lambda x: x[0] < LENGTH + GAP + 1e-9, lambda x: x[0] > 2 * LENGTH + GAP - 1e-9)


def hot(t):
    return np.interp(t, [0, 1000, 20000, 21000, 40000], [20, 55, 55, 300, 300])


def pass_heat(conductance):
    """Ends the step with this conductance: temperatures of both ends, and the gap that they would leave."""
    flow = (a - c) / (1 / conductance + b + d)
    ends = left.end(-flow), right.end(flow)
    return *ends, GAP - LENGTH * (LEFT_ALPHA * (left.mean() - COLD) + RIGHT_ALPHA * (right.mean() - COLD))


for step in range(1, 81):
    time = step * STEP
    (a, b), (c, d) = left.begin(STEP, hot(time)), right.begin(STEP, COLD)
    one, two, free = pass_heat(CLOSED)
    pressure = max(0.0, -free) / (LENGTH / LEFT_E + LENGTH / RIGHT_E)
    gap = 0.0
    if free > 0:
        low, high = 0.0, 2 * GAP
        for _ in range(60):
            gap = 0.5 * (low + high)
            one, two, free = pass_heat(GAS / (gap + GAS / CLOSED))
            low, high = (gap, high) if free > gap else (low, gap)
    if step in (40, 80):
        print(f"VALUE temperature {LENGTH} 0.005 0 {time:g} {one:.10g}")
        print(f"VALUE temperature {LENGTH + GAP:.10g} 0.005 0 {time:g} {two:.10g}")
        print(f"VALUE gap {LENGTH} 0.005 0 {time:g} {1e6 * gap:.10g}")
        print(f"VALUE pressure {LENGTH} 0.005 0 {time:g} {1e-6 * pressure:.10g}")
