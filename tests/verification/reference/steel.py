# SPDX-License-Identifier: BSD-3-Clause
"""The steel of section 7.1: free energy, stress, entropy, energy, J2 flow (monograph 2.48-2.60, tables 7.1, 7.2).

  Psi = k/2 tr^2 + G |dev|^2 - k e_theta tr + T(Theta)             of the elastic strain    (2.48, 2.49)
  e_theta = 3 [alpha (Theta - Theta_ref) - alpha_0 (Theta_0 - Theta_ref)]                   (2.51)
  s(Theta) = int C_v/Theta,  h(Theta) = int C_v                    from Theta_0             (2.49c)

E, alpha, c are linear in Theta, nu is constant, so k e_theta is a cubic and everything is in closed form. Units:
N, mm, s, K. Every function takes complex numbers (derivatives by the complex step): no abs, no comparison but of
real parts. Strains and stresses are arrays [rr, tt, zz].
"""
import numpy as np

DENSITY = 7.8e-9  # N s^2/mm^4
POISSON = 0.3
AMBIENT = 293.0  # K, also Theta_ref
INITIAL = 593.0  # K, Theta_0 of 2.51


def line(at_273, at_673):
    """Value at 0 K and slope of the straight line through the two entries of table 7.2."""
    slope = (at_673 - at_273) / 400.0
    return at_273 - 273.0 * slope, slope


YOUNG = line(221.9e3, 183.9e3)
ALPHA = line(1.19e-5, 1.39e-5)
HEAT = tuple(DENSITY * x for x in line(0.34e9, 0.39e9))  # rho c, N/(mm^2 K)
CONDUCTIVITY = line(45.29, 39.42)


def at(law, temperature):
    return law[0] + law[1] * temperature


def trace(e):
    return e[0] + e[1] + e[2]


def dev(e):
    return e - trace(e) / 3.0


def dot(a, b):
    return (a * b).sum(axis=0)


def conductivity(temperature):
    return at(CONDUCTIVITY, temperature)


def sensible_entropy(temperature):
    a, b = HEAT
    return a * np.log(temperature / INITIAL) + b * (temperature - INITIAL)


def sensible_heat(temperature):
    a, b = HEAT
    return a * (temperature - INITIAL) + 0.5 * b * (temperature**2 - INITIAL**2)


def sensible_capacity(temperature):
    return at(HEAT, temperature)


class Steel:
    """@param expansion factor on alpha (1, 3, 6);  @param flow_stress sigma_0 [N/mm^2], None: elastic."""

    def __init__(self, expansion=1.0, flow_stress=None):
        self.alpha = tuple(expansion * x for x in ALPHA)
        self.radius = None if flow_stress is None else np.sqrt(2.0 / 3.0) * flow_stress

    def bulk(self, t):
        return at(YOUNG, t) / (3.0 * (1.0 - 2.0 * POISSON))

    def shear(self, t):
        return at(YOUNG, t) / (2.0 * (1.0 + POISSON))

    bulk_slope = YOUNG[1] / (3.0 * (1.0 - 2.0 * POISSON))
    shear_slope = YOUNG[1] / (2.0 * (1.0 + POISSON))

    def thermal_strain(self, t):
        """e_theta and its first and second derivative."""
        a = at(self.alpha, t)
        value = 3.0 * (a * (t - AMBIENT) - at(self.alpha, INITIAL) * (INITIAL - AMBIENT))
        return value, 3.0 * (a + self.alpha[1] * (t - AMBIENT)), 6.0 * self.alpha[1]

    def coupling(self, t):
        """k e_theta and its first and second derivative."""
        k, dk = self.bulk(t), self.bulk_slope
        e, de, dde = self.thermal_strain(t)
        return k * e, dk * e + k * de, 2.0 * dk * de + k * dde

    def stress(self, elastic, t):
        """2.52a"""
        return self.bulk(t) * trace(elastic) - self.coupling(t)[0] + 2.0 * self.shear(t) * dev(elastic)

    def stress_slope(self, elastic, t):
        """d sigma/d Theta at fixed elastic strain."""
        return self.bulk_slope * trace(elastic) - self.coupling(t)[1] + 2.0 * self.shear_slope * dev(elastic)

    def entropy(self, elastic, t):
        """-(W_Theta + M_Theta), without the sensible part (2.52b)."""
        tr, e = trace(elastic), dev(elastic)
        return -0.5 * self.bulk_slope * tr**2 - self.shear_slope * dot(e, e) + self.coupling(t)[1] * tr

    def energy(self, elastic, t):
        """W + M + Theta S, without the sensible part."""
        tr, e = trace(elastic), dev(elastic)
        free = 0.5 * self.bulk(t) * tr**2 + self.shear(t) * dot(e, e) - self.coupling(t)[0] * tr
        return free + t * self.entropy(elastic, t)

    def structural_capacity(self, elastic, t):
        """C - C_v = -Theta (W_ThetaTheta + M_ThetaTheta) (2.127a, with the product terms of the errata)."""
        return t * self.coupling(t)[2] * trace(elastic)

    def flow(self, strain, plastic, t):
        """Closest point projection at a given temperature (4.125-4.147). Returns plastic strain and gamma."""
        trial = dev(strain) - plastic
        norm = np.sqrt(dot(trial, trial) + 1e-300)
        if self.radius is None:
            return plastic, 0.0 * norm
        gamma = norm - self.radius / (2.0 * self.shear(t))
        gamma = np.where(gamma.real > 0.0, gamma, 0.0)
        return plastic + gamma * trial / norm, gamma

    def isentropic(self, strain, plastic, entropy, start):
        """Temperature, plastic strain and gamma at a fixed entropy (4.97): Newton for Theta, gamma eliminated.

        @param entropy sensible and structural entropy that is kept;  @param start first temperature
        """
        t = start + 0.0 * strain[0]
        settled = 0
        for _ in range(60):
            new, gamma = self.flow(strain, plastic, t)
            elastic = strain - new
            residual = sensible_entropy(t) + self.entropy(elastic, t) - entropy
            e = dev(elastic)
            slope = sensible_capacity(t) / t + self.coupling(t)[2] * trace(elastic)
            # plastic: |e| = R/(2 G(Theta)), so -G' |e|^2 changes with Theta too
            slope = slope + np.where(gamma.real > 0.0, 2.0 * self.shear_slope**2 * dot(e, e) / self.shear(t), 0.0)
            step = -residual / slope
            t = t + step
            # two more once the real part has converged: the imaginary parts follow exactly
            settled += bool(np.all(np.abs(step.real) < 1e-10 * np.abs(t.real)))
            if settled == 3:
                new, gamma = self.flow(strain, plastic, t)
                return t, new, gamma
        raise ArithmeticError("no temperature keeps the entropy")
