# SPDX-License-Identifier: BSD-3-Clause
"""An axisymmetric strip of Q1/P0 elements through the wall, u_z = 0, as a one-dimensional problem in r.

Two Gauss points an element in r. The volumetric strain is its mean over the element (B-bar, 6.16-6.25):
mean tr = (r_2 u_2 - r_1 u_1)/((r_2^2 - r_1^2)/2). Integrals are per radian and per mm of axis, dV = r dr.
Thermal rule: "open" stores sensible heat at the same Gauss points, "closed" at the nodes with int N r dr and conducts
by the nodal rule (6.3). Structural heat lives at the Gauss points in both.
"""
import numpy as np

STEP = 1e-30  # of complex differentiation


class Strip:
    def __init__(self, elements=50, inner=100.0, outer=200.0, rule="closed"):
        self.n = elements
        self.rule = rule
        self.r = np.linspace(inner, outer, elements + 1)
        left, right = self.r[:-1], self.r[1:]
        self.length = right - left
        x = np.array([-1.0, 1.0]) / np.sqrt(3.0)
        self.shape = 0.5 * np.array([1.0 - x, 1.0 + x])[:, None, :]  # [node, 1, point]
        self.radius = (left * self.shape[0].T + right * self.shape[1].T).T  # [element, point]
        self.weight = self.radius * 0.5 * self.length[:, None]
        slope = np.array([-1.0, 1.0])[:, None] / self.length  # [node, element]
        self.slope = slope[:, :, None]
        self.mean = np.array([-left, right]) / (0.5 * (right**2 - left**2))  # mean of N' + N/r
        self.nodal_weight = (self.weight[None] * self.shape).sum(axis=2)  # [node, element]
        self.nodal_conduction = 0.5 * np.array([left, right]) / self.length

    def gather(self, nodal):
        return np.array([nodal[:-1], nodal[1:]])

    def scatter(self, element_values):
        out = np.zeros(self.n + 1, dtype=element_values.dtype)
        out[:-1] += element_values[0]
        out[1:] += element_values[1]
        return out

    def at_points(self, nodes):
        return (nodes[:, :, None] * self.shape).sum(axis=0)

    def strain(self, u):
        """[rr, tt, zz] at the points, of nodal values [node, element]."""
        rr = (u[:, :, None] * self.slope).sum(axis=0) + 0.0 * self.radius
        tt = self.at_points(u) / self.radius
        mean = (u * self.mean).sum(axis=0)[:, None]
        shift = (mean - rr - tt) / 3.0
        return np.array([rr + shift, tt + shift, shift])

    def force(self, stress):
        """int B-bar^T sigma, [node, element]."""
        p = (stress[0] + stress[1] + stress[2]) / 3.0
        s = stress - p
        b_rr, b_tt = self.slope, self.shape / self.radius
        standard = ((s[0] * b_rr + s[1] * b_tt) * self.weight).sum(axis=2)
        return standard + self.mean * (p * self.weight).sum(axis=1)

    def spread(self, density):
        """int N q, [node, element], of values at the points."""
        return (self.weight * density * self.shape).sum(axis=2)

    def conduct(self, t, conductivity):
        """int grad N k grad Theta, [node, element], of nodal temperatures [node, element]."""
        jump = t[1] - t[0]
        if self.rule == "closed":
            q = (self.nodal_conduction * conductivity(t)).sum(axis=0) * jump
        else:
            k = conductivity(self.at_points(t))
            q = (self.weight * k).sum(axis=1) * jump / self.length**2
        return np.array([-q, q])

    def store(self, t, function):
        """int N f(Theta) by the thermal rule, [node, element]."""
        if self.rule == "closed":
            return self.nodal_weight * function(t)
        return self.spread(function(self.at_points(t)))

    def matrix(self, residual, values):
        """Residual and dense derivative of an assembled element residual with respect to nodal fields.

        @param residual takes one array [node, element] a field, returns [equation, node, element]
        @param values   nodal fields
        @returns residual [equation, node], matrix with one block column a field and one block row an equation
        """
        local = [self.gather(v).astype(complex) for v in values]
        base = residual(*local).real
        equations, fields, n = len(base), len(values), self.n + 1
        jacobian = np.zeros((equations, n, fields, n))
        e = np.arange(self.n)
        for f in range(fields):
            for b in range(2):
                moved = [x.copy() for x in local]
                moved[f][b] += 1j * STEP
                d = residual(*moved).imag / STEP
                for g in range(equations):
                    for a in range(2):
                        jacobian[g, e + a, f, e + b] += d[g, a]
        return np.array([self.scatter(x) for x in base]), jacobian.reshape(equations * n, fields * n)
