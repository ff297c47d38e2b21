"""The answers of a Latin hypercube of the uncertain parameters: `solidus uncertain CASE --samples N`."""

import json
from statistics import NormalDist

import numpy as np

from solidus_plots.compare import write_csv
from solidus_plots.study_plots import rank_correlation
from solidus_plots.style import unit_text
from solidus_plots.uncertain_result import rounded, split
from solidus_plots.vtu import ResultError


def points(count, samples, seed):
    """[run][parameter] shares u = z/2 of the half width: each of `samples` equally likely parts is met once."""
    random = np.random.default_rng(seed)
    inverse = np.vectorize(NormalDist().inv_cdf)
    columns = [(random.permutation(samples) + random.random(samples)) / samples for _ in range(count)]
    return 0.5 * inverse(np.clip(np.column_stack(columns), 1e-3, 1 - 1e-3))  # within 3.1 standard deviations


def summarised(names, values, parameters, shares):
    """[answer] with its mean, two standard deviations and what it follows, of the runs that have it."""
    result = []
    for column, name in enumerate(names):
        known = np.isfinite(values[:, column])
        of_answer = values[known, column]
        if known.sum() < 3 or np.ptp(of_answer) <= 1e-12 * np.abs(of_answer).max():
            continue
        correlations = [rank_correlation(shares[known, p], of_answer) for p in range(len(parameters))]
        order = sorted(range(len(parameters)), key=lambda p: -abs(correlations[p]))
        text, unit = split(name)
        result.append({"name": text, "unit": unit, "runs": int(known.sum()), "mean": float(of_answer.mean()),
                       "plus_minus": 2.0 * float(of_answer.std(ddof=1)), "least": float(of_answer.min()),
                       "greatest": float(of_answer.max()),
                       "rank_correlations": {parameters[p].label: correlations[p] for p in order}})
    return result


def line(answer):
    unit = "" if answer["unit"] in ("", "1") else f" {unit_text(answer['unit'])}"
    spread = answer["plus_minus"]
    first = [f"{label} {value:+.2f}" for label, value in list(answer["rank_correlations"].items())[:3]]
    return (f"{rounded(answer['mean'], spread)}{unit} ± {rounded(spread, spread)}, {rounded(answer['least'], spread)} to "
            f"{rounded(answer['greatest'], spread)} (rank correlations: {', '.join(first)})")


def run(sweep, title, parameters, samples, seed, folder, said):
    """Runs them, writes the tables and prints a line an answer; what was written, nothing after Ctrl-C."""
    shares = points(len(parameters), samples, seed)
    width = len(str(samples))
    done = sweep.run([(f"sample_{number + 1:0{width}d}", f"sample {number + 1}",
                       [change for parameter, u in zip(parameters, row) for change in parameter.changes(float(u))])
                      for number, row in enumerate(shares)], samples)
    if done is None:
        return None
    names = list(dict.fromkeys(name for found in done if found is not None for name in found))
    if not names:
        raise ResultError(f"no run has answers: {sweep.failed[0] if sweep.failed else 'nothing freezes and no probe is set'}")
    values = np.array([[(found or {}).get(name, np.nan) for name in names] for found in done])
    header = ["run", *(f"{parameter.label}, share of +-" for parameter in parameters), *names]
    rows = [[number + 1, *map(float, row), *(None if np.isnan(value) else float(value) for value in values[number])]
            for number, row in enumerate(shares)]
    write_csv(folder / "uncertain_samples.csv", header, rows)
    answers = summarised(names, values, parameters, shares)
    document = {"title": title, "seed": seed, "remarks": said, "answers": answers}
    (folder / "uncertain_samples.json").write_text(json.dumps(document, indent=2) + "\n")
    print(f"\n{title}: mean of the runs ± two standard deviations, least to greatest\n")
    if answers:
        longest = max(len(answer["name"]) for answer in answers)
        print("\n".join(f"  {answer['name']:{longest}}  {line(answer)}" for answer in answers))
    else:
        print("  No answer changes.")
    return "uncertain_samples.csv, uncertain_samples.json"
