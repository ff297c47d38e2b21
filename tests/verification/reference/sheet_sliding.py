# SPDX-License-Identifier: BSD-3-Clause
"""Section 7.2 of the monograph without finite elements: what every pass of the sliding test must show.

A tool presses on a sheet with the force P per width and slides. The coefficient of friction is a polynomial of the
internal variable zeta, which grows at a point of the sheet with the slip s there,

    law a   d zeta = p ds           normal work, 3.53b       [kN/mm]
    law b   d zeta = mu(zeta) p ds  frictional work          [kN/cm]

Closed form. On the plateau every point sees the whole pressure profile pass over it: the integral of p ds is P, whatever the
shape of the profile. Under the tool lie points in every state between those of the pass before and of this one, and the integral of
mu p ds over them is the force: the force ratio is the mean of mu over the pass, with the normal work as the measure.

Strip. The whole stroke with its ends: points of a rigid sheet under a rigid sole (flat and quarter circle) on springs eps_N,
so p = eps_N <penetration>, and friction returned to mu p from springs eps_T. The springs take up mu p / eps_T
of a point's way before it slips, which the closed form does not know. Steps are those of the case, or finer ones.

Units N, mm; zeta as above. Writes sheet_sliding_closed_form.csv and sheet_sliding_strip.csv next to this file.
"""
import csv
from pathlib import Path

import numpy as np

WIDTH = 10.0
FORCES = (3920, 2940, 1960, 980)
PASSES = 20
STEELS = {"ga": (0.178, -0.666e-2), "eg": (0.157, -0.315e-1, 0.104e-1, -0.821e-3, 0.289e-4, -0.410e-6)}
UNIT = {"a": 1e-3, "b": 1e-2}  # of zeta in N/mm: kN/mm, kN/cm


def coefficient(steel, zeta):
    return np.polynomial.polynomial.polyval(zeta, STEELS[steel])


def after(steel, law, zeta, work):
    """zeta after the normal work [N/mm] on a point that had `zeta`; law b by Runge and Kutta's method."""
    if law == "a":
        return zeta + UNIT[law] * work
    step = UNIT[law] * work / 200
    for _ in range(200):
        k1 = coefficient(steel, zeta)
        k2 = coefficient(steel, zeta + 0.5 * step * k1)
        k3 = coefficient(steel, zeta + 0.5 * step * k2)
        k4 = coefficient(steel, zeta + step * k3)
        zeta += step * (k1 + 2 * k2 + 2 * k3 + k4) / 6
    return zeta


def closed_form(steel, law, force):
    """One row a pass: zeta on the plateau after it, its force ratio at mid stroke."""
    line, zeta, rows = force / WIDTH, 0.0, []
    for number in range(1, PASSES + 1):
        new = after(steel, law, zeta, line)
        if law == "a":
            work = np.polynomial.polynomial.polyint(STEELS[steel])
            ratio = np.diff(np.polynomial.polynomial.polyval([zeta, new], work))[0] / (new - zeta)
        else:
            ratio = (new - zeta) / (UNIT[law] * line)  # zeta is the frictional work itself
        rows.append((number, new, ratio))
        zeta = new
    return rows


class Strip:
    LENGTH, START, FLAT, RADIUS, STROKE = 30.0, 2.5, 7.5, 2.5, 20.0
    NORMAL, TANGENTIAL = 500.0, 100.0  # eps_N, eps_T [N/mm3]

    def __init__(self, steel, law, force, steps=20, points=1200):
        self.steel, self.law, self.line, self.steps = steel, law, force / WIDTH, steps
        self.h = self.LENGTH / points
        self.x = (np.arange(points) + 0.5) * self.h
        self.zeta = np.zeros(points)

    def gap(self, travel):
        """Height of the sole above its flat."""
        s = self.x - self.START - travel
        beyond = np.clip(s - self.FLAT, 0, self.RADIUS)
        arc = self.RADIUS - np.sqrt(np.maximum(self.RADIUS**2 - beyond**2, 0))
        return np.where((s < 0) | (s > self.FLAT + self.RADIUS), np.inf, arc)

    def pressure(self, travel):
        """The sole goes down until the pressures carry the force."""
        gap, low, high = self.gap(travel), 0.0, 1.0
        for _ in range(60):
            middle = 0.5 * (low + high)
            carried = self.h * self.NORMAL * np.maximum(middle - gap, 0).sum()
            low, high = (middle, high) if carried < self.line else (low, middle)
        return self.NORMAL * np.maximum(high - gap, 0)

    def slide(self):
        """One pass; the force ratio after every step, the first one before sliding."""
        traction, ratios = np.zeros_like(self.x), [0.0]
        way = self.STROKE / self.steps
        for step in range(1, self.steps + 1):
            p = self.pressure(way * step)
            trial = traction + self.TANGENTIAL * way
            zeta, slip = self.zeta.copy(), np.zeros_like(p)
            for _ in range(50):  # mu at the end of the step: a contraction, d mu / d zeta is small
                mu = coefficient(self.steel, zeta)
                traction = np.minimum(trial, mu * p)
                slip = np.where(p > 0, (trial - traction) / self.TANGENTIAL, 0)
                zeta = self.zeta + UNIT[self.law] * slip * p * (1 if self.law == "a" else mu)
            self.zeta = zeta
            ratios.append(self.h * traction.sum() / self.line)
        return ratios

    def plateau(self):
        return self.zeta[(self.x > 12.5) & (self.x < 22.5)]


def main():
    folder = Path(__file__).parent
    with (folder / "sheet_sliding_closed_form.csv").open("w", newline="") as file:
        table = csv.writer(file, lineterminator="\n")
        table.writerow(["steel", "law", "force[N]", "pass", "zeta", "ratio"])
        for steel in STEELS:
            for law in UNIT:
                for force in FORCES:
                    for number, zeta, ratio in closed_form(steel, law, force):
                        table.writerow([steel, law, force, number, f"{zeta:.8g}", f"{ratio:.8g}"])
    with (folder / "sheet_sliding_strip.csv").open("w", newline="") as file:
        table = csv.writer(file, lineterminator="\n")
        table.writerow(["steel", "law", "force[N]", "pass", "tool_displacement[mm]", "ratio"])
        for steel in STEELS:
            for law in UNIT:
                for force in FORCES:
                    strip, exact = Strip(steel, law, force), closed_form(steel, law, force)
                    for number, zeta, ratio in exact:
                        ratios = strip.slide()
                        for step, r in enumerate(ratios):
                            table.writerow([steel, law, force, number, step, f"{r:.6g}"])
                        middle = ratios[10] / ratio - 1
                    plateau = strip.plateau()
                    print(f"{steel} {law} {force} N: zeta {zeta:.4f}, strip {plateau.mean() / zeta - 1:+.2%} "
                          f"({plateau.min() / zeta - 1:+.1%} to {plateau.max() / zeta - 1:+.1%}); "
                          f"ratio {exact[0][2]:.4f} to {ratio:.4f}, strip {middle:+.2%}")


if __name__ == "__main__":
    main()
