#!/usr/bin/env bash
# What:      GetFEM makes one node of all nodes that lie in one place while it reads a mesh: two bodies that touch, each with nodes of its
#            own as Gmsh writes them for a contact, come out as one. It concerns import from .msh and meshes that are put together by
#            add_convex alike.
# Versions:  GetFEM 5.4.4 (Debian 13)
# Seen on:   30 November 2026, Debian 12, x86-64
# Matters:   casting and mould stick together: no gap opens, no resistance to heat is between them, stresses are those of one body.
# Solidus:   joins the nodes of one body alone; surfaces in a contact stay separate (docs/guide/formats.md).
. "$(dirname "${BASH_SOURCE[0]}")/common/root.sh"

make_root trixie python3-getfem=5.4.4+dfsg1-5
environment=(UCX_LOG_LEVEL=fatal OMPI_ALLOW_RUN_AS_ROOT=1 OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1)

# Two cubes of eight nodes each, side by side.
cat >"$root/tmp/two.msh" <<'MESH'
$MeshFormat
2.2 0 8
$EndMeshFormat
$Nodes
16
1 0 0 0
2 1 0 0
3 1 1 0
4 0 1 0
5 0 0 1
6 1 0 1
7 1 1 1
8 0 1 1
9 1 0 0
10 2 0 0
11 2 1 0
12 1 1 0
13 1 0 1
14 2 0 1
15 2 1 1
16 1 1 1
$EndNodes
$Elements
2
1 5 2 1 1 1 2 3 4 5 6 7 8
2 5 2 2 2 9 10 11 12 13 14 15 16
$EndElements
MESH
said=$(inside python3 - 2>/dev/null <<'PYTHON'
import getfem

read = getfem.Mesh("import", "gmsh", "/tmp/two.msh")
print(f"of 16 nodes {read.nbpts()}, of 12 outer faces {read.outer_faces().shape[1]}")
made = getfem.Mesh("empty", 3)
for x in (0, 1):
    made.add_convex(getfem.GeoTrans("GT_QK(3,1)"), [[x, x + 1] * 4, [0, 0, 1, 1] * 2, [0] * 4 + [1] * 4])
print(f"of 16 nodes {made.nbpts()}, of 12 outer faces {made.outer_faces().shape[1]}")
PYTHON
)
expect "$said" <<END
of 16 nodes 12, of 12 outer faces 10
of 16 nodes 12, of 12 outer faces 10
END
