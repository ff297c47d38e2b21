#!/usr/bin/env bash
# What:      a fit by scipy.odr gives standard errors of its parameters, sd_beta, and their covariance, cov_beta. The errors are not the
#            roots of the covariance's diagonal: they are scaled by the residual variance, res_var, the covariance is not. With weights of
#            0.01 where the scatter is 0.5 the two differ by a factor of 45. curve_fit scales its covariance, unless it is told not to.
# Versions:  SciPy 1.10.1 (Debian 12) and 1.15.3 (Debian 13)
# Seen on:   30 November 2026, Debian 12, x86-64
# Matters:   fits with errors in both axes, of viscosity or conductance over temperature, go on by the covariance into predictions.
# Solidus:   fits by least squares; how its covariance is scaled is in docs/theory/calibration.md.
. "$(dirname "${BASH_SOURCE[0]}")/common/root.sh"

fit() {
  inside python3 -W ignore - <<'PYTHON'
import numpy as np
import scipy
from scipy import odr, optimize

# A straight line with a scatter of 0.5, said to be 0.01; x is exact.
x = np.linspace(0, 10, 50)
y = 2 * x + 1 + 0.5 * np.sin(np.arange(50) ** 2)
result = odr.ODR(odr.RealData(x, y, sx=1e-6, sy=0.01), odr.Model(lambda b, x: b[0] * x + b[1]), beta0=[1, 1]).run()
of_covariance = np.sqrt(np.diag(result.cov_beta))
print("SciPy", scipy.__version__)
print("sd_beta ", *(f"{error:.5f}" for error in result.sd_beta))
print("cov_beta", *(f"{error:.5f}" for error in of_covariance))
print("cov_beta * res_var", *(f"{error:.5f}" for error in of_covariance * np.sqrt(result.res_var)))
for absolute in (False, True):
    _, covariance = optimize.curve_fit(lambda x, a, b: a * x + b, x, y, sigma=np.full(50, 0.01), absolute_sigma=absolute)
    print(f"curve_fit, absolute_sigma={absolute}", *(f"{error:.5f}" for error in np.sqrt(np.diag(covariance))))
PYTHON
}

make_root bookworm python3-scipy=1.10.1-2
old=$(fit)
make_root trixie python3-scipy=1.15.3-1
expect "$old
$(fit)" <<END
SciPy 1.10.1
sd_beta  0.01746 0.10133
cov_beta 0.00048 0.00279
cov_beta * res_var 0.01746 0.10133
curve_fit, absolute_sigma=False 0.01746 0.10133
curve_fit, absolute_sigma=True 0.00048 0.00279
SciPy 1.15.3
sd_beta  0.01746 0.10133
cov_beta 0.00048 0.00279
cov_beta * res_var 0.01746 0.10133
curve_fit, absolute_sigma=False 0.01746 0.10133
curve_fit, absolute_sigma=True 0.00048 0.00279
END
