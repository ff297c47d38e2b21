#!/usr/bin/env bash
# What:      meshio writes hexahedra of second order to Exodus II in VTK's order of nodes; Exodus numbers the four upright edges before
#            those of the upper face, as VTK's reader expects. Eight of twelve mid-edge nodes are on other edges. meshio reads its own
#            file as it was, so that a test of writing and reading sees nothing; to Nastran, which has the order of Exodus, it writes it
#            right.
# Versions:  meshio 5.3.5, VTK 9.3.0 (Debian 13)
# Seen on:   30 November 2026, Debian 12, x86-64
# Matters:   elements are twisted: Jacobians are negative, volumes wrong, corners and faces look right.
# Solidus:   neither reads nor writes Exodus; the orders of its formats are tested against files of other programs (docs/guide/formats.md).
. "$(dirname "${BASH_SOURCE[0]}")/common/root.sh"

make_root trixie python3-meshio=7.0.0-really-5.3.5-6+deb13u1 python3-netcdf4=1.7.2-1+b4 python3-vtk9=9.3.0+dfsg1-4+b1
environment=(UCX_LOG_LEVEL=fatal OMPI_ALLOW_RUN_AS_ROOT=1 OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1)

said=$(inside python3 - 2>/dev/null <<'PYTHON'
import meshio
import numpy as np
from vtkmodules.vtkIOExodus import vtkExodusIIReader

# The edges of a hexahedron in VTK's order: of the lower face, of the upper face, upright.
EDGES = [(0, 1), (1, 2), (2, 3), (3, 0), (4, 5), (5, 6), (6, 7), (7, 4), (0, 4), (1, 5), (2, 6), (3, 7)]


def in_place(points):
    return sum(np.allclose(points[8 + n], (points[a] + points[b]) / 2) for n, (a, b) in enumerate(EDGES))


corners = np.array([[x, y, z] for z in (0, 1) for x, y in ((0, 0), (1, 0), (1, 1), (0, 1))], float)
points = np.vstack([corners] + [(corners[a] + corners[b]) / 2 for a, b in EDGES])
meshio.write("/tmp/cube.e", meshio.Mesh(points, [("hexahedron20", np.arange(20)[None])]))
mesh = meshio.read("/tmp/cube.e")
print(f"meshio: {in_place(mesh.points[mesh.cells[0].data[0]])} of 12 mid-edge nodes on their edges")
reader = vtkExodusIIReader()
reader.SetFileName("/tmp/cube.e")
reader.Update()
cell = reader.GetOutput().GetBlock(0).GetBlock(0).GetCell(0)
print(f"VTK: {in_place(np.array([cell.GetPoints().GetPoint(n) for n in range(20)]))} of 12 mid-edge nodes on their edges")
PYTHON
)
expect "$said" <<END
meshio: 12 of 12 mid-edge nodes on their edges
VTK: 4 of 12 mid-edge nodes on their edges
END
