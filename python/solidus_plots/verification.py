"""Pictures of the verification tests: one for every table that they leave.

    python3 -m solidus_plots.verification build/release/verification docs/verification/images

The first column of a table is the abscissa. Columns called exact… are drawn as black lines, the others as points of one colour each.
Tables called …order… or …convergence… are drawn on logarithmic axes, with a line of the slope that the last two points have;
…radius… over a logarithmic abscissa, with the limit of stability; …newton… with the residual on a logarithmic axis.
"""

import sys
from pathlib import Path

import numpy as np

from solidus_plots import style
from solidus_plots.style import plt


def read(path):
    with path.open() as file:
        headers = file.readline().strip().split(",")
        rows = [[float(cell) for cell in line.split(",")] for line in file if line.strip()]
    return headers, np.array(rows)


def label(header):
    name, _, unit = header.partition("[")
    return style.axis_label(name.replace("_", " "), unit.rstrip("]"))


def draw_convergence(axes, headers, values):
    x = values[:, 0]
    for i, header in enumerate(headers[1:], 1):
        y = np.abs(values[:, i])
        if not np.all(y > 0):
            continue
        order = np.log(y[-1] / y[-2]) / np.log(x[-1] / x[-2])
        axes.loglog(x, y, "o-", markersize=4, label=f"{label(header)}, slope {order:.2f}")


def draw_curves(axes, headers, values):
    x, points = values[:, 0], max(1, len(values) // 40)
    colour = 0
    for i, header in enumerate(headers[1:], 1):
        if header.startswith("exact") or "_exact" in header:
            axes.plot(x, values[:, i], color="black", linewidth=1.0, label=label(header), zorder=3)
        else:
            axes.plot(x, values[:, i], "o-", markersize=3, markevery=points, linewidth=0.8,
                      color=style.COLOURS[colour % len(style.COLOURS)], label=label(header))
            colour += 1


def draw_radius(axes, headers, values):
    for i, header in enumerate(headers[1:], 1):
        axes.semilogx(values[:, 0], values[:, i], "o-", markersize=3, linewidth=0.8, label=label(header),
                      color=style.COLOURS[(i - 1) % len(style.COLOURS)])
    axes.axhline(1, color="black", linewidth=0.8, linestyle="--")
    axes.set_ylabel("spectral radius")


def draw_newton(axes, headers, values):
    """Residuals over iterations, and beside them how many contact points changed their status."""
    counts = axes.twinx()
    counts.bar(values[:, 0], values[:, 2], width=0.5, color="0.85", zorder=1)
    counts.set_ylabel(label(headers[2]))
    counts.grid(False)
    axes.set_zorder(counts.get_zorder() + 1)
    axes.patch.set_visible(False)
    axes.semilogy(values[:, 0], values[:, 1], "o-", markersize=4, label=label(headers[1]), color=style.COLOURS[0])


def draw(path, folder):
    try:
        headers, values = read(path)
    except ValueError:  # a table with words in it is for reading
        return False
    if len(values) < 2:
        return False
    figure, axes = plt.subplots(figsize=(5.2, 3.4))
    if "order" in path.stem or "convergence" in path.stem:
        draw_convergence(axes, headers, values)
    elif "radius" in path.stem:
        draw_radius(axes, headers, values)
    elif "newton" in path.stem:
        draw_newton(axes, headers, values)
    else:
        draw_curves(axes, headers, values)
    axes.set_xlabel(label(headers[0]))
    axes.set_title(path.stem.replace("_", " ").capitalize(), loc="left")
    axes.legend(loc="lower left" if "radius" in path.stem else "best")
    figure.savefig(folder / f"{path.stem}.png", dpi=110)
    plt.close(figure)
    return True


def draw_pair(tables, stem, folder):
    """The closed and the open rule side by side, magnified where the profile meets its two plateaus."""
    figure, panels = plt.subplots(2, 1, figsize=(5.2, 4.4), sharex=True)
    for colour, rule in enumerate(("closed", "open")):
        headers, values = read(tables / f"{stem}_{rule}.csv")
        for axes in panels:
            axes.plot(values[:, 0], values[:, 1], "o-", markersize=3, linewidth=0.8, label=f"{rule} rule",
                      color=style.COLOURS[colour])
    low, high = np.sort(values[[0, -1], 1])  # the two ends are undisturbed
    margin = 0.03 * abs(high - low)
    panels[0].set_ylim(high - margin, high + margin)
    panels[1].set_ylim(low - margin, low + margin)
    panels[1].set_xlabel(label(headers[0]))
    for axes in panels:
        axes.set_ylabel(label(headers[1]))
    panels[0].set_title(stem.replace("_", " ").capitalize() + ", near both plateaus", loc="left")
    panels[0].legend()
    figure.savefig(folder / f"{stem}.png", dpi=110)
    plt.close(figure)
    print(folder / f"{stem}.png")


def main():
    if len(sys.argv) != 3:
        raise SystemExit(__doc__)
    tables, folder = Path(sys.argv[1]), Path(sys.argv[2])
    if not tables.is_dir():
        raise SystemExit(f"{tables}: there is no such folder; run the verification tests first")
    folder.mkdir(parents=True, exist_ok=True)
    style.setup()
    stems = [path.stem.removesuffix("_open") for path in tables.glob("*_open.csv")]
    pairs = {stem for stem in stems
             if (tables / f"{stem}_closed.csv").exists() and len(read(tables / f"{stem}_open.csv")[1]) > 2}
    for stem in sorted(pairs):
        draw_pair(tables, stem, folder)
    for path in sorted(tables.glob("*.csv")):
        if path.stem.removesuffix("_open").removesuffix("_closed") in pairs:
            continue
        if draw(path, folder):
            print(folder / f"{path.stem}.png")


if __name__ == "__main__":
    main()
