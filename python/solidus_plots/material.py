"""Draws a material card: python3 -m solidus_plots.material FOLDER.

FOLDER holds properties.csv and flow_curves.csv as `solidus materials NAME -o FOLDER` writes them; the picture
goes there too. A property that the material does not have gets no panel.
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
# One panel a row: title, label of the axis, factor, and the columns with their names in the legend.
PANELS = [
    ("Conductivity", "W/(m K)", 1, [("conductivity[W/m/K]", "")]),
    ("Specific heat", "J/(kg K)", 1, [("specific_heat[J/kg/K]", "")]),
    ("Enthalpy with latent heat", "kJ/kg", 1, [("enthalpy[kJ/kg]", "")]),
    ("Solid fraction", "", 1, [("solid_fraction[1]", "")]),
    ("Young's modulus", "GPa", 1e-3, [("young_modulus[MPa]", "")]),
    ("Poisson's ratio", "", 1, [("poisson_ratio[1]", "")]),
    ("Mean expansion", "10⁻⁶/K", 1e6, [("expansion[1/K]", "")]),
    ("Flow stress", "MPa", 1, [("flow_stress[MPa]", "at zero strain"),
                               ("saturation_stress[MPa]", "saturated")]),
]
OVERSTRESS = "overstress_at_rate_1e-3[MPa]"


def mushy_range(table):
    """The temperatures between all solid and all liquid; none where nothing melts."""
    if "solid_fraction[1]" not in table:
        return None
    fraction, temperature = table["solid_fraction[1]"], table[TEMPERATURE]
    return temperature[fraction == 1].max(), temperature[fraction == 0].min()


def over_temperature(axes, table, panel, mushy):
    title, unit, factor, columns = panel
    lines = [(factor * table[header], label) for header, label in columns if header in table]
    if title == "Flow stress" and OVERSTRESS in table:
        lines.append((table["flow_stress[MPa]"] + table[OVERSTRESS], "at zero strain, 10⁻³/s"))
    for index, (values, label) in enumerate(lines):
        axes.plot(table[TEMPERATURE], values, label=label, **style.line_style(index))
    if len(lines) > 1:
        axes.legend(loc="best")  # named, so that matplotlib does not warn a slow machine
    values = np.concatenate([values for values, _ in lines])
    if title == "Flow stress":  # the hot strength matters as much as the cold one
        axes.set_yscale("log")
        axes.yaxis.set_major_locator(LogLocator(subs=(1, 2, 5)))
        axes.yaxis.set_major_formatter("{x:g}")
        axes.yaxis.set_minor_formatter("")
    elif values.min() >= 0:
        axes.set_ylim(0, 1.08 * values.max())
    if mushy:
        axes.axvspan(*mushy, color="#f2d9c9", linewidth=0, zorder=0)
    axes.margins(x=0)
    axes.set(xlabel="Temperature [°C]", ylabel=unit)
    axes.set_title(title, loc="left")


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
    panels = [panel for panel in PANELS if panel[3][0][0] in table]
    count = len(panels) + curve_file.exists()
    rows = -(-count // 3)
    figure, grid = plt.subplots(rows, 3, figsize=(9.6, 2.5 * rows), squeeze=False, layout="constrained")
    places = list(grid.flat)
    mushy = mushy_range(table)
    for axes, panel in zip(places, panels):
        over_temperature(axes, table, panel, mushy)
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
