"""`solidus design` on ten parts that are unlike each other, against the riser of `solidus new --riser auto` and, on three of
them, against a grid of designs. Rows of the table in docs/guide/design.md: python3 tests/nightly/design_parts.py FOLDER
[PART...], with the program in SOLIDUS_PROGRAM. What has run in FOLDER is not repeated."""

from dataclasses import dataclass
import json
import os
from pathlib import Path
import resource
import subprocess
import sys

ROOT = Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "python"))

from solidus_plots.design import Workshop  # noqa: E402
from solidus_plots.design_feeders import Chill, Design, Riser, chosen_risers  # noqa: E402
from solidus_plots.design_judgement import Limits  # noqa: E402
from solidus_plots.design_search import Trial  # noqa: E402

LIMITS = Limits(1e-4, 0.01, 0.1)  # the defaults of `solidus design`
LESS = (0.95, 0.87, 0.8)  # of the metal that the search found, in which the grid looks for a sound design
HEIGHTS = (0.8, 1.0, 1.25, 1.5, 1.8, 2.15, 2.6)  # over the diameter, of the grid
JOBS = int(os.environ.get("SOLIDUS_DESIGN_JOBS", "2"))


@dataclass(frozen=True)
class Part:
    file: str  # in tests/parts
    alloy: str
    fineness: float
    grid: bool = False

    def name(self):
        return Path(self.file).stem

    def words(self):
        return ["--alloy", self.alloy, "--process", "sand"]


PARTS = (Part("stepped_plate.step", "low_carbon_steel", 0.4, grid=True),
         Part("dumbbell.step", "aluminium_alsi7mg", 0.4),
         Part("flange.step", "nodular_iron", 0.4),
         Part("hook.step", "medium_carbon_steel", 0.4),
         Part("pillow_block.step", "aluminium_alsi7mg", 0.4),
         Part("design/beam.step", "medium_carbon_steel", 0.4, grid=True),
         Part("design/clamp.step", "medium_carbon_steel", 0.4),
         Part("design/column.step", "medium_carbon_steel", 0.3),
         Part("design/l_block.step", "medium_carbon_steel", 0.4, grid=True),
         Part("design/sheave.step", "medium_carbon_steel", 0.4))


def designed(part, folder):
    """Runs `solidus design` into a folder: design.json, what it printed last, and seconds of processor time."""
    time_file = folder / "processor_time.json"
    before = resource.getrusage(resource.RUSAGE_CHILDREN)
    done = subprocess.run([os.environ["SOLIDUS_PROGRAM"], "design", str(ROOT / "tests/parts" / part.file), *part.words(),
                           "--fineness", f"{part.fineness:g}", "-j", str(JOBS), "--restart", "-o", str(folder)],
                          capture_output=True, text=True, check=False)
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    if not (folder / "design.json").exists():
        raise RuntimeError(f"{part.name()}: {done.stdout[-2000:]}{done.stderr}")
    seconds = sum(getattr(after, key) - getattr(before, key) for key in ("ru_utime", "ru_stime"))
    if not time_file.exists():
        time_file.write_text(json.dumps(seconds))
    return json.loads((folder / "design.json").read_text()), done.stdout, json.loads(time_file.read_text())


def workshop(part, folder):
    """Makes and runs cases of the part next to those of the search."""
    return Workshop(ROOT / "tests/parts" / part.file, part.words(), folder, JOBS, LIMITS, True)


def guessed(part, folder):
    """The trial of the risers of `solidus new --riser auto`, on the mesh on which the design is checked."""
    risers = chosen_risers(folder / "first_guess" / "case.toml")
    if not risers:
        return None
    trial = Trial("--riser auto", Design(risers))
    workshop(part, folder / "guess").evaluate([trial], 2 * part.fineness)
    return trial


def design_of(row):
    """The design of a row of design.json."""
    return Design(tuple(Riser(**{key: tuple(value) if isinstance(value, list) else value for key, value in one.items()})
                        for one in row["risers"]),
                  tuple(Chill(one["name"], tuple(one["lowest"]), tuple(one["highest"])) for one in row["chills"]))


def on_grid(part, folder, found):
    """Trials on the mesh of the search with less metal than the design that was found there, with risers of other heights
    over their diameters."""
    trials = []
    for less in LESS:
        for height in HEIGHTS:
            risers = tuple(riser if riser.beside else
                           Riser(riser.name, riser.foot, riser.sunk, riser.diameter * (less * riser.slender / height) ** (1 / 3),
                                 height, riser.neck, riser.sleeve) for riser in found.risers)
            trials.append(Trial(f"metal x {less:g}, {height:g} diameters high", Design(risers, found.chills)))
    workshop(part, folder / "grid").evaluate(trials, part.fineness)
    return trials


def measured(part, root):
    """All that is known of a part: a dictionary."""
    folder = root / part.name()
    folder.mkdir(parents=True, exist_ok=True)
    document, text, seconds = designed(part, folder)
    rows = {row["run"]: row for row in document["runs"]}
    chosen, coarse = rows.get(document["chosen"]), rows.get(document["best_on_the_coarse_mesh"])
    known = {"part": part, "text": text, "seconds": seconds, "runs": len(rows), "none": document["runs"][0], "chosen": chosen,
             "coarse": coarse, "guess": guessed(part, folder), "grid": []}
    if part.grid and coarse and coarse["risers"]:
        known["grid"] = on_grid(part, folder, design_of(coarse))
    return known


def least_of_grid(known):
    """The sound trial of the grid with the least metal; nothing where none is."""
    return min((trial for trial in known["grid"] if trial.sound()), key=lambda trial: trial.design.metal(), default=None)


def row_of(known):
    """A row of the table in docs/guide/design.md."""
    part, guess, chosen, least = known["part"], known["guess"], known["chosen"], least_of_grid(known)
    first = "none" if guess is None else f"{1e-3 * guess.design.metal():.3g} cm³, " + ("sound" if guess.sound() else "not sound")
    found = "nothing" if chosen is None else f"{chosen['design']}, {chosen['risers[cm3]']:.3g} cm³"
    grid = "" if not known["grid"] else "none with less" if least is None else \
        f"{1e-3 * least.design.metal():.3g} cm³ of {known['coarse']['risers[cm3]']:.3g} cm³"
    cells = [part.name(), f"`{part.alloy}`", f"{known['none']['holes in the part[cm3]']:.3g} cm³", first, found, grid,
             f"{known['runs']}, {known['seconds']:.0f} s"]
    return "| " + " | ".join(cells) + " |"


def main(arguments):
    root, names = Path(arguments[0]).resolve(), arguments[1:]
    for part in PARTS:
        if not names or part.name() in names:
            print(row_of(measured(part, root)), flush=True)


if __name__ == "__main__":
    main(sys.argv[1:])
