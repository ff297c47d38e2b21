"""What a calibration leaves: a table for people, calibrate.json, residuals.csv, the case with the values found, and a card
of the interface."""

import json
from pathlib import Path

import numpy as np

from solidus_plots.calibrate_statistics import NEIGHBOURS
from solidus_plots.compare import as_text, write_csv
from solidus_plots.history import Table


def digits(value, spread):
    """A number with as many digits as its spread has a meaning for: two of the spread."""
    if not (np.isfinite(spread) and spread > 0):
        return f"{value:.6g}"
    places = 1 - int(np.floor(np.log10(spread)))
    return f"{value:.{places}f}" if places > 0 else f"{round(value, places):.0f}"


def percent(confidence):
    return f"{100 * confidence:g} %"


def estimates_text(statistics, confidence):
    rows = []
    for e in statistics.estimates:
        half = 0.5 * (e.high - e.low)
        rows.append([e.name, digits(e.value, half), digits(e.low, half), digits(e.high, half), e.unit,
                     "at its bound" if e.at_bound else ""])
    return as_text(["unknown", "value", f"{percent(confidence)} from", "to", "unit", ""], rows)


def unseen_text(deviation, shares):
    """A combination of unknowns that the readings do not see, in words."""
    names = list(shares)
    far = "however far it moves" if np.isinf(deviation) else f"to a factor of {np.exp(deviation):.3g}" if deviation < 5 else "at all"
    if len(names) == 1:
        return f"{names[0]}: no reading feels it" + ("" if far == "at all" else f" ({far})")
    signs = " ".join(("" if i == 0 else "+ " if share > 0 else "− ") + f"{abs(share):.2f} {name}"
                     for i, (name, share) in enumerate(shares.items()))
    return f"together and not one by one: {signs}"


def text(statistics, fit, confidence):
    """What the command prints."""
    lines = [estimates_text(statistics, confidence), ""]
    header = ["observation", "readings", "root mean square", "mean", "unit"]
    lines.append(as_text(header, [[s["name"], str(s["readings"]), f"{s['rms']:.3g}", f"{s['mean']:+.3g}", s["unit"]]
                                  for s in statistics.series]))
    noise = "the noise that was stated" if statistics.stated else "one unit"
    lines.append(f"\n  residuals are {statistics.scale:.3g} times {noise}, with {statistics.freedom} degrees of freedom")
    for deviation, shares in statistics.unseen:
        lines.append(f"  not seen by the readings: {unseen_text(deviation, shares)}")
    pairs = [(abs(c), i, j) for i, row in enumerate(statistics.correlation) for j, c in enumerate(row[:i]) if abs(c) > 0.95]
    for _, i, j in sorted(pairs, reverse=True)[:5]:
        lines.append(f"  hardly told apart (correlation {statistics.correlation[i][j]:+.3f}): "
                     f"{statistics.estimates[j].name}, {statistics.estimates[i].name}")
    alike = [s for s in statistics.series if s["neighbours"] > NEIGHBOURS and s["readings"] > 5]
    if alike:
        worst = max(s["neighbours"] for s in alike)
        factor = np.sqrt((1 + worst) / (1 - worst)) if worst < 1 else np.inf
        lines.append(f"  residuals of {', '.join(s['name'] for s in alike)} are like those next to them (correlation up to "
                     f"{worst:.2f}): they are not noise but what model and data disagree in, and intervals are too narrow, by "
                     f"a factor of about {factor:.2g}")
    cut = int(np.count_nonzero(fit.weights < 0.5))
    if cut > 0:
        lines.append(f"  {cut} readings count less than half, by the loss")
    return "\n".join(lines)


def curves(readings, fit):
    """Measured and computed values of each observation over the time of the case, for the report; what is compared at the end
    of the run has no time."""
    found, at = [], 0
    for r in readings:
        own = fit.residuals[at:at + len(r.values)]
        at += len(r.values)
        if not r.at_end:
            found.append({"name": r.name, "unit": Table.unit(r.header), "time": [round(float(t), 6) for t in r.time],
                          "measured": [float(f"{v:.8g}") for v in r.values],
                          "computed": [float(f"{v:.8g}") for v in r.values + own]})
    return found


