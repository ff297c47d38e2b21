#!/usr/bin/env bash
# What:      FreeCAD writes a mesh of 10 mm to .unv with coordinates of 10, and dataset 164, the units of the file, says "SI: Meter".
#            FreeCAD's lengths are millimetres always.
# Versions:  FreeCAD 0.20.2 (Debian 12)
# Seen on:   28 November 2026, Debian 12, x86-64
# Matters:   a reader that believes the file has a casting a thousand times too large.
# Solidus:   takes the unit that the user tells and warns where the file says another one (docs/guide/formats.md, universal_file_test).
. "$(dirname "${BASH_SOURCE[0]}")/common/root.sh"

make_root bookworm freecad-python3=0.20.2+dfsg1-4

said=$(inside python3 - <<'PYTHON'
import sys

sys.path += ["/usr/lib/freecad-python3/lib", "/usr/lib/freecad/lib", "/usr/lib/freecad/Mod/Fem"]
import FreeCAD
import Fem

mesh = Fem.FemMesh()
for number, corner in enumerate(((0, 0, 0), (10, 0, 0), (0, 10, 0), (0, 0, 10)), 1):
    mesh.addNode(*corner, number)
mesh.addVolume([1, 2, 3, 4], 1)
mesh.write("/tmp/part.unv")
lines = open("/tmp/part.unv").read().split("\n")
print("the file says:", " ".join(lines[lines.index("   164") + 1].split()[1:3]))
print("a mesh of 10 mm:", float(lines[lines.index("  2411") + 4].split()[0]))
PYTHON
)
expect "$said" <<END
the file says: SI: Meter
a mesh of 10 mm: 10.0
END
