#!/usr/bin/env bash
# What:      meshio reads the *PARTs of an Abaqus deck in their own coordinates and passes over *INSTANCE, which says where each is and how
#            often: a part of two instances is there once, at its own origin, and nothing is said.
# Versions:  meshio 5.0.0 (Debian 12) and 5.3.5 (Debian 13)
# Seen on:   30 November 2026, Debian 12, x86-64
# Matters:   Abaqus/CAE writes decks of parts and instances: feeders, chills or cores are missing, or lie inside of the casting.
# Solidus:   carries instances out, by shift and rotation, and names their bodies by them (docs/guide/formats.md).
. "$(dirname "${BASH_SOURCE[0]}")/common/root.sh"

read_deck() {
  cat >"$root/tmp/two.inp" <<DECK
*HEADING
*PART, NAME=block
*NODE
1, 0., 0., 0.
2, 1., 0., 0.
3, 0., 1., 0.
4, 0., 0., 1.
*ELEMENT, TYPE=C3D4, ELSET=body
1, 1, 2, 3, 4
*END PART
*ASSEMBLY, NAME=both
*INSTANCE, NAME=left, PART=block
2., 0., 0.
*END INSTANCE
*INSTANCE, NAME=right, PART=block
5., 0., 0.
*END INSTANCE
*END ASSEMBLY
DECK
  inside python3 - 2>&1 <<'PYTHON'
import meshio

mesh = meshio.read("/tmp/two.inp")
count = sum(len(block.data) for block in mesh.cells)
print(f"meshio {meshio.__version__}: {count} of 2 tetrahedra, x from {mesh.points[:, 0].min()} to {mesh.points[:, 0].max()} of 2 to 6")
PYTHON
}

make_root bookworm python3-meshio=7.0.0-3
old=$(read_deck)
make_root trixie python3-meshio=7.0.0-really-5.3.5-6+deb13u1
expect "$old
$(read_deck)" <<END
meshio 5.0.0: 1 of 2 tetrahedra, x from 0.0 to 1.0 of 2 to 6
meshio 5.3.5: 1 of 2 tetrahedra, x from 0.0 to 1.0 of 2 to 6
END
