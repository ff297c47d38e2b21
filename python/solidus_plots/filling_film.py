"""A filling as a film: the level in an upright layer of the casting, over time."""

from matplotlib import animation
import matplotlib.pyplot as plt
import numpy as np

from solidus_plots import style
from solidus_plots.filling_picture import image

PICTURES = 30  # at most
PER_SECOND = 6


def upright_plane(cavity, up):
    """The axis across the casting, not that of height, along which it is thinnest, and the layer of cubes there that has most."""
    extents = np.ptp(cavity.cubes.cells, axis=0).astype(float)
    extents[np.abs(up).argmax()] = np.inf
    axis = int(extents.argmin())
    layers, counts = np.unique(cavity.cubes.cells[:, axis], return_counts=True)
    return axis, int(layers[counts.argmax()])


def draw(path, mould, times, levels):
    """Writes an animated GIF. times [s] and levels, [moment][cube] from 0, air, to 255, metal."""
    style.setup()
    cavity = mould.cavity
    axis, layer = upright_plane(cavity, mould.up)
    chosen = np.unique(np.linspace(0, len(times) - 1, min(PICTURES, len(times))).astype(int))
    values, extent, in_plane = image(cavity, axis, layer, levels[chosen[0]] / 255)
    figure, panel = plt.subplots(figsize=(6, 4))
    shown = panel.imshow(values, origin="lower", extent=extent, cmap="Oranges", vmin=0, vmax=1)
    gate = 1e3 * cavity.face_centres()[mould.gate.faces].mean(axis=0)[in_plane]
    panel.plot(*gate, marker="*", color="red", markersize=11)
    panel.set_xlabel("xyz"[in_plane[0]] + " [mm]")
    panel.set_ylabel("xyz"[in_plane[1]] + " [mm]")
    figure.colorbar(shown, ax=panel, label="share of metal")

    def show(moment):
        shown.set_data(image(cavity, axis, layer, levels[moment] / 255)[0])
        panel.set_title(f"{times[moment]:.3g} s, {100 * levels[moment].mean() / 255:.0f} % full")
        return [shown]

    film = animation.FuncAnimation(figure, show, frames=chosen.tolist())
    film.save(path, writer=animation.PillowWriter(fps=PER_SECOND), dpi=80)
    plt.close(figure)
