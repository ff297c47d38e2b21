#!/usr/bin/env bash
# What:      zarr gives a new array the fill value 0, what chunks hold that were never written. xarray takes the fill value of an array of
#            format 2 for the mark of a missing value: every 0 that was written is nan, and whole numbers become floating. Of format 3, the
#            default of zarr since version 3, the zeros are zeros.
# Versions:  zarr 2.13.6, xarray 2023.01.0 (Debian 12); zarr 3.0.6, xarray 2025.03.1 (Debian 13)
# Seen on:   30 November 2026, Debian 12, x86-64
# Matters:   a solid fraction of 0, a closed gap, the first node and the first moment are missing, and means skip them: here 0.75, not
#            0.375.
# Solidus:   writes no zarr.
. "$(dirname "${BASH_SOURCE[0]}")/common/root.sh"

write_and_read() {
  inside python3 - 2>/dev/null <<'PYTHON'
import xarray
import zarr

VALUES = [0.0, 0.5, 1.0, 0.0]
print("zarr", zarr.__version__.split("+")[0])
for form in (2, 3) if zarr.__version__ >= "3" else (2,):
    group = zarr.open_group(f"/tmp/field{form}.zarr", mode="w", zarr_format=form) if zarr.__version__ >= "3" else \
        zarr.open_group("/tmp/field2.zarr", mode="w")
    options = {"shape": (4,), "dtype": "f8", "chunks": (4,)}
    if form == 3:
        array = group.create_array("solid_fraction", dimension_names=["node"], **options)
    else:
        array = (group.create_array if zarr.__version__ >= "3" else group.create_dataset)("solid_fraction", **options)
        array.attrs["_ARRAY_DIMENSIONS"] = ["node"]
    array[:] = VALUES
    read = xarray.open_zarr(f"/tmp/field{form}.zarr", consolidated=False).solid_fraction
    print(f"format {form}: {array[:].tolist()} is {read.values.tolist()}, mean {float(read.mean())}")
PYTHON
}

make_root bookworm python3-zarr=2.13.6+ds-1 python3-xarray=2023.01.0-1.1
old=$(write_and_read)
make_root trixie python3-zarr=3.0.6-2 python3-xarray=2025.03.1-8
expect "$old
$(write_and_read)" <<END
zarr 2.13.6
format 2: [0.0, 0.5, 1.0, 0.0] is [nan, 0.5, 1.0, nan], mean 0.75
zarr 3.0.6
format 2: [0.0, 0.5, 1.0, 0.0] is [nan, 0.5, 1.0, nan], mean 0.75
format 3: [0.0, 0.5, 1.0, 0.0] is [0.0, 0.5, 1.0, 0.0], mean 0.375
END
