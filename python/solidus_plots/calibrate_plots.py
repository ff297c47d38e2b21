"""Measured and computed curves of a calibration with their residuals, and the values of tables with their intervals."""

import matplotlib.pyplot as plt
import numpy as np

from solidus_plots import style
from solidus_plots.history import Table


def draw_residuals(readings, fit, folder):
    """Above what was measured (points) and computed (lines), below the difference."""
    figure, (above, below) = plt.subplots(2, 1, figsize=(6.4, 5.6), sharex=True, height_ratios=(2, 1))
    at = 0
    for index, r in enumerate(readings):
        own = fit.residuals[at:at + len(r.values)]
        at += len(r.values)
        if r.at_end:
            continue
        colour = style.COLOURS[index % len(style.COLOURS)]
        above.plot(r.time, r.values, linestyle="", marker=".", markersize=3, color=colour, alpha=0.5)
        above.plot(r.time, r.values + own, color=colour, linewidth=1.1, label=f"{r.name}: {np.sqrt(np.mean(own ** 2)):.2g}")
        below.plot(r.time, own, color=colour, linewidth=0.9, marker=".", markersize=2)
    unit = Table.unit(readings[0].header)
    above.set_ylabel(style.axis_label("measured, computed", unit))
    above.legend(title="computed (lines), measured: rms")
    below.axhline(0, color="black", linewidth=0.6)
    below.set(xlabel=style.axis_label("Time", "s"), ylabel=style.axis_label("difference", "K" if unit == "degC" else unit))
    return style.save(figure, folder, "calibrate", vector=False)


def draw_tables(calibration, statistics, folder):
    """Every table that was found, over its argument."""
    by_name = {e.name: e for e in statistics.estimates}
    files = []
    for number, unknown in enumerate([u for u in calibration.unknowns if u.at]):
        estimates = [by_name[p.name] for p in unknown.parameters]
        values = np.array([e.value for e in estimates])
        errors = np.abs([[e.value - e.low for e in estimates], [e.high - e.value for e in estimates]])
        figure, axes = plt.subplots(figsize=(5.6, 3.6))
        axes.errorbar(unknown.at, values, errors, marker="o", markersize=4, capsize=3, linewidth=1.2)
        if np.max(values) > 8 * np.min(values) > 0:
            axes.set_yscale("log")
        axes.set(xlabel=style.axis_label(unknown.of.capitalize(), unknown.argument_unit),
                 ylabel=style.axis_label(unknown.name, unknown.unit))
        axes.set_title(f"{100 * calibration.confidence:g} % intervals", loc="left")
        files += style.save(figure, folder, f"calibrate_table_{number + 1}", vector=False)
    return files
