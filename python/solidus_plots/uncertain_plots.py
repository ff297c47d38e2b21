"""The tornado of every answer: bars from its value at one end of a parameter's range to that at the other."""

import matplotlib.pyplot as plt

from solidus_plots import style
from solidus_plots.uncertain_result import rounded

UP, DOWN = style.COLOURS[1], style.COLOURS[0]
BARS = 8  # of one answer; the parameters beyond them are counted together
PANELS = 6  # of one sheet


def _cut(text, most=52):
    return text if len(text) <= most else text[:most - 1] + "…"


def _bars(axes, answer):
    shown = answer.parts[:BARS]
    for place, part in enumerate(shown):
        up = part.up - answer.best if part.up is not None else part.slope
        down = part.down - answer.best if part.down is not None else -part.slope
        computed = part.down is not None
        # Where both ends lie on one side, the longer bar is behind the other.
        axes.barh(place, up, left=answer.best, height=0.62, color=UP, zorder=2.5 if abs(up) <= abs(down) else 2.2)
        axes.barh(place, down, left=answer.best, height=0.62, color=DOWN if computed else "white", edgecolor=DOWN,
                  linewidth=0.8, hatch=None if computed else "////", zorder=2.4)
    labels = [_cut(part.label) for part in shown]
    if answer.band is not None:
        axes.barh(len(shown), 2 * answer.band, left=answer.best - answer.band, height=0.62, color="#7f7f7f", zorder=2.4)
        labels.append("step and mesh")
    axes.set_yticks(range(len(labels)), labels, fontsize=7.5)
    axes.invert_yaxis()
    axes.axvline(answer.best, color="black", linewidth=0.8)
    spread = answer.spread()
    axes.axvspan(answer.best - spread, answer.best + spread, color="#000000", alpha=0.07, linewidth=0, zorder=0)
    unit = "" if answer.unit in ("", "1") else f" {style.unit_text(answer.unit)}"
    axes.set_title(f"{answer.name}: {rounded(answer.best, spread)}{unit} ± {rounded(spread, spread)}"
                   f"{' (about as much by whatever is moved)' if answer.jumps() else ''}", loc="left", fontsize=9)
    axes.set_xlabel(style.axis_label("", answer.unit).strip(), fontsize=8)
    axes.grid(axis="y", visible=False)


def draw(title, found, folder):
    """Sheets of tornados; the files."""
    files = []
    for sheet, start in enumerate(range(0, len(found), PANELS)):
        panels = found[start:start + PANELS]
        heights = [0.9 + 0.24 * (min(len(answer.parts), BARS) + (answer.band is not None)) for answer in panels]
        figure, axes = plt.subplots(len(panels), 1, figsize=(8.4, 0.6 + sum(heights)), squeeze=False,
                                    gridspec_kw={"height_ratios": heights}, constrained_layout=True)
        for panel, answer in zip(axes[:, 0], panels):
            _bars(panel, answer)
        figure.suptitle(f"{title}\norange: parameter at the upper end of its range, blue: at the lower (hatched: taken as the "
                        "mirror image); grey: ± of all", fontsize=8.5, x=0.01, ha="left")
        files += style.save(figure, folder, "uncertain" if len(found) <= PANELS else f"uncertain_{sheet + 1}", vector=False)
    return files
