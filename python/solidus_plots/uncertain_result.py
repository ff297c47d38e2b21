"""From runs with one parameter moved to the spread of every answer, and the part of each parameter in it."""

from dataclasses import dataclass
import math
from statistics import median
import tomllib

from solidus_plots.answers import answers, bands, read_summary
from solidus_plots.style import unit_text
from solidus_plots.uncertain_parameters import root_of_squares

BENT = 0.3  # of the part: an answer that bends so much in a parameter is reported to
JUMPS = 0.3  # of the largest part: where half of all parts are above it, an answer has no order of what matters
MANY = 6  # parameters from which that can be told
MUCH = 1 / 3  # of the spread of an answer: such a parameter is worth a run at its other end
NAMED = 0.05  # of the variance: parameters below it are counted together


@dataclass
class Part:
    """What one parameter does to one answer."""

    label: str
    up: float | None  # the answer with the parameter at the upper end of its range
    down: float | None  # at the lower end; nothing: not run
    slope: float  # change of the answer for half the width of the range
    bend: float  # (up + down)/2 - best, zero where one side was run

    def spread(self):
        """Two standard deviations of the answer: with y = best + slope u + bend u^2 and u normal, of deviation 1/2."""
        return math.sqrt(self.slope ** 2 + 0.5 * self.bend ** 2)



@dataclass
class Answer:
    name: str
    unit: str
    best: float
    parts: list  # by size, the largest first
    band: float | None  # of step and mesh, a half width; nothing: the run does not say
    incomplete: list  # parameters with a run that failed or lacks this answer

    def spread(self):
        return root_of_squares([*(part.spread() for part in self.parts), self.band or 0.0])

    def jumps(self):
        """Whether it changes about as much whatever is moved, as an extreme does that goes from node to node."""
        parts = [part.spread() for part in self.parts]
        return len(parts) >= MANY and median(parts) > JUMPS * parts[0]

    def bent_parts(self):
        """Those that make a third of the spread and are not straight lines."""
        return [part for part in self.parts
                if part.down is not None and part.up is not None and part.spread() > MUCH * self.spread()
                and abs(part.bend) > BENT * abs(part.slope)]


def split(header):
    """Name and unit of "largest gap of wall[mm]"."""
    name, _, unit = header.rpartition("[")
    return (name, unit.removesuffix("]")) if name else (header, "")


def answers_of_run(folder):
    """Name with unit -> number: the answers of a run, and its probes at the end."""
    summary = read_summary(folder)
    found = answers(summary)
    probes = tomllib.loads((folder / "case.toml").read_text()).get("probe", [])
    for header, value in summary.get("final", {}).items():
        name, unit = split(header)
        if any(name == probe["name"] for probe in probes):
            found[f"{name} at the end[{unit}]"] = value
    return found


def bands_of_run(folder):
    return bands(read_summary(folder))


def part_of(label, best, up, down):
    """Nothing where the run at the upper end has no such answer."""
    if up is None and down is None:
        return None
    if up is None or down is None:
        return Part(label, up, down, up - best if up is not None else best - down, 0.0)
    return Part(label, up, down, 0.5 * (up - down), 0.5 * (up + down) - best)


def evaluate(best, band, parameters, ups, downs):
    """Answers with their spreads.

    best: name -> number of the case as it is; ups, downs: [parameter] such names and numbers, or nothing.
    Answers that no parameter changes are left out.
    """
    result = []
    for header, value in best.items():
        name, unit = split(header)
        parts, incomplete = [], []
        for parameter, up, down in zip(parameters, ups, downs):
            part = part_of(parameter.label, value, (up or {}).get(header), (down or {}).get(header))
            if part is None or (down is not None and header not in down) or header not in (up or {}):
                incomplete.append(parameter.label)
            if part is not None:
                parts.append(part)
        parts.sort(key=lambda part: -part.spread())
        answer = Answer(name, unit, value, parts, band.get(header), incomplete)
        if answer.spread() > 1e-9 * max(abs(value), 1e-300) and any(part.spread() > 0 for part in parts):
            result.append(answer)
    return result


def worth_the_other_side(found, parameters, most):
    """Numbers of the parameters that make a third of the spread of some answer that ranks them, the largest first."""
    share = [0.0] * len(parameters)
    numbers = {parameter.label: number for number, parameter in enumerate(parameters)}
    for answer in found:
        for part in answer.parts if not answer.jumps() else []:
            number = numbers[part.label]
            share[number] = max(share[number], part.spread() / answer.spread())
    order = sorted(range(len(share)), key=lambda number: -share[number])
    return [number for number in order if share[number] >= MUCH][:most]


def rounded(value, spread):
    """A number to the second figure of its spread, "165", "0.0123"."""
    if not spread > 0 or not math.isfinite(spread):
        return f"{value:.4g}"
    decimals = max(0, 1 - math.floor(math.log10(spread)))
    return f"{value:.{decimals}f}" if decimals <= 12 else f"{value:.3g}"


def line(answer):
    """ "165 s ± 24 (conductance of metal_in_die 20, latent heat of aluminium_alsi7mg 8, others 4)"."""
    total = answer.spread()
    named = [part for part in answer.parts if part.spread() ** 2 >= NAMED * total ** 2][:4]
    others = root_of_squares(part.spread() for part in answer.parts if part not in named)
    words = [f"{part.label} {rounded(part.spread(), total)}" for part in named]
    if others > 0.02 * total:
        words.append(f"others {rounded(others, total)}")
    if answer.band is not None:
        words.append(f"step and mesh {rounded(answer.band, total)}")
    unit = "" if answer.unit in ("", "1") else f" {unit_text(answer.unit)}"
    return f"{rounded(answer.best, total)}{unit} ± {rounded(total, total)} ({', '.join(words)})"
