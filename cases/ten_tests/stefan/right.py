#!/usr/bin/env python3
"""Stefan and Neumann: a superheated pure metal freezes from a cold wall.

Half space x > 0, melt of 720 degC, freezing at T_m = 660 degC, the wall held at T_w = 400 degC from t = 0 on. In the
solid k_s = 200 W/m/K and c_s = 1000 J/kg/K, in the melt k_l = 90 and c_l = 1100; rho = 2500 kg/m3 in both, L = 390 kJ/kg.

Derivation (Neumann; Carslaw and Jaeger 1959, section 11.2). With a = k/(rho c) the front is at s = 2 lambda sqrt(a_s t),

    T = T_w + (T_m - T_w) erf(x/(2 sqrt(a_s t)))/erf(lambda)                       x < s
    T = T_i - (T_i - T_m) erfc(x/(2 sqrt(a_l t)))/erfc(lambda sqrt(a_s/a_l))       x > s

each of which solves the equation of conduction and the conditions at the wall, at the front and far away. Heat that
arrives at the front and leaves it differ by the latent heat, k_s dT/dx(s-) - k_l dT/dx(s+) = rho L ds/dt, whose only
root is lambda. The bar of the mesh is 100 mm long; after 10 s its end differs from the half space by 0.002 K.
"""
from math import erf, erfc, exp, pi, sqrt
from pathlib import Path
import sys

sys.path.insert(0, str(Path(__file__).resolve().parent.parent))
import table

T_WALL, T_MELT, T_START = 400.0, 660.0, 720.0
K_S, C_S, K_L, C_L, RHO, LATENT = 200.0, 1000.0, 90.0, 1100.0, 2500.0, 390e3
A_S, A_L = K_S / (RHO * C_S), K_L / (RHO * C_L)


def unbalanced(lam):
    """Heat into the front less heat out of it and latent heat, times sqrt(pi t a_s)."""
    nu = lam * sqrt(A_S / A_L)
    out = K_S * (T_MELT - T_WALL) * exp(-lam**2) / erf(lam)
    into = K_L * sqrt(A_S / A_L) * (T_START - T_MELT) * exp(-nu**2) / erfc(nu)
    return out - into - RHO * LATENT * lam * A_S * sqrt(pi)


LAMBDA = table.root(unbalanced, 1e-3, 3)


def temperature(x, t):
    if x < 2 * LAMBDA * sqrt(A_S * t):
        return T_WALL + (T_MELT - T_WALL) * erf(x / (2 * sqrt(A_S * t))) / erf(LAMBDA)
    return T_START - (T_START - T_MELT) * erfc(x / (2 * sqrt(A_L * t))) / erfc(LAMBDA * sqrt(A_S / A_L))


if __name__ == "__main__":
    table.write(__file__, [
        table.row(f"T_{mm}mm_{t}s", "temperature", (mm / 1000, 0), t, temperature(mm / 1000, t), "degC", T_START - T_WALL)
        for t, places in ((4, (5, 10, 15, 25, 35)), (10, (5, 10, 20, 35, 50))) for mm in places])
