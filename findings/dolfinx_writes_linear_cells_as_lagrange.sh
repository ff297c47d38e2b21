#!/usr/bin/env bash
# What:      DOLFINx writes linear tetrahedra and hexahedra to .vtu as Lagrange cells, types 71 and 72 of VTK, not as 10 and 12, which all
#            readers know.
# Versions:  DOLFINx 0.5.2 (Debian 12)
# Seen on:   28 November 2026, Debian 12, x86-64
# Matters:   readers that know the linear types alone find no cell, or refuse the file.
# Solidus:   reads Lagrange cells that have their corners alone (FilesOfDolfinxAreRead in tests/unit/mesh/vtu_mesh_test).
. "$(dirname "${BASH_SOURCE[0]}")/common/root.sh"

make_root bookworm python3-dolfinx-real=1:0.5.2-2+b1
python_path=/usr/lib/petscdir/petsc3.18/x86_64-linux-gnu-real/lib/python3/dist-packages
environment=(OMPI_ALLOW_RUN_AS_ROOT=1 OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1)

said=$(inside python3 - 2>/dev/null <<'PYTHON'
import re

from dolfinx import io, mesh
from mpi4py import MPI

for cell in (mesh.CellType.tetrahedron, mesh.CellType.hexahedron):
    with io.VTKFile(MPI.COMM_WORLD, f"/tmp/{cell.name}.pvd", "w") as file:
        file.write_mesh(mesh.create_unit_cube(MPI.COMM_WORLD, 1, 1, 1, cell))
    text = open(f"/tmp/{cell.name}_p0_000000.vtu").read()
    types = re.search('Name="types"[^>]*>([^<]*)<', text)[1].split()
    print(f"{cell.name}: {len(types)} of type", *set(types))
PYTHON
)
expect "$said" <<END
tetrahedron: 6 of type 71
hexahedron: 1 of type 72
END
