"""A measured part compared with its computed or nominal shape: python3 -m solidus_plots.compare_shape MEASURED SHAPE, as `solidus
compare-shape` does. docs/guide/pattern.md tells what comes out.
"""

import argparse
import json
from pathlib import Path
import sys

import numpy as np

from solidus_plots import pattern_picture, shape_fit, style
from solidus_plots.answers import read_summary
from solidus_plots.pattern_mesh import skin
from solidus_plots.shape_points import read_points, unit_length
from solidus_plots.triangle_surface import Surface, read_stl
from solidus_plots.verb import sentence
from solidus_plots.vtu import ResultError, read_collection, read_fields

PLACES = 5  # that are told
AROUND, FEWEST_AROUND = 0.04, 3  # of the part's diagonal, and points: so large is a place
APART = 0.1  # of the part's diagonal: so far are the worst places from each other
STRIP = 0.02  # of the diagonal: half the width of a strip of which a profile is
FINE = 60  # a map has triangles whose sides are shorter than the diagonal over this
MOST_POINTS = 200_000  # of a scan that are looked at


def shape_of(path, options):
    """The surface to compare with, and its name for people."""
    if not path.is_dir():
        if not path.is_file():
            raise ResultError(f"{path}: there is neither a folder of results nor an STL file")
        if options.nominal or options.body:
            raise ResultError(f"{path}: --nominal and --body are of a folder of results, and this is a file")
        return read_stl(path, unit_length(options.unit, "--unit")), f"{path.name}"
    summary = read_summary(path)
    if not (path / "fields.pvd").exists():
        raise ResultError(f"{path}: there are no fields, whose last moment would be the shape")
    _, files = read_collection(path / "fields.pvd")
    grid = read_fields(files[-1])
    if not np.ptp(grid.points[:, 2]) > 0:
        raise ResultError(f"{path}: the mesh is plane; a shape to compare with is of a solid")
    bodies = list(summary["mesh"]["bodies"])
    castings = summary.get("answers", {}).get("castings", {})
    names = [options.body] if options.body else [n for n, one in castings.items() if not (one.get("riser") or one.get("gating"))] or bodies[:1]
    if names[0] not in bodies:
        raise ResultError(f"--body: there is no body '{names[0]}'; there are {', '.join(bodies)}")
    cells = np.isin(grid.cell_data["body"], [bodies.index(name) for name in names])
    points = grid.points
    if not options.nominal:
        if "displacement" not in grid.point_data:
            raise ResultError(f"{path}: heat alone was computed, so that nothing deforms; --nominal compares with the mesh")
        points = points + grid.point_data["displacement"]
    triangles, extend = skin(grid, cells)
    return used_surface(extend(points), triangles), f"{', '.join(names)} of {path}, {'nominal' if options.nominal else 'as computed'}"


def used_surface(points, triangles):
    """A surface without points that no triangle has."""
    used, index = np.unique(triangles, return_inverse=True)
    return Surface(points[used], index.reshape(-1, 3))


def finer(points, triangles, longest):
    """Triangles are quartered until no side is longer, so that a map can show what lies within them."""
    for _ in range(8):
        corners = points[triangles]
        sides = np.linalg.norm(corners - np.roll(corners, -1, axis=1), axis=2)
        if sides.max() <= longest or len(triangles) > 100_000:
            break
        ends = np.sort(np.stack([triangles, np.roll(triangles, -1, axis=1)], axis=2), axis=2).reshape(-1, 2)
        both, index = np.unique(ends, axis=0, return_inverse=True)
        middle = len(points) + index.reshape(-1, 3)
        points = np.concatenate([points, points[both].mean(axis=1)])
        a, b, c = triangles.T
        ab, bc, ca = middle.T
        triangles = np.concatenate([np.stack(t, axis=1) for t in ((a, ab, ca), (ab, b, bc), (ca, bc, c), (ab, bc, ca))])
    return points, triangles


def measured_points(path, unit):
    """The points of a scan; of one with large triangles also some within these."""
    if not path.is_file():
        raise ResultError(f"{path}: there is no such file")
    if path.suffix.lower() == ".stl":
        surface = read_stl(path, unit_length(unit, "--unit"))
        size = surface.extent()
        return finer(surface.points, surface.triangles, size / FINE)[0]
    return read_points(path, unit)


