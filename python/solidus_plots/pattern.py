"""The pattern whose casting has the shape of the drawing: python3 -m solidus_plots.pattern FOLDER, as `solidus pattern CASE` does.

FOLDER holds drawing.msh and drawing.toml, which the program has written. The case is run with the cavity as the pattern is, and
the pattern is corrected by what the casting misses, until it misses less than a tolerance. docs/guide/pattern.md tells the rest.
"""

import argparse
import json
from pathlib import Path
import re
import sys
import tomllib

import numpy as np

from solidus_plots import fields, pattern_picture, shape_fit, style
from solidus_plots.answers import read_summary
from solidus_plots.many_runs import INTERRUPTED, Runner
from solidus_plots.pattern_mesh import DrawnMesh, Followers, affine, held_planes, skin
from solidus_plots.triangle_surface import write_stl
from solidus_plots.verb import sentence
from solidus_plots.vtu import Grid, ResultError, read_collection, read_fields
from solidus_plots.vtu_writer import write_grid

CANNOT_CONTINUE = 22  # the program's 2
RUNS = 5
COLD = 60.0  # [degC] a casting that ends hotter goes on contracting by more than a thousandth
TOLERANCE = 1e-4  # of the length of the part
LENGTHS = {"m": 1.0, "cm": 1e-2, "mm": 1e-3, "um": 1e-6, "in": 0.0254}


class RunFailed(Exception):
    """A run of the case did not end well."""


def length(text):
    """[m] of a text such as "0.05 mm". Throws ResultError."""
    match = re.fullmatch(r"\s*([0-9.eE+-]+)\s*([a-z]+)\s*", text)
    try:
        value = float(match.group(1)) * LENGTHS[match.group(2)] if match else None
    except (ValueError, KeyError):
        value = None
    if value is None or not value > 0:
        raise ResultError(f"--tolerance is a length above zero such as '0.05 mm' ({', '.join(LENGTHS)}), not '{text}'")
    return value


class Case:
    """The resolved case, whose mesh is a file that is made here."""

    def __init__(self, folder):
        self.folder = folder
        self._text = (folder / "drawing.toml").read_text()
        self.document = tomllib.loads(self._text)

    def with_mesh(self, file, roles):
        """The case with this mesh; `roles`: of bodies that had them from sections of [mesh]."""
        sections = re.split(r"(?m)^(?=\[)", self._text)
        kept = [section for section in sections if not re.match(r"\[+mesh[.\]]", section)]
        for i, section in enumerate(kept):
            name = re.search(r'(?m)^name = "(.*)"$', section)
            if section.startswith("[[body]]") and name and name.group(1) in roles:
                kept[i] = re.sub(r'(?m)^role = ".*"$', f'role = "{roles[name.group(1)]}"', section)
        return "".join([kept[0], f'[mesh]\nfile = {json.dumps(str(file))}\nunit = "m"\n\n', *kept[1:]])


class Part:
    """The casting in a run: where its nodes are in the mesh of the drawing, and where they end up."""

    def __init__(self, results, mesh, wanted):
        summary = read_summary(results)
        fields.declare(summary)
        self.summary = summary
        _, files = read_collection(results / "fields.pvd")
        if not files:
            raise ResultError(f"{results}: no fields were written; [output] of the case has to have them")
        self.grid = read_fields(files[-1])
        if "displacement" not in self.grid.point_data:
            raise ResultError(f"{results}: the field displacement was not written; fields of [output] leave it out")
        self.bodies = list(summary["mesh"]["bodies"])
        self.names = self._castings(summary, wanted)
        self.cells = np.isin(self.grid.cell_data["body"], [self.bodies.index(name) for name in self.names])
        if not self.cells.any():
            raise ResultError(f"the body {', '.join(self.names)} is not there at the end of the run")
        self.number = self.grid.point_data["node"].astype(int) - 1
        if not np.allclose(mesh[self.number], self.grid.points, rtol=0, atol=1e-9 * np.ptp(mesh, axis=0).max()):
            raise ResultError("the nodes of the run are not those of its mesh; this is a fault of the program")
        counts = np.diff(self.grid.offsets, prepend=0)
        self.nodes = np.unique(self.grid.connectivity[np.repeat(self.cells, counts)])  # of the grid

    def _castings(self, summary, wanted):
        castings = summary.get("answers", {}).get("castings", {})
        if wanted:
            if wanted not in self.bodies:
                raise ResultError(f"--body: there is no body '{wanted}'; there are {', '.join(self.bodies)}")
            return [wanted]
        found = [name for name, one in castings.items() if not (one.get("riser") or one.get("gating"))]
        if found or len(self.bodies) == 1:
            return found or self.bodies
        raise ResultError(f"nothing is cast in this case; --body names the part: {', '.join(self.bodies)}")

    def roles(self):
        castings = self.summary.get("answers", {}).get("castings", {})
        return {name: "riser" if one.get("riser") else "gating" for name, one in castings.items() if one.get("riser") or one.get("gating")}

    def movement(self, held):
        """[node of the grid][3]: what the shape changes by. A free part has it since it was coherent, without the motion as a whole."""
        name = "distortion" if not held and "distortion" in self.grid.point_data else "displacement"
        found = np.zeros_like(self.grid.points)
        values = self.grid.point_data[name]
        found[:, :values.shape[1]] = values
        return found


