#!/usr/bin/env bash
# What:      meshio reads a .msh of Gmsh and writes .msh, under the same ending, in the format of ANSYS Fluent: of the two formats with that
#            ending, ANSYS is first. It has no bodies and no names: the physical groups of the file that was read are gone. Gmsh refuses the
#            file; meshio reads it again, so that a test of writing and reading sees nothing but what is missing. Only file_format="gmsh" or
#            "gmsh22" writes Gmsh's.
# Versions:  meshio 5.0.0 (Debian 12) and 5.3.5 (Debian 13), Gmsh 4.8.4 and 4.13.1
# Seen on:   30 November 2026, Debian 12, x86-64
# Matters:   a script that scales, cleans or moves a mesh and writes it again loses which element is casting and which is mould.
# Solidus:   refuses a .msh that does not begin as those of Gmsh do, and says so.
. "$(dirname "${BASH_SOURCE[0]}")/common/root.sh"

write_again() {
  inside python3 - 2>/dev/null <<'PYTHON' | sed '/^$/d'
import gmsh
import meshio

gmsh.initialize()
gmsh.option.setNumber("General.Terminal", 0)
gmsh.option.setNumber("Mesh.MshFileVersion", 2.2)
gmsh.model.occ.addBox(0, 0, 0, 1, 1, 1)
gmsh.model.occ.synchronize()
gmsh.model.setPhysicalName(3, gmsh.model.addPhysicalGroup(3, [1]), "casting")
gmsh.model.mesh.generate(3)
gmsh.write("/tmp/part.msh")
mesh = meshio.read("/tmp/part.msh")
print(f"meshio {meshio.__version__}, Gmsh {gmsh.option.getString('General.Version')}")
print("read:", list(mesh.field_data), sorted(mesh.cell_data))
meshio.write("/tmp/again.msh", mesh)
again = meshio.read("/tmp/again.msh")
print("written and read:", list(again.field_data), sorted(again.cell_data))
try:
    gmsh.open("/tmp/again.msh")
    print("Gmsh reads it")
except Exception:
    print("Gmsh: refuses it")
PYTHON
}

make_root bookworm python3-meshio=7.0.0-3 python3-gmsh=4.8.4+ds2-3
old=$(write_again)
make_root trixie python3-meshio=7.0.0-really-5.3.5-6+deb13u1 python3-gmsh=4.13.1+ds1-6
expect "$old
$(write_again)" <<END
meshio 5.0.0, Gmsh 4.8.4
read: ['casting'] ['gmsh:geometrical', 'gmsh:physical']
written and read: [] []
Gmsh: refuses it
meshio 5.3.5, Gmsh 4.13.1
read: ['casting'] ['gmsh:geometrical', 'gmsh:physical']
written and read: [] []
Gmsh: refuses it
END
