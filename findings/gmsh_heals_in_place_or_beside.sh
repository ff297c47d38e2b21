#!/usr/bin/env bash
# What:      occ.healShapes of one body of two. Gmsh 4.8 makes a new body and keeps the old one in the same place; Gmsh 4.13 heals in place,
#            keeps the number, and returns all bodies and all their faces, curves and points, many of them several times. What takes the
#            first of the answer, or deletes what was healed, works with one of the two.
# Versions:  Gmsh 4.8.4 (Debian 12) and 4.13.1 (Debian 13)
# Seen on:   28 November 2026, Debian 12, x86-64
# Matters:   a casting that is there twice, or a mould that is gone.
# Solidus:   looks at the bodies that there are after healing, not at what is returned (src/mesh/gmsh/casting_bodies.cpp).
. "$(dirname "${BASH_SOURCE[0]}")/common/root.sh"

heal() {
  inside python3 - <<'PYTHON'
import gmsh

gmsh.initialize()
gmsh.option.setNumber("General.Terminal", 0)
for x in (0, 3):
    gmsh.model.occ.addBox(x, 0, 0, 1, 1, 1)
gmsh.model.occ.synchronize()
healed = gmsh.model.occ.healShapes([(3, 1)])
gmsh.model.occ.synchronize()
print("returned:", len(healed), "entities, bodies", [tag for dimension, tag in healed if dimension == 3])
print("bodies then:", [tag for _, tag in gmsh.model.getEntities(3)])
PYTHON
}

make_root bookworm python3-gmsh=4.8.4+ds2-3
expect "$(heal)" <<END
returned: 79 entities, bodies [3]
bodies then: [1, 2, 3]
END
make_root trixie python3-gmsh=4.13.1+ds1-6
expect "$(heal)" <<END
returned: 702 entities, bodies [1, 2]
bodies then: [1, 2]
END
