"""Two bodies that exchange heat through one interface, in DOLFINx: bilinear quadrilaterals of the test's mesh. DOLFINx has no contact:
its user writes what passes. The flow through the interface is the same along it in the tests that include this file, so that its
temperature on each side is a + b q, with what the body does without the flow (a) and with one watt per square metre (b).
"""
from mpi4py import MPI
import numpy as np
from petsc4py import PETSc
import ufl

from dolfinx import fem, mesh
from dolfinx.fem import petsc


class Body:
    """A rectangle with the nodes of a grid along x and y [m]. Heat passes on the side where `touches(x)` is true of the points x
    [3][node], at first `flow` [W/m2]; where `held(x)` is, the temperature is given. Times are integrated with the share `theta` of the
    end of a step."""

    def __init__(self, grid_x, grid_y, conductivity, capacity, start, touches, held=None, theta=1.0, flow=0.0):
        self.grid = mesh.create_rectangle(MPI.COMM_SELF, [np.zeros(2), np.array([len(grid_x) - 1.0, len(grid_y) - 1.0])],
                                          [len(grid_x) - 1, len(grid_y) - 1], mesh.CellType.quadrilateral)
        for axis, places in enumerate((grid_x, grid_y)):  # from numbers of nodes to their places
            self.grid.geometry.x[:, axis] = np.array(places)[np.rint(self.grid.geometry.x[:, axis]).astype(int)]
        space = fem.FunctionSpace(self.grid, ("CG", 1))
        u, v = ufl.TrialFunction(space), ufl.TestFunction(space)
        facets = np.sort(mesh.locate_entities_boundary(self.grid, 1, touches))
        ds = ufl.Measure("ds", self.grid, subdomain_data=mesh.meshtags(self.grid, 1, facets, np.ones(len(facets), np.int32)))
        self._held = fem.locate_dofs_geometrical(space, held) if held else np.zeros(0, np.int32)
        self._surface = fem.locate_dofs_geometrical(space, touches)
        self._stored = petsc.assemble_matrix(fem.form(capacity * u * v * ufl.dx))
        self._conducted = petsc.assemble_matrix(fem.form(conductivity * ufl.inner(ufl.grad(u), ufl.grad(v)) * ufl.dx))
        self._stored.assemble()
        self._conducted.assemble()
        self._flow = petsc.assemble_vector(fem.form(v * ds(1)))
        self.temperature = fem.Function(space)
        self.temperature.x.array[:] = start
        self._theta, self._dt, self._solver, self._old_flow = theta, None, None, flow
        self._sum = fem.form(self.temperature * ufl.dx)
        self._area = fem.assemble_scalar(fem.form(fem.Constant(self.grid, 1.0) * ufl.dx(self.grid)))

    def _solve(self, right):
        out = right.duplicate()
        self._solver.solve(right, out)
        return out

    def begin(self, dt, given=0.0):
        """What a step of `dt` [s] does without flow through the interface, and what 1 W/m2 into the body adds: a [K], b [K m2/W]."""
        if dt != self._dt:
            matrix = self._stored.copy()
            matrix.scale(1 / dt)
            matrix.axpy(self._theta, self._conducted)
            matrix.zeroRows(self._held, 1.0)
            self._solver = PETSc.KSP().create(MPI.COMM_SELF)
            self._solver.setOperators(matrix)
            self._solver.setType("preonly")
            self._solver.getPC().setType("lu")
            self._dt = dt
            by_one = self._flow.copy()
            by_one.scale(self._theta)
            by_one.array[self._held] = 0
            self._by_one = self._solve(by_one)
        old = self.temperature.vector
        right = self._stored * old
        right.scale(1 / dt)
        right.axpy(self._theta - 1, self._conducted * old)
        right.axpy((1 - self._theta) * self._old_flow, self._flow)
        right.array[self._held] = given
        self._without = self._solve(right)
        return self._without.array[self._surface].mean(), self._by_one.array[self._surface].mean()

    def end(self, flow):
        """Ends the step with the flow that passes at its end [W/m2]; returns the temperature of the surface."""
        self.temperature.x.array[:] = self._without.array + flow * self._by_one.array
        self._old_flow = flow
        return self.temperature.x.array[self._surface].mean()

    def mean(self):
        """The mean temperature of the body."""
        return fem.assemble_scalar(self._sum) / self._area
