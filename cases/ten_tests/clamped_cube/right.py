#!/usr/bin/env python3
"""A cube that cannot expand is heated.

An elastic cube, all of its surface held in all directions, is heated evenly by 100 K: E = 70 GPa, nu = 0.33,
alpha = 23e-6 1/K.

Derivation. No displacement is a solution: the strain is zero, and the stress sigma = lambda tr(e - alpha dT 1) 1 +
2 mu (e - alpha dT 1) with e = 0 is the same everywhere and thus in balance, -(3 lambda + 2 mu) alpha dT =
-E alpha dT/(1 - 2 nu) in each normal direction and no shear. Linear elasticity has no other solution. Elements of any
shape should give it to rounding.
"""
from pathlib import Path
import sys

sys.path.insert(0, str(Path(__file__).resolve().parent.parent))
import table

E, NU, ALPHA, RISE = 70e9, 0.33, 23e-6, 100.0
STRESS = -E * ALPHA * RISE / (1 - 2 * NU)
PLACES = {"corner": (0.004, 0.008, 0.002), "middle": (0.052, 0.047, 0.049), "side": (0.09, 0.045, 0.03)}

if __name__ == "__main__":
    table.write(__file__, [
        table.row(f"{component}_{name}", f"stress_{component}", place, 1, value * 1e-6, "MPa", abs(STRESS) * 1e-6)
        for name, place in PLACES.items() for component, value in (("xx", STRESS), ("yy", STRESS), ("zz", STRESS), ("xy", 0.0))])
