#!/usr/bin/env bash
# What:      meshio writes Nastran elements without a property where the mesh has no "nastran:ref" data, also where cell sets name
#            the bodies. By the format's default the property is then the element's own number: as many bodies as elements.
# Versions:  meshio 5.0.0 (Debian 12's package python3-meshio 7.0.0-3)
# Seen on:   29 November 2026, Debian 12, x86-64
# Matters:   casting and mould come out as thousands of bodies, or as one.
# Solidus:   takes elements without a property for one body and says how many (docs/guide/formats.md).
. "$(dirname "${BASH_SOURCE[0]}")/common/root.sh"

make_root bookworm python3-meshio=7.0.0-3

said=$(inside python3 - <<'PYTHON'
import meshio

points = [[0.0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1], [1, 1, 1]]
sets = {"casting": [[0]], "mould": [[1]]}
mesh = meshio.Mesh(points, [("tetra", [[0, 1, 2, 3], [1, 2, 3, 4]])], cell_sets=sets)
meshio.write("/tmp/a.bdf", mesh)
print(meshio.__version__)
for line in open("/tmp/a.bdf"):
    if line.startswith("CTETRA"):
        print("element", line[8:16].strip(), "property", repr(line[16:24].strip()))
PYTHON
)
expect "$said" <<END
5.0.0
element 1 property ''
element 2 property ''
END
