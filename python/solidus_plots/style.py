"""How every picture looks: sizes, colours that colour-blind readers can tell apart, units in words."""

import matplotlib

matplotlib.use("Agg")
from matplotlib import font_manager  # noqa: E402  (after the choice of the backend)
import matplotlib.pyplot as plt  # noqa: E402
from matplotlib.text import Text  # noqa: E402

from solidus_plots.vtu import ResultError  # noqa: E402

FONT = "DejaVu Sans"

from solidus_plots import fields  # noqa: E402

# Okabe and Ito (2008), without the yellow that vanishes on white.
COLOURS = ["#0072B2", "#D55E00", "#009E73", "#CC79A7", "#56B4E9", "#E69F00", "#000000"]
REMARK = {"fontsize": 7.5, "color": "#595959"}
DASHES = ["-", "--", "-.", ":"]
BODIES = ["#a9b6c3", "#d3bd94", "#9db89a", "#c3a5b0", "#b8b093"]
NO_VALUE = (0.82, 0.82, 0.82)  # where a field has none yet

# Units of roots, which the program writes in its own manner.
ROOTS = {"K0.5 s0.5/m": "√(K s)/m", "K0.5 s0.5/mm": "√(K s)/mm", "K0.5 s0.5/cm": "√(K s)/cm"}
# Units that a picture may ask for beyond those in which the program shows values: (SI unit, unit) -> (factor, offset).
CONVERSIONS = {("m", "um"): (1e6, 0.0), ("J", "kJ"): (1e-3, 0.0), ("s", "min"): (1 / 60, 0.0), ("s", "h"): (1 / 3600, 0.0),
               ("1", "%"): (100.0, 0.0), ("K0.5 s0.5/m", "K0.5 s0.5/mm"): (1e-3, 0.0), ("K0.5 s0.5/m", "K0.5 s0.5/cm"): (1e-2, 0.0)}


def setup():
    try:
        font_manager.findfont(FONT, fallback_to_default=False)
    except ValueError:
        raise ResultError(f"the font {FONT} is missing, which comes with matplotlib (Debian: python-matplotlib-data, "
                          "fonts-dejavu-core); nothing is drawn without it") from None
    plt.rcParams.update({
        "figure.dpi": 100, "savefig.dpi": 200, "savefig.bbox": "tight", "savefig.pad_inches": 0.06,
        "font.family": FONT, "font.size": 9, "axes.titlesize": 10, "axes.labelsize": 9,
        "axes.prop_cycle": matplotlib.cycler(color=COLOURS), "axes.grid": True, "axes.axisbelow": True,
        "axes.spines.top": False, "axes.spines.right": False, "axes.linewidth": 0.8,
        "grid.color": "#d9d9d9", "grid.linewidth": 0.6, "lines.linewidth": 1.6,
        "legend.frameon": False, "legend.fontsize": 8, "svg.fonttype": "none", "svg.hashsalt": "solidus",
    })


def unit_text(unit):
    return ROOTS.get(unit) or fields.unit_text(unit)


def body_colour(index):
    """Red, green, blue of a body that is drawn without a field: the casting, the mould, others."""
    return matplotlib.colors.to_rgb(BODIES[index % len(BODIES)])


def time_texts(seconds):
    """Moments [s] in one unit: hours or minutes where the last one has two of them and all have few digits."""
    last = max(abs(time) for time in seconds)
    for scale, unit in ((3600.0, "h"), (60.0, "min")):
        tenths = [10 * time / scale for time in seconds]
        if last >= 2 * scale and all(abs(count - round(count)) < 1e-6 for count in tenths):
            return [f"{time / scale:g} {unit}" for time in seconds]
    scale, unit = (1.0, "s") if last >= 1.0 or last == 0.0 else (1e-3, "ms") if last >= 1e-3 else (1e-6, "µs")
    return [f"{time / scale:.{'4g' if last < 1e4 * scale else '0f'}} {unit}" for time in seconds]


def axis_label(quantity, unit):
    return quantity if unit in ("", "1") else f"{quantity} [{unit_text(unit)}]"


def line_style(index):
    """Different colours first, then dashes."""
    dash = index // len(COLOURS) % len(DASHES)
    return {"color": COLOURS[index % len(COLOURS)], "linestyle": DASHES[dash]}


def convert(values, unit, wanted):
    """Values in SI to the unit a picture asks for; says so when it does not know how."""
    if not wanted or unit == wanted:
        return values
    found = CONVERSIONS.get((unit, wanted)) or fields.conversion(unit, wanted)
    if found is None:
        raise ValueError(f"cannot show a field in {unit} as {wanted}")
    factor, offset = found
    return factor * values + offset


def in_font(figure):
    """The font of the pictures has no bold script L, as labels of the functional of stability have: the plain script one is drawn."""
    for text in figure.findobj(Text):
        if "𝓛" in text.get_text():
            text.set_text(text.get_text().replace("𝓛", "ℒ"))


def save(figure, folder, name, vector):
    """Writes NAME.png (and NAME.svg for line plots) and closes the figure."""
    in_font(figure)
    files = [folder / f"{name}.png"] + ([folder / f"{name}.svg"] if vector else [])
    for file in files:
        # Without a date the same results give the same files.
        figure.savefig(file, metadata={"Date": None} if file.suffix == ".svg" else None)
    plt.close(figure)
    return files
