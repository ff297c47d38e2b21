#!/usr/bin/env bash
# What:      h5diff ends with exit code 0, as for equal files, where a field has another number of values, another shape, or became whole
#            numbers: such fields "are not comparable", which it says on the screen and, with -q, does not say at all. A field that is
#            missing does count as a difference, and so does another precision.
# Versions:  HDF5 1.10.8 (Debian 12) and 1.14.5 (Debian 13)
# Seen on:   30 November 2026, Debian 12, x86-64
# Matters:   a test that holds results against stored ones by h5diff passes when the mesh has changed, of all things.
# Solidus:   no test uses h5diff: numbers of values are compared before the values (tests/program).
. "$(dirname "${BASH_SOURCE[0]}")/common/root.sh"

compare() {
  inside python3 - <<'PYTHON'
import h5py
import numpy as np

stored = np.linspace(300, 700, 10)
for name, field in {
    "stored": stored, "same": stored, "other values": stored + 1, "float32": stored.astype("f4"),
    "nine of ten": stored[:9], "2 by 5": stored.reshape(2, 5), "whole numbers": stored.astype(int), "missing": None,
}.items():
    with h5py.File(f"/tmp/{name}.h5", "w") as file:
        file["time"] = 1.0
        if field is not None:
            file["temperature"] = field
PYTHON
  local name code
  for name in 'same' 'other values' 'float32' 'missing' 'nine of ten' '2 by 5' 'whole numbers'; do
    code=0
    inside h5diff -q /tmp/stored.h5 "/tmp/$name.h5" >"$work/said" 2>&1 || code=$?
    echo "$name: exit code $code, says $(wc -c <"$work/said") characters"
  done
}

make_root bookworm hdf5-tools=1.10.8+repack1-1 python3-h5py=3.7.0-8
old=$(compare)
make_root trixie hdf5-tools=1.14.5+repack-3 python3-h5py=3.13.0-1
new=$(compare)
[[ $old == "$new" ]] || printf 'The two versions differ.\n'
expect "$new" <<END
same: exit code 0, says 0 characters
other values: exit code 1, says 0 characters
float32: exit code 1, says 0 characters
missing: exit code 1, says 0 characters
nine of ten: exit code 0, says 0 characters
2 by 5: exit code 0, says 0 characters
whole numbers: exit code 0, says 0 characters
END
