#!/usr/bin/env bash
# What:      a node of Nastran may be given in a cylindrical system (GRID's third field, CORD2C), one of Abaqus too (*NODE, SYSTEM=C). Gmsh and
#            meshio take radius and angle for x and y: a tetrahedron of 2 x 1 x 1, between 0 and
#            180 degrees, is read as one of 0 x 180 x 1.
# Versions:  Gmsh 4.13.1, meshio 5.3.5 (Debian 13)
# Seen on:   1 December 2026, Debian 12, x86-64
# Matters:   rings, rolls and sprues are written so; the part is another one, and nothing is said.
# Solidus:   transforms both, also systems within others (docs/guide/formats.md).
. "$(dirname "${BASH_SOURCE[0]}")/common/root.sh"

make_root trixie python3-gmsh=4.13.1+ds1-6 python3-meshio=7.0.0-really-5.3.5-6+deb13u1
environment=(UCX_LOG_LEVEL=fatal OMPI_ALLOW_RUN_AS_ROOT=1 OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1)

cat >"$root/tmp/ring.bdf" <<'BDF'
CEND
BEGIN BULK
CORD2C,1,0,0.,0.,0.,0.,0.,1.,+
+,1.,0.,0.
GRID,1,1,1.,0.,0.
GRID,2,1,1.,90.,0.
GRID,3,1,1.,180.,0.
GRID,4,1,1.,90.,1.
PSOLID,1,1
CTETRA,1,1,1,2,3,4
ENDDATA
BDF
cat >"$root/tmp/ring.inp" <<'INP'
*NODE, SYSTEM=C
1, 1., 0., 0.
2, 1., 90., 0.
3, 1., 180., 0.
4, 1., 90., 1.
*ELEMENT, TYPE=C3D4, ELSET=ring
1, 1, 2, 3, 4
INP

said=$(inside python3 - 2>&1 <<'PYTHON'
import gmsh
import meshio
import numpy as np


def show(text, points):
    print(f"{text}: extent", *(f"{length:g}" for length in np.ptp(points, axis=0)), "of 2 1 1")


gmsh.initialize()
gmsh.option.setNumber("General.Verbosity", 2)  # warnings and errors
gmsh.open("/tmp/ring.bdf")
show("Gmsh, .bdf", gmsh.model.mesh.getNodes()[1].reshape(-1, 3))
for name in ("bdf", "inp"):
    show(f"meshio, .{name}", meshio.read(f"/tmp/ring.{name}").points)
PYTHON
)
expect "$(grep -v hwloc <<<"$said")" <<END
Gmsh, .bdf: extent 0 180 1 of 2 1 1
meshio, .bdf: extent 0 180 1 of 2 1 1
meshio, .inp: extent 0 180 1 of 2 1 1
END
