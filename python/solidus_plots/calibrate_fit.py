"""Least squares over the runs of a case: the method of Levenberg and Marquardt within bounds, priors as readings of the
unknowns, and a loss that outliers do not rule.

    minimise  F = ½ Σ_i ρ(r_i²) + ½ Σ_j ((x_j − prior_j)/σ_j)²,   r_i = (y_i(x) − m_i)/σ_i,   lower <= x <= upper

A step solves (Jᵀ W J + P + λ diag) δ = −∇F for the unknowns that no bound holds, with W = ρ'; λ follows from how much of
what the linear model promises a step keeps (J. J. Moré, Lecture Notes in Mathematics 630 (1978) 105). Unknowns above
zero are searched for by their logarithms. Where derivatives are differences of runs those of the start are updated (C. G.
Broyden, Math. Comp. 19 (1965) 577) until a step keeps little of its promise; where they come with the run but cost more
than it, while steps keep most of it.
"""

from dataclasses import dataclass

import numpy as np

from solidus_plots.vtu import ResultError

LAMBDA = 0.1  # at the start
LEAST_DAMPING = 1e-10  # without effect
GOOD, POOR = 0.75, 0.25  # share of the promise with which λ falls, rises
LONGEST = 1.5  # step of a logarithm: a factor of 4.5; of a rough search all of its way
SMALL_STEP = 1e-8  # of an unknown, over its size, with which the search ends
SMALL_GAIN = 1e-4  # promise of a step, over the mean square of a residual: a hundredth of a standard deviation
NEGLIGIBLE = 1e-8  # the same, absolute: no unknown moves by more than 1.4e-4 of its own standard deviation
ROUGH = 100  # times these two, with which a search of runs that are only to find a start ends
NEARLY = 10  # times these two, below which what the next step is expected to promise makes this one the last
TRIES = 8  # steps in a row that do not lower F


class RunFailed(ResultError):
    """A run at a point of the search has not come to its end."""


class OutOfRuns(Exception):
    """The runs that were allowed are used up."""


def weights_of(loss, scale, r):
    """ρ'(r²) of each residual: 1 for squares."""
    t = (r / scale) ** 2
    return {"linear": lambda: np.ones_like(t), "huber": lambda: np.where(t <= 1, 1.0, np.maximum(t, 1.0) ** -0.5),
            "soft_l1": lambda: (1 + t) ** -0.5, "cauchy": lambda: 1 / (1 + t)}[loss]()


def loss_of(loss, scale, r):
    """Σ ρ(r²)."""
    t = (r / scale) ** 2
    form = {"linear": lambda: t, "huber": lambda: np.where(t <= 1, t, 2 * np.sqrt(t) - 1),
            "soft_l1": lambda: 2 * (np.sqrt(1 + t) - 1), "cauchy": lambda: np.log1p(t)}[loss]()
    return float(scale ** 2 * np.sum(form))


@dataclass
class Fit:
    theta: np.ndarray  # the unknowns
    residuals: np.ndarray  # computed − measured, in the units of the probes
    jacobian: np.ndarray  # of the readings by the scaled unknowns, over their noise
    sigma: np.ndarray  # of each reading, with which it was weighted
    weights: np.ndarray  # of each reading by the loss, from 0 to 1
    runs: int
    converged: bool
    message: str


class Search:
    """The unknowns in their scaled form x, and what is known at the points that were computed."""

    def __init__(self, model, measured, sigma, most_runs, say=lambda text: None):
        self.model, self.measured, self.sigma, self.most_runs, self.say = model, measured, sigma, most_runs, say
        self.parameters = model.parameters
        self.logarithmic = np.array([p.logarithmic for p in self.parameters])
        self.prior = np.array([0.0 if p.prior is None else np.log(p.prior) if p.logarithmic else p.prior
                               for p in self.parameters])
        self.certainty = np.array([0.0 if p.deviation is None else 1 / p.deviation for p in self.parameters])
        self.known = {}  # point -> prediction

    def scaled(self, theta):
        theta = np.array(theta, dtype=float)
        with np.errstate(divide="ignore", invalid="ignore"):
            return np.where(self.logarithmic, np.log(np.maximum(theta, 0.0)), theta)

    def natural(self, x):
        return np.where(self.logarithmic, np.exp(np.where(self.logarithmic, x, 0.0)), x)

    def bounds(self):
        return self.scaled([p.low for p in self.parameters]), self.scaled([p.high for p in self.parameters])

    def predict(self, x, derivatives):
        key = tuple(x)
        prediction = self.known.get(key)
        if prediction is not None and (not derivatives or prediction.derivatives is not None):
            return prediction
        cost = 1 + (len(self.model.in_runs()) if derivatives and not self.model.forward else 0)
        if self.known and self.model.runs + cost > self.most_runs:
            raise OutOfRuns
        self.known[key] = self.model.predict(self.natural(x), derivatives)
        return self.known[key]

    def rows(self, x, derivatives):
        """With the run that gives them, where derivatives come with it and are wanted."""
        return (self.predict(x, derivatives or not self.known).values - self.measured) / self.sigma

    def has_derivative(self, x):
        return self.known[tuple(x)].derivatives is not None

    def derivative(self, x):
        """Of the rows by x."""
        slopes = np.where(self.logarithmic, self.natural(x), 1.0)
        return self.predict(x, True).derivatives * slopes / self.sigma[:, None]


