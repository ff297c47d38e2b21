#!/usr/bin/env bash
# What:      Mesh.from_file of numpy-stl reads of a text STL with several solids the first one, and says nothing; from_multi_file reads all,
#            one by one. VTK, meshio and trimesh read all triangles of the same file.
# Versions:  numpy-stl 2.9.0, VTK 9.3.0, meshio 5.3.5, trimesh 4.5.1 (Debian 13)
# Seen on:   30 November 2026, Debian 12, x86-64
# Matters:   casting, feeders and core that were exported into one file have the volume and the mass of the first of them.
# Solidus:   solidus new takes all closed surfaces of an STL file (docs/guide/new_case.md).
. "$(dirname "${BASH_SOURCE[0]}")/common/root.sh"

make_root trixie python3-stl=2.9.0-2+b7 python3-vtk9=9.3.0+dfsg1-4+b1 python3-meshio=7.0.0-really-5.3.5-6+deb13u1 \
  python3-trimesh=4.5.1-3
environment=(UCX_LOG_LEVEL=fatal OMPI_ALLOW_RUN_AS_ROOT=1 OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1)

said=$(inside python3 - 2>/dev/null <<'PYTHON'
import meshio
import stl.mesh
import trimesh
from vtkmodules.vtkIOGeometry import vtkSTLReader

# Two tetrahedra of volume 1/6, beside each other.
with open("/tmp/two.stl", "w") as file:
    for name, x in (("casting", 0), ("feeder", 2)):
        corners = [(x, 0, 0), (x + 1, 0, 0), (x, 1, 0), (x, 0, 1)]
        print("solid", name, file=file)
        for face in ((0, 2, 1), (0, 1, 3), (0, 3, 2), (1, 2, 3)):
            print("facet normal 0 0 0\nouter loop", file=file)
            for n in face:
                print("vertex", *corners[n], file=file)
            print("endloop\nendfacet", file=file)
        print("endsolid", name, file=file)
one = stl.mesh.Mesh.from_file("/tmp/two.stl")
print(f"from_file: {len(one)} of 8 triangles, volume {6 * float(one.get_mass_properties()[0]):.1f} of 2 sixths")
print("from_multi_file:", [len(solid) for solid in stl.mesh.Mesh.from_multi_file("/tmp/two.stl")])
reader = vtkSTLReader()
reader.SetFileName("/tmp/two.stl")
reader.Update()
print("VTK:", reader.GetOutput().GetNumberOfCells())
print("meshio:", sum(len(block.data) for block in meshio.read("/tmp/two.stl").cells))
print("trimesh:", {name: len(part.faces) for name, part in trimesh.load("/tmp/two.stl").geometry.items()})
PYTHON
)
expect "$said" <<END
from_file: 4 of 8 triangles, volume 1.0 of 2 sixths
from_multi_file: [4, 4]
VTK: 8
meshio: 8
trimesh: {'casting': 4, 'feeder': 4}
END
