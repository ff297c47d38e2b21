#!/usr/bin/env python3
"""Freezing in a corner: two cold walls meet at a right angle.

Quarter space x, y > 0, melt of 630 degC, freezing at T_m = 600 degC, both walls held at 500 degC from t = 0 on; solid and melt
alike: k = 150 W/m/K, rho c = 2.5e6 J/m3/K, L = 25 kJ/kg with c = 1000 J/kg/K (the case of Rathjen and Jiji, J. Heat Transfer 93
(1971) 101: (T_i - T_m)/(T_m - T_w) = 0.3, L/(c (T_m - T_w)) = 0.25).

Derivation. There is no closed form. Everything depends on x/sqrt(4 a t) and y/sqrt(4 a t), so that one field holds for all times.
Here it is computed by the enthalpy method on square cells, explicit in time, which has nothing in common with finite
elements, from the time at which the corner has six cells of frozen metal on: far from the corner from Neumann's solution.
Three grids show how far it has converged (0.02 K); the last two are extrapolated, which takes a minute (--coarse: half a second). The script compares, far from the corner, with Neumann's closed form, and the front in the
diagonal with Rathjen and Jiji's curve f(x) = (lambda^m + C/(x^m - lambda^m))^(1/m), lambda = 0.70766, C = 0.159, m = 5.02, whose
diagonal is at x = y = 0.896.
"""
from pathlib import Path
import sys

sys.path.insert(0, str(Path(__file__).resolve().parent.parent))
import table

from math import erf, erfc, exp, pi, sqrt

import numpy as np

T_WALL, T_MELT, T_START, K, RHO, C, LATENT = 500.0, 600.0, 630.0, 150.0, 2500.0, 1000.0, 25e3
A = K / (RHO * C)
LAMBDA = table.root(lambda l: (T_MELT - T_WALL) * exp(-l * l) / erf(l) - (T_START - T_MELT) * exp(-l * l) / erfc(l)
                    - LATENT / C * l * sqrt(pi), 0.1, 2)
PLACES = (10, 20, 24, 30, 36, 44)  # in the diagonal [mm] at 6 s


def neumann(eta):
    if eta < LAMBDA:
        return T_WALL + (T_MELT - T_WALL) * erf(eta) / erf(LAMBDA)
    return T_START - (T_START - T_MELT) * erfc(eta) / erfc(LAMBDA)


def field(n, reach=3.0):
    """Temperatures at the centres of n by n cells over [0, reach] in x/sqrt(4 a t) at the last time.

    Lengths are in cells and temperatures as they are; heat content h = T - T_m of the solid, T - T_m + L/c of the melt.
    """
    heat = LATENT / C
    end = (n / reach)**2 / 4  # a t, at which one unit of the similarity variable has n/reach cells
    now = end / n**2 * 36     # the units have six cells at first
    eta = (np.arange(n) + 0.5) / sqrt(4 * now)
    line = np.array([neumann(e) for e in eta])
    # Near a wall its own solution; near the corner both walls: the smaller of the two is close enough to start from.
    h = np.minimum(line[:, None], line[None, :]) - T_MELT
    h = np.where(h > 0, h + heat, h)
    padded = np.empty((n + 2, n + 2))
    while now < end:
        step = min(0.2, end - now)
        t = np.minimum(h, 0) + np.maximum(h - heat, 0)
        padded[1:-1, 1:-1] = t
        padded[0, 1:-1] = 2 * (T_WALL - T_MELT) - t[0]
        padded[1:-1, 0] = 2 * (T_WALL - T_MELT) - t[:, 0]
        padded[-1, 1:-1], padded[1:-1, -1] = t[-1], t[:, -1]
        h += step * (padded[2:, 1:-1] + padded[:-2, 1:-1] + padded[1:-1, 2:] + padded[1:-1, :-2] - 4 * t)
        now += step
    return T_MELT + np.minimum(h, 0) + np.maximum(h - heat, 0), reach / n


def diagonal(n):
    """Temperatures at PLACES, and the place of the front in the diagonal."""
    t, size = field(n)
    on = np.diag(t)
    eta = (np.arange(n) + 0.5) * size
    unit = sqrt(4 * A * 6.0)
    # The cells around the front are at T_m for a while: the front is where the lines from both sides, two cells off, meet.
    frozen = int(np.sum(on < T_MELT - 1e-9))
    k = frozen - 4
    front = eta[k] + (T_MELT - on[k]) * size / (on[k + 1] - on[k])
    side = t[:, int(0.97 * n)]
    off = max(abs(side[i] - neumann(eta[i])) for i in range(n))
    return np.interp([p / 1000 / unit for p in PLACES], eta, on), front, off


if __name__ == "__main__":
    grids = [60, 120] if "--coarse" in sys.argv else [120, 240, 480]
    found = [diagonal(n) for n in grids]
    values = 2 * found[-1][0] - found[-2][0]
    assert abs(LAMBDA - 0.70766) < 1e-5
    print("far from the corner off Neumann by [K]:", [round(f[2], 3) for f in found], file=sys.stderr)
    print("front in the diagonal:", [round(f[1], 4) for f in found], "Rathjen and Jiji: 0.896", file=sys.stderr)
    print("last grids differ by [K]:", np.abs(found[-1][0] - found[-2][0]).max().round(3), file=sys.stderr)
    table.write(__file__, [table.row(f"T_{p}mm", "temperature", (p / 1000, p / 1000), 6, v, "degC", T_START - T_WALL)
                           for p, v in zip(PLACES, values)])
