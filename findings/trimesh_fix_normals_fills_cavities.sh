#!/usr/bin/env bash
# What:      trimesh's fix_normals turns each closed shell outwards. A cavity inside a body, whose faces must point into it, is turned too:
#            the volume of a box of 8 with a cavity of 1 is 7 before and 9 after, where the mesh is still "watertight" and "a volume".
#            process(validate=True), which loading does not do by itself, does the same. ADMesh, asked to fix normals, keeps the 7.
# Versions:  trimesh 4.5.1, ADMesh 0.98.5 (Debian 13)
# Seen on:   1 December 2026, Debian 12, x86-64
# Matters:   castings with cores or closed cavities weigh too much, their modulus is too large, and slices and meshers see two solids.
# Solidus:   does not use trimesh.
. "$(dirname "${BASH_SOURCE[0]}")/common/root.sh"

make_root trixie python3-trimesh=4.5.1-3 python3-networkx=3.2.1-5 python3-scipy=1.15.3-1 admesh=0.98.5-1+b2
environment=(UCX_LOG_LEVEL=fatal OMPI_ALLOW_RUN_AS_ROOT=1 OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1)

said=$(
  inside python3 - 2>/dev/null <<'PYTHON'
import trimesh

box, cavity = trimesh.creation.box((2, 2, 2)), trimesh.creation.box((1, 1, 1))
cavity.invert()
trimesh.util.concatenate([box, cavity]).export("/tmp/hollow.stl")


def show(text, mesh):
    print(f"{text}: volume {mesh.volume:.3f}, watertight {mesh.is_watertight}, a volume {mesh.is_volume}")


mesh = trimesh.load("/tmp/hollow.stl")
show("loaded", mesh)
mesh.fix_normals()
show("fix_normals", mesh)
mesh = trimesh.load("/tmp/hollow.stl")
mesh.process(validate=True)
show("process(validate=True)", mesh)
PYTHON
  inside admesh --normal-directions /tmp/hollow.stl |
    sed -nE 's/.*Volume *: *([0-9.]+).*/ADMesh: volume \1/p; s/^(Facets reversed) *: *([0-9]+).*/\1: \2/p'
)
expect "$said" <<END
loaded: volume 7.000, watertight True, a volume True
fix_normals: volume 9.000, watertight True, a volume True
process(validate=True): volume 9.000, watertight True, a volume True
ADMesh: volume 6.999998
Facets reversed: 0
END
