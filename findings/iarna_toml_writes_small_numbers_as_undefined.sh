#!/usr/bin/env bash
# What:      stringify of @iarna/toml writes 1e-7 as "1e-7.undefined", which is no TOML and which its own parser refuses. It concerns every
#            number that JavaScript prints as one digit and a negative exponent: 2e-7, -5e-9. 1.2e-7 is written as it should be.
# Versions:  @iarna/toml 3.0.0 (npm)
# Seen on:   30 November 2026, Debian 12, x86-64, Node.js 20.20.2
# Matters:   coefficients of expansion, diffusivities, tolerances and lengths in metres are such numbers: a case that a page saved is not
#            read any more, at one value and not at the next.
# Solidus:   edits a case file as text and leaves all other bytes as they are (python/solidus_casting/workbench/toml_edit.py).
. "$(dirname "${BASH_SOURCE[0]}")/common/root.sh"

make_modules @iarna/toml=3.0.0

said=$(in_node <<'SCRIPT'
import TOML from "@iarna/toml";

for (const value of [1.2e-7, 1e-7, -5e-9, 1e-6]) {
  const text = TOML.stringify({ expansion: value }).trim();
  let read;
  try {
    read = TOML.parse(text).expansion;
  } catch {
    read = "refused";
  }
  console.log(`${text}: ${read}`);
}
SCRIPT
)
expect "$said" <<END
expansion = 1.2e-7: 1.2e-7
expansion = 1e-7.undefined: refused
expansion = -5e-9.undefined: refused
expansion = 0.000001: 0.000001
END
