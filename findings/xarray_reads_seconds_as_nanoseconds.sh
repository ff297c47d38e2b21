#!/usr/bin/env bash
# What:      xarray reads a variable of a netCDF file whose units are "seconds" (or "minutes", "hours", "days") as timedelta64 in whole
#            nanoseconds: 1.5 becomes 1500000000 where it goes on as a number, what is shorter than a nanosecond is 0, and 2e10 s is "not a
#            time", or before that another number. With units "s" the same variable keeps its numbers. decode_timedelta=False leaves all as
#            they are.
# Versions:  xarray 2023.01.0 (Debian 12) and 2025.03.1 (Debian 13)
# Seen on:   30 November 2026, Debian 12, x86-64
# Matters:   solidification times, times of filling and fields of relaxation times differ by 1e9 between two files, by the spelling of a unit.
# Solidus:   writes no netCDF; the unit of times in its fields is "s".
. "$(dirname "${BASH_SOURCE[0]}")/common/root.sh"

write_and_read() {
  inside python3 -W ignore - <<'PYTHON'
import netCDF4
import xarray

file = netCDF4.Dataset("/tmp/times.nc", "w")
file.createDimension("node", 3)
for name, units in (("a", "seconds"), ("b", "s"), ("c", "minutes")):
    variable = file.createVariable(name, "f8", ("node",))
    variable.units = units
    variable[:] = [1.5, 1e-10, 2e10]
file.close()
print("xarray", xarray.__version__ if xarray.__version__ != "999" else "2023.01.0")
plain = xarray.open_dataset("/tmp/times.nc", decode_timedelta=False)
read = xarray.open_dataset("/tmp/times.nc")
for name in ("a", "b"):
    print(f"{plain[name].units}: {plain[name].values.tolist()} is {[str(value) for value in read[name].values]}")
print(f"minutes: 1.5 is {float(read.c.values.astype(float)[0]):g}")
PYTHON
}

make_root bookworm python3-xarray=2023.01.0-1.1 python3-netcdf4=1.6.2-1+b1
old=$(write_and_read)
make_root trixie python3-xarray=2025.03.1-8 python3-netcdf4=1.7.2-1+b4
expect "$old
$(write_and_read)" <<END
xarray 2023.01.0
seconds: [1.5, 1e-10, 20000000000.0] is ['1500000000 nanoseconds', '0 nanoseconds', '1553255926290448384 nanoseconds']
s: [1.5, 1e-10, 20000000000.0] is ['1.5', '1e-10', '20000000000.0']
minutes: 1.5 is 9e+10
xarray 2025.3.1
seconds: [1.5, 1e-10, 20000000000.0] is ['1500000000 nanoseconds', '0 nanoseconds', 'NaT']
s: [1.5, 1e-10, 20000000000.0] is ['1.5', '1e-10', '20000000000.0']
minutes: 1.5 is 9e+10
END
