#!/usr/bin/env bash
# What:      a callback for the sizes of elements. Up to Gmsh 4.8 the smallest of all sizes counts, those of points among them; from 4.9 on
#            the callback gets the size so far as a sixth argument and its answer replaces it: points with a size of 0.1 and a callback
#            that says 0.5 give 10 elements before and 2 since.
# Versions:  Gmsh 4.8.4 (Debian 12) and 4.13.1 (Debian 13)
# Seen on:   28 November 2026, Debian 12, x86-64
# Matters:   a program that only gets its sixth argument meshes thin walls coarsely, without an error.
# Solidus:   returns the smaller of its size and that argument (src/mesh/gmsh/size_callback.hpp).
. "$(dirname "${BASH_SOURCE[0]}")/common/root.sh"

count() {
  inside python3 - <<'PYTHON'
import gmsh

gmsh.initialize()
gmsh.option.setNumber("General.Terminal", 0)
ends = [gmsh.model.geo.addPoint(x, 0, 0, 0.1) for x in (0, 1)]
gmsh.model.geo.addLine(*ends)
gmsh.model.geo.synchronize()
if gmsh.option.getString("General.Version").startswith("4.8"):
    gmsh.model.mesh.setSizeCallback(lambda dimension, tag, x, y, z: 0.5)
else:
    gmsh.model.mesh.setSizeCallback(lambda dimension, tag, x, y, z, size: 0.5)
gmsh.model.mesh.generate(1)
print(len(gmsh.model.mesh.getElements(1)[1][0]), "elements")
PYTHON
}

make_root bookworm python3-gmsh=4.8.4+ds2-3
expect "$(count)" <<<"10 elements"
make_root trixie python3-gmsh=4.13.1+ds1-6
expect "$(count)" <<<"2 elements"
