"""Plastic work heats a cube that loses no heat, for DOLFINx: hexahedra of the test's mesh; DOLFINx has no plasticity, its user writes
the law at the points of quadrature (../plastic_dolfinx.py), and as heat 0.9 of the mean flow stress of the step times its plastic
strain. Insulated, and the same everywhere, so that no heat is conducted.
/usr/bin/python3 fenicsx.py
"""
from pathlib import Path
import sys

from mpi4py import MPI
import numpy as np
from petsc4py import PETSc

from dolfinx import fem, mesh
from dolfinx.fem import petsc

sys.path.insert(0, str(Path(__file__).resolve().parent.parent))
from plastic_dolfinx import Points, radial_return  # noqa: E402

SIZE, E, NU, YIELD, H, SHARE, RHO, C = 0.01, 200e9, 0.3, 300e6, 1e9, 0.9, 7800.0, 500.0
MU, BULK = E / (2 * (1 + NU)), E / (3 * (1 - 2 * NU))
STEPS = 50

grid = mesh.create_box(MPI.COMM_SELF, [np.zeros(3), np.full(3, SIZE)], [2, 2, 2], mesh.CellType.hexahedron)
space = fem.VectorFunctionSpace(grid, ("CG", 1))
displacement = fem.Function(space)
points = Points(grid, displacement)
# Of each point: plastic strain, the length of its path, and the rise of temperature.
plastic, length, rise = np.zeros((points.number, 6)), np.zeros(points.number), np.zeros(points.number)

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
        stress, tangent, flow, ended = radial_return(points.strains(), plastic, YIELD + H * length, H, MU, BULK)
        points.carry(stress, tangent)
        matrix = petsc.assemble_matrix(points.jacobian, bcs=conditions)
        matrix.assemble()
        right = petsc.assemble_vector(points.residual)
        right.scale(-1)
        petsc.apply_lifting(right, [points.jacobian], [conditions], [displacement.vector], 1.0)
        petsc.set_bc(right, conditions, displacement.vector, 1.0)
        change = right.duplicate()
        solver.setOperators(matrix)
        solver.solve(right, change)
        displacement.x.array[:] += change.array
        if np.abs(change.array).max() < 1e-12 * SIZE:
            break
    else:
        raise RuntimeError("Newton's method got stuck")
    mean = YIELD + H * (length + 0.5 * flow)
    plastic, length, rise = ended, length + flow, rise + SHARE * mean * flow / (RHO * C)
    if step in (STEPS // 2, STEPS):
        time = step / STEPS
        print(f"VALUE temperature 0.005 0.005 0.005 {time:g} {20 + rise.mean():.10g}")
        print(f"VALUE stress_zz 0.0025 0.0025 0.0025 {time:g} {1e-6 * stress[:points.each, 2].mean():.10g}")