def without_motion(missed, drawn, held):
    """What the casting misses, without the motions as a whole that the case leaves it."""
    if held:
        return missed
    motion = shape_fit.of_pairs(drawn + missed, drawn)
    return motion(drawn + missed) - drawn


class Search:
    """Runs, and corrects the pattern, until the casting is the drawing."""

    def __init__(self, case, options):
        self.case, self.mesh = case, DrawnMesh(case.folder / "drawing.msh")
        self.points, self.options = self.mesh.points.copy(), options
        self.rows, self.part, self.missed = [], None, None
        kind = case.document.get("analysis", {}).get("kind")
        if kind != "solid":
            raise ResultError(f"a pattern is made for a part in three dimensions; the case has analysis.kind = \"{kind}\", not \"solid\"")
        self._followers, self._roles = None, {}

    def run(self):
        """True when the tolerance is met."""
        for turn in range(self.options.runs):
            results = self._run(turn)
            self.part = Part(results, self.points, self.options.body)
            self._roles = self.part.roles()
            drawn = self.mesh.points[self.part.number[self.part.nodes]]
            held = held_planes(self.case.document, self.mesh, self.part.number[self.part.nodes])
            moved = self.part.movement(held)
            cast = (self.part.grid.points + moved)[self.part.nodes]
            self.missed = without_motion(cast - drawn, drawn, held)
            self.moved = moved[self.part.nodes]
            size = np.ptp(drawn, axis=0).max()
            self.tolerance = length(self.options.tolerance) if self.options.tolerance else TOLERANCE * size
            largest = float(np.linalg.norm(self.missed, axis=1).max())
            self.rows.append({"run": turn, "folder": str(results), "largest[m]": largest,
                              "mean[m]": float(np.linalg.norm(self.missed, axis=1).mean())})
            print(f"  run {turn + 1}: the casting misses the drawing by {1e3 * largest:.4g} mm at most, "
                  f"{1e3 * self.rows[-1]['mean[m]']:.4g} mm in the mean", flush=True)
            if largest <= self.tolerance:
                return True
            if turn > 0 and largest > 0.9 * self.rows[-2]["largest[m]"]:
                raise RunFailed("correcting the pattern does not bring the casting nearer: how it deforms depends on the shape too strongly, or "
                                "the runs scatter (a finer step and mesh, or a larger --tolerance)")
            if turn + 1 < self.options.runs:
                self._correct(held, drawn)
        return False

    def _run(self, turn):
        folder = self.case.folder / f"run_{turn + 1}"
        folder.mkdir(parents=True, exist_ok=True)
        mesh, case = self.case.folder / f"mesh_{turn + 1}.msh", self.case.folder / f"case_{turn + 1}.toml"
        self.mesh.write(mesh, self.points)
        case.write_text(self.case.with_mesh(mesh.resolve(), self._roles))
        record = Runner(case, self.options.restart).run(folder, [])
        if record is None:
            raise KeyboardInterrupt
        if record["code"] != 0:
            raise RunFailed(f"run {turn + 1} did not end well: {record['reason']} ({folder / 'log.txt'})")
        return folder

    def _correct(self, held, drawn):
        """The pattern less what the casting misses; everything else follows."""
        own = self.part.number[self.part.nodes]
        target = self.points[own] - self.missed - drawn
        if self._followers is None:
            planes = [(axis, at) for axis, at in held if at is not None]
            at_drawn = Grid(self.mesh.points[self.part.number], self.part.grid.cell_types, self.part.grid.offsets, self.part.grid.connectivity,
                            cell_data={"body": self.part.grid.cell_data["body"]})
            self._followers = Followers(at_drawn, self.part.cells, self.mesh.points, own, planes)
        at_grid = np.zeros_like(self.part.grid.points)
        at_grid[self.part.nodes] = target
        self.points = self._followers.displaced(target, at_grid)


