#!/usr/bin/env python3
"""A gap that closes, and conducts what its width allows.

Two bars of 100 mm in a line, the outer ends held and kept at T_h and T_c, insulated along their sides, with a gap of
0.1 mm between them when all is at 20 degC. Left bar: E = 70 GPa, alpha = 23e-6 1/K, k = 200 W/m/K; right bar: E = 200 GPa,
alpha = 12e-6 1/K, k = 40 W/m/K; nu = 0 in both, rho c = 2.5e6 and 3.9e6 J/m3/K. The gap g conducts k_g/(g + k_g/h_0) with
k_g = 0.05 W/m/K and h_0 = 5000 W/m2/K, and h_0 where the bars touch. T_c = 20 degC. T_h rises to 55 degC within 1000 s and is
held until 20000 s (the gap stays open), then within 1000 s to 300 degC and is held until 40000 s (it closes).

Derivation. Long after a change (the slower bar has L^2/a = 970 s) each bar has a straight line of temperature. With the heat
flow q both ends of the gap are at T_h - q L/k_1 and T_c + q L/k_2, and the bars grow by alpha L times their mean
temperature over 20 degC. Open: g = g_0 - growth, and q = h(g) times the difference of both ends: one equation for g.
Closed: q from three resistances in a row, and the growth beyond g_0 is pressed back, p = excess/(L/E_1 + L/E_2). The script
asserts that each state has one solution of its kind and none of the other.
"""
from pathlib import Path
import sys

sys.path.insert(0, str(Path(__file__).resolve().parent.parent))
import table

L, GAP, REFERENCE = 0.1, 1e-4, 20.0
E1, ALPHA1, K1 = 70e9, 23e-6, 200.0
E2, ALPHA2, K2 = 200e9, 12e-6, 40.0
K_GAS, H0, COLD = 0.05, 5000.0, 20.0


def state(hot, conductance):
    """Temperatures at both ends of the gap, and by how much it is open where nothing presses."""
    q = (hot - COLD) / (L / K1 + 1 / conductance + L / K2)
    one, two = hot - q * L / K1, COLD + q * L / K2
    growth = ALPHA1 * L * (0.5 * (hot + one) - REFERENCE) + ALPHA2 * L * (0.5 * (COLD + two) - REFERENCE)
    return one, two, GAP - growth


def conductance(gap):
    return K_GAS / (gap + K_GAS / H0)


def open_gaps(hot):
    """All gaps above zero at which the width fits what the heat makes of it."""
    def misfit(gap):
        return state(hot, conductance(gap))[2] - gap
    grid = [GAP * i / 2000 for i in range(2001)]
    return [table.root(misfit, a, b) for a, b in zip(grid, grid[1:]) if (misfit(a) > 0) != (misfit(b) > 0)]


if __name__ == "__main__":
    (gap,) = open_gaps(55.0)
    assert state(55.0, H0)[2] > 0
    warm = state(55.0, conductance(gap))
    assert open_gaps(300.0) == []
    hot = state(300.0, H0)
    pressure = -hot[2] / (L / E1 + L / E2)
    left, right = (L, 0.005), (L + GAP, 0.005)
    table.write(__file__, [
        table.row("T_left_open", "temperature", left, 20000, warm[0], "degC", 50),
        table.row("T_right_open", "temperature", right, 20000, warm[1], "degC", 50),
        table.row("gap_open", "gap", left, 20000, gap * 1e6, "um", GAP * 1e6),
        table.row("T_left_closed", "temperature", left, 40000, hot[0], "degC", 280),
        table.row("T_right_closed", "temperature", right, 40000, hot[1], "degC", 280),
        table.row("pressure_closed", "pressure", left, 40000, pressure * 1e-6, "MPa", pressure * 1e-6)])
