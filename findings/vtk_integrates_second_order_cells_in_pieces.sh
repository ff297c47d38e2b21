#!/usr/bin/env bash
# What:      VTK integrates a cell of second order over linear pieces between its nodes. Of x^2, which a quadratic element holds exactly,
#            the integral is 12 % too large over a hexahedron and 41 % over a tetrahedron. The volume of a tetrahedron with a curved face is
#            17 % too small, also by the filter of cell sizes.
# Versions:  VTK 9.1.0 (Debian 12) and 9.3.0 (Debian 13)
# Seen on:   30 November 2026, Debian 12, x86-64
# Matters:   ParaView's "Integrate Variables" and "Cell Size" are these filters: volumes, masses, mean temperatures and energies of results
#            with mid-edge nodes are those of another, coarser field.
# Solidus:   has probes of kind mean and integral, which it evaluates itself (docs/guide/results.md).
. "$(dirname "${BASH_SOURCE[0]}")/common/root.sh"

integrate() {
  inside python3 - 2>/dev/null <<'PYTHON'
import math

from vtkmodules.vtkCommonCore import vtkDoubleArray, vtkPoints, vtkVersion
from vtkmodules.vtkCommonDataModel import VTK_QUADRATIC_HEXAHEDRON, VTK_QUADRATIC_TETRA, vtkUnstructuredGrid
from vtkmodules.vtkFiltersParallel import vtkIntegrateAttributes
from vtkmodules.vtkFiltersVerdict import vtkCellSizeFilter


def with_middles(corners, edges):
    return corners + [tuple((a + b) / 2 for a, b in zip(corners[m], corners[n])) for m, n in edges]


def filtered(kind, points, function):
    grid, nodes, field = vtkUnstructuredGrid(), vtkPoints(), vtkDoubleArray()
    nodes.SetDataTypeToDouble()
    field.SetName("f")
    for point in points:
        nodes.InsertNextPoint(*point)
        field.InsertNextValue(function(*point))
    grid.SetPoints(nodes)
    grid.Allocate(1)
    grid.InsertNextCell(kind, len(points), list(range(len(points))))
    grid.GetPointData().SetScalars(field)
    integral, size = vtkIntegrateAttributes(), vtkCellSizeFilter()
    for algorithm in (integral, size):
        algorithm.SetInputData(grid)
        algorithm.Update()
    return (integral.GetOutput().GetPointData().GetArray("f").GetValue(0),
            size.GetOutput().GetCellData().GetArray("Volume").GetValue(0))


cube = with_middles([(x, y, z) for z in (0, 1) for x, y in ((0, 0), (1, 0), (1, 1), (0, 1))],
                    ((0, 1), (1, 2), (2, 3), (3, 0), (4, 5), (5, 6), (6, 7), (7, 4), (0, 4), (1, 5), (2, 6), (3, 7)))
tetrahedron = with_middles([(0, 0, 0), (1, 0, 0), (0, 1, 0), (0, 0, 1)], ((0, 1), (1, 2), (2, 0), (0, 3), (1, 3), (2, 3)))
# The three mid-edge nodes of the inclined face lie on the sphere.
curved = [tuple(x / math.dist(p, (0, 0, 0)) for x in p) if n in (5, 8, 9) else p for n, p in enumerate(tetrahedron)]
print("VTK", vtkVersion.GetVTKVersion())
print(f"x^2 over the cube: {filtered(VTK_QUADRATIC_HEXAHEDRON, cube, lambda x, y, z: x * x)[0]:.4f}, exactly {1 / 3:.4f}")
print(f"x^2 over the tetrahedron: {filtered(VTK_QUADRATIC_TETRA, tetrahedron, lambda x, y, z: x * x)[0]:.5f}, exactly {1 / 60:.5f}")
# By Gauss' rule with 24^3 points; the volume of a cell of second order is a polynomial of its nodes.
print("curved volume: {:.4f} and {:.4f}, exactly 0.4456".format(*filtered(VTK_QUADRATIC_TETRA, curved, lambda x, y, z: 1)))
PYTHON
}

make_root bookworm python3-vtk9=9.1.0+really9.1.0+dfsg2-5+deb12u1
old=$(integrate)
make_root trixie python3-vtk9=9.3.0+dfsg1-4+b1
environment=(UCX_LOG_LEVEL=fatal OMPI_ALLOW_RUN_AS_ROOT=1 OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1)
expect "$old
$(integrate)" <<END
VTK 9.1.0
x^2 over the cube: 0.3750, exactly 0.3333
x^2 over the tetrahedron: 0.02344, exactly 0.01667
curved volume: 0.3679 and 0.3679, exactly 0.4456
VTK 9.3.0
x^2 over the cube: 0.3750, exactly 0.3333
x^2 over the tetrahedron: 0.02344, exactly 0.01667
curved volume: 0.3679 and 0.3679, exactly 0.4456
END
