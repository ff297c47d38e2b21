#!/usr/bin/env bash
# What:      UDUNITS-2 reads W/mK, as data sheets write a thermal conductivity, as watt per millikelvin, and W/m K and W/m2 K as products
#            with kelvin. All three are valid units of something else. A quantity that no one checks is wrong without a word:
#            "40 W/mK" are 40 000 W/K.
# Versions:  UDUNITS 2.2.28 (Debian 12)
# Seen on:   28 November 2026, Debian 12, x86-64
# Matters:   tables of conductivity and of coefficients of heat transfer are copied with these units.
# Solidus:   knows the dimension of every key: these are errors that name the unit with brackets (tests/unit/input/units_test).
. "$(dirname "${BASH_SOURCE[0]}")/common/root.sh"

make_root bookworm udunits-bin=2.2.28-5

# What one of the first is in the second.
in_units() { inside udunits2 -H "$1" -W "$2" 2>&1 | head -n 1 | sed 's/^ *//'; }

said=$(
  in_units 'W/mK' 'W/K'
  in_units 'W/mK' 'W/m/K'
  in_units 'W/m K' 'W K/m'
  in_units 'W/m2 K' 'W K/m2'
  in_units 'W/(m K)' 'W/m/K'
)
expect "$said" <<END
1 W/mK = 1000 W/K
udunits2: Units are not convertible
1 W/m K = 1 (W K/m)
1 W/m2 K = 1 (W K/m2)
1 W/(m K) = 1 W/m/K
END
