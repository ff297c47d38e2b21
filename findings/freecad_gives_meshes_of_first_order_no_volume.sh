#!/usr/bin/env bash
# What:      the Volume of a mesh of first order is 0 mm^3 in FreeCAD; of the same mesh of second order it is right. The property is
#            described as the volume of the mesh, of any order; nothing is printed.
# Versions:  FreeCAD 0.20.2 (Debian 12) and 1.0.0 (Debian 13)
# Seen on:   30 November 2026, Debian 12, x86-64
# Matters:   masses, yields and checks against the volume of the part that a macro takes from the mesh are zero, or divide by zero.
# Solidus:   mesh-info prints the volume of each body, of either order.
. "$(dirname "${BASH_SOURCE[0]}")/common/root.sh"

measure() {
  inside python3 - 2>/dev/null <<'PYTHON'
import sys

import gmsh

sys.path += ["/usr/lib/freecad-python3/lib", "/usr/lib/freecad/lib", "/usr/lib/freecad/Mod/Fem", "/usr/share/freecad/Mod/Fem"]
import FreeCAD
import Fem

gmsh.initialize()
gmsh.option.setNumber("General.Terminal", 0)
gmsh.model.occ.addBox(0, 0, 0, 10, 10, 10)
gmsh.model.occ.synchronize()
gmsh.option.setNumber("Mesh.MeshSizeMax", 10)
gmsh.option.setNumber("Mesh.SaveAll", 1)
gmsh.model.mesh.generate(3)
print("FreeCAD", ".".join(FreeCAD.Version()[:2]))
for order in (1, 2):
    gmsh.model.mesh.setOrder(order)
    gmsh.write("/tmp/cube.unv")
    mesh = Fem.read("/tmp/cube.unv")
    print(f"order {order}: {'some' if mesh.TetraCount else 'no'} tetrahedra, {mesh.Volume.Value:.3f} mm^3 of 1000")
PYTHON
}

make_root bookworm freecad-python3=0.20.2+dfsg1-4 python3-gmsh=4.8.4+ds2-3
old=$(measure)
make_root trixie freecad-python3=1.0.0+dfsg-8+deb13u3 python3-gmsh=4.13.1+ds1-6
environment=(UCX_LOG_LEVEL=fatal OMPI_ALLOW_RUN_AS_ROOT=1 OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1)
expect "$old
$(measure)" <<END
FreeCAD 0.20
order 1: some tetrahedra, 0.000 mm^3 of 1000
order 2: some tetrahedra, 1000.000 mm^3 of 1000
FreeCAD 1.0
order 1: some tetrahedra, 0.000 mm^3 of 1000
order 2: some tetrahedra, 1000.000 mm^3 of 1000
END
