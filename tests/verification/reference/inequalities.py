#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Tries the inequalities (c), (e), (f) of docs/theory/coupling_stability.md on random points of the steel of section 7.1
with a flow stress that falls with temperature. Prints the smallest margin of each; exit code 1 if one is negative.

usage: inequalities.py [POINTS]
"""
import sys

import numpy as np

import steel as law
from steel import dev, dot


class SofteningSteel(law.Steel):
    """sigma_0 = 320 + softening (Theta - 593), not below 5 N/mm^2."""

    def __init__(self, expansion, softening):
        super().__init__(expansion, 320.0)
        self.softening = softening

    def freeze(self, temperature):
        """The yield radius of these temperatures is used from now on."""
        flow_stress = np.maximum(320.0 + self.softening * (temperature - law.INITIAL), 5.0)
        self.radius = np.sqrt(2.0 / 3.0) * flow_stress
        return self.radius


def margins(expansion, softening, n, random):
    s = SofteningSteel(expansion, softening)

    def energy(elastic, t):
        return law.sensible_heat(t) + s.energy(elastic, t)

    def entropy(elastic, t):
        return law.sensible_entropy(t) + s.entropy(elastic, t)

    # an admissible start, a strain step of any size, any temperature at the end
    t_n = random.uniform(320.0, 700.0, n)
    strain_n = 2e-3 * random.normal(size=(3, n))
    radius_n = s.freeze(t_n)
    plastic_n, _ = s.flow(strain_n, dev(2e-3 * random.normal(size=(3, n))), t_n)
    step = 2e-3 * random.normal(size=(3, n)) * 10.0 ** random.uniform(-3.0, 0.0, n)
    t_1 = t_n * (1.0 + random.normal(size=n) * 10.0 ** random.uniform(-4.0, -1.0, n))
    strain = strain_n + step
    energy_n, entropy_n = energy(strain_n - plastic_n, t_n), entropy(strain_n - plastic_n, t_n)

    t_bar, plastic_bar, gamma_bar = s.isentropic(strain, plastic_n, entropy_n, t_n)
    work = dot(s.stress(strain - plastic_bar, t_bar), step)
    dissipated = radius_n * gamma_bar
    c = work - dissipated - (energy(strain - plastic_bar, t_bar) - energy_n)

    def produced(plastic):
        """Theta_1 Delta S minus the heat of the energy form (d)."""
        elastic = strain - plastic
        return t_1 * (entropy(elastic, t_1) - entropy_n) - (energy(elastic, t_1) - energy_n - work)

    e = produced(plastic_bar) - dissipated
    radius_1 = s.freeze(t_1)
    plastic_1, gamma_1 = s.flow(strain, plastic_n, t_1)
    restarted = produced(plastic_1)
    f = restarted - (radius_1 * gamma_1 - (radius_1 - radius_n) * gamma_bar)
    return [x.min() for x in (c, e, f, restarted)]


if __name__ == "__main__":
    points = int(sys.argv[1]) if len(sys.argv) > 1 else 400000
    generator = np.random.default_rng(1)
    print("expansion  softening   (c)        (e)        (f)        entropy produced after a restart   [N/mm^2]")
    lowest = np.inf
    for factor in (1.0, 6.0):
        for slope in (0.0, -0.5, -2.0):
            row = margins(factor, slope, points, generator)
            print(f"{factor:9g}  {slope:9g}   " + "  ".join(f"{x:.2e} " for x in row))
            lowest = min([lowest] + row)
    sys.exit(int(lowest < -1e-9))  # rounding of energies of the order 1e3
