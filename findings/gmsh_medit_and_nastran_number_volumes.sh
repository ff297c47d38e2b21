#!/usr/bin/env bash
# What:      Gmsh writes numbers of bodies into Medit's .mesh and Nastran's .bdf, but not those of the physical groups: those of the
#            volumes. A casting that is group 1 and volume 2 is number 2, and the mould, group 2 and volume 1, is number 1. In .msh 2.2 the
#            first number is the group. Mesh.SaveElementTagType = 2 writes groups; its default is 1.
# Versions:  Gmsh 4.8.4 (Debian 12) and 4.13.1 (Debian 13)
# Seen on:   30 November 2026, Debian 12, x86-64
# Matters:   casting and mould, or alloy and chill, are exchanged; a group of several volumes comes out as several bodies.
# Solidus:   names bodies of these formats by the numbers of the file, and mesh-info prints their extents (docs/guide/formats.md).
. "$(dirname "${BASH_SOURCE[0]}")/common/root.sh"

write() {
  inside python3 - <<'PYTHON'
import gmsh

gmsh.initialize()
gmsh.option.setNumber("General.Terminal", 0)
gmsh.model.occ.addBox(1, 0, 0, 1, 1, 1)
gmsh.model.occ.addBox(0, 0, 0, 1, 1, 1)
gmsh.model.occ.fragment([(3, 1)], [(3, 2)])
gmsh.model.occ.synchronize()
at = {round(gmsh.model.occ.getCenterOfMass(3, volume)[0], 1): volume for _, volume in gmsh.model.getEntities(3)}
for group, name, x in ((1, "casting", 0.5), (2, "mould", 1.5)):
    gmsh.model.addPhysicalGroup(3, [at[x]], group)
    gmsh.model.setPhysicalName(3, group, name)
gmsh.option.setNumber("Mesh.MshFileVersion", 2.2)
gmsh.model.mesh.generate(3)


def casting(ending):
    """The numbers of the elements whose nodes all have x <= 1."""
    gmsh.write("/tmp/two" + ending)
    lines = [line.rstrip() for line in open("/tmp/two" + ending)]
    tags, points, _ = gmsh.model.mesh.getNodes()
    if ending == ".bdf":
        xs = {int(line[8:16]): float(line[24:32]) for line in lines if line.startswith("GRID")}
        elements = [(int(line[16:24]), [int(line[24 + 8 * n:32 + 8 * n]) for n in range(4)]) for line in lines if line.startswith("CTETRA")]
    elif ending == ".mesh":
        start, tetrahedra = (next(n for n, line in enumerate(lines) if line.strip() == word) for word in ("Vertices", "Tetrahedra"))
        xs = {n: float(lines[start + 1 + n].split()[0]) for n in range(1, int(lines[start + 1]) + 1)}
        rows = [[int(x) for x in line.split()] for line in lines[tetrahedra + 2:tetrahedra + 2 + int(lines[tetrahedra + 1])]]
        elements = [(row[4], row[:4]) for row in rows]
    else:
        start, first = (lines.index(word) for word in ("$Nodes", "$Elements"))
        xs = {int(line.split()[0]): float(line.split()[1]) for line in lines[start + 2:lines.index("$EndNodes")]}
        rows = [[int(x) for x in line.split()] for line in lines[first + 2:lines.index("$EndElements")]]
        elements = [(row[3], row[-4:]) for row in rows if row[1] == 4]
    return sorted({number for number, nodes in elements if max(xs[n] for n in nodes) < 1.001})


print("Gmsh", gmsh.option.getString("General.Version"))
for kind in (1, 2):
    gmsh.option.setNumber("Mesh.SaveElementTagType", kind)
    print(f"group 1 by SaveElementTagType = {kind}:", *(f"{ending} {casting(ending)}" for ending in (".msh", ".mesh", ".bdf")))
PYTHON
}

make_root bookworm python3-gmsh=4.8.4+ds2-3
old=$(write)
make_root trixie python3-gmsh=4.13.1+ds1-6
expect "$old
$(write)" <<END
Gmsh 4.8.4
group 1 by SaveElementTagType = 1: .msh [1] .mesh [2] .bdf [2]
group 1 by SaveElementTagType = 2: .msh [1] .mesh [1] .bdf [1]
Gmsh 4.13.1
group 1 by SaveElementTagType = 1: .msh [1] .mesh [2] .bdf [2]
group 1 by SaveElementTagType = 2: .msh [1] .mesh [1] .bdf [1]
END
