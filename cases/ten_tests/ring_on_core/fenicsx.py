"""A hot ring shrinks onto a core, for DOLFINx: axisymmetric, bilinear quadrilaterals, the radial displacement alone (nothing moves along
the axis). DOLFINx has no contact: that the gap is closed is known here, and one pressure along the line of contact follows from
what one pascal does on each side. /usr/bin/python3 fenicsx.py
"""
from mpi4py import MPI
import numpy as np
import ufl

from dolfinx import fem, mesh
from dolfinx.fem import petsc

HEIGHT, A, B, C = 0.004, 0.05, 0.05002, 0.08002
RISE, ALPHA = -100.0, 23e-6


class Body:
    """A ring from one radius to another, of (columns, rows) elements: what pressures and a change of temperature do to it."""

    def __init__(self, inner, outer, divisions, young, poisson):
        self.mu, self.lame = young / (2 * (1 + poisson)), young * poisson / ((1 + poisson) * (1 - 2 * poisson))
        self.grid = mesh.create_rectangle(MPI.COMM_SELF, [np.array([inner, 0.0]), np.array([outer, HEIGHT])], list(divisions),
                                          mesh.CellType.quadrilateral)
        self.space = fem.FunctionSpace(self.grid, ("CG", 1))
        self.r = ufl.SpatialCoordinate(self.grid)[0]
        self._held = [fem.dirichletbc(0.0, fem.locate_dofs_geometrical(self.space, lambda x: x[0] < 1e-12), self.space)]

    def solve(self, side, traction, rise):
        """The radial displacement under a traction [Pa] along r on the side at this radius [m], and a rise of temperature [K]."""
        u, v = ufl.TrialFunction(self.space), ufl.TestFunction(self.space)
        facets = mesh.locate_entities_boundary(self.grid, 1, lambda x: abs(x[0] - side) < 1e-9)
        tags = mesh.meshtags(self.grid, 1, np.sort(facets), np.ones(len(facets), np.int32))
        ds = ufl.Measure("ds", self.grid, subdomain_data=tags)
        radial, hoop = self.stress(u, 0.0)
        a = (radial * v.dx(0) + hoop * v / self.r + self.mu * u.dx(1) * v.dx(1)) * self.r * ufl.dx
        pull, thermal = fem.Constant(self.grid, traction), fem.Constant(self.grid, self.thermal(rise))
        right = pull * v * self.r * ds(1) + thermal * (v.dx(0) + v / self.r) * self.r * ufl.dx
        return petsc.LinearProblem(a, right, bcs=self._held, petsc_options={"ksp_type": "preonly", "pc_type": "lu"}).solve()

    def thermal(self, rise):
        return (3 * self.lame + 2 * self.mu) * ALPHA * rise

    def stress(self, u, rise):
        """Radial and hoop stress."""
        volume, thermal = u.dx(0) + u / self.r, self.thermal(rise)
        return self.lame * volume + 2 * self.mu * u.dx(0) - thermal, self.lame * volume + 2 * self.mu * u / self.r - thermal

    def at(self, expression, r):
        """The mean over the elements whose middle is at a radius and nearest to half of the height."""
        cells = np.arange(self.grid.topology.index_map(2).size_local, dtype=np.int32)
        middles = mesh.compute_midpoints(self.grid, 2, cells)
        way = np.hypot(middles[:, 0] - r, middles[:, 1] - HEIGHT / 2)
        near = cells[way < way.min() + 1e-9]
        return float(np.mean(fem.Expression(expression, np.array([[0.5, 0.5]])).eval(near)))

    def displacement(self, u, r):
        places = self.space.tabulate_dof_coordinates()
        return u.x.array[np.argmin(np.hypot(places[:, 0] - r, places[:, 1] - HEIGHT / 2))]


core, ring = Body(0.0, A, (25, 2), 200e9, 0.3), Body(B, C, (15, 3), 70e9, 0.33)
pressed, widened, cooled = core.solve(A, -1.0, 0.0), ring.solve(B, 1.0, 0.0), ring.solve(B, 0.0, RISE)
by_one = ring.displacement(widened, B) - core.displacement(pressed, A)
pressure = -(ring.displacement(cooled, B) + (B - A)) / by_one
end = fem.Function(ring.space)
end.x.array[:] = cooled.x.array + pressure * widened.x.array
radial, hoop = ring.stress(end, RISE)
print(f"VALUE pressure {B} {HEIGHT / 2} 0 1 {1e-6 * pressure:.10g}")
for r in (0.05102, 0.07902):
    print(f"VALUE stress_tt {r} {HEIGHT / 2} 0 1 {1e-6 * ring.at(hoop, r):.10g}")
print(f"VALUE stress_rr 0.05102 {HEIGHT / 2} 0 1 {1e-6 * ring.at(radial, 0.05102):.10g}")
print(f"VALUE stress_rr 0.025 {HEIGHT / 2} 0 1 {1e-6 * pressure * core.at(core.stress(pressed, 0.0)[0], 0.025):.10g}")
print(f"VALUE displacement_x {C} {HEIGHT / 2} 0 1 {1e6 * ring.displacement(end, C):.10g}")
