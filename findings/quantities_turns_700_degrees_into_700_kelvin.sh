#!/usr/bin/env bash
# What:      the Python package quantities knows degC and K as units of one size and rescales 700 degC to 700 K, without a warning; 1292 degF
#            are 717.8 degC. A difference of 700 degC and 300 K is 400. Its guide says that it treats differences of temperature alone;
#            pint, of the same purpose, has 973.15 K and 673.15.
# Versions:  quantities 0.13.0 (Debian 12) and 0.16.1 (Debian 13), pint 0.24.4 (Debian 13)
# Seen on:   30 November 2026, Debian 12, x86-64
# Matters:   radiation, gas laws and rates by Arrhenius take the absolute temperature: it is 273 K too low, in a number that looks right.
# Solidus:   takes "700 degC" and "973.15 K" for the same temperature, by UDUNITS-2.
. "$(dirname "${BASH_SOURCE[0]}")/common/root.sh"

rescale() {
  inside python3 -W ignore - <<'PYTHON'
import quantities as pq

print("quantities", pq.__version__.split("+")[0])
print("700 degC:", pq.Quantity(700, "degC").rescale("K"))
print("1292 degF:", pq.Quantity(1292, "degF").rescale("degC").round(1))
print("700 degC - 300 K:", pq.Quantity(700, "degC") - pq.Quantity(300, "K"))
PYTHON
}

make_root bookworm python3-quantities=0.13.0-2
old=$(rescale)
make_root trixie python3-quantities=0.16.1-1 python3-pint=0.24.4-2
said=$(
  rescale
  inside python3 - <<'PYTHON'
import pint

units = pint.UnitRegistry()
print("pint", pint.__version__)
print("700 degC:", units.Quantity(700, "degC").to("K"))
print("700 degC - 300 K:", units.Quantity(700, "degC") - units.Quantity(300, "K"))
PYTHON
)
expect "$old
$said" <<END
quantities 0.13.0
700 degC: 700.0 K
1292 degF: 717.8 degC
700 degC - 300 K: 400.0 degC
quantities 0.16.1
700 degC: 700.0 K
1292 degF: 717.8 degC
700 degC - 300 K: 400.0 degC
pint 0.24.4
700 degC: 973.15 kelvin
700 degC - 300 K: 673.15 delta_degree_Celsius
END
