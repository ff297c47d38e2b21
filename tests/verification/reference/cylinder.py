# SPDX-License-Identifier: BSD-3-Clause
"""One step of every quasi-static coupling scheme for the wall of section 7.1, and its audit.

Schemes: a mechanical phase (isentropic 4.40, isothermal 4.46), then a thermal phase at the fixed configuration:

  entropy      Theta_1 (S_1 - S_n) - D dt                         4.43a; with the isothermal phase: collapsed 4.48a
  enthalpy     the same with h_1 - h_n for the sensible part of Theta_1 (S_1 - S_n)
  literal      Theta_1 (S_1 - S_bar) + H^ep dt - D dt             4.48a with 4.50, as printed
  temperature  C_1 (Theta_1 - Theta_n) + H^ep dt - D dt           4.53a
  energy       E_1 - E_n - sigma_bar : (eps_1 - eps_n)            first law, work of the mechanical phase

or all at once (4.1.1). The flow of the thermal phase starts from the plastic strain at t_n (4.45) with restart=True,
otherwise the plastic strain of the mechanical phase is kept.
"""
from dataclasses import dataclass

import numpy as np

import steel as law
from steel import dot
from strip import Strip

FILM_INNER, FILM_OUTER = 1.16, 0.01  # N/(mm s K)


class Diverged(Exception):
    pass


@dataclass
class State:
    u: np.ndarray  # mm
    t: np.ndarray  # K
    plastic: np.ndarray  # [3, element, point]


@dataclass
class Scheme:
    name: str
    mechanical: str  # isentropic, isothermal, simultaneous
    thermal: str  # entropy, enthalpy, literal, temperature, energy
    restart: bool = True


SCHEMES = [
    Scheme("simultaneous", "simultaneous", "entropy"),
    Scheme("simultaneous_enthalpy", "simultaneous", "enthalpy"),
    Scheme("simultaneous_energy", "simultaneous", "energy"),
    Scheme("isentropic_printed", "isentropic", "entropy"),
    Scheme("isentropic_enthalpy", "isentropic", "enthalpy"),
    Scheme("isentropic_energy", "isentropic", "energy"),
    Scheme("isentropic_energy_kept", "isentropic", "energy", restart=False),
    Scheme("isothermal", "isothermal", "literal"),
    Scheme("isothermal_collapsed", "isothermal", "entropy"),
    Scheme("isothermal_enthalpy", "isothermal", "enthalpy"),
    Scheme("isothermal_temperature", "isothermal", "temperature"),
    Scheme("isothermal_energy", "isothermal", "energy"),
]
BY_NAME = {s.name: s for s in SCHEMES}


