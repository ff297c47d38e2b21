#!/usr/bin/env python3
"""Draws the charts of docs/benchmarks.md from bench/measured.csv, which holds the figures of docs/log/benchmarks.md.

    PYTHONPATH=python /usr/bin/python3 bench/charts.py [FOLDER]       docs/images where none is named

A row of the table is one measurement: the chart, the curve that it belongs to, its abscissa (a number, or a name where the chart has
bars) and its ordinate in the unit that the chart names.
"""
import csv
import sys
from pathlib import Path

from solidus_plots import style
from solidus_plots.style import plt

ROOT = Path(__file__).resolve().parents[1]
SIZE = (5.6, 2.9)  # [in]
CHARTS = {  # title, abscissa (None: bars with names), ordinate
    "freezing_cube": ("Heat alone: a cube that freezes, 40 s", "Nodes", "Processor time [s]"),
    "cooling_block": ("An elastic-plastic block cools, ten steps", "Nodes", "Processor time [s]"),
    "mixed": ("The same block, tetrahedra with and without a pressure", "Nodes", "Processor time [s]"),
    "castings": ("Castings with nothing set but their data", None, "Processor time [s]"),
    "laws": ("One update of the constitutive law", None, "Time per point [ns]"),
    "contact": ("Search and projection of contact", "Slave points", "Time per point [µs]"),
}


def read(file=ROOT / "bench/measured.csv"):
    """Chart -> curve -> list of (abscissa, ordinate), in the order of the table."""
    charts = {}
    with open(file, newline="", encoding="utf-8") as table:
        for row in csv.DictReader(table):
            charts.setdefault(row["chart"], {}).setdefault(row["curve"], []).append((row["x"], float(row["y"])))
    return charts


def draw(name, curves, folder):
    """One picture: lines over numbers on logarithmic axes, or bars with names next to each other."""
    title, abscissa, ordinate = CHARTS[name]
    figure, axes = plt.subplots(figsize=SIZE)
    for number, (curve, points) in enumerate(curves.items()):
        names, values = zip(*points)
        if abscissa:
            axes.plot([float(x) for x in names], values, "o-", ms=4, label=curve)
        else:
            height = 0.8 / len(curves)
            places = [-i - height * number for i in range(len(names))]  # the first row of the table is the uppermost bar
            axes.barh(places, values, height * 0.95, label=curve)
            if number == 0:
                axes.set_yticks([place - height * (len(curves) - 1) / 2 for place in places], names)
    axes.set_title(title)
    axes.set_xlabel(abscissa or ordinate)
    if abscissa:
        axes.set_xscale("log")
        axes.set_yscale("log" if name != "contact" else "linear")
        axes.set_ylabel(ordinate)
        if name == "contact":
            axes.set_ylim(0, 4)
    if len(curves) > 1:
        axes.legend()
    file = Path(folder) / f"benchmark_{name}.png"
    figure.savefig(file, dpi=110)
    plt.close(figure)
    return file


def main(folder=ROOT / "docs/images"):
    style.setup()
    for name, curves in read().items():
        print(draw(name, curves, folder))


if __name__ == "__main__":
    main(*sys.argv[1:])
