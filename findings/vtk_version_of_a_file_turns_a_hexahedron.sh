#!/usr/bin/env bash
# What:      VTK's reader of .vtu exchanges two mid-edge points of Lagrange hexahedra (type 72, second order) where the attribute
#            version of the file is below 2.1: the same connectivity is another element. A writer that puts "0.1" or "1.0" there, as most
#            examples do, has its edges 10 and 11 exchanged.
# Versions:  VTK 9.1.0 (Debian 12)
# Seen on:   28 November 2026, Debian 12, x86-64; VTK 9.3.0 of Debian 13 too
# Matters:   curved elements are twisted in pictures and integrals, corners and faces look right.
# Solidus:   reads type 72 with corners alone and refuses it with more points, so that the two numberings never matter
#            (docs/guide/formats.md).
. "$(dirname "${BASH_SOURCE[0]}")/common/root.sh"

make_root bookworm python3-vtk9=9.1.0+really9.1.0+dfsg2-5+deb12u1

said=$(inside python3 - <<'PYTHON'
import vtk

GRID = """<VTKFile type="UnstructuredGrid" version="%s" byte_order="LittleEndian"><UnstructuredGrid>
<Piece NumberOfPoints="27" NumberOfCells="1">
<Points><DataArray type="Float64" NumberOfComponents="3" format="ascii">%s</DataArray></Points>
<Cells><DataArray type="Int64" Name="connectivity" format="ascii">%s</DataArray>
<DataArray type="Int64" Name="offsets" format="ascii">27</DataArray>
<DataArray type="UInt8" Name="types" format="ascii">72</DataArray></Cells>
</Piece></UnstructuredGrid></VTKFile>"""

print("VTK", vtk.vtkVersion.GetVTKVersion())
for version in ("0.1", "1.0", "2.0", "2.1", "2.2"):
    with open("/tmp/a.vtu", "w") as file:
        file.write(GRID % (version, " ".join(f"{n} 0 0" for n in range(27)), " ".join(map(str, range(27)))))
    reader = vtk.vtkXMLUnstructuredGridReader()
    reader.SetFileName("/tmp/a.vtu")
    reader.Update()
    cell = reader.GetOutput().GetCell(0)
    print(version, *(cell.GetPointId(n) for n in range(16, 20)))
PYTHON
)
expect "$said" <<END
VTK 9.1.0
0.1 16 17 19 18
1.0 16 17 19 18
2.0 16 17 19 18
2.1 16 17 18 19
2.2 16 17 18 19
END
