"""Bodies in three dimensions, seen from outside or cut open: [[surfaces]] of plots.toml."""

import numpy as np

from solidus_plots import moments, paint, style
from solidus_plots.annotations import dimensions, mark, triad
from solidus_plots.cut import cut, cut_where
from solidus_plots.scene import Camera, Surface, View, cap, outer
from solidus_plots.sections import read_plane
from solidus_plots.sheet import Sheet, heading, wrap
from solidus_plots.vtu import ResultError

MM = 1e3
EDGE, MESH_LINE = 3.0, 1.4  # widths, in pixels of the picture
EDGE_COLOUR = (0.12, 0.12, 0.12, 1.0)
GLASS, GLASS_EDGE = 0.22, (0.45, 0.45, 0.45, 1.0)  # how much of it is seen


def _points(grid, spec):
    """Where the nodes are drawn [m]."""
    if not spec.get("magnification", 0):
        return grid.points
    return grid.points + spec["magnification"] * moments.displacement(grid)


def _clipped(grid, cells, points, field, clip, eye):
    """Bodies without what lies on the eye's side of a plane, or where a field is above a value."""
    if "field" in clip:
        if set(clip) - {"unit"} != {"field", "above"}:
            raise ResultError(f"plots.toml: {clip} is no clip; write "
                              '{ field = "solid_fraction", above = 0.9 }')
        kind, values = moments.values(grid, {"field": clip["field"], "unit": clip.get("unit", "")})
        if kind != "point_data":
            raise ResultError(f"plots.toml: clip: '{clip['field']}' is a field of elements; it must be one of "
                              "nodes")
        level = values - clip["above"]
        part, normal = cut_where(grid, cells, level), None
    else:
        plane = read_plane(clip)[0].facing(eye)
        level, part, normal = plane.distance(grid.points), cut(grid, cells, plane), plane.normal
    return [outer(grid, cells, points, field, level), cap(grid, part, points, field, normal)]


def surface_of(grid, run, spec, eye):
    """What a picture shows of a moment."""
    points, others = _points(grid, spec), spec.get("plain", []) + spec.get("ghost", [])
    names = spec.get("bodies") or [name for name in run.bodies if name not in others]
    nobody = np.zeros(len(grid.cell_types), bool)
    coloured = run.body_mask(grid, names) if "field" in spec else nobody
    field = moments.values(grid, spec, coloured) if "field" in spec else ("cell_data", nobody.astype(float))
    shown, parts = run.body_mask(grid, names + spec.get("plain", [])), []
    if "clip" in spec:
        clipped = shown & run.body_mask(grid, spec.get("clip_bodies"))
        parts += _clipped(grid, clipped, points, field, spec["clip"], eye)
        shown = shown & ~clipped
    surface = Surface.join([*parts, outer(grid, shown, points, field)])
    surface.values[~coloured[surface.cells]] = np.nan
    return surface


def _ghost(grid, run, spec):
    """The bodies that are drawn like glass, in their nominal shape."""
    cells = run.body_mask(grid, spec["ghost"])
    return outer(grid, cells, grid.points, ("cell_data", np.zeros(len(cells))))


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


def _through_glass(image, depth, view, grid):
    """A picture seen through the surface of a view."""
    nearer = view.picture.depth > depth
    colour = np.ones(image.shape)
    colour[view.picture.seen, :3] = _colour(view, grid, None) * view.light()[:, None]
    image[image[..., 3] == 0.0] = 1.0  # on white
    image[..., 3] = view.picture.seen | (depth > -np.inf)
    image[nearer] = (1.0 - GLASS) * image[nearer] + GLASS * colour[nearer].clip(0.0, 1.0)
    edges = view.edges(0.5 * EDGE) & (nearer | ~view.picture.seen)
    image[edges] = GLASS_EDGE


def image_of(view, grid, colours, spec):
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
    image = np.ones((*view.picture.triangle.shape, 4))
    image[..., 3] = view.picture.seen
    image[view.picture.seen, :3] = np.clip(colour, 0.0, 1.0)
    if edges != "none":
        image[view.edges(EDGE)] = EDGE_COLOUR
    return image


def frame_of(surfaces, camera):
    places = [camera.project(surface.points_shown())[:, :2] for surface in surfaces]
    places = [place for place in places if place.size]
    low = np.min([place.min(axis=0) for place in places], axis=0)
    high = np.max([place.max(axis=0) for place in places], axis=0)
    margin = 0.015 * (high - low).max()
    return low - margin, high + margin


def _camera(spec):
    """The camera of a picture, after a look at the words that it may say."""
    place = f"plots.toml: surfaces '{spec['file']}'"
    if spec.get("edges", "features") not in ("features", "mesh", "none"):
        raise ResultError(f'{place}: edges is "features", "mesh" or "none", not {spec["edges"]!r}')
    if spec.get("up", "z") not in ("x", "y", "z"):
        raise ResultError(f'{place}: up is "x", "y" or "z", not {spec["up"]!r}')
    return Camera(*spec.get("view", [-60, 25]), spec.get("up", "z"))


def draw(spec, run, folder):
    """One [[surfaces]] of plots.toml: bodies at several moments with one colour bar."""
    camera = _camera(spec)
    grids = run.those_of(spec.get("times", ["last"]))
    times = style.time_texts([grid.time for grid in grids])
    surfaces = [surface_of(grid, run, spec, camera.eye) for grid in grids]
    colours = None
    if "field" in spec:
        shown = [surface.values[surface.triangles_shown()].ravel() for surface in surfaces]
        colours = paint.Paint({"contours": 0, **spec}, moments.unit(grids[0], spec), np.concatenate(shown))
    ghosts = [_ghost(grid, run, spec) for grid in grids] if spec.get("ghost") else []
    frame = frame_of(surfaces + ghosts, camera)
    size = tuple(MM * (frame[1] - frame[0]))
    rows = wrap(list(range(len(grids))), spec.get("columns"), *size)
    title = heading(spec, times[0] if len(times) == 1 and colours else "")
    sheet = Sheet([[None if moment is None else size for moment in row] for row in rows], title, 0.15,
                  [0.3] * len(rows), bar=colours is not None, legend=colours.legend() if colours else ())
    for r, c in np.ndindex(len(rows), len(rows[0])):
        if rows[r][c] is None:
            continue
        moment, axes = rows[r][c], sheet.axes[r][c]
        view = View(surfaces[moment], camera, frame, sheet.pixels(size))
        image = image_of(view, grids[moment], colours, spec)
        if ghosts:
            glass = View(ghosts[moment], camera, frame, sheet.pixels(size))
            _through_glass(image, view.picture.depth, glass, grids[moment])
        axes.imshow(image, extent=(MM * np.array(frame)).T.ravel(), interpolation="antialiased", aspect="equal")
        axes.axis("off")
        axes.set_title(times[moment] if len(times) > 1 else "", fontsize=9)
        if spec.get("dimensions", False):
            inside = surfaces[moment].points_shown()
            dimensions(axes, camera, inside.min(axis=0), inside.max(axis=0))
        if spec.get("probes"):
            names, places = run.probes(spec["probes"])
            mark(axes, MM * camera.project(places)[:, :2], names)
    triad(sheet.figure, camera)
    if colours is not None:
        colours.bar(sheet.bar, bool(colours.contours))
    return style.save(sheet.figure, folder, spec["file"], vector=False)
