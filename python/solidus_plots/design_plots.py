"""The picture of what a design tried: metal of the risers and what was wrong, run by run."""

import matplotlib.pyplot as plt

from solidus_plots import style

SOUND, UNSOUND = style.COLOURS[2], style.COLOURS[1]


def draw(rows, chosen, path):
    """rows: of the workshop, in the order of their runs; chosen: the trial that was taken, or nothing."""
    judged = [(number, row["trial"]) for number, row in enumerate(rows, 1) if row["trial"].judgement is not None]
    figure, (above, below) = plt.subplots(2, 1, figsize=(7.2, 5.2), sharex=True, constrained_layout=True)
    for sound, colour, marker, label in ((True, SOUND, "o", "sound"), (False, UNSOUND, "x", "not sound")):
        chosen_ones = [(number, trial) for number, trial in judged if trial.judgement.sound is sound]
        numbers = [number for number, _ in chosen_ones]
        above.plot(numbers, [1e-3 * trial.design.metal() for _, trial in chosen_ones], marker, color=colour, label=label)
        below.plot(numbers, [1e6 * trial.judgement.holes for _, trial in chosen_ones], marker, color=colour)
    for number, trial in judged:
        if trial is chosen:
            above.annotate("taken", (number, 1e-3 * trial.design.metal()), xytext=(0, 9), textcoords="offset points",
                           ha="center", fontsize=8)
    finer = next((number for number, row in enumerate(rows, 1) if row["fineness"] > rows[0]["fineness"]), None)
    if finer is not None:
        for axes in (above, below):
            axes.axvspan(finer - 0.5, len(rows) + 0.5, color="#eeeeee", zorder=0)
        above.text(len(rows) + 0.4, above.get_ylim()[1], "finer mesh", ha="right", va="top", **style.REMARK)
    above.set_ylabel("Metal of the risers [cm³]")
    below.set_ylabel("Holes in the part [cm³]")
    below.set_xlabel("Run")
    below.xaxis.get_major_locator().set_params(integer=True)
    above.legend()
    figure.savefig(path)
    plt.close(figure)
