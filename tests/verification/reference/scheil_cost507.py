# SPDX-License-Identifier: BSD-3-Clause
"""Scheil solidification of Al-Si-Mg alloys with the thermodynamic assessment of COST 507 (I. Ansara, A. T. Dinsdale,
M. H. Rand, eds., Thermochemical database for light metal alloys, European Communities 1998; pure elements: A. T.
Dinsdale, CALPHAD 15, 1991). Writes scheil_cost507.csv, with which liquidus_system_test compares the straight lines of
the library. Shares no code with Solidus: Gibbs energies, chemical potentials by the complex step, local equilibrium
step by step. Needs numpy and scipy: /usr/bin/python3 scheil_cost507.py

Phases: melt, aluminium solid solution, silicon (pure), Mg2Si. The calculation ends where Mg2Si begins to freeze, at the
ternary eutectic, where what is left freezes at one temperature."""
from pathlib import Path

import numpy as np
from scipy.optimize import fsolve

GAS_CONSTANT = 8.31451  # J/(mol K), of the assessment
MOLAR_MASS = np.array([26.98154, 24.305, 28.0855])  # Al, Mg, Si [g/mol]
ALLOYS = [(5, 0.5), (7, 0.3), (7, 0.35), (7, 0.6), (9, 0.3), (10, 0.35)]  # Si, Mg in weight per cent


# Gibbs energies of the pure elements [J/mol] at a temperature T [K].
def aluminium(T):
    if T < 700:
        return (-7976.15 + 137.093038 * T - 24.3671976 * T * np.log(T) - 1.884662e-3 * T**2 - 0.877664e-6 * T**3
                + 74092 / T)
    if T < 933.47:
        return (-11276.24 + 223.048446 * T - 38.5844296 * T * np.log(T) + 18.531982e-3 * T**2 - 5.764227e-6 * T**3
                + 74092 / T)
    return -11278.378 + 188.684153 * T - 31.748192 * T * np.log(T) - 1230.524e25 * T**-9


def magnesium(T):
    return (-8367.34 + 143.675547 * T - 26.1849782 * T * np.log(T) + 0.4858e-3 * T**2 - 1.393669e-6 * T**3
            + 78950 / T)


def silicon(T):
    return (-8162.609 + 137.236859 * T - 22.8317533 * T * np.log(T) - 1.912904e-3 * T**2 - 0.003552e-6 * T**3
            + 176667 / T)


def liquid_aluminium(T):
    if T < 933.47:
        return aluminium(T) + 11005.029 - 11.841867 * T + 7.934e-20 * T**7
    return aluminium(T) + 10482.282 - 11.253974 * T + 1.231e28 * T**-9


def liquid_magnesium(T):
    return magnesium(T) + 8202.243 - 8.83693 * T - 8.0176e-20 * T**7


def liquid_silicon(T):
    return silicon(T) + 50696.4 - 30.0994 * T + 2.09307e-21 * T**7


def series(x, y, coefficients):
    """Redlich-Kister: the excess energy of a pair."""
    return x * y * sum(c * (x - y)**k for k, c in enumerate(coefficients))


def ideal_mixing(x, T):
    return GAS_CONSTANT * T * sum(c * np.log(c) for c in x)


def melt(x, T):
    """Gibbs energy of the melt; x: mole fractions of Al, Mg, Si."""
    al, mg, si = x
    g = al * liquid_aluminium(T) + mg * liquid_magnesium(T) + si * liquid_silicon(T) + ideal_mixing(x, T)
    g += series(al, mg, [-12000 + 8.566 * T, 1894 - 3 * T, 2000])
    g += series(al, si, [-11340.1 - 1.23394 * T, -3530.93 + 1.35993 * T, 2265.39])
    g += series(mg, si, [-83864.26 + 32.44438 * T, 18027.41 - 19.61202 * T, 2486.67 - 0.31084 * T,
                         18541.17 - 2.31766 * T, -12338.84 + 1.54236 * T])
    ternary = [4125.86 - 0.51573 * T, -47961.64 + 5.9952 * T, 25813.8 - 3.22672 * T]
    rest = (1 - al - mg - si) / 3
    return g + al * mg * si * sum(c * (fraction + rest) for c, fraction in zip(ternary, x))


