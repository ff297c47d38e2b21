#!/usr/bin/env bash
# What:      dumps of the Python package toml writes a number of numpy as a text: "0.25", and with numpy 2 "np.float64(0.25)". No error
#            comes up, and the file is valid TOML. tomli_w and tomlkit write numbers or refuse. TomlNumpyEncoder of the package, which has
#            to be asked for, writes numbers.
# Versions:  toml 0.10.2 with numpy 1.24.2 (Debian 12) and 2.2.4 (Debian 13)
# Seen on:   30 November 2026, Debian 12, x86-64
# Matters:   results of a fit or a table go into a case or a material by it, and come out as text where a number was meant.
# Solidus:   names a quantity that is a text without a unit, or one that begins with no number, as an error. Its Python package writes
#            numbers of numpy as numbers (python/solidus_casting/toml_text.py).
. "$(dirname "${BASH_SOURCE[0]}")/common/root.sh"

write() {
  inside python3 - <<'PYTHON'
import numpy
import toml

case = {"conductivity": numpy.array([0.25, 0.5])[0], "steps": numpy.arange(3)[2]}
print(f"toml {toml.__version__}, numpy {numpy.__version__}")
print(toml.dumps(case).strip())
print("with its encoder:", toml.dumps(case, encoder=toml.TomlNumpyEncoder()).strip().replace("\n", ", "))
PYTHON
}

make_root bookworm python3-toml=0.10.2-1 python3-numpy=1:1.24.2-1+deb12u1
old=$(write)
make_root trixie python3-toml=0.10.2-1 python3-numpy=1:2.2.4+ds-1
expect "$old
$(write)" <<END
toml 0.10.2, numpy 1.24.2
conductivity = "0.25"
steps = "2"
with its encoder: conductivity = 0.25, steps = 2
toml 0.10.2, numpy 2.2.4
conductivity = "np.float64(0.25)"
steps = "np.int64(2)"
with its encoder: conductivity = 0.25, steps = 2
END
