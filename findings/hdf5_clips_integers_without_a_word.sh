#!/usr/bin/env bash
# What:      HDF5 converts between types of numbers on reading and writing, and clips what does not fit: a 64-bit number of a node read
#            into 32 bits is 2147483647, a temperature that is no number read as an integer is -2147483648. No call fails.
# Versions:  HDF5 1.10.8 with h5py 3.7.0 (Debian 12)
# Seen on:   28 November 2026, Debian 12, x86-64
# Matters:   numbers of nodes and elements beyond 2^31 all become one and the same valid number; formats on top of HDF5 (MED, CGNS,
#            VTKHDF, Exodus) inherit it.
# Solidus:   asks for the type that is stored and refuses another one (src/results/formats/hdf5_file.cpp, hdf5_reader_test).
. "$(dirname "${BASH_SOURCE[0]}")/common/root.sh"

make_root bookworm python3-h5py=3.7.0-8

said=$(inside python3 - <<'PYTHON'
import h5py
import numpy as np

print("HDF5", h5py.version.hdf5_version)
with h5py.File("/tmp/a.h5", "w") as file:
    file["numbers"] = np.array([7, 2**31, 2**40], dtype=np.int64)
    file["temperature"] = np.array([293.15, 1e12, np.nan])
    for name in file:
        read = np.empty(3, np.int32)
        file[name].read_direct(read)
        print(name, "read as 32 bits:", *read)
    small = file.create_dataset("small", (2,), dtype=np.int32)
    small[...] = np.array([7, 2**40], dtype=np.int64)
    print("written to 32 bits:", *small[...])
PYTHON
)
expect "$said" <<END
HDF5 1.10.8
numbers read as 32 bits: 7 2147483647 2147483647
temperature read as 32 bits: 293 2147483647 -2147483648
written to 32 bits: 7 2147483647
END
