#!/usr/bin/env bash
# What:      latent heat that is put into the table of *SPECIFIC HEAT, the usual way in CalculiX, which has none, counts for steps that end
#            within its range alone. Of 198 kJ/kg over 10 K nothing is left where a step crosses the range, and the run ends with exit code
#            0. Steps that are short enough to go into the range from above end by "diverge".
# Versions:  CalculiX 2.20 (Debian 12)
# Seen on:   30 November 2026, Debian 12, x86-64
# Matters:   castings freeze too early, by up to all of their latent heat; DIRECT with few steps looks like a run that works best.
# Solidus:   stores enthalpy and takes exact differences of it, so that a step of any size keeps the latent heat (docs/theory/thermal.md).
. "$(dirname "${BASH_SOURCE[0]}")/common/root.sh"

make_root bookworm calculix-ccx=2.20-1

# A cube of 1 m at 650 degrees loses 3.5 MW for 200 s: 1 K/s without latent heat, 50 s down to 600. The 150 s that remain are less than the
# 398 s that 7000 kg/m3 x 199 kJ/kg between 600 and 590 take, so that it ends at 596.3.
cool_by() {
  cat >"$root/tmp/cube.inp" <<DECK
*NODE, NSET=all
1, 0., 0., 0.
2, 1., 0., 0.
3, 1., 1., 0.
4, 0., 1., 0.
5, 0., 0., 1.
6, 1., 0., 1.
7, 1., 1., 1.
8, 0., 1., 1.
*ELEMENT, TYPE=DC3D8, ELSET=cube
1, 1, 2, 3, 4, 5, 6, 7, 8
*MATERIAL, NAME=metal
*CONDUCTIVITY
30.
*SPECIFIC HEAT
500., 590.
20500., 590.1
20500., 599.9
500., 600.
*DENSITY
7000.
*SOLID SECTION, ELSET=cube, MATERIAL=metal
*INITIAL CONDITIONS, TYPE=TEMPERATURE
all, 650.
*STEP, INC=1000
*HEAT TRANSFER, DIRECT
$1, 200.
*DFLUX
cube, BF, -3.5e6
*NODE PRINT, NSET=all
NT
*END STEP
DECK
  local code=0
  inside ccx -i /tmp/cube >"$work/log" 2>&1 || code=$?
  if ((code)); then
    echo "steps of $1 s: exit code $code,$(grep -m 1 -o ' solution seems to diverge' "$work/log")"
  else
    echo "steps of $1 s: exit code 0, $(awk 'NF == 2 { t = $2 } END { printf "%.1f", t }' "$root/tmp/cube.dat") degrees"
  fi
}

said=$(for step in 1. 2. 5. 10. 20. 200.; do cool_by "$step"; done)
expect "$said" <<END
steps of 1. s: exit code 201, solution seems to diverge
steps of 2. s: exit code 201, solution seems to diverge
steps of 5. s: exit code 0, 596.3 degrees
steps of 10. s: exit code 0, 450.0 degrees
steps of 20. s: exit code 0, 450.0 degrees
steps of 200. s: exit code 0, 450.0 degrees
END
