"""Pictures of a study: every result over every parameter, with the runs that failed, and what matters for what."""

import matplotlib.pyplot as plt
import numpy as np

from solidus_plots import style
from solidus_plots.history import Table

FAILED = "#D55E00"
ROWS = 5  # results on one sheet


def _positions(values):
    """Places on an axis: numbers as they are, texts in the order of their first time."""
    if all(isinstance(value, (int, float)) and not isinstance(value, bool) for value in values):
        return np.array(values, float), None
    names = list(dict.fromkeys(map(str, values)))
    return np.array([names.index(str(value)) for value in values], float), names


def ranks(values):
    """Ranks from zero; equal values share their mean."""
    _, inverse, count = np.unique(values, return_inverse=True, return_counts=True)
    return (np.cumsum(count) - 0.5 * (count + 1))[inverse]


def rank_correlation(x, y):
    """Spearman's; nan where one of them does not vary."""
    first, second = ranks(x), ranks(y)
    if len(first) < 3 or np.ptp(first) == 0 or np.ptp(second) == 0:
        return np.nan
    return float(np.corrcoef(first, second)[0, 1])


def varying(header, rows, first):
    """Columns of results from `first` on that differ from run to run: name -> values, nan of failed runs."""
    found = {}
    for index in range(first, len(header)):
        values = np.array([np.nan if row[index] is None else float(row[index]) for row in rows])
        known = values[np.isfinite(values)]
        if known.size > 1 and np.ptp(known) > 1e-12 * np.abs(known).max():
            found[header[index]] = values
    return found


def draw(study, header, rows, folder):
    """Scatter sheets and, of three runs or more, the rank correlations; the files."""
    count = len(study.parameters)
    axes_values = [_positions([row[1 + i] for row in rows]) for i in range(count)]
    results, files = varying(header, rows, count + 3), []
    names = list(results)
    for sheet, start in enumerate(range(0, len(names), ROWS)):
        shown = names[start:start + ROWS]
        figure, axes = plt.subplots(len(shown), count, figsize=(1.2 + 2.9 * count, 0.8 + 1.9 * len(shown)), squeeze=False,
                                    sharex="col", sharey="row", constrained_layout=True)
        for r, name in enumerate(shown):
            values = results[name]
            ended = np.isfinite(values)
            low = values[ended].min() - 0.12 * np.ptp(values[ended])
            for c, (places, texts) in enumerate(axes_values):
                panel = axes[r][c]
                panel.plot(places[ended], values[ended], "o", markersize=4, color=style.COLOURS[0])
                if count == 1 and texts is None:
                    order = np.argsort(places[ended])
                    panel.plot(places[ended][order], values[ended][order], linewidth=0.9, color=style.COLOURS[0])
                if not ended.all():
                    panel.plot(places[~ended], np.full((~ended).sum(), low), "x", color=FAILED, clip_on=False)
                if texts is not None:
                    panel.set_xticks(range(len(texts)), texts, rotation=20, ha="right", fontsize=7.5)
                if study.parameters[c].logarithmic:
                    panel.set_xscale("log")
                if r == len(shown) - 1:
                    panel.set_xlabel(style.axis_label(study.parameters[c].label, study.parameters[c].unit), fontsize=8)
            label = style.axis_label(Table.name(name), Table.unit(name))
            axes[r][0].set_ylabel(label.replace(": ", ":\n").replace("local ", "local\n"), fontsize=7.5)
        figure.suptitle(study.title + ("" if all(row[count + 1] == "finished" for row in rows) else "  (x: failed, or no such result)"),
                        fontsize=10)
        files += style.save(figure, folder, "study" if len(names) <= ROWS else f"study_{sheet + 1}", vector=False)
    if len(rows) >= 3 and results:
        files += _matters(study, axes_values, results, folder)
    return files


def _matters(study, axes_values, results, folder):
    """Rank correlations as coloured squares with their numbers."""
    table = np.full((len(results), len(axes_values)), np.nan)
    for r, values in enumerate(results.values()):
        ended = np.isfinite(values)
        for c, (places, _) in enumerate(axes_values):
            table[r, c] = rank_correlation(places[ended], values[ended])
    figure, axes = plt.subplots(figsize=(3.4 + 1.1 * len(axes_values), 1.3 + 0.32 * len(results)), constrained_layout=True)
    axes.imshow(np.where(np.isfinite(table), table, 0.0), cmap="RdBu_r", vmin=-1, vmax=1, aspect="auto")
    for (r, c), value in np.ndenumerate(table):
        axes.text(c, r, "-" if np.isnan(value) else f"{value:+.2f}", ha="center", va="center", fontsize=8,
                  color="white" if abs(value) > 0.7 else "black")
    axes.set_xticks(range(len(axes_values)), [parameter.label for parameter in study.parameters], rotation=20, ha="right")
    axes.set_yticks(range(len(results)), results, fontsize=8)
    axes.grid(False)
    axes.set_title("What matters: rank correlation", loc="left", fontsize=9)
    return style.save(figure, folder, "study_what_matters", vector=False)
