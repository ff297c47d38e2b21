"""Fits parameters of a hardening law to a measured curve of stress and strain, with the law of the simulation itself.

scipy's least squares are used where scipy is there, else a Levenberg-Marquardt iteration of our own with numpy.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from typing import Any

import numpy as np

from .constitutive import Material
from .errors import SolidusError

#: the parameters of each law of isotropic hardening that are fitted, by their names in a material file, with their units
PARAMETERS = {
    "linear": {"flow_stress": "Pa", "hardening_modulus": "Pa"},
    "saturation": {"flow_stress": "Pa", "saturation_stress": "Pa", "saturation_rate": ""},
    "power": {"flow_stress": "Pa", "reference_strain": "", "hardening_exponent": ""},
}


def fit_hardening(kind: str, strain: Any, stress: Any, base: Material, temperature: float, start: Mapping[str, float],
                  rate: float = 1e-3) -> dict[str, float]:
    """Finds the parameters with which a tensile test of the material has the measured stresses.

    Parameters
    ----------
    kind:
        ``"linear"``, ``"saturation"`` (Voce) or ``"power"`` (Swift).
    strain, stress:
        Of the test: total axial strain, increasing, and true stress [Pa].
    base:
        The material with the elasticity and the rate dependence.
    temperature, rate:
        Of the test [K], [1/s].
    start:
        Initial values of the parameters to be found, in SI units, by their names in :data:`PARAMETERS`.

    Returns the parameters in SI units, and under ``"error"`` the root mean square error of the stresses [Pa].
    """
    if kind not in PARAMETERS:
        raise ValueError(f"there is no hardening {kind!r} to fit; one of: {', '.join(PARAMETERS)}")
    unknown = set(start) - set(PARAMETERS[kind])
    if unknown or not start:
        raise ValueError(f"{kind} hardening has the parameters {', '.join(PARAMETERS[kind])}, not {', '.join(unknown) or 'none'}")
    strain, stress = np.asarray(strain, float), np.asarray(stress, float)
    names = list(start)
    guess = np.log([start[name] for name in names])  # all of them are positive

    def quantities(logarithms: np.ndarray) -> dict[str, Any]:
        values = {name: float(value) for name, value in zip(names, np.exp(logarithms))}
        units = PARAMETERS[kind]
        return {f"plasticity.{name}": f"{value!r} {units[name]}" if units[name] else value for name, value in values.items()}

    def missing(logarithms: np.ndarray) -> np.ndarray:
        trial = base.changed({"plasticity.isotropic_hardening": kind, **quantities(logarithms)})
        return (trial.tension(strain, temperature, rate) - stress) / np.abs(stress).max()

    try:
        from scipy.optimize import least_squares
    except ImportError:
        found = _levenberg_marquardt(missing, guess)
    else:
        found = least_squares(missing, guess, diff_step=1e-5, xtol=1e-10, ftol=1e-12).x
    result = {name: float(value) for name, value in zip(names, np.exp(found))}
    result["error"] = float(np.sqrt(np.mean(missing(found) ** 2)) * np.abs(stress).max())
    return result


def _levenberg_marquardt(residual: Callable[[np.ndarray], np.ndarray], x: np.ndarray, iterations: int = 100) -> np.ndarray:
    """Least squares with a slope by differences; the damping follows success."""
    damping, now = 1e-3, residual(x)
    for _ in range(iterations):
        slope = np.stack([(residual(x + 1e-5 * axis) - now) / 1e-5 for axis in np.eye(len(x))], 1)
        normal, right = slope.T @ slope, -slope.T @ now
        while damping < 1e12:
            change = np.linalg.solve(normal + damping * np.diag(np.diag(normal)), right)
            trial = residual(x + change)
            if trial @ trial < now @ now:
                x, now, damping = x + change, trial, damping / 10
                break
            damping *= 10
        else:
            return x
        if np.abs(change).max() < 1e-10:
            return x
    raise SolidusError("the fit has not converged; other first guesses may help")
