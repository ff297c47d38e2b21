"""Pictures of shapes: a value on the skin of a part, from two sides, with its places in words."""

import numpy as np

from solidus_plots import style
from solidus_plots.scene import Camera, Surface, View, _normals
from solidus_plots.pattern_mesh import skin

EYES = ((-60, 25, "from the front, above"), (120, -25, "from behind, below"))
PIXELS = 900
MARGIN = 0.04


def drawn_surface(points, triangles, values):
    """Triangles with values [point] as scene.Surface has them."""
    normals, edges = _normals(points, triangles, np.zeros(len(triangles), int))
    return Surface(points, np.full(len(points), -1.0), triangles, np.arange(len(triangles)), normals, np.zeros((len(triangles), 3), bool), edges,
                   values[triangles])


def draw_on_skin(points, triangles, values, title, label, file, symmetric=False, marks=(), footer=""):
    """One picture: values [point] on a skin, seen from two sides; `marks`: (text, place) of places that are shown where they are seen."""
    surface = drawn_surface(points, triangles, values)
    shown = values[np.isfinite(values)]
    high = float(np.abs(shown).max()) if shown.size else 1.0
    low, high = (-high, high) if symmetric else (float(shown.min()) if shown.size else 0.0, float(shown.max()) if shown.size else 1.0)
    norm = style.matplotlib.colors.Normalize(low, high if high > low else low + 1e-12)
    colours = style.plt.get_cmap("RdBu_r" if symmetric else "viridis")
    figure, axes = style.plt.subplots(1, 2, figsize=(10, 4.8), constrained_layout=True)
    for panel, (azimuth, elevation, words) in zip(axes, EYES):
        camera = Camera(azimuth, elevation)
        flat = camera.project(points)[:, :2]
        margin = MARGIN * np.ptp(flat, axis=0).max()
        frame = flat.min(axis=0) - margin, flat.max(axis=0) + margin
        size = frame[1] - frame[0]
        rows, columns = (np.ceil(PIXELS * size[::-1] / size.max())).astype(int)
        view = View(surface, camera, frame, (rows, columns))
        image = np.zeros((rows, columns, 4))
        seen = view.picture.seen
        found = view.values()
        paint = np.where(np.isfinite(found)[:, None], colours(norm(np.nan_to_num(found)))[:, :3], style.NO_VALUE)
        image[seen, :3], image[seen, 3] = np.clip(paint * view.light()[:, None], 0, 1), 1
        image[view.edges(2.0)] = (0.12, 0.12, 0.12, 1)
        panel.imshow(image, extent=1e3 * np.array(frame).T.ravel(), interpolation="antialiased")
        for text, place in marks:
            if not view.sees(place):
                continue
            x, y = 1e3 * camera.project(np.asarray(place)[None])[0, :2]
            panel.annotate(text, (x, y), ha="center", va="center", fontsize=7,
                           bbox={"boxstyle": "circle,pad=0.15", "facecolor": "white", "edgecolor": "black", "linewidth": 0.6})
        panel.set_title(words, fontsize=8.5)
        panel.axis("off")
    bar = figure.colorbar(style.matplotlib.cm.ScalarMappable(norm, colours), ax=axes, shrink=0.8, pad=0.02)
    bar.set_label(label)
    figure.suptitle(title, fontsize=10)
    if footer:
        figure.text(0.01, 0.0, footer, va="top", **style.REMARK)
    return style.save(figure, file.parent, file.stem, vector=False)


def draw_pattern(part, drawn, allowance, folder):
    """How far the pattern is from the drawing, along the normal of the drawing: where it is larger."""
    triangles, extend = skin(part.grid, part.cells)
    used, index = np.unique(triangles, return_inverse=True)
    points, triangles = extend(drawn)[used], index.reshape(-1, 3)
    normals = _normals(points, triangles, np.zeros(len(triangles), int))[0]
    at_points = np.zeros_like(points)
    for corner in range(3):
        for axis in range(3):
            at_points[:, axis] += np.bincount(triangles[:, corner], normals[:, corner, axis], len(points))
    at_points /= np.maximum(np.linalg.norm(at_points, axis=1), 1e-300)[:, None]
    larger = 1e3 * np.einsum("pi,pi->p", extend(allowance)[used], at_points)
    footer = (f"largest allowance {larger.max():.3g} mm, least {larger.min():.3g} mm, along the normal of the drawing; "
              f"{', '.join(part.names)}")
    return draw_on_skin(points, triangles, larger, "Pattern allowance: by how much the pattern is larger than the drawing", "allowance [mm]",
                        folder / "pattern.png", symmetric=bool(larger.min() < 0), footer=footer)