def contraction(search):
    """By axis [1], and what a scale of its own for each axis leaves [m]."""
    pattern = search.part.grid.points[search.part.nodes]
    cast = search.moved
    _, gradient = affine(pattern, cast)
    axes = np.diag(gradient)
    middle = pattern.mean(axis=0)
    scaled = axes * (pattern - middle)
    rest = shape_fit.of_pairs(pattern + cast, pattern + scaled)(pattern + cast) - pattern - scaled
    return -axes, float(np.linalg.norm(rest, axis=1).max())


def write(search, met):
    """Meshes, skins, numbers and the picture of what was found; the lines that tell of them."""
    folder, part = search.case.folder, search.part
    drawn = search.mesh.points[part.number]
    allowance, missed = part.grid.points - drawn, np.zeros_like(part.grid.points)
    missed[part.nodes] = search.missed
    grid = Grid(part.grid.points, part.grid.cell_types, part.grid.offsets, part.grid.connectivity,
                {"allowance": allowance, "missed": missed, "node": part.grid.point_data["node"]}, {"body": part.grid.cell_data["body"]},
                {"allowance": "m", "missed": "m"}, 0.0)
    write_grid(folder / "pattern.vtu", grid)
    search.mesh.write(folder / "pattern.msh", search.points)
    axes, rest = contraction(search)
    names = "xyz"
    found = {"met": met, "tolerance[m]": search.tolerance, "runs": search.rows, "bodies": part.names,
             "contraction[%]": {name: 100 * float(value) for name, value in zip(names, axes)},
             "left_by_scales[m]": rest, "largest_allowance[m]": float(np.linalg.norm(allowance[part.nodes], axis=1).max())}
    (folder / "pattern.json").write_text(json.dumps(found, indent=2) + "\n")
    lines = ["contraction from pattern to casting: " + ", ".join(f"{name} {100 * value:.4g} %" for name, value in zip(names, axes))
             + f"; a scale for each axis alone would miss by {1e3 * rest:.3g} mm"]
    files = ["pattern.msh", "pattern.vtu", "pattern.json", *write_skins(search, folder)]
    style.setup()
    files += [file.name for file in pattern_picture.draw_pattern(part, drawn, allowance, folder)]
    hottest = part.grid.point_data["temperature"][part.nodes].max() - 273.15 if "temperature" in part.grid.point_data else 0.0
    if hottest > COLD:
        lines.append(f"the casting is still up to {hottest:.0f} degC hot when the run ends: what it contracts by from there on is not in the pattern "
                     "(a later time.end, or a stage in air)")
    error = part.summary.get("answers", {}).get("largest_distortion", {}).get("error[m]")
    if error is not None and error > search.tolerance:
        lines.append(f"step and mesh leave the distortion uncertain by {1e3 * error:.3g} mm, more than the tolerance of {1e3 * search.tolerance:.3g} mm")
    return lines + [f"written in {folder}: {', '.join(files)}"]


def write_skins(search, folder):
    """An STL file in mm of each body that is poured, or of the part."""
    castings = search.part.summary.get("answers", {}).get("castings", {})
    files = []
    for name in castings or search.part.names:
        cells = search.part.grid.cell_data["body"] == search.part.bodies.index(name)
        if cells.any():
            triangles, extend = skin(search.part.grid, cells)
            file = folder / f"pattern_{re.sub(r'[^A-Za-z0-9_-]', '_', name)}.stl"
            write_stl(file, extend(search.part.grid.points), triangles)
            files.append(file.name)
    return files


def main(arguments=None):
    parser = argparse.ArgumentParser(prog="solidus pattern", description=__doc__.splitlines()[0])
    parser.add_argument("folder", type=Path, metavar="FOLDER")
    parser.add_argument("--tolerance", metavar="LENGTH")
    parser.add_argument("--runs", type=int, default=RUNS)
    parser.add_argument("--body", metavar="NAME")
    parser.add_argument("--restart", action="store_true")
    options = parser.parse_args(arguments)
    try:
        if options.tolerance:
            length(options.tolerance)
        search = Search(Case(options.folder), options)
        met = search.run()
        for line in write(search, met):
            print(line)
    except RunFailed as error:
        print(f"solidus: {error}", file=sys.stderr)
        return CANNOT_CONTINUE
    except KeyboardInterrupt:
        print("solidus: stopped; --restart goes on with the runs that have ended", file=sys.stderr)
        return INTERRUPTED
    except (ResultError, OSError) as error:
        print(f"solidus: {sentence(error)}", file=sys.stderr)
        return 1
    if not met:
        print(f"solidus: the tolerance of {1e3 * search.tolerance:.4g} mm is not met after {len(search.rows)} runs; --runs allows more, --restart "
              "keeps these", file=sys.stderr)
        return CANNOT_CONTINUE
    return 0
