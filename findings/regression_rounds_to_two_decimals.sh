#!/usr/bin/env bash
# What:      fits by the package "regression" are rounded to two decimals, and its predictions are those of the rounded formula. A thermal
#            expansion of 2.3e-5 per K is 0, a conductivity that falls by 0.0213 per K falls by 0.02, its quadratic term is gone. The option
#            "precision" takes a count of decimals, not of digits. The coefficient of determination, r2, is that of the rounded formula too.
# Versions:  regression 2.0.1 (npm)
# Seen on:   1 December 2026, Debian 12, x86-64, Node.js 20.20.2
# Matters:   properties over temperature have coefficients far below 0.01: the fitted material does not expand.
# Solidus:   calibrates without this package (docs/theory/calibration.md).
. "$(dirname "${BASH_SOURCE[0]}")/common/root.sh"

make_modules regression=2.0.1

said=$(in_node <<'SCRIPT'
import regression from "regression";

const temperatures = [20, 200, 400, 600, 800];
const fits = {
  "strain, linear": ["linear", (t) => 2.3e-5 * (t - 20), {}],
  "conductivity, quadratic": ["polynomial", (t) => 80 - 0.0213 * t + 1.2e-5 * t * t, { order: 2 }],
};
for (const [name, [kind, law, options]] of Object.entries(fits))
  for (const precision of [undefined, 12]) {
    const points = temperatures.map((t) => [t, law(t)]);
    const fit = regression[kind](points, precision ? { ...options, precision } : options);
    const at = `at 800: ${Number(fit.predict(800)[1].toPrecision(6))} of ${Number(law(800).toPrecision(6))}`;
    console.log(`${name}, ${precision ?? "default"}: ${fit.equation.map((c) => Number(c.toPrecision(6))).join(" ")}, ${at}, r2 ${fit.r2}`);
  }
SCRIPT
)
expect "$said" <<END
strain, linear, default: 0 0.01, at 800: 0.01 of 0.01794, r2 -0.03
strain, linear, 12: 0.000023 -0.00046, at 800: 0.01794 of 0.01794, r2 1
conductivity, quadratic, default: 0 -0.02 80, at 800: 64 of 70.64, r2 -0.1
conductivity, quadratic, 12: 0.000012 -0.0213 80, at 800: 70.64 of 70.64, r2 1
END