class Cylinder:
    def __init__(self, expansion=1.0, flow_stress=None, elements=50, rule="closed", pressure=200.0, ambient=law.AMBIENT):
        self.strip = Strip(elements, rule=rule)
        self.steel = law.Steel(expansion, flow_stress)
        self.pressure, self.ambient = pressure, ambient

    def start(self):
        n = self.strip.n
        return State(np.zeros(n + 1), np.full(n + 1, law.INITIAL), np.zeros((3, n, 2)))

    # Energies per radian and mm, in N mm.
    def energy(self, s):
        return self._total(s, law.sensible_heat, self.steel.energy)

    def entropy(self, s):
        return self._total(s, law.sensible_entropy, self.steel.entropy)

    def _total(self, s, sensible, structural):
        p, t = self.strip, self.strip.gather(s.t)
        elastic = p.strain(p.gather(s.u)) - s.plastic
        return p.store(t, sensible).sum() + (p.weight * structural(elastic, p.at_points(t))).sum()

    def lyapunov(self, s):
        """L of 2.24 with Theta_0 the ambient temperature; the pressure is a dead load."""
        potential = -self.pressure * self.strip.r[0] * s.u[0]
        return self.energy(s) - law.AMBIENT * self.entropy(s) + potential + self._kinetic(s)

    def film(self, t):
        """Heat out of the wall [N mm/s] at the nodes, and its derivative."""
        q, dq = np.zeros_like(t), np.zeros_like(t)
        for i, h in ((0, FILM_INNER), (-1, FILM_OUTER)):
            q[i], dq[i] = h * self.strip.r[i] * (t[i] - self.ambient), h * self.strip.r[i]
        return q, dq

    def heat_in(self, s, dt):
        return -dt * self.film(s.t)[0].sum()

    def work(self, old, new):
        return self.pressure * self.strip.r[0] * (new.u[0] - old.u[0])

    # The residuals of a step, by elements. `old` is (u, Theta, plastic strain) at t_n, [node, element].
    def _mechanics(self, scheme, old, u):
        """The state of the points in the mechanical phase of a split: elastic and plastic strain, temperature."""
        p, steel = self.strip, self.steel
        u_n, t_n, plastic_n = old
        t_n, strain_n, strain = p.at_points(t_n), p.strain(u_n), p.strain(u)
        if scheme.mechanical == "isentropic":
            entropy = law.sensible_entropy(t_n) + steel.entropy(strain_n - plastic_n, t_n)
            t, plastic, _ = steel.isentropic(strain, plastic_n, entropy, t_n)
        else:
            t = t_n + 0.0 * strain[0]
            plastic, _ = steel.flow(strain, plastic_n, t)
        return strain - plastic, plastic, t

    def _forces(self, scheme, old, u):
        elastic, _, t = self._mechanics(scheme, old, u)
        return self.strip.force(self.steel.stress(elastic, t))

    def _heat(self, form, old, u, t, plastic, plastic_bar, work_stress):
        """Heat that the wall takes up in the step by the form of the energy equation.

        @param plastic at the end of the step;  @param plastic_bar, work_stress of the mechanical phase
        """
        p, steel = self.strip, self.steel
        u_n, nodes_n, plastic_n = old
        tn, t1 = p.at_points(nodes_n), p.at_points(t)
        strain_n, strain = p.strain(u_n), p.strain(u)
        elastic_n, elastic = strain_n - plastic_n, strain - plastic
        if form == "energy":
            stored = p.store(t, law.sensible_heat) - p.store(nodes_n, law.sensible_heat)
            change = steel.energy(elastic, t1) - steel.energy(elastic_n, tn) - dot(work_stress, strain - strain_n)
            return stored + p.spread(change)
        dissipated = dot(steel.stress(elastic, t1), plastic - plastic_n)  # D_mech dt (2.117), no hardening
        heating = -t1 * dot(steel.stress_slope(elastic, t1), elastic - elastic_n)  # H^ep dt (2.127b)
        if form == "temperature":
            if p.rule == "closed":
                stored = p.nodal_weight * law.sensible_capacity(t) * (t - nodes_n)
            else:
                stored = p.spread(law.sensible_capacity(t1) * (t1 - tn))
            change = steel.structural_capacity(elastic, t1) * (t1 - tn) + heating
            return stored + p.spread(change - dissipated)
        if form == "enthalpy":
            stored = p.store(t, law.sensible_heat) - p.store(nodes_n, law.sensible_heat)
        elif p.rule == "closed":
            stored = p.nodal_weight * t * (law.sensible_entropy(t) - law.sensible_entropy(nodes_n))
        else:
            stored = p.spread(t1 * (law.sensible_entropy(t1) - law.sensible_entropy(tn)))
        if form == "literal":
            change = t1 * (steel.entropy(elastic, t1) - steel.entropy(strain - plastic_bar, tn)) + heating
        else:
            change = t1 * (steel.entropy(elastic, t1) - steel.entropy(elastic_n, tn))
        return stored + p.spread(change - dissipated)

    def _balance(self, scheme, old, u, t, dt, mechanics=None):
        """The energy equation without films. `mechanics` spares a second solution of the mechanical points."""
        p, steel = self.strip, self.steel
        simultaneous = scheme.mechanical == "simultaneous"
        if not simultaneous:
            elastic, plastic_bar, t_bar = mechanics or self._mechanics(scheme, old, u)
            stress = steel.stress(elastic, t_bar)
        plastic = self._plastic(scheme, old, u, t, None if simultaneous else plastic_bar)
        if simultaneous:
            stress, plastic_bar = steel.stress(p.strain(u) - plastic, p.at_points(t)), plastic
        heat = self._heat(scheme.thermal, old, u, t, plastic, plastic_bar, stress)
        return heat + dt * p.conduct(t, law.conductivity)

    def _plastic(self, scheme, old, u, t, plastic_bar):
        """Plastic strain at t_{n+1}."""
        if not scheme.restart:
            return plastic_bar
        return self.steel.flow(self.strip.strain(u), old[2], self.strip.at_points(t))[0]

    def _coupled(self, scheme, old, u, t, dt):
        """Both residuals of the simultaneous scheme."""
        p, steel = self.strip, self.steel
        elastic = p.strain(u) - self._plastic(scheme, old, u, t, None)
        return np.array([p.force(steel.stress(elastic, p.at_points(t))), self._balance(scheme, old, u, t, dt)])

    # The step.
    def step(self, scheme, old, dt):
        """@returns new state, and L between the phases."""
        p, n = self.strip, self.strip.n + 1
        before = (p.gather(old.u), p.gather(old.t), old.plastic)
        if scheme.mechanical == "simultaneous":
            def outside(r, k, v):
                self._act(r[0], k[:n, :n], v[0], old, dt)
                self._films(r[1], k[n:, n:], v[1], dt)

            u, t = self._newton(lambda u, t: self._coupled(scheme, before, u, t, dt), [old.u, old.t], outside)
            new = self._state(old, u, t, self._plastic(scheme, before, p.gather(u), p.gather(t), None), dt)
            return new, self.lyapunov(new)

        (u,) = self._newton(lambda u: self._forces(scheme, before, u)[None], [old.u],
                            lambda r, k, v: self._act(r[0], k, v[0], old, dt))
        fixed = p.gather(u)
        mechanics = self._mechanics(scheme, before, fixed)
        (t,) = self._newton(lambda t: self._balance(scheme, before, fixed, t, dt, mechanics)[None], [old.t],
                            lambda r, k, v: self._films(r[0], k, v[0], dt))
        plastic = self._plastic(scheme, before, fixed, p.gather(t), mechanics[1])
        new = self._state(old, u, t, plastic, dt)
        return new, self._lyapunov_between(new, old, mechanics)

    def _state(self, old, u, t, plastic, dt):
        return State(u, t, plastic)

    def _act(self, r, k, u, old, dt):
        """What is not the wall's own force: the pressure."""
        r[0] -= self.pressure * self.strip.r[0]

    def _kinetic(self, state):
        return 0.0

    def _lyapunov_between(self, new, old, mechanics):
        """L after the mechanical phase, where the points have temperatures of their own. Under the closed rule the
        nodes keep their sensible heat and the points add its change."""
        p, steel = self.strip, self.steel
        elastic, _, t = mechanics
        nodes = p.gather(old.t)
        t_n = p.at_points(nodes)

        def total(sensible, structural):
            at_points = sensible(t) - sensible(t_n) + structural(elastic, t)
            return p.store(nodes, sensible).sum() + (p.weight * at_points).sum()

        energy, entropy = total(law.sensible_heat, steel.energy), total(law.sensible_entropy, steel.entropy)
        return energy - law.AMBIENT * entropy - self.pressure * p.r[0] * new.u[0] + self._kinetic(new)

    def linearised(self, scheme, dt):
        """Derivatives of both residuals of a step with respect to (u_1, Theta_1) and (u_n, Theta_n), films included, about
        the free wall at the initial temperature.

        The ambient temperature must be the initial one and the pressure zero, so that this is a state of rest.
        """
        assert self.ambient == law.INITIAL and self.pressure == 0.0
        n, rest = self.strip.n + 1, self.start()

        def residual(u1, t1, u_n, t_n):
            old = (u_n, t_n, rest.plastic)
            if scheme.mechanical == "simultaneous":
                return self._coupled(scheme, old, u1, t1, dt)
            return np.array([self._forces(scheme, old, u1), self._balance(scheme, old, u1, t1, dt)])

        r, k = self.strip.matrix(residual, [rest.u, rest.t, rest.u, rest.t])
        self._films(r[1], k[n:, n:2 * n], rest.t, dt)
        assert np.abs(r).max() < 1e-9
        return k[:, :2 * n], k[:, 2 * n:]

    def step_matrix(self, scheme, dt):
        """The linearised step (u_n, Theta_n) -> (u_1, Theta_1) about that state."""
        new, old = self.linearised(scheme, dt)
        return -np.linalg.solve(new, old)

    def _films(self, r, k, t, dt):
        q, dq = self.film(t)
        r += dt * q
        i = np.arange(len(t))
        k[i, i] += dt * dq

    def _newton(self, residual, start, outside):
        """Newton to round-off. The step that follows one below 1e-8 K and 1e-9 mm is the last."""
        values = [v.copy() for v in start]
        n = len(values[0])
        last = False  # one step more, after which quadratic convergence leaves round-off
        for _ in range(40):
            try:
                with np.errstate(all="raise"):
                    r, k = self.strip.matrix(residual, values)
                    outside(r, k, values)
                    change = -np.linalg.solve(k, r.ravel())
            except (FloatingPointError, np.linalg.LinAlgError, ArithmeticError) as reason:
                raise Diverged(str(reason)) from reason
            for i in range(len(values)):
                values[i] = values[i] + change[i * n:(i + 1) * n]
            if last:
                return values
            last = np.abs(change).max() < 1e-8
        raise Diverged("Newton's method does not converge")

    def march(self, scheme, dt, steps, state=None):
        """Yields (time, old, new, L between the phases) until the end or until the scheme diverges."""
        old = self.start() if state is None else state
        for i in range(steps):
            new, middle = self.step(scheme, old, dt)
            if not np.all(np.isfinite(new.t)) or new.t.min() <= 0:
                raise Diverged("temperature below zero")
            yield (i + 1) * dt, old, new, middle
            old = new
