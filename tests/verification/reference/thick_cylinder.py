#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Runs every scheme of cylinder.py on the wall of section 7.1 and writes the CSV files next to this file.

usage: thick_cylinder.py [TABLE ...]     default: all of histories limits audit blow_up order spectral_radius
                                         threshold dynamic_radius dynamic_histories
"""
import csv
import os
import sys

for threads in ("OMP_NUM_THREADS", "OPENBLAS_NUM_THREADS"):
    os.environ.setdefault(threads, "1")

import numpy as np

import steel
from cylinder import BY_NAME, SCHEMES, Cylinder, Diverged
from dynamics import INTEGRATORS, MovingCylinder

FOLDER = os.path.dirname(os.path.abspath(__file__))
JOULE = 2e-3 * np.pi  # of N mm per radian: the whole ring, 1 mm high
PROBLEMS = [("te", 1, None), ("te", 6, None), ("tp", 1, 320.0), ("tp", 6, 320.0)]
ISOTHERMAL = [s.name for s in SCHEMES if s.mechanical == "isothermal"]
OTHERS = [s.name for s in SCHEMES if s.mechanical != "isothermal"]
STATE = ["u_inner[mm]", "u_outer[mm]", "T_inner[K]", "T_outer[K]"]


def surface(state):
    return [state.u[0], state.u[-1], state.t[0], state.t[-1]]


def write(name, header, rows):
    with open(os.path.join(FOLDER, name + ".csv"), "w", newline="") as file:
        out = csv.writer(file, lineterminator="\n")
        out.writerow(header)
        out.writerows([f"{x:.9g}" if isinstance(x, float) else x for x in row] for row in rows)
    print(name, "written", flush=True)


def histories():
    """The schemes that come to the end, dt = 10 s, at chosen times."""
    rows = []
    times = [10, 20, 50, 100, 200, 500, 1000]
    for law, factor, flow in PROBLEMS:
        for rule in ("closed", "open"):
            # the open rule for one scheme only: what the rule of integration changes
            for name in OTHERS + (ISOTHERMAL if factor == 1 else []) if rule == "closed" else ["simultaneous"]:
                wall = Cylinder(factor, flow, rule=rule)
                for time, old, new, middle in wall.march(BY_NAME[name], 10.0, 100):
                    if round(time) in times:
                        start, end = wall.lyapunov(old) * JOULE, wall.lyapunov(new) * JOULE
                        row = [end, middle * JOULE - start, end - middle * JOULE]
                        rows.append([law, factor, rule, name, round(time)] + surface(new) + row)
    header = ["law", "expansion_factor", "rule", "scheme", "time[s]"] + STATE
    write("histories", header + ["lyapunov[J]", "mechanical_increment[J]", "thermal_increment[J]"], rows)


def limits():
    """What schemes of the energy form lead to as the step vanishes, pressure at once, at chosen times."""
    rows = []
    times = [100, 200, 500, 1000]
    for law, factor, flow in PROBLEMS:
        ends = []
        for dt in (5.0, 2.5, 1.25):
            march = Cylinder(factor, flow).march(BY_NAME["simultaneous_energy"], dt, round(times[-1] / dt))
            at = {round(time, 6): surface(new) for time, _, new, _ in march}
            ends.append({time: np.array(at[time]) for time in times})
        a, b, c = ends
        for time in times:  # Neville's table, as in order()
            limit = (4 * (2 * c[time] - b[time]) - (2 * b[time] - a[time])) / 3
            rows.append([law, factor, time] + limit.tolist())
    write("limits", ["law", "expansion_factor", "time[s]"] + STATE, rows)


def audit():
    """First law and L over 1000 s. The heat exchanged is the sum of |heat| of the steps."""
    rows = []
    for law, factor, flow in PROBLEMS:
        for name in OTHERS + (ISOTHERMAL if factor == 1 else []):
            for dt in (10.0, 100.0, 1000.0):
                wall = Cylinder(factor, flow)
                defects, heat, increments = [], 0.0, []
                for _, old, new, middle in wall.march(BY_NAME[name], dt, round(1000 / dt)):
                    q = wall.heat_in(new, dt)
                    defects.append(wall.energy(new) - wall.energy(old) - wall.work(old, new) - q)
                    heat += abs(q)
                    start, end = wall.lyapunov(old), wall.lyapunov(new)
                    increments.append([end - start, middle - start, end - middle])
                worst = max(abs(x) for x in defects) / heat
                largest = (np.max(increments, axis=0) * JOULE).tolist()
                rows.append([law, factor, name, dt, f"{worst:.2e}", f"{sum(defects) / heat:.3e}"] + largest)
    header = ["law", "expansion_factor", "scheme", "step[s]", "worst_defect[heat exchanged]", "defect[heat exchanged]"]
    header += ["largest_increment_of_L[J]", "of_mechanical_phase[J]", "of_thermal_phase[J]"]
    write("audit", header, rows)


def blow_up():
    """The isothermal forms at six times the expansion: the step that fails, and the mean growth per step, from step 3 to
    step 5, of the change of the mean temperature. It alternates: the product of two factors is what is steady."""
    rows = []
    for law, factor, flow in PROBLEMS:
        if factor == 1:
            continue
        for name in ISOTHERMAL:
            for elements in (10, 50):
                for dt in (1.0, 5.0, 10.0, 50.0):
                    wall = Cylinder(factor, flow, elements=elements)
                    changes, reason, grows = [], "none", 0
                    try:
                        for _, old, new, _ in wall.march(BY_NAME[name], dt, 100):
                            changes.append(np.mean(new.t - old.t))
                            if not grows and wall.lyapunov(new) > wall.lyapunov(old):
                                grows = len(changes)
                    except Diverged as failure:
                        reason = str(failure)
                    alternates = all(x * y < 0 for x, y in zip(changes[:5], changes[1:6]))
                    growth = -float(np.sqrt(changes[4] / changes[2])) if alternates else float("nan")
                    rows.append([law, factor, name, elements, dt, len(changes) + 1, reason, growth, grows])
    header = ["law", "expansion_factor", "scheme", "elements", "step[s]", "failing_step", "reason"]
    write("blow_up", header + ["growth_a_step[1]", "first_step_in_which_L_grows"], rows)


def order():
    """Error at 100 s against the limit of vanishing step, extrapolated from the simultaneous scheme's energy form.

    The pressure rises over 20 s here. Applied at once it does twice the work that the wall stores, whatever the step: the
    energy forms turn the rest into heat, the others lose it, and their limits differ by some hundredths of a kelvin.
    """
    rows = []
    time, ramp, steps = 100.0, 20.0, (10.0, 5.0, 2.5, 1.25)

    def end(name, factor, flow, dt):
        wall = Cylinder(factor, flow)
        state, full = wall.start(), wall.pressure
        for i in range(round(time / dt)):
            wall.pressure = full * min(1.0, (i + 1) * dt / ramp)
            state, _ = wall.step(BY_NAME[name], state, dt)
        return np.array(surface(state))

    for law, factor, flow in PROBLEMS:
        # order one: Neville's table of three steps takes out the first two terms of the error
        a, b, c = (end("simultaneous_energy", factor, flow, dt) for dt in (1.0, 0.5, 0.25))
        limit = (4 * (2 * c - b) - (2 * b - a)) / 3
        rows.append([law, factor, "limit", 0.0] + limit.tolist())
        for name in OTHERS + (ISOTHERMAL if factor == 1 else []):
            for dt in steps:
                rows.append([law, factor, name, dt] + (end(name, factor, flow, dt) - limit).tolist())
    write("order", ["law", "expansion_factor", "scheme", "step[s]"] + STATE, rows)


def resting(factor):
    return Cylinder(factor, pressure=0.0, ambient=steel.INITIAL)


def radius(name, factor, dt):
    eigenvalues = np.linalg.eigvals(resting(factor).step_matrix(BY_NAME[name], dt))
    return eigenvalues[np.argmax(np.abs(eigenvalues))]


def spectral_radius():
    """Largest eigenvalue of one step about the free wall at 593 K."""
    rows = []
    for name in OTHERS + ISOTHERMAL:
        for factor in (1, 3, 6):
            for dt in (1e-3, 1e-2, 0.1, 1.0, 10.0, 100.0, 1000.0, 2000.0):
                value = radius(name, factor, dt)
                rows.append([name, factor, dt, float(abs(value)), float(value.real), f"{1 - abs(value):.3e}"])
    header = ["scheme", "expansion_factor", "step[s]", "spectral_radius[1]", "real_part[1]", "one_minus_radius[1]"]
    write("spectral_radius", header, rows)


def threshold():
    """The factor on alpha above which the isothermal forms amplify, by bisection, and by the coupling number."""
    wall = steel.Steel()
    t = steel.INITIAL
    expansion = wall.thermal_strain(t)[1] * wall.bulk(t)  # 3 alpha_eff k
    stiff = wall.bulk(t) + 4.0 / 3.0 * wall.shear(t)  # lambda + 2 mu
    delta = expansion**2 * t / (steel.sensible_capacity(t) * stiff)
    uniform = 2.0 * (1.0 - steel.POISSON) * delta
    rows = [["coupling number", 0.0, delta, uniform, uniform**-0.5]]
    for name in ISOTHERMAL:
        for dt in (1e-3, 1.0, 10.0, 50.0, 1000.0):
            low, high = 1.0, 20.0
            for _ in range(40):
                middle = 0.5 * (low + high)
                # alternating growth: the eigenvalue below -1
                worst = np.linalg.eigvals(resting(middle).step_matrix(BY_NAME[name], dt)).real.min()
                low, high = (middle, high) if worst > -1.0 else (low, middle)
            rows.append([name, dt, delta, uniform, low])
    write("threshold", ["scheme", "step[s]", "delta[1]", "delta_uniform[1]", "threshold_on_alpha[1]"], rows)


DYNAMIC = ["simultaneous_energy", "isentropic_printed", "isentropic_energy", "isothermal"]


def dynamic_radius():
    """Largest eigenvalue of one step with inertia about the free wall at 593 K."""
    rows = []
    for integrator in INTEGRATORS:
        for name in DYNAMIC:
            for factor in (1, 3, 6):
                for dt in (1e-7, 5e-7, 2e-6, 1e-5, 1e-4, 1e-2, 10.0):
                    wall = MovingCylinder(integrator, factor, pressure=0.0, ambient=steel.INITIAL)
                    value = np.abs(np.linalg.eigvals(wall.step_matrix(BY_NAME[name], dt))).max()
                    rows.append([integrator, name, factor, dt, float(value)])
    write("dynamic_radius", ["integrator", "scheme", "expansion_factor", "step[s]", "spectral_radius[1]"], rows)


def dynamic_histories():
    """With inertia, 250 steps of 2 microseconds, pressure at once."""
    rows = []
    dt = 2e-6
    for law, flow in (("te", None), ("tp", 320.0)):
        for factor in (1, 3, 6):
            for integrator in INTEGRATORS:
                printed = ["isentropic_printed"] if integrator == "newmark" and factor < 6 else []  # figures 7.6 to 7.9
                for name in ["simultaneous_energy", "isentropic_energy", *printed, "isothermal"]:
                    wall = MovingCylinder(integrator, factor, flow)
                    step, rise = 0, -np.inf
                    try:
                        for _, old, new, _ in wall.march(BY_NAME[name], dt, 250):
                            step += 1
                            rise = max(rise, (wall.lyapunov(new) - wall.lyapunov(old)) * JOULE)
                            if step in (10, 25, 50, 100, 150, 200, 250):
                                rows.append([law, factor, integrator, name, step, "ok"] + surface(new) + [rise])
                    except Diverged as failure:
                        rows.append([law, factor, integrator, name, step + 1, str(failure)] + surface(new) + [rise])
    header = ["law", "expansion_factor", "integrator", "scheme", "step", "status"] + STATE
    write("dynamic_histories", header + ["largest_increment_of_L[J]"], rows)


TABLES = [histories, limits, audit, blow_up, order, spectral_radius, threshold, dynamic_radius, dynamic_histories]

if __name__ == "__main__":
    chosen = sys.argv[1:] or [table.__name__ for table in TABLES]
    known = {table.__name__: table for table in TABLES}
    for name in chosen:
        if name not in known:
            sys.exit(f"no table {name}; there are {', '.join(known)}")
        known[name]()