def solid_solution(x, T):
    al, mg, si = x
    g = al * aluminium(T) + mg * (2600 - 0.9 * T + magnesium(T)) + si * (51000 - 21.8 * T + silicon(T))
    g += ideal_mixing(x, T) + series(al, mg, [4971 - 3.5 * T, 900 + 0.423 * T, 950])
    return g + series(al, si, [-3143.78 + 0.39297 * T]) + series(mg, si, [-7148.79 + 0.89361 * T])


def magnesium_silicide(T):
    """Per mole of Mg2Si."""
    return -92250 + 440.4 * T - 75.9 * T * np.log(T) - 0.0018 * T**2 + 630000 / T


def potentials(energy, x, T):
    """Chemical potentials: the derivatives of n g(n / sum n) with respect to the three amounts n, at one mole."""
    step, result = 1e-30, []
    for i in range(3):
        n = np.array(x, complex)
        n[i] += 1j * step
        result.append((n.sum() * energy(n / n.sum(), T)).imag / step)
    return np.array(result)


def composition(solutes):
    return np.array([1 - sum(solutes), *solutes])


class Freezing:
    """Melt of the composition `solutes` (mole fractions of Mg, Si) and the moles of it that are left."""

    def __init__(self, si, mg):
        n = np.array([100 - si - mg, mg, si]) / MOLAR_MASS
        self.solutes, self.moles, self.valley = n[1:] / n.sum(), 1.0, False
        self.all_mass = composition(self.solutes) @ MOLAR_MASS
        guess = [0.97, *np.log(self.solutes * [0.3, 0.12])]
        found = fsolve(lambda v: self.equilibrium(v[0] * 900, self.solutes, np.exp(v[1:])), guess, xtol=1e-12)
        self.liquidus, self.solid = found[0] * 900, np.exp(found[1:])

    @staticmethod
    def equilibrium(T, melt_solutes, solid_solutes):
        difference = (potentials(melt, composition(melt_solutes), T)
                      - potentials(solid_solution, composition(solid_solutes), T))
        return difference / (GAS_CONSTANT * T)

    def mass_fraction(self):
        return self.moles * (composition(self.solutes) @ MOLAR_MASS) / self.all_mass

    def cool_to(self, T):
        """Freezes what a step in temperature takes; returns whether Mg2Si has begun."""
        shares = [0.05, 0.005] if self.valley else [0.01]

        def defect(v):
            new, solid = np.exp(v[:2]), np.exp(v[2:4])
            frozen, pure_silicon = v[4], (v[5] if self.valley else 0)
            balance = (1 - frozen - pure_silicon) * new + frozen * solid + [0, pure_silicon]
            equations = [*self.equilibrium(T, new, solid), *(balance / self.solutes - 1)]
            if self.valley:
                equations.append((potentials(melt, composition(new), T)[2] - silicon(T)) / (GAS_CONSTANT * T))
            return equations

        v = fsolve(defect, [*np.log(self.solutes), *np.log(self.solid), *shares], xtol=1e-12)
        new = np.exp(v[:2])
        mu = potentials(melt, composition(new), T)
        if not self.valley and mu[2] > silicon(T):
            self.valley = True  # the step is made once more, with silicon
            return self.cool_to(T)
        if self.valley and 2 * mu[1] + mu[2] > magnesium_silicide(T):
            return True
        self.moles *= 1 - v[4:].sum()
        self.solutes, self.solid = new, np.exp(v[2:4])
        return False


def main():
    step = 0.1
    with open(Path(__file__).with_suffix(".csv"), "w", encoding="utf-8") as table:
        table.write("alloy,event,temperature[degC],liquid_fraction\n")
        for si, mg in ALLOYS:
            freezing = Freezing(si, mg)

            def row(event, T):
                table.write(f"Al-{si}Si-{mg}Mg,{event},{T - 273.15:.1f},{freezing.mass_fraction():.4f}\n")

            row("liquidus", freezing.liquidus)
            T = np.floor((freezing.liquidus - 273.15) / step) * step + 273.15
            while not freezing.cool_to(T):
                if abs((T - 273.15) / 5 - round((T - 273.15) / 5)) < 1e-6:
                    row("valley" if freezing.valley else "primary", T)
                T -= step
            row("ternary_eutectic", T)


if __name__ == "__main__":
    main()