def worst_places(points, places, deviation, size):
    """Numbers of the points that stand for the worst places, each far from those before it: those with the median of the points around
    them, so that a speck of dust is none. `places`: of the points on the shape."""
    cell = np.floor((places - places.min(axis=0)) / (AROUND * size)).astype(np.int64)
    spans = cell.max(axis=0) + 1
    order = np.lexsort((deviation, np.ravel_multi_index(tuple(cell.T), tuple(spans))))
    _, first, count = np.unique(np.ravel_multi_index(tuple(cell.T), tuple(spans))[order], return_index=True, return_counts=True)
    medians = order[(first + (count - 1) // 2)[count >= FEWEST_AROUND]]
    found = []
    for number in medians[np.argsort(-np.abs(deviation[medians]))]:
        if all(np.linalg.norm(points[number] - points[other]) > APART * size for other in found):
            found.append(int(number))
            if len(found) == PLACES:
                break
    return found or [int(np.argmax(np.abs(deviation)))]


def map_values(surface, points, deviation, size):
    """Deviations at the points of the shape: of the nearest measured point, nan where none is near."""
    cloud = Surface(points, np.repeat(np.arange(len(points))[:, None], 3, axis=1))
    spacing = np.sqrt(surface.areas.sum() / len(points))  # were they spread evenly over the shape
    near = cloud.nearest(surface.points, max(0.05 * size, 2 * spacing))
    return np.where(np.isfinite(near.distance), deviation[near.triangle], np.nan)


def draw_profiles(surface, points, deviation, worst, folder):
    """Deviations in strips through the worst places, across each of the two longest directions of the part there."""
    size = surface.extent()
    figure, axes = style.plt.subplots(len(worst), 1, figsize=(8, 1.2 + 1.9 * len(worst)), constrained_layout=True, squeeze=False)
    for rank, (panel, number) in enumerate(zip(axes[:, 0], worst)):
        strip, axis = strip_through(points, number, size)
        order = strip[np.argsort(points[strip, axis])]
        panel.axhline(0, color="black", linewidth=0.6)
        panel.plot(1e3 * points[order, axis], 1e3 * deviation[order], ".", markersize=2.5, color=style.COLOURS[0])
        panel.plot([1e3 * points[number, axis]], [1e3 * deviation[number]], "o", markersize=5, color=style.COLOURS[1])
        panel.set_title(f"place {rank + 1}, ({', '.join(f'{1e3 * x:.4g}' for x in points[number])}) mm: {1e3 * deviation[number]:+.3g} mm", fontsize=8.5)
        panel.set_xlabel(f"{'xyz'[axis]} [mm]")
        panel.set_ylabel("deviation [mm]")
    figure.suptitle(f"Profiles through the worst places, in strips of {2e3 * STRIP * size:.3g} mm", fontsize=10)
    return style.save(figure, folder, "profiles", vector=False)


def strip_through(points, number, size):
    """Points within a strip through a point, along the axis of which most points lie in it."""
    best = (np.zeros(0, int), 0)
    for axis in range(3):
        others = [k for k in range(3) if k != axis]
        near = np.flatnonzero((np.abs(points[:, others] - points[number, others]) < STRIP * size).all(axis=1))
        wide = near if near.size else np.array([number])
        if np.ptp(points[wide, axis]) > (np.ptp(points[best[0], best[1]]) if best[0].size else -1):
            best = (wide, axis)
    return best


def compare(options):
    """Fits, measures, writes; the lines that tell of it."""
    surface, name = shape_of(Path(options.shape), options)
    path = Path(options.measured)
    scan = measured_points(path, options.unit)
    kept = scan if len(scan) <= MOST_POINTS else scan[:: len(scan) // MOST_POINTS + 1]
    motion = shape_fit.identity() if options.as_placed else shape_fit.best_fit(kept, surface)
    places = motion(kept)
    near, size = surface.nearest(places), surface.extent()
    deviation = near.distance
    worst = worst_places(places, near.place, deviation, size)
    folder = Path(options.output) if options.output else path.parent / f"{path.stem}_compared"
    folder.mkdir(parents=True, exist_ok=True)
    np.savetxt(folder / "deviations.csv", 1e3 * np.column_stack([places, deviation]), delimiter=",", fmt="%.6g", comments="",
               header="x[mm],y[mm],z[mm],deviation[mm]")
    counted = shape_fit.weights_of(deviation, not options.as_placed) > 0
    found = {"measured": str(path), "shape": name, "points": len(kept), "rotation": motion.rotation.tolist(), "shift[m]": motion.shift.tolist(),
             "mean[m]": float(deviation.mean()), "rms[m]": float(np.sqrt(np.mean(deviation ** 2))), "least[m]": float(deviation.min()),
             "largest[m]": float(deviation.max()), "within_95%[m]": float(np.quantile(np.abs(deviation), 0.95)),
             "left_out_of_fit": int((~counted).sum()),
             "worst": [{"at[m]": places[i].tolist(), "deviation[m]": float(deviation[i])} for i in worst]}
    (folder / "shape.json").write_text(json.dumps(found, indent=2) + "\n")
    files = draw(surface, places, deviation, worst, size, found, folder)
    return report(found, motion, options) + [f"written in {folder}: deviations.csv, shape.json, {', '.join(file.name for file in files)}"]


def draw(surface, places, deviation, worst, size, found, folder):
    style.setup()
    fine = Surface(*finer(surface.points, surface.triangles, size / FINE))
    values = 1e3 * map_values(fine, places, deviation, size)
    worst_values = np.abs(1e3 * deviation[worst])
    # Colours are for what many points say: dust is beyond them.
    values = np.clip(values, -1.2 * worst_values.max(), 1.2 * worst_values.max()) if worst_values.max() > 0 else values
    footer = (f"{found['measured']} against {found['shape']}: 95 % within {1e3 * found['within_95%[m]']:.3g} mm, "
              f"{1e3 * found['least[m]']:+.3g} to {1e3 * found['largest[m]']:+.3g} mm; grey: nothing was measured")
    marks = [(str(rank + 1), places[number]) for rank, number in enumerate(worst)]
    files = pattern_picture.draw_on_skin(fine.points, fine.triangles, values, "Measured shape: above zero where there is more metal", "deviation [mm]",
                                         folder / "deviations.png", symmetric=True, marks=marks, footer=footer)
    return files + draw_profiles(surface, places, deviation, worst, folder)


def report(found, motion, options):
    """What is printed."""
    fitted = "as placed" if options.as_placed else f"best fit: turned by {motion.angle():.4g} degrees, shifted by {1e3 * np.linalg.norm(motion.shift):.4g} mm"
    lines = [f"{found['points']} points against {found['shape']}, {fitted}"]
    lines.append(f"  mean {1e3 * found['mean[m]']:+.4g} mm, root mean square {1e3 * found['rms[m]']:.4g} mm, 95 % within {1e3 * found['within_95%[m]']:.4g} mm, "
                 f"from {1e3 * found['least[m]']:+.4g} to {1e3 * found['largest[m]']:+.4g} mm")
    if found["left_out_of_fit"]:
        lines.append(f"  {found['left_out_of_fit']} points lie so far off that they did not count in the fit")
    lines.append("  worst places, medians of what was measured around them:")
    for rank, place in enumerate(found["worst"]):
        where = ", ".join(f"{1e3 * x:.4g}" for x in place["at[m]"])
        lines.append(f"  {rank + 1}: {1e3 * place['deviation[m]']:+.4g} mm at ({where}) mm")
    return lines


def main(arguments=None):
    parser = argparse.ArgumentParser(prog="solidus compare-shape", description=__doc__.splitlines()[0])
    parser.add_argument("measured", metavar="MEASURED")
    parser.add_argument("shape", metavar="SHAPE")
    parser.add_argument("--nominal", action="store_true")
    parser.add_argument("--as-placed", action="store_true")
    parser.add_argument("--body", metavar="NAME")
    parser.add_argument("--unit", default="mm", metavar="UNIT")
    parser.add_argument("--output", metavar="FOLDER")
    try:
        for line in compare(parser.parse_args(arguments)):
            print(line)
    except (ResultError, OSError) as error:
        print(f"solidus: {sentence(error)}", file=sys.stderr)
        return 1
    return 0
