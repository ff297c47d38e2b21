"""A shell that freezes, stays flat and yields (Weiner and Boley), for DOLFINx: heat on quadrilaterals (../freezing_dolfinx.py), which have
the nodes of the test's hexahedra in the plane; displacements on the hexahedra. DOLFINx has neither freezing nor plasticity nor faces
that stay plane: its user writes them. Each hexahedron has the mean temperature of its nodes; melt is a solid without strength. A face
that stays plane is one that is held, with a stretch of the whole shell along its normal as a further unknown.
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
from freezing_dolfinx import Freezing  # noqa: E402
from plastic_dolfinx import DEVIATOR, ONE, Points, radial_return  # noqa: E402

LENGTH, WIDTH, CELLS, DT = 0.03, 0.0004, 75, 0.1
START, WALL, MELT, K, C, RHO, LATENT = 1494.5, 1000.0, 1494.4, 33.0, 661.0, 7500.0, 272e3
E, NU, ALPHA, YIELD = 40e9, 0.35, 2e-5, 20e6
MU, BULK = E / (2 * (1 + NU)), E / (3 * (1 - 2 * NU))
SOLID = RHO * C * (MELT - WALL)  # heat content of the solid at the freezing point, from that at the wall


def content(t):
    return RHO * C * (t - WALL) + np.where(t > MELT, RHO * LATENT, 0)


def warmth(h):
    return WALL + np.where(h < SOLID, h, np.maximum(SOLID, h - RHO * LATENT)) / (RHO * C)


def slope(h):
    return np.where((h >= SOLID) & (h <= SOLID + RHO * LATENT), 0.0, 1 / (RHO * C))


class Shell:
    """Displacements on the hexahedra of the test, and the stretch of the shell along y and z."""

    def __init__(self):
        grid = mesh.create_box(MPI.COMM_SELF, [np.zeros(3), np.array([LENGTH, WIDTH, WIDTH])], [CELLS, 1, 1], mesh.CellType.hexahedron)
        space = fem.VectorFunctionSpace(grid, ("CG", 1))
        self.displacement, self.stretch = fem.Function(space), np.zeros(2)
        self.points = Points(grid, self.displacement)
        self.plastic = np.zeros((self.points.number, 6))
        self._volume = LENGTH * WIDTH * WIDTH / self.points.number  # of a point: all cells are alike
        # The wall is held along x; the four sides are held along their normals, whose stretch comes on top.
        held = [(0, lambda x: x[0] < 1e-9), (1, lambda x: (x[1] < 1e-9) | (x[1] > WIDTH - 1e-9)),
                (2, lambda x: (x[2] < 1e-9) | (x[2] > WIDTH - 1e-9))]
        self._conditions = [fem.dirichletbc(fem.Constant(grid, 0.0), fem.locate_dofs_topological(
            space.sub(axis), 2, mesh.locate_entities_boundary(grid, 2, where)), space.sub(axis)) for axis, where in held]
        self._solver = PETSc.KSP().create(MPI.COMM_SELF)
        self._solver.setType("preonly")
        self._solver.getPC().setType("lu")
        corners = grid.geometry.x[grid.geometry.dofmap.array.reshape(-1, 8)]
        self.middles = corners.mean(axis=1)

    def _forces(self, stress, tangent):
        """What is out of balance at the nodes."""
        self.points.carry(stress, tangent)
        forces = petsc.assemble_vector(self.points.residual)
        petsc.set_bc(forces, self._conditions, scale=0.0)
        return forces.array.copy()

    def _answer(self, thermal, strength):
        """Stress, tangent, plastic strain, and what is out of balance at the nodes and in the stretch, with the present unknowns."""
        strain = self.points.strains() - thermal[:, None] * ONE
        strain[:, 1:3] += self.stretch
        stress, tangent, _, ended = radial_return(strain, self.plastic, strength, 0.0, MU, BULK)
        return stress, tangent, ended, self._forces(stress, tangent), stress[:, 1:3].sum(axis=0) * self._volume

    def _direction(self, tangent, forces, net):
        """Newton's. The last two rows and columns of the system belong to the stretch, on which no force acts. Melt, and a shell that
        yields as a whole, get a little stiffness in shear, which changes the way to the answer and not the answer."""
        tangent = tangent + 1e-3 * MU * DEVIATOR
        beside = [self._forces(tangent[:, :, 1 + k], tangent) for k in range(2)]
        matrix = petsc.assemble_matrix(self.points.jacobian, bcs=self._conditions)
        matrix.assemble()
        self._solver.setOperators(matrix)
        by_force, *by_stretch = [self._solve(column) for column in (forces, *beside)]
        corner = tangent[:, 1:3, 1:3].sum(axis=0) * self._volume - np.array([[a @ b for b in by_stretch] for a in beside])
        change = np.linalg.solve(corner, np.array([a @ by_force for a in beside]) - net)
        return -by_force - sum(c * column for c, column in zip(change, by_stretch)), change

    def _solve(self, array):
        right, out = self.displacement.vector.duplicate(), self.displacement.vector.duplicate()
        right.array[:] = array
        self._solver.solve(right, out)
        return out.array.copy()

    def advance(self, temperature):
        """A step to the temperatures of the cells; returns their stresses along y [Pa]."""
        at_points = np.repeat(temperature, self.points.each)
        thermal = ALPHA * (at_points - MELT)
        strength = YIELD * np.clip((MELT - at_points) / (MELT - WALL), 0, None)
        _, tangent, _, forces, net = self._answer(thermal, strength)
        for iteration in range(200):
            moved, change = self._direction(tangent, forces, net)
            start, stretch = self.displacement.x.array.copy(), self.stretch
            before = forces @ moved + net @ change
            # The work of what is out of balance along the direction rises evenly, for the law has a potential: half of it is enough.
            share = 1.0
            for _ in range(60):
                self.displacement.x.array[:], self.stretch = start + share * moved, stretch + share * change
                stress, tangent, ended, forces, net = self._answer(thermal, strength)
                work = forces @ moved + net @ change
                if work <= 0.5 * abs(before):
                    break
                share *= 0.5
            if max(np.abs(forces).max(), np.abs(net).max()) < 1e-9 * YIELD * WIDTH * WIDTH:
                break
        else:
            raise RuntimeError("Newton's method got stuck")
        self.plastic = ended
        return stress[:, 1].reshape(-1, self.points.each).mean(axis=1)


heat = Freezing((LENGTH, WIDTH), (CELLS, 1), lambda x: x[0] < 1e-9, START, WALL, content, warmth, slope, lambda t: np.full_like(t, K))
shell = Shell()
order = np.argsort(heat.places[:, 0], kind="stable")[::2]  # one node of each cross section
cell = np.rint(shell.middles[:, 0] / WIDTH - 0.5).astype(int)
for step in range(1, 211):
    heat.advance(DT)
    line = heat.temperature.x.array[order]
    stress = shell.advance((0.5 * (line[1:] + line[:-1]))[cell])
    if step in (50, 210):
        for index in np.argsort(cell):
            x, y, z = shell.middles[index]
            print(f"VALUE stress_yy {x:.10g} {y:.10g} {z:.10g} {step * DT:g} {1e-6 * stress[index]:.10g}")
heat.print_values([(x, 0) for x in (0.004, 0.008, 0.012, 0.02)], 21)
