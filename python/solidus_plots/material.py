"""Draws a material card: python3 -m solidus_plots.material FOLDER.

FOLDER holds properties.csv and flow_curves.csv as `solidus materials NAME -o FOLDER` writes them; the picture
goes there too. Every property that the material has is drawn, but for those that are zero.
"""

import argparse
from pathlib import Path
import re
import sys

import matplotlib.pyplot as plt
from matplotlib.ticker import LogLocator
import numpy as np

from solidus_plots import style
from solidus_plots.history import read_table
from solidus_plots.verb import sentence
from solidus_plots.vtu import ResultError

TEMPERATURE = "temperature[degC]"
LOGARITHMIC = 30  # ratio of the ends of an axis from which the small values need a logarithmic one
# Units of a card's stresses and expansions are inconvenient for some of its properties: unit, the values that take
# another one (by the largest), its factor and its name.
OTHER_UNITS = [("MPa", lambda largest: largest >= 1000, 1e-3, "GPa"),
               ("1/K", lambda largest: largest < 1e-3, 1e6, "10⁻⁶/K")]


class Panel:
    """A property over temperature, or several stresses on one axis, since they are compared."""

    def __init__(self, title, unit):
        self.title, self.unit, self.lines = title, unit, []

    def scaled(self):
        """Factor and unit of the axis."""
        largest = max(np.abs(values).max() for _, values in self.lines)
        for unit, applies, factor, other in OTHER_UNITS:
            if self.unit == unit and applies(largest):
                return factor, other
        return 1, "" if self.unit == "1" else self.unit


def words(name):
    return name.replace("_", " ").capitalize()


def panels_of(table):
    """Every column that is not zero throughout is drawn, those of stresses on one axis, in the order of the file."""
    panels, stresses = [], Panel("Stresses", "MPa")
    for header, values in table.items():
        name, unit = header.rstrip("]").split("[")
        if header == TEMPERATURE or not values.any():
            continue
        is_stress = unit == "MPa" and "stress" in name
        panel = stresses if is_stress else Panel(words(name), unit)
        if not panel.lines:
            panels.append(panel)
        panel.lines.append((words(name), values))
    return panels


def mushy_range(table):
    """The temperatures between all solid and all liquid; none where nothing melts."""
    if "solid_fraction[1]" not in table:
        return None
    fraction, temperature = table["solid_fraction[1]"], table[TEMPERATURE]
    return temperature[fraction == 1].max(), temperature[fraction == 0].min()


def over_temperature(axes, temperature, panel, mushy):
    factor, unit = panel.scaled()
    for index, (label, values) in enumerate(panel.lines):
        axes.plot(temperature, factor * values, label=label, **style.line_style(index))
    if len(panel.lines) > 1:
        axes.legend(loc="best")  # named, so that matplotlib does not warn a slow machine
    values = np.concatenate([factor * values for _, values in panel.lines])
    if 0 < LOGARITHMIC * values.min() < values.max():  # the hot strength matters as much as the cold one
        axes.set_yscale("log")
        axes.yaxis.set_major_locator(LogLocator(subs=(1, 2, 5)))
        axes.yaxis.set_major_formatter("{x:g}")
        axes.yaxis.set_minor_formatter("")
    elif values.min() >= 0:
        axes.set_ylim(0, 1.08 * values.max())
    if mushy:
        axes.axvspan(*mushy, color="#f2d9c9", linewidth=0, zorder=0)
    axes.margins(x=0)
    axes.set(xlabel="Temperature [°C]", ylabel=style.unit_text(unit))
    axes.set_title(panel.title if len(panel.lines) > 1 else panel.lines[0][0], loc="left")


def flow_curves(axes, table):
    """σ(ξ), cold curves dark and hot ones bright."""
    curves = [header for header in table if header.startswith("stress_at_")]
    colours = plt.get_cmap("plasma")(np.linspace(0, 0.85, max(len(curves), 2)))
    for header, colour in zip(curves, colours):
        celsius = re.match(r"stress_at_(.+)_degC", header).group(1)
        axes.plot(100 * table["plastic_strain[1]"], table[header], color=colour,
                  label=f"{float(celsius):.0f} °C")
    axes.set(xlabel="Plastic strain [%]", ylabel="MPa")
    axes.set_title("Flow curves, slow test", loc="left")
    axes.set_ylim(bottom=0)
    axes.margins(x=0)
    axes.legend(loc="upper left", bbox_to_anchor=(1.01, 1.0), borderaxespad=0)


def draw(folder):
    style.setup()
    table = read_table(folder / "properties.csv", TEMPERATURE)
    curve_file = folder / "flow_curves.csv"
    panels = panels_of(table)
    count = len(panels) + curve_file.exists()
    rows = -(-count // 3)
    figure, grid = plt.subplots(rows, 3, figsize=(9.6, 2.5 * rows), squeeze=False, layout="constrained")
    places = list(grid.flat)
    mushy = mushy_range(table)
    for axes, panel in zip(places, panels):
        over_temperature(axes, table[TEMPERATURE], panel, mushy)
    if curve_file.exists():
        flow_curves(places.pop(), read_table(curve_file, "plastic_strain[1]"))  # its legend is outside
    for axes in places[len(panels):]:
        axes.set_visible(False)
    name = folder.resolve().name
    figure.suptitle(name + (" (shaded: freezing range)" if mushy else ""), x=0.01, ha="left")
    return style.save(figure, folder, "material", vector=True)


def main(arguments=None):
    parser = argparse.ArgumentParser(prog="solidus_plots.material", description=__doc__.splitlines()[0])
    parser.add_argument("folder", type=Path, metavar="FOLDER")
    options = parser.parse_args(arguments)
    try:
        files = draw(options.folder)
    except (ResultError, OSError) as error:
        print(f"solidus_plots: {sentence(error)}", file=sys.stderr)
        return 1
    for file in files:
        print(file)
    return 0


if __name__ == "__main__":
    raise SystemExit(main())
