#!/usr/bin/env python3
"""An alloy freezes: a range from the liquidus down, and a eutectic that takes what is left.

Half space x > 0, melt of T_i = 660 degC, the wall held at T_w = 450 degC. The solid fraction rises linearly from 0 at the
liquidus T_l = 620 degC to 0.6 at the eutectic T_e = 570 degC, where the rest freezes at one temperature. In all phases
k = 150 W/m/K, c = 1000 J/kg/K, rho = 2500 kg/m3; L = 390 kJ/kg.

Derivation (as Tien and Geiger, J. Heat Transfer 89 (1967) 230). In the mush heat content is linear in T: its capacity is
c_m = c + 0.6 L/(T_l - T_e), its diffusivity a_m = k/(rho c_m). Solid, mush and melt have temperatures A + B erf(eta_i),
eta_i = x/(2 sqrt(a_i t)); both fronts move as 2 lambda sqrt(a t) with a of the solid: one number for the eutectic front,
one for the liquidus. At the eutectic front k dT/dx jumps by rho 0.4 L ds/dt, at the liquidus it does not jump. For each
place of the eutectic front the second condition has one root for the liquidus, and the first then tells the place.
The bar of the mesh is 100 mm long; after 10 s its end differs from the half space by 0.1 K, and no point is asked for
beyond 60 mm, where the difference is below 0.01 K.
"""
from math import erf, erfc, exp, pi, sqrt
from pathlib import Path
import sys

sys.path.insert(0, str(Path(__file__).resolve().parent.parent))
import table

T_WALL, T_EUTECTIC, T_LIQUIDUS, T_START = 450.0, 570.0, 620.0, 660.0
K, C, RHO, LATENT, PRIMARY = 150.0, 1000.0, 2500.0, 390e3, 0.6
C_MUSH = C + PRIMARY * LATENT / (T_LIQUIDUS - T_EUTECTIC)
A, A_MUSH = K / (RHO * C), K / (RHO * C_MUSH)
R = sqrt(A / A_MUSH)


def slope_of_mush(lam, inner, outer):
    """dT/dx sqrt(pi a t) in the mush at x = 2 lam sqrt(a t), its fronts being at inner and outer."""
    return (T_LIQUIDUS - T_EUTECTIC) / (erf(R * outer) - erf(R * inner)) * R * exp(-(R * lam)**2)


def liquidus_front(inner):
    def jump(outer):
        melt = (T_START - T_LIQUIDUS) * exp(-outer**2) / erfc(outer)
        return slope_of_mush(outer, inner, outer) - melt
    return table.root(jump, inner + 1e-9, inner + 3)


def unbalanced(inner):
    solid = (T_EUTECTIC - T_WALL) * exp(-inner**2) / erf(inner)
    mush = slope_of_mush(inner, inner, liquidus_front(inner))
    return K * (solid - mush) - RHO * (1 - PRIMARY) * LATENT * inner * A * sqrt(pi)


INNER = table.root(unbalanced, 1e-3, 1.5)
OUTER = liquidus_front(INNER)


def temperature(x, t):
    eta = x / (2 * sqrt(A * t))
    if eta < INNER:
        return T_WALL + (T_EUTECTIC - T_WALL) * erf(eta) / erf(INNER)
    if eta < OUTER:
        return T_EUTECTIC + (T_LIQUIDUS - T_EUTECTIC) * (erf(R * eta) - erf(R * INNER)) / (erf(R * OUTER) - erf(R * INNER))
    return T_START - (T_START - T_LIQUIDUS) * erfc(eta) / erfc(OUTER)


if __name__ == "__main__":
    table.write(__file__, [
        table.row(f"T_{mm}mm_{t}s", "temperature", (mm / 1000, 0), t, temperature(mm / 1000, t), "degC", T_START - T_WALL)
        for t, places in ((4, (4, 8, 14, 18, 30)), (10, (5, 10, 20, 30, 50))) for mm in places])
