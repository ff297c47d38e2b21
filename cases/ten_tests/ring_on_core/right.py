#!/usr/bin/env python3
"""A hot ring shrinks onto a core.

A core of 50 mm radius, and around it a ring from 50.02 to 80 mm that is put on at 120 degC while the core has 20 degC; both
end at 20 degC. No friction, no axial displacement (plane strain), elastic: core E = 200 GPa, nu = 0.3; ring E = 70 GPa,
nu = 0.33, alpha = 23e-6 1/K.

Derivation (Lame; Timoshenko and Goodier, section 28, in plane strain: E/(1 - nu^2) and nu/(1 - nu) in place of E and nu).
Without the core the bore of radius b would move by (1 + nu) alpha dT b. What of that is more than the gap of 0.02 mm is
taken up by the core, which a pressure p makes smaller by p a (1 - nu_s)/E_s, and by the ring, whose bore it widens by
p b ((c^2 + b^2)/(c^2 - b^2) + nu_s)/E_s (starred values, each of its own body). In the ring the hoop stress is
p b^2/(c^2 - b^2) (1 + c^2/r^2), the radial one the same with a minus; in the core both are -p.
Radii change by less than 0.3 %, which small strains leave out.
"""
from pathlib import Path
import sys

sys.path.insert(0, str(Path(__file__).resolve().parent.parent))
import table

A, B, C = 0.05, 0.05002, 0.08
DROP = -100.0
E_CORE, NU_CORE = 200e9, 0.3
E_RING, NU_RING, ALPHA = 70e9, 0.33, 23e-6


def plane_strain(e, nu):
    return e / (1 - nu**2), nu / (1 - nu)


E_C, NU_C = plane_strain(E_CORE, NU_CORE)
E_R, NU_R = plane_strain(E_RING, NU_RING)
CORE_GIVES = A * (1 - NU_C) / E_C
RING_GIVES = B * ((C**2 + B**2) / (C**2 - B**2) + NU_R) / E_R
PRESSURE = (-(1 + NU_RING) * ALPHA * DROP * B - (B - A)) / (CORE_GIVES + RING_GIVES)
LAME = PRESSURE * B**2 / (C**2 - B**2)
OUTER = (1 + NU_RING) * ALPHA * DROP * C + 2 * LAME * C / E_R

if __name__ == "__main__":
    # Centres of the first and the last row of elements.
    near, far = B + 0.5 * (0.03 / 15), B + 14.5 * (0.03 / 15)
    middle = 0.5 * 0.004
    table.write(__file__, [
        table.row("pressure", "pressure", (B, middle), 1, PRESSURE * 1e-6, "MPa", PRESSURE * 1e-6),
        table.row("hoop_bore", "stress_tt", (near, middle), 1, LAME * (1 + C**2 / near**2) * 1e-6, "MPa", LAME * 2e-6),
        table.row("hoop_rim", "stress_tt", (far, middle), 1, LAME * (1 + C**2 / far**2) * 1e-6, "MPa", LAME * 2e-6),
        table.row("radial_bore", "stress_rr", (near, middle), 1, LAME * (1 - C**2 / near**2) * 1e-6, "MPa", LAME * 2e-6),
        table.row("radial_core", "stress_rr", (0.025, middle), 1, -PRESSURE * 1e-6, "MPa", PRESSURE * 1e-6),
        table.row("u_rim", "displacement_x", (C + 2e-5, middle), 1, OUTER * 1e6, "um", abs(OUTER) * 1e6)])
