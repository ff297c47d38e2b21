#!/usr/bin/env bash
# What:      VTK's reader of Exodus II adds to the coordinates every vector of the nodes whose name begins with "dis": not only
#            displacements, which is its documented default (ApplyDisplacements), but a "distance" or a "dissipation" too, metres or W/m2. A
#            "velocity" is left alone.
# Versions:  VTK 9.1.0 (Debian 12) and 9.3.0 (Debian 13)
# Seen on:   30 November 2026, Debian 12, x86-64
# Matters:   ParaView reads Exodus by it: probes, sections and volumes are those of a mesh that the file does not hold, and a warp by the
#            displacement shows twice of it.
# Solidus:   writes no Exodus; the displacement is a field beside the coordinates (docs/guide/results.md).
. "$(dirname "${BASH_SOURCE[0]}")/common/root.sh"

read_fields() {
  inside python3 - 2>/dev/null <<'PYTHON'
import netCDF4
import numpy as np
from vtkmodules.vtkCommonCore import vtkVersion
from vtkmodules.vtkIOExodus import vtkExodusIIReader

POINTS = np.array([[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1]], float)


def write(name):
    """One tetrahedron; the vector is (0.5, 0, 0) in its second node."""
    file = netCDF4.Dataset("/tmp/one.e", "w", format="NETCDF3_64BIT_OFFSET")
    file.api_version = file.version = np.float32(5.1)
    file.floating_point_word_size, file.file_size, file.title = np.int32(8), np.int32(1), "one"
    for dimension, length in {"len_string": 33, "num_dim": 3, "num_nodes": 4, "num_elem": 1, "num_el_blk": 1, "num_el_in_blk1": 1,
                              "num_nod_per_el1": 4, "num_nod_var": 3, "time_step": None}.items():
        file.createDimension(dimension, length)
    file.createVariable("time_whole", "f8", ("time_step",))[:] = [0]
    file.createVariable("eb_status", "i4", ("num_el_blk",))[:] = 1
    block = file.createVariable("eb_prop1", "i4", ("num_el_blk",))
    block.setncattr("name", "ID")
    block[:] = 1
    corners = file.createVariable("connect1", "i4", ("num_el_in_blk1", "num_nod_per_el1"))
    corners.elem_type = "TETRA4"
    corners[:] = [[1, 2, 3, 4]]
    names = file.createVariable("name_nod_var", "S1", ("num_nod_var", "len_string"))
    for n, axis in enumerate("xyz"):
        file.createVariable("coord" + axis, "f8", ("num_nodes",))[:] = POINTS[:, n]
        names[n] = np.array(list(f"{name}_{axis}".ljust(33, "\0")), "S1")
        file.createVariable(f"vals_nod_var{n + 1}", "f8", ("time_step", "num_nodes"))[:] = [[0, 0.5 if n == 0 else 0, 0, 0]]
    file.close()


print("VTK", vtkVersion.GetVTKVersion())
for name in ("displacement", "distance", "dissipation", "velocity"):
    write(name)
    reader = vtkExodusIIReader()
    reader.SetFileName("/tmp/one.e")
    reader.UpdateInformation()
    reader.SetAllArrayStatus(reader.NODAL, 1)
    reader.Update()
    grid = reader.GetOutput().GetBlock(0).GetBlock(0)
    print(f"{name}: the node of (1, 0, 0) is at {grid.GetPoint(1)}")
PYTHON
}

make_root bookworm python3-vtk9=9.1.0+really9.1.0+dfsg2-5+deb12u1 python3-netcdf4=1.6.2-1+b1
old=$(read_fields)
make_root trixie python3-vtk9=9.3.0+dfsg1-4+b1 python3-netcdf4=1.7.2-1+b4
environment=(UCX_LOG_LEVEL=fatal OMPI_ALLOW_RUN_AS_ROOT=1 OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1)
expect "$old
$(read_fields)" <<END
VTK 9.1.0
displacement: the node of (1, 0, 0) is at (1.5, 0.0, 0.0)
distance: the node of (1, 0, 0) is at (1.5, 0.0, 0.0)
dissipation: the node of (1, 0, 0) is at (1.5, 0.0, 0.0)
velocity: the node of (1, 0, 0) is at (1.0, 0.0, 0.0)
VTK 9.3.0
displacement: the node of (1, 0, 0) is at (1.5, 0.0, 0.0)
distance: the node of (1, 0, 0) is at (1.5, 0.0, 0.0)
dissipation: the node of (1, 0, 0) is at (1.5, 0.0, 0.0)
velocity: the node of (1, 0, 0) is at (1.0, 0.0, 0.0)
END
