#!/usr/bin/env bash
# What:      CalculiX reads the first twenty characters of a number. Of 1.000000000000000e+01, with sixteen digits, that is
#            1.000000000000000e+0, which is 1; -1.23456789012345e-05 is -1.23. With seventeen digits, as meshio writes all coordinates and
#            as printing a number in full does, the e is left without a digit and the deck is refused.
# Versions:  CalculiX 2.20 (Debian 12)
# Seen on:   30 November 2026, Debian 12, x86-64
# Matters:   a node ten or a hundred thousand times too far away, or a modulus of 21 Pa, in a run with exit code 0.
# Solidus:   writes no more than twenty characters (tests/program/summary_test, docs/guide/export.md).
. "$(dirname "${BASH_SOURCE[0]}")/common/root.sh"

make_root bookworm calculix-ccx=2.20-1

# What CalculiX makes of a coordinate of a bar's fifth node.
read_as() {
  cat >"$root/tmp/bar.inp" <<DECK
*NODE, NSET=all
1, 0., 0., 0.
2, 30., 0., 0.
3, 30., 30., 0.
4, 0., 30., 0.
5, $1, 0., 30.
6, 30., 0., 30.
7, 30., 30., 30.
8, 0., 30., 30.
*ELEMENT, TYPE=C3D8, ELSET=bar
1, 1, 2, 3, 4, 5, 6, 7, 8
*MATERIAL, NAME=metal
*ELASTIC
2.1e5, 0.3
*SOLID SECTION, ELSET=bar, MATERIAL=metal
*STEP
*STATIC
*BOUNDARY
all, 1, 3
*NODE FILE
U
*END STEP
DECK
  rm -f "$root/tmp/bar.frd"
  local code=0
  inside ccx -i /tmp/bar >"$work/log" 2>&1 || code=$?
  if ((code)); then
    echo "$1: exit code $code, $(grep -m 1 -o 'ERROR reading \*[A-Z]*' "$work/log")"
  else
    echo "$1: exit code 0, $(awk '$1 == -1 && substr($0, 4, 10) + 0 == 5 { print substr($0, 14, 12) + 0; exit }' "$root/tmp/bar.frd")"
  fi
}

said=$(
  for value in 10. 1.00000000000000e+01 1.000000000000000e+01 -1.23456789012345e-05 1.0000000000000000e+01; do read_as "$value"; done
)
expect "$said" <<END
10.: exit code 0, 10
1.00000000000000e+01: exit code 0, 10
1.000000000000000e+01: exit code 0, 1
-1.23456789012345e-05: exit code 0, -1.23457
1.0000000000000000e+01: exit code 201, ERROR reading *NODE
END
