#!/usr/bin/env python3
"""Plastic work heats a cube that loses no heat.

A cube of 10 mm is compressed by 5 % of its height in 50 equal steps, free on its sides, insulated, small strains.
E = 200 GPa, nu = 0.3, yield stress 300 MPa, linear hardening H = 1 GPa over plastic strain, no thermal expansion; 90 % of
the plastic power becomes heat; rho = 7800 kg/m3, c = 500 J/kg/K; 20 degC at the start.

Derivation. The stress is uniaxial, sigma = E (eps - xi) = sigma_0 + H xi while it flows, so the plastic strain is
xi = (E eps - sigma_0)/(E + H) and the plastic work sigma_0 xi + H xi^2/2: T rises by 0.9 of it over rho c.
"""
from pathlib import Path
import sys

sys.path.insert(0, str(Path(__file__).resolve().parent.parent))
import table

E, YIELD, H, SHARE, RHO, C = 200e9, 300e6, 1e9, 0.9, 7800.0, 500.0


def plastic_strain(strain):
    return (E * strain - YIELD) / (E + H)


def rise(strain):
    xi = plastic_strain(strain)
    return SHARE * (YIELD * xi + 0.5 * H * xi**2) / (RHO * C)


if __name__ == "__main__":
    middle, rows = (0.005, 0.005, 0.005), []
    for time, strain in ((0.5, 0.025), (1, 0.05)):
        rows.append(table.row(f"T_{time:g}s", "temperature", middle, time, 20 + rise(strain), "degC", rise(0.05)))
        stress = -(YIELD + H * plastic_strain(strain)) * 1e-6
        rows.append(table.row(f"zz_{time:g}s", "stress_zz", (0.0025, 0.0025, 0.0025), time, stress, "MPa", 350))
    table.write(__file__, rows)
