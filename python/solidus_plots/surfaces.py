"""Bodies in three dimensions, seen from outside or cut open: [[surfaces]] of plots.toml."""

import numpy as np

from solidus_plots import moments, paint, style
from solidus_plots.scene import Camera, Surface, View, cap, outer
from solidus_plots.sections import read_plane
from solidus_plots.sheet import Sheet, arrange
from solidus_plots.vtu import ResultError

MM = 1e3
EDGE, MESH_LINE = 3.0, 1.4  # widths, in pixels of the picture
EDGE_COLOUR = (0.12, 0.12, 0.12, 1.0)


def _surface(grid, run, spec, eye):
    """What a picture shows of a moment."""
    points = grid.points
    if spec.get("magnification", 0):
        points = points + spec["magnification"] * moments.displacement(grid)
    names = spec.get("bodies") or [name for name in run.bodies if name not in spec.get("plain", [])]
    coloured = run.body_mask(grid, names) if "field" in spec else np.zeros(len(grid.cell_types), bool)
    shown = run.body_mask(grid, names + spec.get("plain", []))
    field = ("cell_data", np.zeros(len(grid.cell_types)))
    if "field" in spec:
        field = moments.values(grid, spec, coloured)
    parts = []
    if "clip" in spec:
        plane = read_plane(spec["clip"])[0].facing(eye)  # what is in the way of the eye is cut away
        clipped = shown & run.body_mask(grid, spec.get("clip_bodies"))
        parts += [outer(grid, clipped, points, field, plane), cap(grid, clipped, points, field, plane)]
        shown = shown & ~clipped
    if shown.any():
        parts.append(outer(grid, shown, points, field))
    surface = Surface.join(parts)
    surface.values[~coloured[surface.cells]] = np.nan
    return surface


def _colour(view, grid, colours):
    """Colours of the pixels seen [pixel][3], before light."""
    body = grid.cell_data["body"][view.cells()]
    colour = np.array([style.body_colour(b) for b in range(body.max(initial=0) + 1)])[body]
    if colours is not None:
        values = view.values()
        painted = np.isfinite(values)
        colour[painted] = colours(values[painted])
    return colour


def _level_lines(view, levels, width):
    """Pixels seen [pixel] on lines of a value."""
    values = np.full(view.picture.triangle.shape, np.nan)
    values[view.picture.seen] = view.values()
    found = np.zeros(values.shape, bool)
    for level in levels:
        above, below = values >= level, values < level
        for axis in (0, 1):
            for step in range(1, width + 1):
                found |= (above & np.roll(below, step, axis)) | (above & np.roll(below, -step, axis))
    return found[view.picture.seen]


def _image(surface, camera, frame, shape, grid, colours, spec):
    view = View(surface, camera, frame, shape)
    light = view.light()
    if colours is not None:  # colours that are read off a bar are shaded less
        light = np.where(np.isfinite(view.values()), 0.42 + 0.58 * light, light)
    colour = _colour(view, grid, colours) * light[:, None]
    if colours is not None:
        if colours.contours:
            colour[_level_lines(view, colours.contours, 1)] *= 0.6
        if colours.levels:
            colour[_level_lines(view, [level["value"] for level in colours.levels], 2)] = 0.0
    edges = spec.get("edges", "features")
    if edges == "mesh":
        colour[view.mesh(MESH_LINE)] *= 0.45
    image = np.ones((*shape, 4))
    image[..., 3] = view.picture.seen
    image[view.picture.seen, :3] = np.clip(colour, 0.0, 1.0)
    if edges != "none":
        image[view.edges(EDGE)] = EDGE_COLOUR
    return image


def _frame(surfaces, camera):
    places = [camera.project(surface.points_shown())[:, :2] for surface in surfaces]
    low = np.min([place.min(axis=0) for place in places], axis=0)
    high = np.max([place.max(axis=0) for place in places], axis=0)
    margin = 0.015 * (high - low).max()
    return low - margin, high + margin


def _triad(sheet, camera):
    """The directions of the axes, in the lower left corner of the figure."""
    size = sheet.figure.get_size_inches()
    axes = sheet.figure.add_axes([0.02 / size[0], 0.02 / size[1], 0.75 / size[0], 0.75 / size[1]])
    axes.set(xlim=(-1.45, 1.45), ylim=(-1.45, 1.45))
    axes.axis("off")
    for direction, name in zip(camera.project(np.eye(3)), "xyz"):
        if np.hypot(*direction[:2]) > 0.12:
            axes.annotate("", direction[:2], (0, 0), arrowprops={"arrowstyle": "-|>", "shrinkA": 0, "shrinkB": 0,
                                                                 "lw": 0.9, "mutation_scale": 7, "color": "black"})
            axes.text(*(direction[:2] * (1 + 0.3 / np.hypot(*direction[:2]))), name, ha="center", va="center",
                      fontsize=8)