def document(calibration, measured, readings, statistics, fit, cost):
    """calibrate.json: numbers in the units of the file."""
    return {"title": calibration.title, "measured": str(measured), "confidence": calibration.confidence,
            "converged": fit.converged, "message": fit.message, **cost,
            "unknowns": [{"name": e.name, "unit": e.unit, "value": e.value, "low": e.low, "high": e.high,
                          "deviation": e.deviation, "of_logarithm": e.logarithmic, "at_bound": e.at_bound}
                         for e in statistics.estimates],
            "correlation": [[round(float(c), 6) for c in row] for row in statistics.correlation],
            "residuals_over_noise": statistics.scale, "noise_stated": statistics.stated,
            "degrees_of_freedom": statistics.freedom, "quantile": statistics.quantile,
            "not_seen": [{"deviation": None if np.isinf(d) else d, "combination": shares} for d, shares in statistics.unseen],
            "observations": statistics.series, "curves": curves(readings, fit)}


def write_residuals(path, readings, fit):
    rows, at = [], 0
    for r in readings:
        for i, value in enumerate(r.values):
            rows.append([r.name, int(r.lines[i]), float(r.time[i]) if not r.at_end else None, float(value),
                         float(value + fit.residuals[at + i]), float(fit.residuals[at + i]), float(fit.weights[at + i])])
        at += len(r.values)
    write_csv(path, ["observation", "line", "time[s]", "measured", "computed", "computed - measured", "weight"], rows)


def _toml(value):
    """A value of a resolved case on one line."""
    if isinstance(value, dict):
        return "{ " + ", ".join(f"{key} = {_toml(entry)}" for key, entry in value.items()) + " }"
    if isinstance(value, list):
        return "[" + ", ".join(_toml(entry) for entry in value) + "]"
    if isinstance(value, bool):
        return "true" if value else "false"
    return json.dumps(value, ensure_ascii=False) if isinstance(value, str) else repr(value)


def _section(case, kind, name):
    """The section of a list by its name, or by its number from one."""
    sections = case.get(kind, [])
    if name.isdigit() and 0 < int(name) <= len(sections):
        return sections[int(name) - 1]
    return next((s for s in sections if s.get("name") == name), None)


def interface_card(case, calibration, measured, statistics):
    """The card of the contact whose heat was fitted; None where none was."""
    of_heat = [u for u in calibration.unknowns if u.key.split(".")[0] in ("contact", "interface") and ".heat." in u.key]
    if not of_heat:
        return None
    kind, name = of_heat[0].key.split(".")[:2]
    contact = _section(case, kind, name)
    if contact is None:
        return None
    labels = {p.name for u in of_heat for p in u.parameters}
    own = [e for e in statistics.estimates if e.name in labels and e.logarithmic]
    conductances = [e for e in own if "/K" in e.unit]
    factor = max((e.high / e.value for e in own), default=1.0)
    lines = [f'title = "{calibration.title or name}: fitted to measurements"',
             f'source = "solidus calibrate, {Path(measured).name}: {len(statistics.series)} thermocouples, root mean square '
             f'{max(s["rms"] for s in statistics.series):.2g} {statistics.series[0]["unit"]} at the worst"']
    if conductances:
        lines.append(f'range = "{min(e.low for e in conductances):.4g} to {max(e.high for e in conductances):.4g} '
                     f'{conductances[0].unit}"')
    lines += ["by_name_alone = true   # it is of the process that was measured", "", "[one]", "", "[other]", "", "[heat]"]
    lines += [f"{key} = {_toml(value)}" for key, value in contact.get("heat", {}).items() if value is not None]
    lines += ["", f"# {percent(calibration.confidence)} of what the fit leaves open:"]
    lines += [f"#   {e.name}: {e.value:.4g}, {e.low:.4g} to {e.high:.4g} {e.unit}" for e in own]
    if factor > 1.0:
        lines += ["", "[spread]", f'conductance = {{ factor = {factor:.4g}, source = "the widest interval of the fit" }}']
    return "\n".join(lines) + "\n"
