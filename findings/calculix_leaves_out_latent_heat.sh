#!/usr/bin/env bash
# What:      CalculiX has no latent heat: it passes over *LATENT HEAT of an Abaqus deck, as over every keyword that it does not know, with
#            a warning among its output, and ends with exit code 0. The cube cools as if it did not solidify.
# Versions:  CalculiX 2.20 (Debian 12)
# Seen on:   28 November 2026, Debian 12, x86-64
# Matters:   a casting cools as if it had nothing to solidify, in a run that looks right.
# Solidus:   has latent heat of its own; in comparisons with CalculiX it is put into the table of the specific heat (docs/benchmarks.md).
. "$(dirname "${BASH_SOURCE[0]}")/common/root.sh"

make_root bookworm calculix-ccx=2.20-1

# A cube of 1 kg with 1000 J/kg/K at 700 K loses 200 kJ. With 400 kJ/kg between 610 and 600 K it would end at 607.3 K.
cat >"$root/tmp/cube.inp" <<'DECK'
*NODE, NSET=all
1, 0., 0., 0.
2, 1., 0., 0.
3, 1., 1., 0.
4, 0., 1., 0.
5, 0., 0., 1.
6, 1., 0., 1.
7, 1., 1., 1.
8, 0., 1., 1.
*ELEMENT, TYPE=C3D8, ELSET=cube
1, 1, 2, 3, 4, 5, 6, 7, 8
*MATERIAL, NAME=metal
*CONDUCTIVITY
30.
*SPECIFIC HEAT
1000.
*DENSITY
1.
*LATENT HEAT
400000., 600., 610.
*SOLID SECTION, ELSET=cube, MATERIAL=metal
*PHYSICAL CONSTANTS, ABSOLUTE ZERO=0.
*INITIAL CONDITIONS, TYPE=TEMPERATURE
all, 700.
*STEP
*HEAT TRANSFER, DIRECT
1., 10.
*DFLUX
cube, BF, -20000.
*NODE PRINT, NSET=all, FREQUENCY=10
NT
*END STEP
DECK
said=$(
  inside ccx -i /tmp/cube >"$work/log" 2>&1 && echo "exit code 0"
  grep -A 1 'WARNING reading the input file' "$work/log" | grep -o '\*LATENT.*'
  awk '$1 == 1 { printf "%.1f K at the end\n", $2 }' "$root/tmp/cube.dat"
)
expect "$said" <<END
exit code 0
*LATENTHEAT
500.0 K at the end
END
