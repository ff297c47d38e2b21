"""Heat with freezing in DOLFINx: bilinear quadrilaterals of the test's mesh, heat content at the nodes, backward Euler, as
freezing.edp has it for FreeFEM. Newton's method has the heat content h [J/m3] of the nodes as its unknown, of which the temperature
is a function that never falls: a freezing range of zero is no difficulty. DOLFINx has no freezing of its own.
"""
from mpi4py import MPI
import numpy as np
from petsc4py import PETSc
import ufl

from dolfinx import fem, mesh
from dolfinx.fem import petsc


class Freezing:
    """A rectangle with walls at a held temperature. `content(T)`, `warmth(h)` and its `slope(h)`, `conductivity(T)` take and return
    arrays over the nodes; `walls(x)` says which of the points x [3][node] are on a wall."""

    def __init__(self, size, divisions, walls, start, wall, content, warmth, slope, conductivity):
        self.warmth, self.slope, self.conductivity = warmth, slope, conductivity
        grid = mesh.create_rectangle(MPI.COMM_SELF, [np.zeros(2), np.array(size)], list(divisions), mesh.CellType.quadrilateral)
        space = fem.FunctionSpace(grid, ("CG", 1))
        self.places = space.tabulate_dof_coordinates()
        self.temperature, self._k = fem.Function(space), fem.Function(space)
        u, v = ufl.TrialFunction(space), ufl.TestFunction(space)
        self._stiffness = fem.form(self._k * ufl.inner(ufl.grad(u), ufl.grad(v)) * ufl.dx)
        self._matrix = petsc.create_matrix(self._stiffness)
        self._volume = petsc.assemble_vector(fem.form(v * ufl.dx)).array.copy()
        self._held = fem.locate_dofs_geometrical(space, walls)
        self.content = np.full(len(self.places), float(content(np.array([start]))[0]))
        self.content[self._held] = content(np.array([wall]))[0]
        self._solver = PETSc.KSP().create(MPI.COMM_SELF)
        self._solver.setType("preonly")
        self._solver.getPC().setType("lu")

    def _residual(self, old, dt):
        """The heat that is out of balance at each node [W/m], with the matrix of the present conductivities."""
        self.temperature.x.array[:] = self.warmth(self.content)
        self._k.x.array[:] = self.conductivity(self.temperature.x.array)
        self._matrix.zeroEntries()
        petsc.assemble_matrix(self._matrix, self._stiffness)
        self._matrix.assemble()
        r = (self._matrix * self.temperature.vector).array + self._volume * (self.content - old) / dt
        r[self._held] = 0
        return r

    def advance(self, dt):
        """One step; raises RuntimeError where Newton's method does not converge. As in freezing.edp the slope of the conductivity is
        not in the tangent."""
        old, first = self.content.copy(), 0.0
        change, right = self.temperature.vector.duplicate(), self.temperature.vector.duplicate()
        for iteration in range(60):
            r = self._residual(old, dt)
            now = np.abs(r).max()
            first = first or max(now, 1e-30)
            if now < 1e-9 * first:
                return
            tangent = self._matrix.copy()
            slope = self.temperature.vector.duplicate()
            slope.array[:] = self.slope(self.content)
            tangent.diagonalScale(None, slope)
            diagonal = tangent.getDiagonal()
            diagonal.array[:] += self._volume / dt
            tangent.setDiagonal(diagonal)
            tangent.zeroRows(self._held, 1.0)
            right.array[:] = r
            self._solver.setOperators(tangent)
            self._solver.solve(right, change)
            self.content -= change.array
        if now > 1e-6 * first:
            raise RuntimeError(f"Newton's method got stuck at {now / first:.1e}")

    def print_values(self, places, time):
        for place in places:
            node = np.argmin(np.linalg.norm(self.places[:, :2] - np.array(place), axis=1))
            print(f"VALUE temperature {place[0]:.10g} {place[1]:.10g} 0 {time:g} {self.temperature.x.array[node]:.10g}")
