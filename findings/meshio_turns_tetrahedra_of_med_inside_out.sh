#!/usr/bin/env bash
# What:      MED numbers the corners of a tetrahedron so that it is left-handed by the order of VTK, Gmsh and Abaqus. meshio takes the
#            numbers of a .med as they are: all tetrahedra that FreeCAD writes have negative volumes, of a mesh that has positive ones when
#            FreeCAD writes it to .inp. Back and forth by meshio alone shows nothing.
# Versions:  FreeCAD 1.0.0, meshio 5.3.5, Gmsh 4.13.1 (Debian 13)
# Seen on:   30 November 2026, Debian 12, x86-64
# Matters:   masses and stiffnesses are negative, or their determinants stop a solver; normals of faces point inwards.
# Solidus:   turns mirrored elements in every format (docs/guide/formats.md).
. "$(dirname "${BASH_SOURCE[0]}")/common/root.sh"

make_root trixie freecad-python3=1.0.0+dfsg-8+deb13u3 python3-meshio=7.0.0-really-5.3.5-6+deb13u1 python3-h5py=3.13.0-1 \
  python3-gmsh=4.13.1+ds1-6
environment=(UCX_LOG_LEVEL=fatal OMPI_ALLOW_RUN_AS_ROOT=1 OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1)

said=$(inside python3 - 2>/dev/null <<'PYTHON'
import sys

import gmsh
import meshio
import numpy as np

sys.path += ["/usr/lib/freecad-python3/lib", "/usr/lib/freecad/lib", "/usr/lib/freecad/Mod/Fem", "/usr/share/freecad/Mod/Fem"]
import FreeCAD
import Fem


def volumes(name):
    mesh = meshio.read(name)
    a, b, c, d = (mesh.points[mesh.cells_dict["tetra"][:, n]] for n in range(4))
    six = np.einsum("ij,ij->i", np.cross(b - a, c - a), d - a)
    signs = {"positive": six > 0, "negative": six < 0}
    return f"{' and '.join(sign for sign, those in signs.items() if those.any())}, {six.sum() / 6:.3f} in all"


gmsh.initialize()
gmsh.option.setNumber("General.Terminal", 0)
gmsh.model.occ.addBox(0, 0, 0, 10, 10, 10)
gmsh.model.occ.synchronize()
gmsh.option.setNumber("Mesh.MeshSizeMax", 10)
gmsh.option.setNumber("Mesh.SaveAll", 1)
gmsh.model.mesh.generate(3)
for ending in ("unv", "vtk"):
    gmsh.write("/tmp/cube." + ending)
print("Gmsh's .vtk:", volumes("/tmp/cube.vtk"))
mesh = Fem.read("/tmp/cube.unv")
for ending in ("inp", "med"):
    mesh.write("/tmp/again." + ending)
    print(f"FreeCAD's .{ending}:", volumes("/tmp/again." + ending))
PYTHON
)
expect "$said" <<END
Gmsh's .vtk: positive, 1000.000 in all
FreeCAD's .inp: positive, 1000.000 in all
FreeCAD's .med: negative, -1000.000 in all
END
