#!/usr/bin/env bash
# What:      Gmsh's export to Abaqus' .inp names every volume twice: as VolumeN, its geometry, and by its physical group. Who takes
#            each *ELSET for a body gets all bodies twice, in one place.
# Versions:  Gmsh 4.8.4 (Debian 12) and 4.13.1 (Debian 13)
# Seen on:   28 November 2026, Debian 12, x86-64
# Matters:   bodies that overlap have twice the mass and the heat, and contact with themselves.
# Solidus:   takes bodies that hold each element once, and says which sets it leaves out (docs/guide/formats.md).
. "$(dirname "${BASH_SOURCE[0]}")/common/root.sh"

export_sets() {
  inside python3 - <<'PYTHON'
import gmsh

gmsh.initialize()
gmsh.option.setNumber("General.Terminal", 0)
gmsh.model.occ.addBox(0, 0, 0, 1, 1, 1)
gmsh.model.occ.addBox(1, 0, 0, 1, 1, 1)
gmsh.model.occ.fragment([(3, 1)], [(3, 2)])
gmsh.model.occ.synchronize()
for volume, name in ((1, "casting"), (2, "mould")):
    gmsh.model.setPhysicalName(3, gmsh.model.addPhysicalGroup(3, [volume]), name)
gmsh.option.setNumber("Mesh.MeshSizeMax", 2)
gmsh.model.mesh.generate(3)
gmsh.write("/tmp/two.inp")
print(gmsh.option.getString("General.Version"))
for line in open("/tmp/two.inp"):
    if "ELSET" in line:
        print(line.strip())
PYTHON
}

for of in "bookworm 4.8.4+ds2-3 4.8.4" "trixie 4.13.1+ds1-6 4.13.1"; do
  read -r suite package version <<<"$of"
  make_root "$suite" "python3-gmsh=$package"
  expect "$(export_sets)" <<END
$version
*ELEMENT, type=C3D4, ELSET=Volume1
*ELEMENT, type=C3D4, ELSET=Volume2
*ELSET,ELSET=casting
*ELSET,ELSET=mould
END
done
