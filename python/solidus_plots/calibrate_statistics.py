"""What a fit knows of its unknowns: covariance, intervals, correlations, and what the readings cannot see.

    C = s² (Jᵀ W J + P)⁻¹,   s² = rᵀ W r/(n − p) or 1 where the noise is stated,   x ± t_{n−p} √C_jj

with J the derivatives of the readings over their noise by the scaled unknowns, W the weights of the loss and P the priors.
docs/theory/calibration.md has the derivation, its sources and where it fails.
"""

from dataclasses import dataclass
from statistics import NormalDist

import numpy as np

from solidus_plots.vtu import ResultError

UNSEEN = 0.5  # standard deviation of a combination, over the size of its unknowns, from which on it is not seen
NOTHING = 1e-9  # singular value over the largest one that is rounding
MUCH = 0.3  # share of an unknown in a combination from which on it is named
NEIGHBOURS = 0.3  # correlation of residuals next to each other from which on they are no noise


@dataclass
class Estimate:
    name: str
    unit: str
    value: float
    low: float
    high: float
    deviation: float  # standard; of the logarithm where it is searched for by that
    logarithmic: bool
    at_bound: bool


@dataclass
class Statistics:
    estimates: list
    correlation: np.ndarray
    scale: float  # s: of the residuals over the noise that was stated or taken
    stated: bool  # whether the noise was stated for all readings
    freedom: int
    quantile: float
    unseen: list  # (standard deviation over size, {name: share}) of each combination that the readings do not see
    series: list  # per observation: name, unit, readings, rms, mean, correlation of neighbours


def quantile_of(confidence, freedom):
    """The half width of an interval in standard deviations: of the normal distribution, or of Student's with `freedom`
    degrees (exact for one and two; Abramowitz and Stegun 26.7.5, within 2 % of those for three and 0.1 % from six on)."""
    share = 0.5 + confidence / 2
    if freedom == 1:
        return float(np.tan(np.pi * (share - 0.5)))
    if freedom == 2:
        return float((2 * share - 1) * np.sqrt(2 / (4 * share * (1 - share))))
    x = NormalDist().inv_cdf(share)
    if freedom is None:
        return x
    terms = ((x ** 3 + x) / 4, (5 * x ** 5 + 16 * x ** 3 + 3 * x) / 96, (3 * x ** 7 + 19 * x ** 5 + 17 * x ** 3 - 15 * x) / 384,
             (79 * x ** 9 + 776 * x ** 7 + 1482 * x ** 5 - 1920 * x ** 3 - 945 * x) / 92160)
    return float(x + sum(term / freedom ** (k + 1) for k, term in enumerate(terms)))


def sizes(parameters, theta):
    """By what an unknown may be off as far as is known without the readings, in its scaled form."""
    found = []
    for parameter, value in zip(parameters, theta):
        if parameter.deviation is not None:
            found.append(parameter.deviation)
        elif parameter.logarithmic:
            found.append(1.0)
        elif np.isfinite(parameter.high - parameter.low):
            found.append(0.5 * (parameter.high - parameter.low))
        else:
            found.append(max(abs(value), abs(parameter.start), 1e-12))
    return np.array(found)


def combinations(jacobian, size, scale):
    """Directions in the space of the unknowns, each over its size, from the least seen on: (deviation, direction)."""
    triangle = np.linalg.qr(jacobian * size, mode="r")
    _, values, directions = np.linalg.svd(triangle, full_matrices=True)
    values = np.append(values, np.zeros(len(directions) - len(values)))
    largest = values.max() if len(values) > 0 else 0.0
    deviations = [scale / value if value > NOTHING * largest else np.inf for value in values]
    return sorted(zip(deviations, directions), key=lambda found: -found[0])


def named(direction, names):
    """The unknowns of a combination with their signs, the largest first; those that weigh alike as they were given."""
    order = sorted(range(len(direction)), key=lambda i: (-round(abs(float(direction[i])), 3), i))
    sign = np.sign(direction[order[0]])
    return {names[i]: float(sign * direction[i]) for i in order if abs(direction[i]) >= MUCH}


def untold(names):
    """Why unknowns cannot be found."""
    if len(names) == 1:
        return f"no reading depends on '{names[0]}': leave it out, give a prior, or measure elsewhere"
    return ("the readings depend on " + " and ".join(f"'{name}'" for name in names) + " through one combination of them: they "
            "cannot be told apart; leave one out, give a prior, or measure something else")


def neighbours(residuals):
    """Correlation of residuals with those next to them."""
    about = residuals - residuals.mean()
    total = about @ about
    return float(about[:-1] @ about[1:] / total) if len(about) > 2 and total > 0 else 0.0


def evaluate(fit, parameters, readings, confidence):
    """Throws ResultError for unknowns that cannot be told apart, with their names."""
    n, p = fit.jacobian.shape
    names = [parameter.name for parameter in parameters]
    stated = all(r.noise is not None for r in readings)
    priors = np.array([0.0 if q.deviation is None else 1 / q.deviation ** 2 for q in parameters])
    freedom = n - p + int(np.count_nonzero(priors))
    weighted = fit.jacobian * np.sqrt(fit.weights)[:, None]
    squares = float(np.sum(fit.weights * (fit.residuals / fit.sigma) ** 2))
    scale = np.sqrt(squares / max(n - p, 1))
    spread = 1.0 if stated else scale
    size = sizes(parameters, fit.theta)
    found = combinations(weighted, size, spread)
    for deviation, direction in found:
        share = named(direction, names)
        if np.isinf(deviation) and not any(priors[names.index(name)] > 0 for name in share):
            raise ResultError(untold(list(share)))
    information = weighted.T @ weighted / spread ** 2 + np.diag(priors)
    root = np.sqrt(np.diag(information))
    covariance = np.linalg.inv(information / np.outer(root, root)) / np.outer(root, root)
    deviation = np.sqrt(np.diag(covariance))
    quantile = quantile_of(confidence, None if stated else max(freedom, 1))
    estimates = []
    for parameter, value, sd in zip(parameters, fit.theta, deviation):
        reach = quantile * sd
        low, high = (value * np.exp(-reach), value * np.exp(reach)) if parameter.logarithmic else (value - reach, value + reach)
        near = 1e-3 * min(sd, 1.0) * (value if parameter.logarithmic else 1.0)
        at_bound = value - parameter.low <= near or parameter.high - value <= near
        estimates.append(Estimate(parameter.name, parameter.unit, float(value), float(low), float(high), float(sd),
                                  parameter.logarithmic, bool(at_bound)))
    unseen = [(float(d), named(direction, names)) for d, direction in found if d > UNSEEN]
    return Statistics(estimates, covariance / np.outer(deviation, deviation), float(scale), stated, freedom, quantile, unseen,
                      series(fit, readings))


def series(fit, readings):
    found, at = [], 0
    for r in readings:
        own = fit.residuals[at:at + len(r.values)]
        at += len(r.values)
        unit = r.header.partition("[")[2].rstrip("]")
        found.append({"name": r.name, "unit": "K" if unit == "degC" else unit, "readings": len(own),
                      "rms": float(np.sqrt(np.mean(own ** 2))), "mean": float(np.mean(own)),
                      "neighbours": neighbours(own)})
    return found