def _solve(gradient, matrix, damping, x, low, high):
    """The step within the bounds, which hold what lies on them and is pushed outward."""
    free = ~((x <= low) & (gradient > 0) | (x >= high) & (gradient < 0))
    step = np.zeros_like(x)
    if not free.any():
        return step
    part = matrix[np.ix_(free, free)]
    size = np.sqrt(np.maximum(np.diag(part), 1e-300))
    damped = part / np.outer(size, size) + damping * np.eye(len(size))
    step[free] = -np.linalg.lstsq(damped, gradient[free] / size, rcond=1e-14)[0] / size
    return step


def _updated(jacobian, rows_before, rows, step):
    return jacobian + np.outer(rows - rows_before - jacobian @ step, step) / (step @ step)


def fit(search, loss="linear", loss_scale=2.0, start=None, rough=False):
    """rough: what is found is a start for another search. Throws ResultError where a run fails."""
    low, high = search.bounds()
    x = np.clip(search.scaled([p.start for p in search.parameters]) if start is None else start, low, high)
    if rough:  # what coarse runs do not determine could go to where no reading feels it, and would stay there
        low = np.where(search.logarithmic, np.maximum(low, x - LONGEST), low)
        high = np.where(search.logarithmic, np.minimum(high, x + LONGEST), high)
    n = len(search.measured)
    sum_of = lambda rows, x: 0.5 * (loss_of(loss, loss_scale, rows) + np.sum((search.certainty * (x - search.prior)) ** 2))
    # The first point has exact derivatives, and later ones where they cost no run of their own.
    jacobian = search.derivative(x)
    rows = search.rows(x, True)
    value, damping, converged, message = sum_of(rows, x), LAMBDA, False, f"the {search.most_runs} runs are used up"
    failed, fresh, kept, promised = 0, True, 0.0, np.inf
    try:
        while True:
            weights = weights_of(loss, loss_scale, rows)
            gradient = jacobian.T @ (weights * rows) + search.certainty ** 2 * (x - search.prior)
            matrix = jacobian.T @ (weights[:, None] * jacobian) + np.diag(search.certainty ** 2)
            step = _solve(gradient, matrix, damping, x, low, high)
            step = np.where(search.logarithmic, np.clip(step, -LONGEST, LONGEST), step)
            target = np.clip(x + step, low, high)
            step = target - x
            promise = -(gradient @ step + 0.5 * step @ matrix @ step)
            size = np.where(search.logarithmic, 1.0, np.maximum(np.abs(x), 1e-300))
            enough = (ROUGH if rough else 1) * max(SMALL_GAIN * 2 * value / max(n, 1), NEGLIGIBLE)
            if np.all(np.abs(step) <= SMALL_STEP * size) or promise <= enough:
                if failed == 0 and damping > LEAST_DAMPING and not rough:
                    damping /= 10  # along a valley it is the damping that makes steps short
                    continue
                if fresh or rough or np.all(step == 0):
                    converged, message = True, ""
                    break
                # The last word is that of derivatives at the point itself.
                jacobian, fresh = search.derivative(x), True
                continue
            # Derivatives that cost more than the run itself are updated while the linear model keeps its promise. Those of the
            # last point are needed in the end: a step that is expected to be the last brings them, so that its run is not repeated.
            last = promise * min(1.0, promise / promised) <= NEARLY * max(SMALL_GAIN * 2 * max(value - promise, 0.0) / max(n, 1), NEGLIGIBLE)
            wanted = search.model.forward and (not search.model.dear or kept < GOOD or (last and not rough))
            promised = promise
            try:
                rows_there = search.rows(target, wanted)
            except RunFailed as failure:  # the physics of a far step may not go through: a shorter one is taken
                search.say(f"  {failure}: a shorter step")
                damping, failed = max(damping * 10, 1e-2), failed + 1
                if failed >= TRIES:
                    raise
                continue
            there = sum_of(rows_there, target)
            kept = (value - there) / promise if promise > 0 else -1.0
            search.say(f"  run {search.model.runs}: mean square {2 * there / n:.4g}")
            better = there < value
            if not wanted:
                jacobian, fresh = _updated(jacobian, rows, rows_there, step), False
            damping = damping / 10 if kept > GOOD else damping * 4 if kept < POOR else damping
            if better:
                x, rows, value, failed = target, rows_there, there, 0
                if search.has_derivative(x):
                    jacobian, fresh = search.derivative(x), True
            else:
                damping, failed = max(damping * 10, 1e-6), failed + 1
                if failed >= TRIES:
                    converged, message = True, "no step lowers the sum any more"
                    break
            if kept < POOR and not fresh:
                jacobian, fresh = search.derivative(x), True
    except OutOfRuns:
        pass
    if not fresh:
        message += "; derivatives are updated ones" if message else "derivatives are updated ones"
    return Fit(search.natural(x), rows * search.sigma, jacobian, search.sigma, weights_of(loss, loss_scale, rows),
               search.model.runs, converged, message)
