#!/usr/bin/env python3
"""Two bodies rub on each other, and heat passes between them.

Two blocks of 100 mm, pressed by p = 100 MPa, slide on each other with v = 5 mm/s for 1 s; friction is 0.3, and its heat
q = 0.3 p v = 150 kW/m2 goes to both surfaces in equal parts, between which h = 20 kW/m2/K conducts. Upper block: k = 200 W/m/K,
rho c = 2.5e6 J/m3/K; lower block: k = 40, rho c = 3.9e6. Both elastic, E = 200 GPa, nu = 0, no thermal expansion, 20 degC. All
nodes of the upper block have the displacement v t along x, all of the lower one none, so that friction does not tilt them
and the pressure is even; the top is pressed by p, the bottom stands.

Derivation. Heat reaches 4 and 10 mm deep in 1 s, so that in the middle both are half spaces. A half space that takes the
flow F(t) has, in Laplace's transform, the surface temperature F/(e sqrt(s)), e = sqrt(k rho c). With F = q/2 -+ h D, where D is
the difference of both surfaces (upper less lower), D = q kappa/(s (sqrt(s) + w)), w = h (1/e_1 + 1/e_2) and
kappa = (1/e_1 - 1/e_2)/2, so D = q kappa (1 - exp(w^2 t) erfc(w sqrt(t)))/w; and e_1 T_1 + e_2 T_2 = 2 q sqrt(t/pi), because
what leaves one arrives in the other (Carslaw and Jaeger 1959, sections 2.9 and 12.4).
"""
from math import erfc, exp, pi, sqrt
from pathlib import Path
import sys

sys.path.insert(0, str(Path(__file__).resolve().parent.parent))
import table

Q, H, START = 0.3 * 100e6 * 0.005, 20e3, 20.0
E_UPPER, E_LOWER = sqrt(200 * 2.5e6), sqrt(40 * 3.9e6)


def rises(t):
    """Of the upper and of the lower surface."""
    w, kappa = H * (1 / E_UPPER + 1 / E_LOWER), 0.5 * (1 / E_UPPER - 1 / E_LOWER)
    difference = Q * kappa * (1 - exp(w * w * t) * erfc(w * sqrt(t))) / w
    both = 2 * Q * sqrt(t / pi)
    lower = (both - E_UPPER * difference) / (E_UPPER + E_LOWER)
    return lower + difference, lower


if __name__ == "__main__":
    rows, scale = [], max(rises(1.0))
    for t in (0.5, 1.0):
        upper, lower = rises(t)
        rows.append(table.row(f"T_upper_{t:g}s", "temperature", (0.05, 0, 1), t, START + upper, "degC", scale))
        rows.append(table.row(f"T_lower_{t:g}s", "temperature", (0.05, 0, -1), t, START + lower, "degC", scale))
    table.write(__file__, rows)
