#!/usr/bin/env bash
# What:      meshio reads the sets of elements of an Abaqus deck and leaves them out of .msh of Gmsh, .bdf and .med, which all have places for
#            bodies, without a word. It writes them to .inp; but writing .vtu makes cell data of them in the mesh itself, of which it tells,
#            and an .inp that is written afterwards has none.
# Versions:  meshio 5.3.5 (Debian 13)
# Seen on:   30 November 2026, Debian 12, x86-64
# Matters:   a converted mesh of a casting in its mould is one body, of one material.
# Solidus:   reads .inp with its sets, so that there is nothing to convert (docs/guide/formats.md).
. "$(dirname "${BASH_SOURCE[0]}")/common/root.sh"

make_root trixie python3-meshio=7.0.0-really-5.3.5-6+deb13u1 python3-h5py=3.13.0-1

cat >"$root/tmp/two.inp" <<DECK
*NODE
1, 0., 0., 0.
2, 1., 0., 0.
3, 0., 1., 0.
4, 0., 0., 1.
5, 1., 1., 1.
*ELEMENT, TYPE=C3D4
1, 1, 2, 3, 4
2, 2, 5, 3, 4
*ELSET, ELSET=casting
1
*ELSET, ELSET=mould
2
DECK
said=$(inside python3 - 2>/dev/null <<'PYTHON'
import contextlib
import io

import meshio

mesh = meshio.read("/tmp/two.inp")
print("read:", sorted(mesh.cell_sets))
for kind in ("abaqus", "gmsh", "nastran", "med", "vtu", "abaqus"):
    with contextlib.redirect_stdout(io.StringIO()):
        meshio.write("/tmp/again", mesh, file_format=kind)
    again = meshio.read("/tmp/again", file_format=kind)
    print(f"as {kind}: {sum(len(block.data) for block in again.cells)} tetrahedra, {sorted(again.cell_sets)}")
PYTHON
)
expect "$said" <<END
read: ['casting', 'mould']
as abaqus: 2 tetrahedra, ['casting', 'mould']
as gmsh: 2 tetrahedra, []
as nastran: 2 tetrahedra, []
as med: 2 tetrahedra, []
as vtu: 2 tetrahedra, []
as abaqus: 2 tetrahedra, []
END
