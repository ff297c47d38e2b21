#!/usr/bin/env bash
# What:      Debian's Gmsh lists med and cgns among the formats of -format, whatever it was built with. Both are missing from this build:
#            asking for one is an error, which comes when the mesh has been made.
# Versions:  Gmsh 4.8.4 (Debian 12)
# Seen on:   28 November 2026, Debian 12, x86-64; for med Gmsh 4.13.1 of Debian 13 too
# Matters:   a chain from Salome or code_aster through Gmsh fails at its last step, after the meshing.
# Solidus:   says so of .med files, and .unv is the way (docs/guide/formats.md); it writes MED by the library of MED itself.
. "$(dirname "${BASH_SOURCE[0]}")/common/root.sh"

make_root bookworm gmsh=4.8.4+ds2-3

printf 'Point(1) = {0, 0, 0};\nPoint(2) = {1, 0, 0};\nLine(1) = {1, 2};\n' >"$root/tmp/line.geo"
# What it says of one format in its help and when it writes it.
say() {
  inside gmsh -help 2>&1 | grep -o -- "-format.*\b$1\b" | sed "s/ .*/ lists $1/"
  local status=0
  inside gmsh -1 /tmp/line.geo -format "$1" -o "/tmp/line.$1" -v 1 >"$work/log" 2>&1 || status=$?
  grep -io "gmsh .*$1 support" "$work/log"
  echo "exit code $status"
}
expect "$(say med; say cgns)" <<END
-format lists med
Gmsh must be compiled with MED support
exit code 1
-format lists cgns
Gmsh was compiled without CGNS support
exit code 1
END
