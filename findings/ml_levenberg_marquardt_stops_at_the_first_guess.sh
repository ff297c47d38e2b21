#!/usr/bin/env bash
# What:      ml-levenberg-marquardt ends when the sum of squares is below 0.01, in whatever unit. A fit of a gap that grows to 0.5 mm within
#            60 s finds both numbers in millimetres. In metres, the same values and the same first guess, the time stays at its guess of 20 s
#            and the gap is 0.39 mm; the result says one iteration and a small error. A smaller errorTolerance and
#            gradientDifference lead to 21.5 s.
# Versions:  ml-levenberg-marquardt 5.1.0 (npm)
# Seen on:   1 December 2026, Debian 12, x86-64, Node.js 20.20.2
# Matters:   strains, gaps and diffusivities in SI units are small: their fits return guesses, with a residual that looks excellent.
# Solidus:   calibrates without this package (docs/theory/calibration.md).
. "$(dirname "${BASH_SOURCE[0]}")/common/root.sh"

make_modules ml-levenberg-marquardt=5.1.0

said=$(in_node <<'SCRIPT'
import { levenbergMarquardt } from "ml-levenberg-marquardt";

const times = [0, 10, 20, 40, 80, 160, 320];
const grow = ([gap, time]) => (t) => gap * (1 - Math.exp(-t / time));
const fit = (unit, size, options) => {
  const gaps = times.map(grow([0.5 * size, 60]));
  const { parameterValues: [gap, time], iterations } = levenbergMarquardt({ x: times, y: gaps }, grow, {
    initialValues: [size, 20], ...options });
  console.log(`${unit}: ${(gap / size).toFixed(3)} mm, ${time.toFixed(2)} s, more than one iteration: ${iterations > 1}`);
};
fit("mm", 1, {});
fit("m", 1e-3, {});
fit("m, both options", 1e-3, { errorTolerance: 1e-20, gradientDifference: [1e-7, 1e-3] });
SCRIPT
)
expect "$said" <<END
mm: 0.500 mm, 60.00 s, more than one iteration: true
m: 0.389 mm, 20.00 s, more than one iteration: false
m, both options: 0.394 mm, 21.51 s, more than one iteration: true
END
