#!/usr/bin/env bash
# What:      VTK writes values that are no numbers into text files and does not read them again, each format in its own way. In .vtk all
#            values after a nan or an inf are lost, zero or what was in memory; the reader ends without an error code. In .vtu nan is
#            read, but with one inf there is not one node left of the whole mesh. Binary files of both keep everything.
# Versions:  VTK 9.1.0 (Debian 12) and 9.3.0 (Debian 13)
# Seen on:   30 November 2026, Debian 12, x86-64
# Matters:   "not solidified yet", "no contact here" and a width of a gap divided by zero are such values, and text is what one chooses for
#            looking at a file.
# Solidus:   writes binary .vtu and refuses to write values that are not finite (src/results/formats/vtu.cpp). Of .vtk it reads bodies
#            behind fields with nan and inf, in text too (tests/program/foreign_meshes_test).
. "$(dirname "${BASH_SOURCE[0]}")/common/root.sh"

write_and_read() {
  inside python3 - 2>/dev/null <<'PYTHON'
import math

from vtkmodules.vtkCommonCore import vtkDoubleArray, vtkPoints, vtkVersion
from vtkmodules.vtkCommonDataModel import VTK_VERTEX, vtkUnstructuredGrid
from vtkmodules.vtkIOLegacy import vtkUnstructuredGridReader, vtkUnstructuredGridWriter
from vtkmodules.vtkIOXML import vtkXMLUnstructuredGridReader, vtkXMLUnstructuredGridWriter


def grid_of(values):
    grid, points, field = vtkUnstructuredGrid(), vtkPoints(), vtkDoubleArray()
    field.SetName("gap")
    grid.SetPoints(points)
    grid.Allocate(len(values))
    for n, value in enumerate(values):
        points.InsertNextPoint(n, 0, 0)
        field.InsertNextValue(value)
        grid.InsertNextCell(VTK_VERTEX, 1, [n])
    grid.GetPointData().SetScalars(field)
    return grid


def kept(values, writer, reader, ending):
    writer.SetInputData(grid_of(values))
    for file in (writer, reader):
        file.SetFileName("/tmp/gap" + ending)
    writer.Write()
    reader.Update()
    grid = reader.GetOutput()
    field = grid.GetPointData().GetArray("gap")
    read = [field.GetValue(n) for n in range(grid.GetNumberOfPoints())] if field else []
    same = [a == b or (math.isnan(a) and math.isnan(b)) for a, b in zip(values, read)]
    return f"{grid.GetNumberOfPoints()} nodes, {sum(same)} values, error code {reader.GetErrorCode()}"


print("VTK", vtkVersion.GetVTKVersion())
for odd in (math.nan, math.inf):
    values = [1.0, odd, 3.0, 4.0, 5.0]
    for text in (True, False):
        legacy, xml = vtkUnstructuredGridWriter(), vtkXMLUnstructuredGridWriter()
        (legacy.SetFileTypeToASCII if text else legacy.SetFileTypeToBinary)()
        (xml.SetDataModeToAscii if text else xml.SetDataModeToBinary)()
        for writer, reader, ending in ((legacy, vtkUnstructuredGridReader(), ".vtk"), (xml, vtkXMLUnstructuredGridReader(), ".vtu")):
            print(f"{odd} in {'text' if text else 'binary'} {ending}: {kept(values, writer, reader, ending)}")
PYTHON
}

make_root bookworm python3-vtk9=9.1.0+really9.1.0+dfsg2-5+deb12u1
old=$(write_and_read)
make_root trixie python3-vtk9=9.3.0+dfsg1-4+b1
environment=(UCX_LOG_LEVEL=fatal OMPI_ALLOW_RUN_AS_ROOT=1 OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1)
expect "$old
$(write_and_read)" <<END
VTK 9.1.0
nan in text .vtk: 5 nodes, 1 values, error code 0
nan in text .vtu: 5 nodes, 5 values, error code 0
nan in binary .vtk: 5 nodes, 5 values, error code 0
nan in binary .vtu: 5 nodes, 5 values, error code 0
inf in text .vtk: 5 nodes, 1 values, error code 0
inf in text .vtu: 0 nodes, 0 values, error code 0
inf in binary .vtk: 5 nodes, 5 values, error code 0
inf in binary .vtu: 5 nodes, 5 values, error code 0
VTK 9.3.0
nan in text .vtk: 5 nodes, 1 values, error code 0
nan in text .vtu: 5 nodes, 5 values, error code 0
nan in binary .vtk: 5 nodes, 5 values, error code 0
nan in binary .vtu: 5 nodes, 5 values, error code 0
inf in text .vtk: 5 nodes, 1 values, error code 0
inf in text .vtu: 0 nodes, 0 values, error code 0
inf in binary .vtk: 5 nodes, 5 values, error code 0
inf in binary .vtu: 5 nodes, 5 values, error code 0
END
