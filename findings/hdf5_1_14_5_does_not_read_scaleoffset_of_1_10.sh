#!/usr/bin/env bash
# What:      a chunk that the filter "scaleoffset" of HDF5 cannot make smaller, because a number of 1e20 among the temperatures stands for "no
#            value" (1e8 in single precision), is stored as it is. HDF5 1.10.8 reads it again with every value. HDF5 1.14.5 refuses it, in
#            files of 1.10.8 and in its own, which it writes without an error: no value of that chunk is to be had.
# Versions:  HDF5 1.10.8 with h5py 3.7.0 (Debian 12), HDF5 1.14.5 with h5py 3.13.0 (Debian 13)
# Seen on:   1 December 2026, Debian 12, x86-64
# Matters:   measured fields cannot be read after an update, and new ones are lost when they are written.
# Solidus:   does not use this filter.
. "$(dirname "${BASH_SOURCE[0]}")/common/root.sh"

write() {
  inside python3 - "$1" 2>/dev/null <<'PYTHON'
import sys

import h5py
import numpy as np

with h5py.File(sys.argv[1], "w") as file:
    for kind, empty in (("f8", 1e15), ("f8", 1e20), ("f4", 1e7), ("f4", 1e8)):
        temperature = np.linspace(20, 1500, 256).astype(kind)
        temperature[100] = empty
        file.create_dataset(f"{kind} with {empty:.0e}", data=temperature, scaleoffset=2, chunks=(256,))
PYTHON
}

read_by() {
  inside python3 - "$1" 2>/dev/null <<'PYTHON'
import sys

import h5py
import numpy as np

print(f"{sys.argv[1]} by HDF5 {h5py.version.hdf5_version}")
with h5py.File(sys.argv[1]) as file:
    for name in file:
        try:
            error = np.abs(np.delete(file[name][:], 100) - np.delete(np.linspace(20, 1500, 256), 100)).max()
            print(f"{name}: within {error:.3f}")
        except OSError as error:
            print(f"{name}: {error}")
PYTHON
}

make_root bookworm python3-h5py=3.7.0-8
write /tmp/old.h5
old=$(read_by /tmp/old.h5)
cp "$root/tmp/old.h5" "$work/old.h5"
make_root trixie python3-h5py=3.13.0-1
environment=(UCX_LOG_LEVEL=fatal OMPI_ALLOW_RUN_AS_ROOT=1 OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1)
cp "$work/old.h5" "$root/tmp/old.h5"
write /tmp/new.h5
expect "$old
$(read_by /tmp/old.h5)
$(read_by /tmp/new.h5)" <<END
/tmp/old.h5 by HDF5 1.10.8
f4 with 1e+07: within 0.005
f4 with 1e+08: within 0.000
f8 with 1e+15: within 0.005
f8 with 1e+20: within 0.000
/tmp/old.h5 by HDF5 1.14.5
f4 with 1e+07: within 0.005
f4 with 1e+08: Can't synchronously read data (filter returned failure during read)
f8 with 1e+15: within 0.005
f8 with 1e+20: Can't synchronously read data (filter returned failure during read)
/tmp/new.h5 by HDF5 1.14.5
f4 with 1e+07: within 0.005
f4 with 1e+08: Can't synchronously read data (filter returned failure during read)
f8 with 1e+15: within 0.005
f8 with 1e+20: Can't synchronously read data (filter returned failure during read)
END
