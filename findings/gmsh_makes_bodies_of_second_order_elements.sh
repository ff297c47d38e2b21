#!/usr/bin/env bash
# What:      Gmsh writes second order to Medit's .mesh as TetrahedraP2 where the option Mesh.ElementOrder is 2, and else as Tetrahedra,
#            whatever the elements are. A mesh that was raised by setOrder(2) has ten nodes and the number of the body in lines of
#            Tetrahedra, where the format has four nodes and the number: Gmsh itself reads the fifth node as the body, and makes hundreds of
#            bodies of one, of first order.
# Versions:  Gmsh 4.8.4 (Debian 12) and 4.13.1 (Debian 13)
# Seen on:   30 November 2026, Debian 12, x86-64
# Matters:   a casting is hundreds of bodies; mid-edge nodes belong to no element.
# Solidus:   reads .mesh by a reader of its own, which refuses such a line with its number (docs/guide/formats.md).
. "$(dirname "${BASH_SOURCE[0]}")/common/root.sh"

write_and_read() {
  inside python3 - <<'PYTHON'
import gmsh

gmsh.initialize()
gmsh.option.setNumber("General.Terminal", 0)
print("Gmsh", gmsh.option.getString("General.Version"))
for way in ("first order", "ElementOrder = 2", "setOrder(2)"):
    gmsh.clear()
    gmsh.option.setNumber("Mesh.ElementOrder", 2 if "=" in way else 1)
    gmsh.model.occ.addBox(0, 0, 0, 1, 1, 1)
    gmsh.model.occ.synchronize()
    gmsh.model.mesh.generate(3)
    if "set" in way:
        gmsh.model.mesh.setOrder(2)
    gmsh.write("/tmp/cube.mesh")
    lines = [line.strip() for line in open("/tmp/cube.mesh")]
    block = next(n for n, line in enumerate(lines) if line.startswith("Tetrahedra"))
    gmsh.clear()
    gmsh.merge("/tmp/cube.mesh")
    bodies, (kind,) = len(gmsh.model.getEntities(3)), gmsh.model.mesh.getElementTypes(3)
    count = "one body" if bodies == 1 else "more than 100 bodies" if bodies > 100 else f"{bodies} bodies"
    print(f"{way}: {lines[block]} of {len(lines[block + 2].split())} numbers, read as {count} of "
          f"{gmsh.model.mesh.getElementProperties(kind)[3]} nodes an element")
PYTHON
}

make_root bookworm python3-gmsh=4.8.4+ds2-3
old=$(write_and_read)
make_root trixie python3-gmsh=4.13.1+ds1-6
expect "$old
$(write_and_read)" <<END
Gmsh 4.8.4
first order: Tetrahedra of 5 numbers, read as one body of 4 nodes an element
ElementOrder = 2: TetrahedraP2 of 11 numbers, read as one body of 10 nodes an element
setOrder(2): Tetrahedra of 11 numbers, read as more than 100 bodies of 4 nodes an element
Gmsh 4.13.1
first order: Tetrahedra of 5 numbers, read as one body of 4 nodes an element
ElementOrder = 2: TetrahedraP2 of 11 numbers, read as one body of 10 nodes an element
setOrder(2): Tetrahedra of 11 numbers, read as more than 100 bodies of 4 nodes an element
END
