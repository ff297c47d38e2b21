#!/usr/bin/env bash
# What:      a plot of contours of a field is one artist since matplotlib 3.8 and was one for each level before; ContourSet.collections, by
#            which scripts set widths and smooth edges of levels, is gone in 3.10: AttributeError. What replaces it, the set itself, is no
#            artist before 3.8, so that each works with one of the two.
# Versions:  matplotlib 3.6.3 (Debian 12) and 3.10.1 (Debian 13)
# Seen on:   28 November 2026, Debian 12, x86-64
# Matters:   plots of fields fail after the run that they are of.
# Solidus:   takes the one or the other (artists of contours in python/solidus_plots/maps.py).
. "$(dirname "${BASH_SOURCE[0]}")/common/root.sh"

contours() {
  inside python3 - <<'PYTHON'
import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt
from matplotlib.artist import Artist

contours = plt.contourf([[0, 1], [2, 3]], levels=[0, 1, 2, 3])
print("an artist:", isinstance(contours, Artist), end=", ")
try:
    print(len(contours.collections), "collections")
except AttributeError as error:
    print(error)
PYTHON
}

make_root bookworm python3-matplotlib=3.6.3-1+b1
expect "$(contours)" <<<"an artist: False, 3 collections"
make_root trixie python3-matplotlib=3.10.1+dfsg1-4
expect "$(contours)" <<<"an artist: True, 'QuadContourSet' object has no attribute 'collections'"
