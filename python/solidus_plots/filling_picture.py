"""The picture of a filling: when and how hot the metal came, in the plane of the casting that shows most of it."""

import matplotlib.pyplot as plt
import numpy as np

from solidus_plots import style

KELVIN = 273.15
LINES = 10  # of equal time


def plane_of(cavity):
    """The axis across which the casting is thinnest, and the layer of cubes along it that has most."""
    axis = int(np.ptp(cavity.cubes.cells, axis=0).argmin())
    layers, counts = np.unique(cavity.cubes.cells[:, axis], return_counts=True)
    return axis, int(layers[counts.argmax()])


def image(cavity, axis, layer, values):
    """Values of the cubes of a layer as rows and columns, NaN outside, and its extent in mm."""
    cells = cavity.cubes.cells
    in_plane = [d for d in range(3) if d != axis]
    of = cells[:, axis] == layer
    low, high = cells[:, in_plane].min(axis=0), cells[:, in_plane].max(axis=0)
    picture = np.full(high - low + 1, np.nan)
    picture[tuple((cells[of][:, in_plane] - low).T)] = values[of]
    start = 1e3 * (cavity.cubes.origin[in_plane] + low * cavity.cubes.edge)
    end = 1e3 * (cavity.cubes.origin[in_plane] + (high + 1) * cavity.cubes.edge)
    return picture.T, (start[0], end[0], start[1], end[1]), in_plane


def draw(path, mould, grid):
    """Writes filling.png."""
    style.setup()
    cavity = mould.cavity
    axis, layer = plane_of(cavity)
    figure, panels = plt.subplots(1, 2, figsize=(10, 4.5), constrained_layout=True)
    for panel, name, label, shift in ((panels[0], "fill_time", "time of arrival [s]", 0.0),
                                      (panels[1], "temperature_at_arrival", "temperature at arrival [°C]", KELVIN)):
        values, extent, in_plane = image(cavity, axis, layer, grid.cell_data[name] - shift)
        shown = panel.imshow(values, origin="lower", extent=extent, cmap="viridis" if shift == 0 else "inferno")
        if shift == 0 and min(values.shape) > 1:
            x = np.linspace(extent[0], extent[1], values.shape[1] * 2 + 1)[1::2]
            y = np.linspace(extent[2], extent[3], values.shape[0] * 2 + 1)[1::2]
            panel.contour(x, y, values, LINES, colors="white", linewidths=0.6)
        gate = 1e3 * cavity.face_centres()[mould.gate.faces].mean(axis=0)[in_plane]
        panel.plot(*gate, marker="*", color="red", markersize=11)
        panel.set_xlabel("xyz"[in_plane[0]] + " [mm]")
        panel.set_ylabel("xyz"[in_plane[1]] + " [mm]")
        figure.colorbar(shown, ax=panel, label=label)
    height = 1e3 * (cavity.cubes.origin[axis] + (layer + 0.5) * cavity.cubes.edge)
    figure.suptitle(f"{mould.file['title']}: gate (star), layer of cubes at {'xyz'[axis]} = {height:.3g} mm")
    figure.savefig(path)
    plt.close(figure)
