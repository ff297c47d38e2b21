"""Integrators of second order on a coupled layer (docs/decisions/0009-two-stages.md): a table to the screen.

A layer between rigid walls in uniaxial strain, the face x = 0 at g(t), the other insulated. With the strain
eliminated, (1 + d) th' - d mean(th') = th'' in units of the length and of the diffusion time; 40 linear elements, lumped.
"""
import numpy as np

N_ELEMENTS, DELTA, END = 40, 0.36, 0.2
GAMMA = 1 - 1 / np.sqrt(2)


def matrices():
    n = N_ELEMENTS
    weights = np.full(n + 1, 1 / n)
    weights[[0, -1]] /= 2
    conduction = n * (2 * np.eye(n + 1) - np.eye(n + 1, k=1) - np.eye(n + 1, k=-1))
    conduction[[0, -1], [0, -1]] = n
    return (1 + DELTA) * np.diag(weights) - DELTA * np.outer(weights, weights), conduction


CAPACITY, CONDUCTION = matrices()


def march(method, g, end, n_steps):
    """Temperatures of all nodes after every step, and the heat that has come in by the integrator's own account."""
    dt = end / n_steps
    c, k = CAPACITY[1:, 1:], CONDUCTION[1:, 1:]

    def solve(content, weight, time):
        """The temperatures whose heat content is `content` + weight dt rate(time)."""
        face = g(time)
        inner = np.linalg.solve(c + weight * dt * k, content - face * (CAPACITY[1:, 0] + weight * dt * CONDUCTION[1:, 0]))
        return np.append(face, inner)

    def content(theta):
        return CAPACITY[1:] @ theta

    def rate(theta):
        return -CONDUCTION[1:] @ theta

    theta = np.zeros(N_ELEMENTS + 1)
    before, history, heat = content(theta), [], 0.0
    for step in range(n_steps):
        t, now = step * dt, content(theta)
        start = np.append(g(t + 1e-12), theta[1:])
        if method == "trapezoidal":
            theta = solve(now + dt / 2 * rate(start), 0.5, t + dt)
            heat += dt / 2 * (rate(start) + rate(theta)).sum()
        elif method == "bdf2" and step > 0:
            theta = solve((4 * now - before) / 3, 2 / 3, t + dt)
            heat += dt * rate(theta).sum()
        elif method == "sdirk2":
            middle = solve(now, GAMMA, t + GAMMA * dt)
            theta = solve(now + (1 - GAMMA) / GAMMA * (content(middle) - now), GAMMA, t + dt)
            heat += dt * ((1 - GAMMA) * rate(middle) + GAMMA * rate(theta)).sum()
        else:  # backward Euler, and the first step of BDF2
            theta = solve(now, 1, t + dt)
            heat += dt * rate(theta).sum()
        before = now
        history.append(theta)
    return np.array(history), heat


def main():
    conditions = {"smooth": lambda t: np.sin(np.pi * t / (2 * END)) ** 2, "jump": lambda t: float(t > 0)}
    for name, g in conditions.items():
        exact = march("sdirk2", g, END, 6400)[0][-1]
        for method in ("backward_euler", "trapezoidal", "bdf2", "sdirk2"):
            cells = []
            for n_steps in (10, 20, 40, 80):
                history, heat = march(method, g, END, n_steps)
                stored = (CAPACITY[1:] @ history[-1]).sum()
                cells.append(f"{np.abs(history[-1] - exact).max():.1e} {history.max():5.2f} {abs(stored / heat - 1):.0e}")
            print(f"{name:7s}{method:15s}", " | ".join(cells))


main()
