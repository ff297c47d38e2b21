#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Figures 7.10 to 7.16 of the monograph and the tables of docs/verification/sheet_sliding.md.

usage: figures.py [--results DIR] [--images DIR]      reads the results of all variants (README.md runs them)

Draws the runs over the closed form and the strip of tests/verification/reference/sheet_sliding.py and prints, of every run,
how far it is from them: zeta_c on the plateau after 20 passes, the force ratio at mid stroke in all passes.
"""
import argparse
import csv
from pathlib import Path
import sys
import tomllib

import numpy as np

HERE = Path(__file__).resolve().parent
ROOT = HERE.parents[1]
sys.path.insert(0, str(ROOT / "python"))

from solidus_plots import style  # noqa: E402
from solidus_plots.history import read_table  # noqa: E402
from solidus_plots.style import plt  # noqa: E402
from solidus_plots.vtu import read_collection, read_fields  # noqa: E402

FORCES = (3920, 2940, 1960, 980)
STEELS = {"ga": (0.178, -0.666e-2), "eg": (0.157, -0.315e-1, 0.104e-1, -0.821e-3, 0.289e-4, -0.410e-6)}
LAWS = {"": "a", "_work": "b"}
UNITS = {"a": "kN/mm", "b": "kN/cm"}
PLATEAU = (12.5, 22.5)  # [mm]
MIDDLE = 10.0           # of the stroke [mm]


def reference(name):
    """Rows of a table of the reference program, by steel, law and force."""
    found = {}
    with (ROOT / "tests/verification/reference" / f"sheet_sliding_{name}.csv").open(newline="") as file:
        for row in csv.DictReader(file):
            key = row["steel"], row["law"], int(row["force[N]"])
            found.setdefault(key, []).append([float(v) for v in list(row.values())[3:]])
    return {key: np.array(rows) for key, rows in found.items()}


class Run:
    def __init__(self, folder, steel, law, force):
        history = read_table(folder / "history.csv")
        self.steel, self.law, self.force = steel, law, force
        slides = history["normal_force[N]"] > 0.98 * force
        self.number, self.way = history["pass"][slides], history["tool_displacement[mm]"][slides]
        self.tangential = history["tangential_force[N]"][slides]
        wear = read_table(folder / "wear_profile.csv", first=None)
        self.x, self.zeta = wear["x[mm]"], wear[f"zeta_c[{UNITS[law]}]"]

    def ratios(self):
        """At mid stroke, of every pass."""
        return self.tangential[np.abs(self.way - MIDDLE) < 1e-6] / self.force

    def plateau(self):
        inside = (self.x > PLATEAU[0] - 1e-6) & (self.x < PLATEAU[1] + 1e-6)
        return self.zeta[inside]


def read_runs(results):
    runs = {}
    for steel in STEELS:
        for suffix, law in LAWS.items():
            for force in FORCES:
                folder = results / f"{steel}_{force}{suffix}"
                if (folder / "wear_profile.csv").exists():
                    runs[steel, law, force] = Run(folder, steel, law, force)
    return runs


def panel(title, x, y):
    figure, axes = plt.subplots(figsize=(5.6, 3.6))
    axes.set(xlabel=x, ylabel=y)
    axes.set_title(title, loc="left")
    return figure, axes


def draw_laws(images):
    figure, axes = panel("Friction over the normal work (figure 7.11b)", "Normal work ζ$_c$ [kN/mm]", "Coefficient of friction μ")
    zeta = np.linspace(0, 10, 201)
    for index, (steel, terms) in enumerate(STEELS.items()):
        axes.plot(zeta, np.polynomial.polynomial.polyval(zeta, terms), label=steel.upper(), **style.line_style(index))
    axes.axvline(7.84, color="#7f7f7f", linewidth=0.8, linestyle="--")
    axes.annotate("20 passes, 3.92 kN", (7.84, 0.02), xytext=(-3, 0), textcoords="offset points", ha="right", **style.REMARK)
    axes.set_ylim(bottom=0)
    axes.margins(x=0)
    axes.legend()
    return style.save(figure, images, "sheet_sliding_laws", vector=False)


def draw_hardening(images):
    """Of the cards: saturation from the yield stress, sigma_0 + (sigma_inf - sigma_0) (1 - exp(-delta xi))."""
    figure, axes = panel("Hardening of the sheets (figure 7.11a; its rate is chosen)", "Equivalent plastic strain [%]", "Flow stress [N/mm²]")
    xi = np.linspace(0, 0.3, 301)
    for index, steel in enumerate(STEELS):
        card = tomllib.loads((HERE / f"materials/{steel}.toml").read_text())["plasticity"]
        first, last = (float(card[key]["value"].split()[0]) for key in ("flow_stress", "saturation_stress"))
        rate = card["saturation_rate"]["value"]
        axes.plot(100 * xi, last + (first - last) * np.exp(-rate * xi), label=steel.upper(), **style.line_style(index))
    axes.set_ylim(bottom=0)
    axes.margins(x=0)
    axes.legend(loc="lower right")
    return style.save(figure, images, "sheet_sliding_7_11a", vector=False)


CYCLE = ((0, "(a) before the press"), (15, "(b) it slides, half way"), (30, "(c) at the end of the stroke, the force released"),
         (31, "(d) lifted, on its way back"))


def draw_cycle(folder, images):
    """The mesh where the bodies are, in the first pass."""
    figure, panels = plt.subplots(len(CYCLE), 1, figsize=(6.4, 5.2), sharex=True, sharey=True, layout="constrained")
    times, files = read_collection(folder / "fields.pvd")
    for axes, (time, title) in zip(panels, CYCLE):
        grid = read_fields(files[int(np.argmin(np.abs(times - time)))])
        points = 1000 * (grid.points + grid.point_data["displacement"])[:, :2]
        for line in grid.edges()[0]:
            axes.plot(*points[line].T, color="black", linewidth=0.3)
        axes.set_title(title, loc="left", fontsize=9)
        axes.set_aspect("equal")
        axes.set_axis_off()
    figure.suptitle("Mesh and cycle (figure 7.10)", x=0.01, ha="left", fontsize=10)
    return style.save(figure, images, "sheet_sliding_7_10", vector=False)


def draw_forces(run, closed, strip, images, name, title):
    figure, axes = panel(title, "Passes", "Tangential force [N]")
    stroke = run.way.max()
    axes.plot(strip[:, 0] - 1 + strip[:, 1] / stroke, run.force * strip[:, 2], color="#c0c0c0", linewidth=2.5, label="strip")
    axes.plot(run.number - 1 + run.way / stroke, run.tangential, color=style.COLOURS[0], linewidth=0.9, label="Solidus")
    axes.plot(closed[:, 0] - 0.5, run.force * closed[:, 2], "o", markersize=3, color=style.COLOURS[1], label="closed form")
    axes.set_ylim(bottom=0)
    axes.set_xlim(0, closed[-1, 0])
    axes.set_xticks(range(0, 21, 2))
    axes.legend(loc="upper center", bbox_to_anchor=(0.5, -0.15), ncol=3)
    return style.save(figure, images, name, vector=False)


def draw_passes(runs, images, name, title):
    figure, panels = plt.subplots(2, 2, figsize=(6.4, 4.6), sharex=True, layout="constrained")
    for axes, run in zip(panels.flat, runs):
        shown = (1, 2, 5, 10, 15, 20)
        for number, colour in zip(shown, plt.get_cmap("viridis")(np.linspace(0, 0.9, len(shown)))):
            rows = (run.number == number) & (run.way > 0.5)
            axes.plot(run.way[rows], run.tangential[rows] / run.force, color=colour, label=f"pass {number}")
        axes.set_title(f"{run.force / 1000:g} kN", loc="left")
        axes.margins(x=0)
    panels[0, 1].legend(loc="upper left", bbox_to_anchor=(1.01, 1.0), borderaxespad=0)
    figure.supxlabel("Way of the tool [mm]", fontsize=9)
    figure.supylabel("Tangential over normal force", fontsize=9)
    figure.suptitle(title, x=0.01, ha="left", fontsize=10)
    return style.save(figure, images, name, vector=False)


def draw_wear(runs, images):
    figure, axes = panel("Wear of the sheet after 20 passes (figure 7.16)", "Distance from the left edge [mm]", "Normal work ζ$_c$ [kN/mm]")
    for index, run in enumerate(runs):
        axes.plot(run.x, run.zeta, label=f"{run.force / 1000:g} kN", **style.line_style(index))
        axes.plot(PLATEAU, 2 * [20 * run.force * 1e-4], color="black", linewidth=0.8, linestyle=":")
    axes.margins(x=0)
    axes.set_ylim(bottom=0)
    axes.legend(title="GA; dotted: closed form", title_fontsize=8, loc="lower center", ncol=2)
    return style.save(figure, images, "sheet_sliding_7_16", vector=False)


def table(runs, closed, strip):
    print("| run | ζ_c | closed form | mean | least, largest | ratio, passes 1, 10, 20 | largest difference | to the strip |")
    print("|---|---|---|---|---|---|---|---|")
    for (steel, law, force), run in runs.items():
        exact, rows = closed[steel, law, force], strip[steel, law, force]
        zeta, ratios, plateau = exact[-1, 1], run.ratios(), run.plateau()
        count = len(ratios)
        middle = rows[np.abs(rows[:, 1] - MIDDLE) < 1e-6][:count, 2]
        away = ratios / exact[:count, 2] - 1
        shown = ", ".join(f"{ratios[i]:.4f}" for i in (0, 9, 19) if i < count)
        print(f"| {steel}_{force}{'_work' if law == 'b' else ''} | {plateau.mean():.4f} {UNITS[law]} | {zeta:.4f} | "
              f"{100 * (plateau.mean() / zeta - 1):+.2f} % | {100 * (plateau.min() / zeta - 1):+.1f}, "
              f"{100 * (plateau.max() / zeta - 1):+.1f} % | {shown} | "
              f"{100 * away[np.argmax(np.abs(away))]:+.2f} % | {100 * np.abs(ratios / middle - 1).max():.2f} % |")


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--results", type=Path, default=ROOT / "results/sheet_sliding")
    parser.add_argument("--images", type=Path, default=ROOT / "docs/verification/images")
    options = parser.parse_args()
    style.setup()
    plt.rcParams["savefig.dpi"] = 100
    options.images.mkdir(parents=True, exist_ok=True)
    closed, strip, runs = reference("closed_form"), reference("strip"), read_runs(options.results)
    files = draw_laws(options.images) + draw_hardening(options.images)
    if (options.results / "ga_3920/fields.pvd").exists():
        files += draw_cycle(options.results / "ga_3920", options.images)
    for steel, first in (("ga", 12), ("eg", 14)):
        for index, force in enumerate(FORCES):
            key = steel, "a", force
            if key in runs:
                figure = f"7.{first + index // 2}{'abcd'[index]}"
                files += draw_forces(runs[key], closed[key], strip[key], options.images,
                                     f"sheet_sliding_{figure.replace('.', '_')}",
                                     f"{steel.upper()} steel, {force / 1000:g} kN (figure {figure})")
        those = [runs[steel, "a", force] for force in FORCES if (steel, "a", force) in runs]
        if those:
            files += draw_passes(those, options.images, f"sheet_sliding_passes_{steel}", f"{steel.upper()} steel: within a pass")
    those = [runs["ga", "a", force] for force in FORCES if ("ga", "a", force) in runs]
    if those:
        files += draw_wear(those, options.images)
    table(runs, closed, strip)
    for file in files:
        print(file, file=sys.stderr)


if __name__ == "__main__":
    main()
