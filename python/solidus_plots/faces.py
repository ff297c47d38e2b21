"""Pictures of the faces of bodies by number, from what `solidus mesh-info --pictures FOLDER` writes: one sheet a body, four sides."""

import argparse
from pathlib import Path

import numpy as np

from solidus_plots import style
from solidus_plots.raster import rasterise
from solidus_plots.scene import AMBIENT, LIGHTS, Camera

SIDES = ((-60.0, 25.0), (120.0, 25.0), (-60.0, -40.0), (120.0, -40.0))  # azimuth and elevation of the eye [degrees]
TITLES = ("from the front, above", "from behind, above", "from the front, below", "from behind, below")
ROWS = 620  # pixels of a picture
LEAST = 90  # pixels that a face shows where it is to be numbered


def read_faces(path):
    """Points [triangle][3][3] m, face [triangle] from one, body [triangle] of faces.vtk."""
    words = Path(path).read_text().split()
    points = words.index("POINTS")
    n_points = int(words[points + 1])
    place = np.array(words[points + 3:points + 3 + 3 * n_points], float).reshape(-1, 3, 3)
    at = [i for i, word in enumerate(words) if word == "default"]
    face, body = (np.array(words[i + 1:i + 1 + len(place)], int) for i in at)
    return place, face, body


def colours(faces):
    """Pale colours of faces: neighbours in number differ in hue."""
    hue = (faces * 0.61803398875) % 1.0
    return style.matplotlib.colors.hsv_to_rgb(np.stack([hue, np.full(len(faces), 0.34), np.full(len(faces), 0.96)], axis=1))


def seen_from(place, face, side):
    """The picture [row][column][4], and where which face is numbered [(column, row, number)]."""
    camera = Camera(*side)
    flat = camera.project(place.reshape(-1, 3))
    low, high = flat[:, :2].min(axis=0), flat[:, :2].max(axis=0)
    margin = 0.03 * (high - low).max()
    low, high = low - margin, high + margin
    scale = ROWS / (high - low).max()
    shape = tuple(np.ceil((high - low)[::-1] * scale).astype(int))
    pixels = (flat - [low[0], high[1], 0.0]) * [scale, -scale, scale]
    picture = rasterise(pixels, np.arange(len(flat)).reshape(-1, 3), shape)
    normal = np.cross(place[:, 1] - place[:, 0], place[:, 2] - place[:, 0])
    normal = camera.project(normal / np.maximum(np.linalg.norm(normal, axis=1), 1e-300)[:, None])
    normal *= np.where(normal[:, 2:] < 0.0, -1.0, 1.0)
    light = AMBIENT + sum(strength * np.maximum(normal @ direction, 0.0) for direction, strength in LIGHTS)
    image = np.zeros((*shape, 4))
    image[picture.seen, :3] = np.clip(picture.at_triangles(colours(face) * light[:, None]), 0.0, 1.0)
    image[picture.seen, 3] = 1.0
    number = np.where(picture.seen, face[picture.triangle], 0)
    border = np.zeros(shape, bool)
    border[1:] |= number[1:] != number[:-1]
    border[:, 1:] |= number[:, 1:] != number[:, :-1]
    image[border] = (0.15, 0.15, 0.15, 1.0)
    return image, [(*inmost(number == f), f) for f in np.unique(number[number > 0]) if (number == f).sum() >= LEAST]


def inmost(shown):
    """Column and row of the pixel of a face that lies farthest inside it."""
    corner = [np.flatnonzero(shown.any(axis=1 - axis))[[0, -1]] for axis in range(2)]  # the part of the picture that the face is in
    shown = shown[corner[0][0]:corner[0][1] + 1, corner[1][0]:corner[1][1] + 1]
    inside, left = shown, shown
    while left.any():
        inside, left = left, left.copy()
        left[1:] &= inside[:-1]
        left[:-1] &= inside[1:]
        left[:, 1:] &= inside[:, :-1]
        left[:, :-1] &= inside[:, 1:]
        left[[0, -1]] = False
        left[:, [0, -1]] = False
    rows, columns = np.nonzero(inside)
    middle = len(rows) // 2
    return corner[1][0] + columns[middle], corner[0][0] + rows[middle]


def draw(place, face, path, title):
    figure, axes = style.plt.subplots(2, 2, figsize=(11, 8.5), constrained_layout=True)
    for panel, side, words in zip(axes.ravel(), SIDES, TITLES):
        image, labels = seen_from(place, face, side)
        panel.imshow(image, interpolation="antialiased")
        for column, row, number in labels:
            panel.text(column, row, str(number), ha="center", va="center", fontsize=7,
                       bbox={"boxstyle": "round,pad=0.12", "facecolor": "white", "edgecolor": "none", "alpha": 0.75})
        panel.set_title(words, fontsize=9)
        panel.axis("off")
    figure.suptitle(title)
    figure.savefig(path)
    style.plt.close(figure)


def main(arguments=None):
    parser = argparse.ArgumentParser(prog="solidus mesh-info --pictures", description=__doc__)
    parser.add_argument("file", type=Path, help="faces.vtk")
    file = parser.parse_args(arguments).file
    style.setup()
    place, face, body = read_faces(file)
    for number in np.unique(body):
        own = body == number
        path = file.parent / f"faces_{face[own].min()}_to_{face[own].max()}.png"
        draw(place[own], face[own], path, f"Faces {face[own].min()} to {face[own].max()}, as mesh-info lists them")
        print(path)
    return 0


if __name__ == "__main__":
    raise SystemExit(main())
