#!/usr/bin/env bash
# What:      Netgen numbers the corners of a tetrahedron the other way round than VTK, Gmsh, Abaqus and Nastran: the volume by their
#            formula, (b-a)x(c-a).(d-a)/6, is negative for every element. What copies the connectivity as it is gets a mesh inside out.
# Versions:  Netgen 6.2.1905 (Debian 12)
# Seen on:   28 November 2026, Debian 12, x86-64
# Matters:   Jacobians are negative, normals of faces look inwards, loads of pressure pull.
# Solidus:   turns mirrored elements of any mesh that it reads (tests/unit/mesh/validate_test).
. "$(dirname "${BASH_SOURCE[0]}")/common/root.sh"

make_root bookworm python3-netgen=6.2.2006+really6.2.1905+dfsg-5.1+b1 python3-numpy=1:1.24.2-1+deb12u1

said=$(inside python3 - <<'PYTHON' | tail -n 1
import numpy as np
from netgen.csg import unit_cube

mesh = unit_cube.GenerateMesh(maxh=1)
x = [np.array(list(point.p)) for point in mesh.Points()]
volumes = []
for element in mesh.Elements3D():
    a, b, c, d = (x[corner.nr - 1] for corner in element.vertices)
    volumes.append(np.dot(np.cross(b - a, c - a), d - a) / 6)
print(f"of a cube of 1: {sum(volumes):.6f}, elements of positive volume: {sum(v > 0 for v in volumes)}")
PYTHON
)
expect "$said" <<END
of a cube of 1: -1.000000, elements of positive volume: 0
END
