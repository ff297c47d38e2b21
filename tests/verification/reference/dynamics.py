# SPDX-License-Identifier: BSD-3-Clause
"""The wall with inertia: u_1 by backward Euler or by Newmark's formulas with equilibrium at t_{n+1} (4.30, 4.36).

  Newmark        a_1 = (u_1 - u_n - dt v_n - dt^2 (1/2 - beta) a_n)/(beta dt^2),  v_1 = v_n + dt ((1-gamma) a_n + gamma a_1)
  backward Euler a_1 = (u_1 - u_n - dt v_n)/dt^2,                                 v_1 = (u_1 - u_n)/dt

Consistent mass. The trapezoidal rule is gamma = 1/2, beta = 1/4. The pressure acts from t = 0 on, so a_0 is not zero.
The work of the energy form is that of sigma_1 with backward Euler, else of the mean stress (sigma_n + sigma_1)/2, sigma_n being
that of the mechanical phase before (docs/theory/dynamics.md).
"""
from dataclasses import dataclass

import numpy as np

import steel as law
from cylinder import Cylinder, State

INTEGRATORS = {"be": None, "newmark": (0.6, 0.3025), "trapezoidal": (0.5, 0.25)}  # gamma, beta


@dataclass
class MovingState(State):
    v: np.ndarray = None  # mm/s
    a: np.ndarray = None  # mm/s^2
    stress: np.ndarray = None  # of the mechanical phase, N/mm^2, [3, element, point]


class MovingCylinder(Cylinder):
    def __init__(self, integrator, *arguments, **options):
        super().__init__(*arguments, **options)
        self.newmark = INTEGRATORS[integrator]
        p = self.strip
        self.mass = np.zeros((p.n + 1, p.n + 1))
        e = np.arange(p.n)
        for a in range(2):
            for b in range(2):
                local = law.DENSITY * (p.weight * p.shape[a] * p.shape[b]).sum(axis=1)
                np.add.at(self.mass, (e + a, e + b), local)

    def start(self):
        rest = super().start()
        load = np.zeros_like(rest.u)
        load[0] = self.pressure * self.strip.r[0]
        still = np.zeros_like(rest.u)
        return MovingState(rest.u, rest.t, rest.plastic, still, np.linalg.solve(self.mass, load), np.zeros_like(rest.plastic))

    def step(self, scheme, old, dt):
        self.scheme, self.old_stress = scheme, old.stress
        return super().step(scheme, old, dt)

    def linearised(self, scheme, dt):
        self.old_stress = np.zeros_like(self.start().plastic)
        return super().linearised(scheme, dt)

    def _heat(self, form, old, u, t, plastic, plastic_bar, work_stress):
        if self.newmark is not None:
            work_stress = 0.5 * (work_stress + self.old_stress)
        return super()._heat(form, old, u, t, plastic, plastic_bar, work_stress)

    def _stress(self, old, u, t, plastic):
        """Of the mechanical phase at t_{n+1}."""
        p = self.strip
        if self.scheme.mechanical == "simultaneous":
            return self.steel.stress(p.strain(p.gather(u)) - plastic, p.at_points(p.gather(t)))
        before = (p.gather(old.u), p.gather(old.t), old.plastic)
        elastic, _, t_bar = self._mechanics(self.scheme, before, p.gather(u))
        return self.steel.stress(elastic, t_bar)

    def _acceleration(self, old, u, dt):
        """a_1 and its derivative with respect to u_1."""
        if self.newmark is None:
            return (u - old.u - dt * old.v) / dt**2, 1 / dt**2
        beta = self.newmark[1]
        return (u - old.u - dt * old.v - dt**2 * (0.5 - beta) * old.a) / (beta * dt**2), 1 / (beta * dt**2)

    def _act(self, r, k, u, old, dt):
        super()._act(r, k, u, old, dt)
        a, slope = self._acceleration(old, u, dt)
        r += self.mass @ a
        k += slope * self.mass

    def _state(self, old, u, t, plastic, dt):
        a, _ = self._acceleration(old, u, dt)
        if self.newmark is None:
            v = (u - old.u) / dt
        else:
            gamma = self.newmark[0]
            v = old.v + dt * ((1 - gamma) * old.a + gamma * a)
        return MovingState(u, t, plastic, v, a, self._stress(old, u, t, plastic))

    def _kinetic(self, state):
        return 0.5 * state.v @ self.mass @ state.v

    def step_matrix(self, scheme, dt):
        """The linearised step (u, Theta, dt v, dt^2 a)_n -> the same at t_{n+1}."""
        new, old = self.linearised(scheme, dt)
        n = self.strip.n + 1
        unit, zero = np.eye(n), np.zeros((n, n))
        # rows: both residuals, v_1, a_1; columns: u, Theta, dt v, dt^2 a
        if self.newmark is None:
            a1 = [np.hstack([unit, zero, zero, -unit]), np.hstack([unit, zero, unit, zero])]
            v1 = [np.hstack([unit, zero, -unit, zero]), np.hstack([unit, zero, zero, zero])]
        else:
            gamma, beta = self.newmark
            a1 = [np.hstack([unit / beta, zero, zero, -unit]),
                  np.hstack([unit / beta, zero, unit / beta, (0.5 - beta) / beta * unit])]
            v1 = [np.hstack([zero, zero, -unit, gamma * unit]), np.hstack([zero, zero, -unit, -(1 - gamma) * unit])]
        inertia = np.vstack([np.hstack([zero, zero, zero, self.mass / dt**2]), np.zeros((n, 4 * n))])
        left = np.vstack([np.hstack([new, np.zeros((2 * n, 2 * n))]) + inertia, v1[0], a1[0]])
        right = np.vstack([np.hstack([-old, np.zeros((2 * n, 2 * n))]), v1[1], a1[1]])
        return np.linalg.solve(left, right)
