#!/usr/bin/env bash
# What:      h5wasm returns numbers for a field that it could not read: a field that h5py compressed by lzf, for which this build of HDF5
#            has no filter. `value` is an array of the right type and length with what was in memory, here the field that was read before;
#            HDF5's message goes to the console, nothing is thrown. A type that h5wasm does not know (float16) does throw.
# Versions:  h5wasm 0.10.3 (npm), h5py 3.7.0 (Debian 12)
# Seen on:   30 November 2026, Debian 12, x86-64, Node.js 20.20.2
# Matters:   a viewer in the browser draws temperatures that no one computed, and small ones look like zero.
# Solidus:   its pages read no HDF5 (docs/guide/report.md); where it reads HDF5 itself, a read that fails is an error with the file's name.
. "$(dirname "${BASH_SOURCE[0]}")/common/root.sh"

make_modules h5wasm=0.10.3
make_root bookworm python3-h5py=3.7.0-8

inside python3 - <<'PYTHON'
import h5py
import numpy as np

with h5py.File("/tmp/fields.h5", "w") as file:
    file.create_dataset("gzip", data=np.arange(1.0, 9.0), compression="gzip")
    file.create_dataset("lzf", data=np.arange(11.0, 19.0), compression="lzf")
    file["float16"] = np.arange(21, 29, dtype="f2")
PYTHON
said=$(in_node "$root/tmp/fields.h5" 2>/dev/null <<'SCRIPT'
import h5wasm from "h5wasm/node";

await h5wasm.ready;
const file = new h5wasm.File(process.argv[2], "r");
for (const [name, first] of [["gzip", 1], ["lzf", 11], ["float16", 21]]) {
  let said;
  try {
    const values = file.get(name).value;
    const right = [...values].filter((value, n) => value === first + n).length;
    said = `${values.constructor.name} of ${values.length}, ${right} of them right`;
  } catch (error) {
    said = `thrown: ${error.message ?? error}`;
  }
  process.stdout.write(`${name}: ${said}\n`);
}
SCRIPT
)
expect "$said" <<END
gzip: Float64Array of 8, 8 of them right
lzf: Float64Array of 8, 0 of them right
float16: thrown: Float16 not supported
END
