"""Draws the results of a run: python3 -m solidus_plots RESULTS_DIR.

Every case gets one picture per unit of history.csv and one of its steps. What else is drawn stands in the
`plots.toml` beside the case file; docs/guide/plots.md describes it. Pictures go to RESULTS_DIR/plots.
"""

import argparse
import json
from pathlib import Path
import sys
import tomllib

from solidus_plots import curves, graphs, maps, point, sections, style, surfaces
from solidus_plots.history import read_table
from solidus_plots.moments import Moments
from solidus_plots.probes import read_points
from solidus_plots.vtu import ResultError, read_collection

# What plots.toml may say; anything else is a typo.
FIELD_KEYS = {"quantity", "field", "component", "unit", "contours", "levels", "bands", "colours", "range",
              "above", "smooth"}
SHEET_KEYS = {"file", "only", "title", "times", "columns", "bodies", "magnification", "probes"}
KEYS = {"curves": {"file", "only", "title", "quantity", "lines", "levels", "moments", "name",
                   "compare"},
        "graphs": {"file", "only", "title", "table", "x", "x_quantity", "part", "quantity", "lines", "each",
                   "values", "keep", "from_zero"},
        "maps": {"file", "only", "title", "quantity", "field", "component", "unit", "times", "mirror",
                 "magnification", "bodies", "contours", "range"},
        "deformed": {"file", "only", "title", "time", "mirror", "magnification", "bodies"},
        "sections": FIELD_KEYS | SHEET_KEYS | {"planes", "mesh"},
        "surfaces": FIELD_KEYS | SHEET_KEYS | {"plain", "ghost", "clip", "clip_bodies", "view", "up", "edges",
                                               "dimensions"}}
REQUIRED = {"curves": ("file", "lines"), "graphs": ("file", "x", "lines"), "maps": ("file", "field"),
            "deformed": ("file",), "sections": ("file", "field", "planes"), "surfaces": ("file",)}
# Keys of a picture that change nothing without another one.
NEEDS = {"surfaces": {"clip_bodies": "clip", **dict.fromkeys(FIELD_KEYS - {"field"}, "field")}}
# Pictures of fields and what draws them.
FIELD_PICTURES = {"maps": maps.field_maps, "deformed": maps.deformed_mesh, "sections": sections.draw,
                  "surfaces": surfaces.draw}


def find_spec(results, summary):
    """plots.toml beside the case file the run was made of, else cases/CASE/plots.toml of this repository."""
    repository = Path(__file__).resolve().parents[2]
    case_file = Path(summary.get("case", ""))
    places = [case_file.parent, repository / case_file.parent] if case_file.name else []
    places.append(repository / "cases" / results.resolve().parent.name)
    return next((place / "plots.toml" for place in places if (place / "plots.toml").exists()), None)


def read_spec(path):
    try:
        spec = tomllib.loads(path.read_text())
    except tomllib.TOMLDecodeError as error:
        raise ResultError(f"{path}: {error}") from error
    for section, pictures in spec.items():
        if section not in KEYS:
            raise ResultError(f"{path}: unknown section '{section}'; there are {', '.join(KEYS)}")
        for picture in pictures:
            unknown = set(picture) - KEYS[section]
            if unknown:
                raise ResultError(f"{path}: unknown key '{unknown.pop()}' in [[{section}]]; there are "
                                  f"{', '.join(sorted(KEYS[section]))}")
            for key in REQUIRED[section]:
                if key not in picture:
                    raise ResultError(f"{path}: a [[{section}]] lacks its '{key}'")
            for key, needed in NEEDS.get(section, {}).items():
                if key in picture and needed not in picture:
                    raise ResultError(f"{path}: [[{section}]] '{picture['file']}': '{key}' needs '{needed}'")
    return spec


def star(patterns, variant):
    """What '*' stands for in the first pattern that fits a variant's name ('' where it has no '*'); None where
    none fits."""
    for pattern in patterns:
        head, wild, tail = pattern.partition("*")
        if pattern == variant:
            return ""
        if wild and len(variant) >= len(head + tail) and variant.startswith(head) and variant.endswith(tail):
            return variant[len(head):len(variant) - len(tail)]
    return None


def histories(compare, part, results):
    """The histories to lay over those of `results`, where they are there, by their labels."""
    found = {}
    for entry in compare:
        entry = entry if isinstance(entry, dict) else {"variant": entry}
        variant = entry["variant"].replace("*", part)
        file = results.resolve().parent / variant / "history.csv"
        if variant != results.resolve().name and file.exists():
            found[entry.get("label", variant)] = read_table(file)
    return found


def draw(results, spec_file=None):
    """Draws everything; returns the files written and what could not be drawn."""
    style.setup()
    summary_file = results / "summary.json"
    summary = json.loads(summary_file.read_text()) if summary_file.exists() else {}
    if summary.get("kind") == "point":
        return point.draw(results, summary)
    spec_file = spec_file or find_spec(results, summary)
    spec = read_spec(spec_file) if spec_file else {}
    variant = summary.get("variant") or results.resolve().name
    spec = {section: [picture for picture in pictures
                      if star(picture.get("only", [variant]), variant) is not None]
            for section, pictures in spec.items()}
    folder = results / "plots"
    folder.mkdir(exist_ok=True)
    history = read_table(results / "history.csv")
    files, problems = curves.unit_groups(history, folder), []
    if (results / "steps.csv").exists():
        files += curves.steps(read_table(results / "steps.csv"), folder)

    def attempt(work, *arguments):
        # One picture that cannot be drawn (a run that stopped early) must not cost the others.
        try:
            files.extend(work(*arguments, folder))
        except (ResultError, ValueError) as error:
            problems.append(str(error))

    for picture in spec.get("curves", []):
        part = star(picture.get("only", [variant]), variant)
        attempt(curves.chosen, picture, history, histories(picture.get("compare", []), part, results))
    for picture in spec.get("graphs", []):
        attempt(graphs.draw, picture, results)
    if any(spec.get(kind) for kind in FIELD_PICTURES):
        times, files_of = read_collection(results / "fields.pvd")
        run = Moments(times, files_of, list(summary.get("mesh", {}).get("bodies", {})),
                      read_points(results / "case.toml"))
        for kind, work in FIELD_PICTURES.items():
            for picture in spec.get(kind, []):
                attempt(work, picture, run)
        problems += list(dict.fromkeys(run.missing))
    return files, problems


def main(arguments=None):
    parser = argparse.ArgumentParser(prog="solidus_plots", description=__doc__.splitlines()[0])
    parser.add_argument("results", type=Path, metavar="RESULTS_DIR")
    parser.add_argument("--plots", type=Path, metavar="FILE", help="a plots.toml other than the case's own")
    options = parser.parse_args(arguments)
    try:
        files, problems = draw(options.results, options.plots)
    except (ResultError, OSError) as error:
        print(f"solidus_plots: {error}", file=sys.stderr)
        return 1
    for file in files:
        print(file)
    for problem in problems:
        print(f"solidus_plots: not drawn: {problem}", file=sys.stderr)
    return 0
