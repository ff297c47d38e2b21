"""Plastic work heats a cube that loses no heat, for DOLFINx: hexahedra of the test's mesh; DOLFINx has no plasticity, its user writes
the law at the points of quadrature: radial return with linear hardening, its consistent tangent, and as heat 0.9 of the mean flow
stress of the step times its plastic strain. Insulated, and the same everywhere, so that no heat is conducted.
/usr/bin/python3 fenicsx.py
"""
import basix
from mpi4py import MPI
import numpy as np
from petsc4py import PETSc
import ufl

from dolfinx import fem, mesh
from dolfinx.fem import petsc

SIZE, E, NU, YIELD, H, SHARE, RHO, C = 0.01, 200e9, 0.3, 300e6, 1e9, 0.9, 7800.0, 500.0
MU, BULK = E / (2 * (1 + NU)), E / (3 * (1 - 2 * NU))
DEGREE, STEPS, ROOT = 2, 50, np.sqrt(2.0)
# Symmetric tensors as six numbers, shear times the root of two.
ONE = np.array([1, 1, 1, 0, 0, 0.0])
DEVIATOR = np.eye(6) - np.outer(ONE, ONE) / 3


def six(e):
    return ufl.as_vector([e[0, 0], e[1, 1], e[2, 2], ROOT * e[1, 2], ROOT * e[0, 2], ROOT * e[0, 1]])


class Law:
    """Points with plastic strain, the length of its path, and the rise of temperature of the last committed step."""

    def __init__(self, n):
        self.strain, self.length, self.rise = np.zeros((n, 6)), np.zeros(n), np.zeros(n)

    def answer(self, total):
        """Stress [n][6], its tangent [n][6][6] and the state that they lead to, from the strain [n][6]."""
        trial = 2 * MU * (total - self.strain) @ DEVIATOR
        size = np.linalg.norm(trial, axis=1)
        equivalent = np.sqrt(1.5) * size
        flow = np.maximum(0, equivalent - YIELD - H * self.length) / (3 * MU + H)
        normal = trial / np.maximum(size, 1e-9)[:, None]
        scale = 1 - 3 * MU * flow / np.maximum(equivalent, 1e-9)
        pressure = BULK * total[:, :3].sum(axis=1)
        stress = trial * scale[:, None] + pressure[:, None] * ONE
        turning = (2 * MU * (scale[:, None, None] * DEVIATOR))
        along = np.where(flow > 0, 2 * MU * (scale - 1 + 3 * MU / (3 * MU + H)), 0)
        tangent = BULK * np.outer(ONE, ONE) + turning - along[:, None, None] * normal[:, :, None] * normal[:, None, :]
        mean = YIELD + H * (self.length + 0.5 * flow)
        state = (self.strain + np.sqrt(1.5) * flow[:, None] * normal, self.length + flow, self.rise + SHARE * mean * flow / (RHO * C))
        return stress, tangent, state


grid = mesh.create_box(MPI.COMM_SELF, [np.zeros(3), np.full(3, SIZE)], [2, 2, 2], mesh.CellType.hexahedron)
space = fem.VectorFunctionSpace(grid, ("CG", 1))
cell = grid.ufl_cell()
dx = ufl.Measure("dx", grid, metadata={"quadrature_degree": DEGREE, "quadrature_rule": "default"})
stresses = fem.Function(fem.FunctionSpace(grid, ufl.VectorElement("Quadrature", cell, DEGREE, dim=6, quad_scheme="default")))
tangents = fem.Function(fem.FunctionSpace(grid, ufl.TensorElement("Quadrature", cell, DEGREE, shape=(6, 6), quad_scheme="default")))
displacement, u, v = fem.Function(space), ufl.TrialFunction(space), ufl.TestFunction(space)
residual = fem.form(ufl.inner(stresses, six(ufl.sym(ufl.grad(v)))) * dx)
jacobian = fem.form(ufl.inner(ufl.dot(tangents, six(ufl.sym(ufl.grad(u)))), six(ufl.sym(ufl.grad(v)))) * dx)
points, _ = basix.make_quadrature(basix.CellType.hexahedron, DEGREE)
strains = fem.Expression(six(ufl.sym(ufl.grad(displacement))), points)
cells = np.arange(grid.topology.index_map(3).size_local, dtype=np.int32)
law = Law(len(cells) * len(points))

pressed = fem.Constant(grid, 0.0)
conditions = [fem.dirichletbc(fem.Constant(grid, 0.0), fem.locate_dofs_topological(
    space.sub(axis), 2, mesh.locate_entities_boundary(grid, 2, lambda x, axis=axis: x[axis] < 1e-9)), space.sub(axis)) for axis in range(3)]
conditions.append(fem.dirichletbc(pressed, fem.locate_dofs_topological(
    space.sub(2), 2, mesh.locate_entities_boundary(grid, 2, lambda x: x[2] > SIZE - 1e-9)), space.sub(2)))
solver = PETSc.KSP().create(MPI.COMM_SELF)
solver.setType("preonly")
solver.getPC().setType("lu")

for step in range(1, STEPS + 1):
    pressed.value = -0.05 * SIZE * step / STEPS
    for iteration in range(20):
        stress, tangent, state = law.answer(strains.eval(cells).reshape(-1, 6))
        stresses.x.array[:], tangents.x.array[:] = stress.ravel(), tangent.ravel()
        matrix = petsc.assemble_matrix(jacobian, bcs=conditions)
        matrix.assemble()
        right = petsc.assemble_vector(residual)
        right.scale(-1)
        petsc.apply_lifting(right, [jacobian], [conditions], [displacement.vector], 1.0)
        petsc.set_bc(right, conditions, displacement.vector, 1.0)
        change = right.duplicate()
        solver.setOperators(matrix)
        solver.solve(right, change)
        displacement.x.array[:] += change.array
        if np.abs(change.array).max() < 1e-12 * SIZE:
            break
    else:
        raise RuntimeError("Newton's method got stuck")
    law.strain, law.length, law.rise = state
    if step in (STEPS // 2, STEPS):
        time = step / STEPS
        print(f"VALUE temperature 0.005 0.005 0.005 {time:g} {20 + law.rise.mean():.10g}")
        print(f"VALUE stress_zz 0.0025 0.0025 0.0025 {time:g} {1e-6 * stress[:len(points), 2].mean():.10g}")
