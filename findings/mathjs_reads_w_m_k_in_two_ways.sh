#!/usr/bin/env bash
# What:      "40 W/m K" is a conductivity of 40 W/(m K) for evaluate of math.js and a product 40 W K/m for its unit(): for evaluate, units
#            with a space between them belong together before a slash counts, unit() goes from left to right. Each is documented, at its
#            place; both are of one library and take the same text.
# Versions:  mathjs 15.2.0 (npm)
# Seen on:   30 November 2026, Debian 12, x86-64, Node.js 20.20.2
# Matters:   data sheets write W/m K and J/kg K; a page that reads a field by one and computes with the other has a wrong power of kelvin.
# Solidus:   reads units by UDUNITS-2, and refuses those of another dimension than that of the key.
. "$(dirname "${BASH_SOURCE[0]}")/common/root.sh"

make_modules mathjs=15.2.0

said=$(in_node <<'SCRIPT'
import { evaluate, unit } from "mathjs";

for (const text of ["40 W/m K", "900 J/kg K", "2000 W/m^2 K"]) {
  console.log(`${text}: unit() ${unit(text).toSI()}, evaluate ${evaluate(text).toSI()}`);
}
SCRIPT
)
expect "$said" <<END
40 W/m K: unit() 40 (kg m K) / s^3, evaluate 40 (kg m) / (s^3 K)
900 J/kg K: unit() 900 (m^2 K) / s^2, evaluate 900 m^2 / (s^2 K)
2000 W/m^2 K: unit() 2000 (kg K) / s^3, evaluate 2000 kg / (s^3 K)
END
