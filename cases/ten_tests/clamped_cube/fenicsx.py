"""A cube that cannot expand is heated, for DOLFINx: linear tetrahedra of mesh.msh. /usr/bin/python3 fenicsx.py"""
from pathlib import Path

from mpi4py import MPI
import numpy as np
import ufl

from dolfinx import fem, geometry, mesh
from dolfinx.fem import petsc

E, NU, ALPHA, RISE = 70e9, 0.33, 23e-6, 100.0
MU, LAMBDA = E / (2 * (1 + NU)), E * NU / ((1 + NU) * (1 - 2 * NU))
PLACES = [(0.004, 0.008, 0.002), (0.052, 0.047, 0.049), (0.09, 0.045, 0.03)]
TETRAHEDRON = "4"  # in Gmsh's format


def read(path):
    """Nodes and tetrahedra of a file of Gmsh 2.2, whose nodes are numbered from one on without a gap."""
    lines = iter(path.read_text().splitlines())
    nodes, cells = [], []
    for line in lines:
        if line == "$Nodes":
            nodes = [[float(x) for x in next(lines).split()[1:]] for _ in range(int(next(lines)))]
        elif line == "$Elements":
            rows = [next(lines).split() for _ in range(int(next(lines)))]
            cells = [[int(n) - 1 for n in row[-4:]] for row in rows if row[1] == TETRAHEDRON]
    return np.array(nodes), np.array(cells)


def stress(u):
    strain = ufl.sym(ufl.grad(u))
    return LAMBDA * ufl.tr(strain) * ufl.Identity(3) + 2 * MU * strain


nodes, cells = read(Path(__file__).resolve().parent / "mesh.msh")
grid = mesh.create_mesh(MPI.COMM_SELF, cells, nodes, ufl.Mesh(ufl.VectorElement("Lagrange", ufl.tetrahedron, 1)))
space = fem.VectorFunctionSpace(grid, ("CG", 1))
u, v = ufl.TrialFunction(space), ufl.TestFunction(space)
THERMAL = (3 * LAMBDA + 2 * MU) * ALPHA * RISE
grid.topology.create_connectivity(2, 3)
held = fem.locate_dofs_topological(space, 2, mesh.exterior_facet_indices(grid.topology))
problem = petsc.LinearProblem(ufl.inner(stress(u), ufl.sym(ufl.grad(v))) * ufl.dx, THERMAL * ufl.div(v) * ufl.dx,
                              bcs=[fem.dirichletbc(np.zeros(3), held, space)],
                              petsc_options={"ksp_type": "preonly", "pc_type": "lu"})
found = problem.solve()
total = fem.Expression(stress(found) - THERMAL * ufl.Identity(3), np.array([[0.25, 0.25, 0.25]]))
tree = geometry.BoundingBoxTree(grid, 3)
for place in PLACES:
    point = np.array([place])
    cell = geometry.compute_colliding_cells(grid, geometry.compute_collisions(tree, point), point).links(0)[0]
    s = total.eval([cell])[0].reshape(3, 3)
    for name, value in (("xx", s[0, 0]), ("yy", s[1, 1]), ("zz", s[2, 2]), ("xy", s[0, 1])):
        print(f"VALUE stress_{name} {place[0]} {place[1]} {place[2]} 1 {1e-6 * value:.10g}")
