"""What DOLFINx lacks for plasticity, which is its user's to write: von Mises' law at points of quadrature by radial return, with its
consistent tangent, and the spaces that carry stresses and tangents. Symmetric tensors are six numbers, shear times the root of two.
"""
import basix
import numpy as np
import ufl

from dolfinx import fem

ROOT = np.sqrt(2.0)
ONE = np.array([1, 1, 1, 0, 0, 0.0])
DEVIATOR = np.eye(6) - np.outer(ONE, ONE) / 3


def six(e):
    return ufl.as_vector([e[0, 0], e[1, 1], e[2, 2], ROOT * e[1, 2], ROOT * e[0, 2], ROOT * e[0, 1]])


def radial_return(strain, plastic, yield_stress, hardening, mu, bulk):
    """Stress [n][6] and its tangent [n][6][6], the length of the plastic strain of the step [n] and the plastic strain at its end
    [n][6], from the strain without thermal strain [n][6], the plastic strain at the start and the yield stress there [n]."""
    trial = 2 * mu * (strain - plastic) @ DEVIATOR
    size = np.linalg.norm(trial, axis=1)
    equivalent = np.sqrt(1.5) * size
    flow = np.maximum(0, equivalent - yield_stress) / (3 * mu + hardening)
    normal = trial / np.maximum(size, 1e-9)[:, None]
    scale = 1 - 3 * mu * flow / np.maximum(equivalent, 1e-9)
    stress = trial * scale[:, None] + bulk * strain[:, :3].sum(axis=1)[:, None] * ONE
    turning = 2 * mu * scale[:, None, None] * DEVIATOR
    along = np.where(flow > 0, 2 * mu * (scale - 1 + 3 * mu / (3 * mu + hardening)), 0)
    tangent = bulk * np.outer(ONE, ONE) + turning - along[:, None, None] * normal[:, :, None] * normal[:, None, :]
    return stress, tangent, flow, plastic + np.sqrt(1.5) * flow[:, None] * normal


class Points:
    """The points of quadrature of all cells of `grid`, and the forms of equilibrium that take stresses and tangents from them."""

    def __init__(self, grid, displacement, degree=2):
        space, cell = displacement.function_space, grid.ufl_cell()
        dx = ufl.Measure("dx", grid, metadata={"quadrature_degree": degree, "quadrature_rule": "default"})
        self._stresses = fem.Function(fem.FunctionSpace(
            grid, ufl.VectorElement("Quadrature", cell, degree, dim=6, quad_scheme="default")))
        self._tangents = fem.Function(fem.FunctionSpace(
            grid, ufl.TensorElement("Quadrature", cell, degree, shape=(6, 6), quad_scheme="default")))
        u, v = ufl.TrialFunction(space), ufl.TestFunction(space)
        self.residual = fem.form(ufl.inner(self._stresses, six(ufl.sym(ufl.grad(v)))) * dx)
        self.jacobian = fem.form(ufl.inner(ufl.dot(self._tangents, six(ufl.sym(ufl.grad(u)))), six(ufl.sym(ufl.grad(v)))) * dx)
        points, _ = basix.make_quadrature(basix.CellType.hexahedron, degree)
        self.each = len(points)
        self._strains = fem.Expression(six(ufl.sym(ufl.grad(displacement))), points)
        self._cells = np.arange(grid.topology.index_map(3).size_local, dtype=np.int32)
        self.number = len(self._cells) * self.each

    def strains(self):
        """Of the present displacement [point][6], cell by cell."""
        return self._strains.eval(self._cells).reshape(-1, 6)

    def carry(self, stress, tangent):
        self._stresses.x.array[:], self._tangents.x.array[:] = stress.ravel(), tangent.ravel()