def _dimensions(axes, camera, low, high):
    """The lengths of the box between two corners [m], along those of its edges that lie outside in the picture."""
    corners = np.array([[(low, high)[i >> a & 1][a] for a in range(3)] for i in range(8)])
    flat = camera.project(corners)[:, :2] * MM
    middle = flat.mean(axis=0)
    offset = 0.05 * np.ptp(flat, axis=0).max()
    for axis in range(3):
        edges = [(i, i | 1 << axis) for i in range(8) if not i >> axis & 1]
        along = flat[edges[0][1]] - flat[edges[0][0]]
        length = np.hypot(*along)
        if length < 0.08 * np.ptp(flat, axis=0).max():
            continue
        outwards = np.array([along[1], -along[0]]) / length
        if abs(outwards[1]) < 0.35:
            outwards *= 1 if outwards[0] > 0 else -1  # steep edges at the right
        elif outwards[1] > 0:
            outwards = -outwards  # the others below
        a, b = max(edges, key=lambda edge: (flat[edge[0]] - middle) @ outwards)
        start, end = flat[a] + offset * outwards, flat[b] + offset * outwards
        if end[0] < start[0]:
            start, end = end, start
        for corner, tip in ((flat[a], flat[a] + 1.25 * offset * outwards), (flat[b], flat[b] + 1.25 * offset * outwards)):
            axes.plot(*zip(corner + 0.25 * offset * outwards, tip), color="#404040", linewidth=0.5, clip_on=False)
        axes.annotate("", end, start, arrowprops={"arrowstyle": "<|-|>", "shrinkA": 0, "shrinkB": 0, "lw": 0.6,
                                                  "mutation_scale": 7, "color": "#404040"}, annotation_clip=False)
        angle = np.degrees(np.arctan2(end[1] - start[1], end[0] - start[0]))
        axes.text(*(0.5 * (start + end) + 0.55 * offset * outwards), f"{MM * (high - low)[axis]:.4g} mm", rotation=angle,
                  ha="center", va="center", fontsize=8, rotation_mode="anchor",
                  bbox={"facecolor": "white", "edgecolor": "none", "pad": 0.5})


def _camera(spec):
    """The camera of a picture, after a look at the words that it may say."""
    place = f"plots.toml: surfaces '{spec['file']}'"
    if spec.get("edges", "features") not in ("features", "mesh", "none"):
        raise ResultError(f'{place}: edges is "features", "mesh" or "none", not {spec["edges"]!r}')
    if spec.get("up", "z") not in ("x", "y", "z"):
        raise ResultError(f'{place}: up is "x", "y" or "z", not {spec["up"]!r}')
    view = spec.get("view", [-60, 25])
    if not isinstance(view, list) or len(view) != 2 or not all(isinstance(angle, (int, float)) for angle in view):
        raise ResultError(f"{place}: view is [azimuth, elevation] in degrees, not {view!r}")
    return Camera(*view, spec.get("up", "z"))


def draw(spec, run, folder):
    """One [[surfaces]] of plots.toml: bodies at several moments with one colour bar."""
    camera = _camera(spec)
    grids = run.those_of(spec.get("times", ["last"]))
    surfaces = [_surface(grid, run, spec, camera.eye) for grid in grids]
    colours = None
    if "field" in spec:
        shown = np.concatenate([surface.values[(surface.levels[surface.triangles] <= 0.0).any(axis=1)].ravel()
                                for surface in surfaces])
        colours = paint.Paint({"contours": 0, **spec}, moments.unit(grids[0], spec), shown)
    frame = _frame(surfaces, camera)
    size = tuple(MM * (frame[1] - frame[0]))
    columns = arrange(len(grids), spec.get("columns"), *size)
    rows = -(-len(grids) // columns)
    sizes = [[size if r * columns + c < len(grids) else None for c in range(columns)] for r in range(rows)]
    remarks, times = [spec.get("title", "")], style.time_texts([grid.time for grid in grids])
    if len(grids) == 1 and "field" in spec:
        remarks.append(times[0])
    if spec.get("magnification", 0):
        remarks.append(f"displacements × {spec['magnification']:g}")
    sheet = Sheet(sizes, ", ".join(part for part in remarks if part), (0.15, [0.3] * rows), bar="field" in spec,
                  legend=colours.legend() if colours else ())
    for index, (grid, surface) in enumerate(zip(grids, surfaces)):
        axes = sheet.axes[index // columns][index % columns]
        image = _image(surface, camera, frame, sheet.pixels(size), grid, colours, spec)
        (left, below), (right, above) = MM * np.array(frame)
        axes.imshow(image, extent=(left, right, below, above), interpolation="antialiased", aspect="equal")
        axes.axis("off")
        if len(grids) > 1:
            axes.set_title(times[index], fontsize=9)
        if spec.get("dimensions", False):
            inside = surface.points_shown()
            _dimensions(axes, camera, inside.min(axis=0), inside.max(axis=0))
    _triad(sheet, camera)
    if colours is not None:
        colours.bar(sheet.bar, bool(colours.contours))
    return style.save(sheet.figure, folder, spec["file"], vector=False)
