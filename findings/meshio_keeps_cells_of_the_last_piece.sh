#!/usr/bin/env bash
# What:      meshio reads of a .vtu with several pieces the points of all and the cells of the last one, without a word. VTK writes such a
#            file where SetNumberOfPieces is more than one, and reads it whole.
# Versions:  meshio 5.3.5, VTK 9.3.0 (Debian 13)
# Seen on:   30 November 2026, Debian 12, x86-64
# Matters:   all nodes are there, so that extents and numbers of nodes are right, but of several parts or processes one has elements.
# Solidus:   refuses a .vtu with several pieces, and says so (docs/guide/formats.md); each .vtu that it writes is one piece.
. "$(dirname "${BASH_SOURCE[0]}")/common/root.sh"

make_root trixie python3-meshio=7.0.0-really-5.3.5-6+deb13u1 python3-vtk9=9.3.0+dfsg1-4+b1
environment=(UCX_LOG_LEVEL=fatal OMPI_ALLOW_RUN_AS_ROOT=1 OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1)

said=$(inside python3 - 2>/dev/null <<'PYTHON'
import meshio
from vtkmodules.vtkCommonCore import vtkPoints
from vtkmodules.vtkCommonDataModel import VTK_TETRA, vtkUnstructuredGrid
from vtkmodules.vtkFiltersParallel import vtkExtractUnstructuredGridPiece
from vtkmodules.vtkIOXML import vtkXMLUnstructuredGridReader, vtkXMLUnstructuredGridWriter

# Four tetrahedra side by side, in two pieces.
grid, nodes = vtkUnstructuredGrid(), vtkPoints()
for n in range(4):
    for x, y, z in ((0, 0, 0), (1, 0, 0), (0, 1, 0), (0, 0, 1)):
        nodes.InsertNextPoint(x + 2 * n, y, z)
grid.SetPoints(nodes)
grid.Allocate(4)
for n in range(4):
    grid.InsertNextCell(VTK_TETRA, 4, list(range(4 * n, 4 * n + 4)))
piece, writer, reader = vtkExtractUnstructuredGridPiece(), vtkXMLUnstructuredGridWriter(), vtkXMLUnstructuredGridReader()
piece.SetInputData(grid)
piece.CreateGhostCellsOff()
writer.SetInputConnection(piece.GetOutputPort())
writer.SetNumberOfPieces(2)
writer.SetDataModeToAscii()
for file in (writer, reader):
    file.SetFileName("/tmp/four.vtu")
writer.Write()
reader.Update()
print(f"VTK: {reader.GetOutput().GetNumberOfPoints()} nodes, {reader.GetOutput().GetNumberOfCells()} tetrahedra")
mesh = meshio.read("/tmp/four.vtu")
print(f"meshio: {len(mesh.points)} nodes, {sum(len(block.data) for block in mesh.cells)} tetrahedra")
PYTHON
)
expect "$said" <<END
VTK: 24 nodes, 4 tetrahedra
meshio: 24 nodes, 2 tetrahedra
END
