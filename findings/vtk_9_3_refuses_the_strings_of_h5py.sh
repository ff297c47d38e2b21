#!/usr/bin/env bash
# What:      attrs["Type"] = "UnstructuredGrid" of h5py is a UTF-8 string of variable length. VTK 9.1 reads a .vtkhdf with it, VTK 9.3 says
#            "Not an ASCII string character type" and gives nothing; CanReadFile says yes in both. np.bytes_("UnstructuredGrid"), ASCII of
#            fixed length, is read by both.
# Versions:  VTK 9.1.0, h5py 3.7.0 (Debian 12); VTK 9.3.0, h5py 3.13.0 (Debian 13)
# Seen on:   30 November 2026, Debian 12, x86-64
# Matters:   a script that wrote results for one ParaView writes none for the next.
# Solidus:   writes ASCII of fixed length (src/results/formats/vtkhdf.cpp).
. "$(dirname "${BASH_SOURCE[0]}")/common/root.sh"

write_and_read() {
  local kind
  for kind in str bytes; do
    inside python3 - $kind 2>/dev/null <<'PYTHON'
import sys

import h5py
import numpy as np
from vtkmodules.vtkCommonCore import vtkVersion
from vtkmodules.vtkIOHDF import vtkHDFReader

kind = sys.argv[1]
with h5py.File("/tmp/one.vtkhdf", "w") as file:
    group = file.create_group("VTKHDF")
    group.attrs["Version"] = [1, 0]
    group.attrs["Type"] = "UnstructuredGrid" if kind == "str" else np.bytes_("UnstructuredGrid")
    for name, value in {"NumberOfPoints": [4], "NumberOfCells": [1], "NumberOfConnectivityIds": [4], "Connectivity": range(4),
                        "Offsets": [0, 4], "Types": np.array([10], "u1"), "Points": np.vstack([np.zeros(3), np.eye(3)])}.items():
        group[name] = value
reader = vtkHDFReader()
reader.SetFileName("/tmp/one.vtkhdf")
reader.Update()
grid = reader.GetOutput()
can = "can" if reader.CanReadFile("/tmp/one.vtkhdf") else "cannot"
print(f"VTK {vtkVersion.GetVTKVersion()}, {kind}: {can} read it, {grid.GetNumberOfCells() if grid else 'no'} cells")
PYTHON
  done
}

make_root bookworm python3-vtk9=9.1.0+really9.1.0+dfsg2-5+deb12u1 python3-h5py=3.7.0-8
old=$(write_and_read)
make_root trixie python3-vtk9=9.3.0+dfsg1-4+b1 python3-h5py=3.13.0-1
environment=(UCX_LOG_LEVEL=fatal OMPI_ALLOW_RUN_AS_ROOT=1 OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1)
expect "$old
$(write_and_read)" <<END
VTK 9.1.0, str: can read it, 1 cells
VTK 9.1.0, bytes: can read it, 1 cells
VTK 9.3.0, str: can read it, no cells
VTK 9.3.0, bytes: can read it, 1 cells
END
