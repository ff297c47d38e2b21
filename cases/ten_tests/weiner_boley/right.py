#!/usr/bin/env python3
"""Weiner and Boley: the stress in a shell that freezes from a cold wall.

Melt at its freezing point T_m = 1494.4 degC (start 0.1 K above it), the wall x = 0 held at T_w = 1000 degC. k = 33 W/m/K,
c = 661 J/kg/K, rho = 7500 kg/m3, L = 272 kJ/kg, E = 40 GPa, nu = 0.35, alpha = 2e-5 1/K, elastic and perfectly plastic with a yield
stress that falls from Y_w = 20 MPa at T_w linearly to nothing at T_m (data of Koric and Thomas, Int. J. Numer. Meth. Engng 66
(2006) 1955). The shell stays flat and carries no net force: both strains in its plane are the same everywhere, sigma_x = 0.

Derivation (J. Mech. Phys. Solids 11 (1963) 145). The front is s = 2 lambda sqrt(a t), sqrt(pi) lambda exp(lambda^2) erf(lambda)
= c (T_m - T_w)/L, T = T_w + (T_m - T_w) erf(lambda xi)/erf(lambda) with xi = x/s. No other length exists, so the stress in the
plane is a function of xi, d/dt = -xi/(2 t) d/dxi and the strain rate is C/(2 t). A point freezes in tension and flows,
unloads at xi_2 where the plastic rate is zero, C + xi_2 (alpha T' + (1 - nu)/E Y') = 0, is elastic between xi_1 and xi_2,

    sigma = Y(xi_2) - E/(1 - nu) (C ln(xi/xi_2) + alpha (T - T(xi_2))),

and flows in compression below xi_1, where that reaches -Y. No net force gives the third number of C, xi_1 and xi_2.
"""
from math import erf, exp, log, pi, sqrt
from pathlib import Path
import sys

sys.path.insert(0, str(Path(__file__).resolve().parent.parent))
import table

T_WALL, T_MELT, K, C, RHO, LATENT = 1000.0, 1494.4, 33.0, 661.0, 7500.0, 272e3
MODULUS, ALPHA, YIELD = 40e9 / (1 - 0.35), 2e-5, 20e6
A = K / (RHO * C)
LAMBDA = table.root(lambda l: sqrt(pi) * l * exp(l * l) * erf(l) - C * (T_MELT - T_WALL) / LATENT, 1e-6, 3)


def temperature(xi):
    return T_WALL + (T_MELT - T_WALL) * erf(LAMBDA * xi) / erf(LAMBDA) if xi < 1 else T_MELT


def slope(xi):
    return (T_MELT - T_WALL) * 2 * LAMBDA / sqrt(pi) * exp(-(LAMBDA * xi)**2) / erf(LAMBDA)


def yield_stress(xi):
    return YIELD * (T_MELT - temperature(xi)) / (T_MELT - T_WALL)


class Shell:
    """The stress that goes with a place xi_2 at which tension begins."""

    def __init__(self, tension):
        self.tension = tension
        self.rate = -tension * slope(tension) * (ALPHA - YIELD / (T_MELT - T_WALL) / MODULUS)
        self.compression = table.root(lambda xi: self.elastic(xi) + yield_stress(xi), 1e-9, tension)

    def elastic(self, xi):
        grown = ALPHA * (temperature(xi) - temperature(self.tension))
        return yield_stress(self.tension) - MODULUS * (self.rate * log(xi / self.tension) + grown)

    def stress(self, xi):
        if xi >= 1:
            return 0.0
        if xi >= self.tension:
            return yield_stress(xi)
        return -yield_stress(xi) if xi <= self.compression else self.elastic(xi)

    def force(self, n=400):
        """Integral of the stress by Simpson's rule on each part, on which it is smooth."""
        limits, total = (1e-12, self.compression, self.tension, 1 - 1e-12), 0.0
        for low, high in zip(limits, limits[1:]):
            h = (high - low) / n
            for i in range(n):
                ends = self.stress(low + i * h + 1e-13) + self.stress(low + (i + 1) * h - 1e-13)
                total += h / 6 * (ends + 4 * self.stress(low + (i + 0.5) * h))
        return total


SHELL = Shell(table.root(lambda tension: Shell(tension).force(), 0.3, 0.999))


def front(t):
    return 2 * LAMBDA * sqrt(A * t)


if __name__ == "__main__":
    rows, cell = [], 0.0004
    for t, elements in ((5, (1, 5, 9, 13)), (21, (1, 8, 14, 20, 26))):
        for element in elements:
            x = (element + 0.5) * cell
            rows.append(table.row(f"yy_{x * 1e3:.1f}mm_{t}s", "stress_yy", (x, 0.5 * cell, 0.5 * cell), t,
                                  SHELL.stress(x / front(t)) * 1e-6, "MPa", YIELD * 1e-6))
    for mm in (4, 8, 12, 20):
        rows.append(table.row(f"T_{mm}mm_21s", "temperature", (mm / 1000, 0, 0), 21, temperature(mm / 1000 / front(21)), "degC",
                              T_MELT - T_WALL))
    table.write(__file__, rows)
