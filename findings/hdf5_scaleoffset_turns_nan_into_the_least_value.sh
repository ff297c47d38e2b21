#!/usr/bin/env bash
# What:      the filter "scaleoffset" of HDF5 stores numbers by a given count of decimals. A nan among the values of a chunk is read as the
#            least of them: 20 of temperatures from 20 to 1500. Nothing is said by the writer or the reader. Where the nan is the first value
#            of its chunk, it stays a nan (HDF5 1.10.8).
# Versions:  HDF5 1.10.8 with h5py 3.7.0 (Debian 12), HDF5 1.14.5 with h5py 3.13.0 (Debian 13)
# Seen on:   1 December 2026, Debian 12, x86-64
# Matters:   fields are nan where a body is not active yet or a probe lies outside: there the file has a temperature that can be true.
# Solidus:   does not use this filter.
. "$(dirname "${BASH_SOURCE[0]}")/common/root.sh"

compress() {
  inside python3 - 2>/dev/null <<'PYTHON'
import h5py
import numpy as np

print("HDF5", h5py.version.hdf5_version)
temperature = np.linspace(20, 1500, 256)
temperature[100:103] = np.nan
for filters in ({"compression": "gzip"}, {"scaleoffset": 2}):
    with h5py.File("/tmp/field.h5", "w") as file:
        file.create_dataset("T", data=temperature, chunks=(256,), **filters)
    with h5py.File("/tmp/field.h5") as file:
        read = file["T"][:]
    print(*filters, "99 to 103:", *(f"{value:.2f}" for value in read[99:104]), f"mean {np.nanmean(read):.3f}")
PYTHON
}

make_root bookworm python3-h5py=3.7.0-8
old=$(compress)
make_root trixie python3-h5py=3.13.0-1
environment=(UCX_LOG_LEVEL=fatal OMPI_ALLOW_RUN_AS_ROOT=1 OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1)
expect "$old
$(compress)" <<END
HDF5 1.10.8
compression 99 to 103: 594.59 nan nan nan 617.80 mean 761.824
scaleoffset 99 to 103: 594.59 20.00 20.00 20.00 617.80 mean 753.131
HDF5 1.14.5
compression 99 to 103: 594.59 nan nan nan 617.80 mean 761.824
scaleoffset 99 to 103: 594.59 20.00 20.00 20.00 617.80 mean 753.131
END
