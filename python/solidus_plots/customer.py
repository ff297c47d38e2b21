"""A run as four printed pages for a customer: python3 -m solidus_plots.customer RUN, as `solidus report RUN --pdf` does.

Pictures, answers with their errors, materials with their sources, assumptions, name and date. A headless Chromium writes the PDF;
where there is none the same pages are an HTML file that any browser prints. docs/guide/customer.md describes it.
"""

import argparse
from dataclasses import dataclass, field
import datetime
import json
from pathlib import Path
import re
import sys
import tempfile

from solidus_plots import automatic, chromium, fields, overview, sheet, style, xray
from solidus_plots.answers import answers, bands, read_summary
from solidus_plots.customer_page import page_of
from solidus_plots.customer_template import find_template, read_template
from solidus_plots.history import read_table
from solidus_plots.moments import Moments
from solidus_plots.probes import read_points
from solidus_plots.verb import sentence
from solidus_plots.vtu import ResultError, read_collection

SHOWN = 3  # pictures
SIZE = 8.2, 5.6  # of a picture [in], on paper 7.0 at most


@dataclass
class Answer:
    name: str
    value: float
    unit: str
    error: float | None


@dataclass
class MaterialSources:
    title: str
    bodies: list
    sources: list  # (property, source)


@dataclass
class Report:
    """What the pages hold."""

    title: str
    date: str
    program: str
    outcome: str
    answers: list
    pictures: list = field(default_factory=list)
    bodies: list = field(default_factory=list)
    contacts: list = field(default_factory=list)
    surroundings: list = field(default_factory=list)
    numerics: list = field(default_factory=list)
    materials: list = field(default_factory=list)
    warnings: list = field(default_factory=list)


def answers_of(summary):
    """All answers that are numbers: those of the parts with an error first, what says the least last, else in the order of the run."""
    errors, rows = bands(summary), []
    castings = summary.get("answers", {}).get("castings", {})
    parts = [name for name, casting in castings.items() if not casting.get("riser") and not casting.get("gating")]
    found = {**answers(summary), **_strength_of(summary, parts)}
    for name, value in found.items():
        if not isinstance(value, (int, float)):
            continue
        text, _, unit = name.rpartition("[")
        unit = style.unit_text(unit.rstrip("]"))
        rows.append(Answer(text[:1].upper() + text[1:] if ":" not in text else text, value, unit, errors.get(name)))

    def rank(row):
        body, colon, said = row.name.partition(": ")
        return said == "solid fraction" and row.value == 1, row.error is None, bool(colon) and body in castings and body not in parts
    return sorted(rows, key=rank)


def _strength_of(summary, parts):
    """Name with unit -> number: the properties of each part by the tables of its card, in the units that their fields are read in."""
    criteria, found = summary.get("criteria", {}), {}
    for part in parts:
        for field in fields.known():
            exact = "" if field.unit == "1" else f"[{field.unit}]"
            for word, suffix in (("least", "min"), ("mean", "mean")):
                key = f"{field.name}_in_{part}_{suffix}{exact}"
                if key in criteria:
                    text = field.label.removesuffix(" (by table)").lower()
                    found[f"{part}: {word} {text}[{field.shown}]"] = field.factor * criteria[key]
    return found


def chosen(sheets, wanted):
    """The sheets of at most three pictures. `wanted`: names of fields, which must be there."""
    by_field = {}
    for entry in sheets:
        by_field.setdefault(entry.get("field", entry.get("kind")), entry)
    if wanted:
        missing = [name for name in wanted if name not in by_field]
        if missing:
            raise ResultError(f"'pictures' of the template: there is no picture of '{missing[0]}' of this run; there are "
                              f"{', '.join(by_field)}")
        return [by_field[name] for name in wanted[:SHOWN]]
    telling = {}
    for entry in sheets:
        if "telling" in entry:
            telling.setdefault(entry["telling"], entry)
    return [telling[rank] for rank in sorted(telling)][:SHOWN]


def draw_pictures(results, summary, wanted, folder):
    """The files of the pictures; those of the first page first."""
    if not (results / "fields.pvd").exists():
        return []
    style.setup()
    fields.declare(summary)
    times, written = read_collection(results / "fields.pvd")
    if not len(times):
        return []
    run = Moments(times, written, list(summary.get("mesh", {}).get("bodies", {})), read_points(results / "case.toml"))
    case, sheets = automatic.plan(run, times, summary, read_table(results / "history.csv"), results, {})
    sheet.WIDTH, sheet.HEIGHT = SIZE
    files = []
    for entry in chosen(sheets, wanted):
        files += xray.draw(entry, run, case, folder) if entry.get("kind") == "xray" else overview.draw(entry, run, case, folder)
    return files


def bodies_of(toml, summary):
    """Rows of body, material, temperature at the start, mass."""
    known = {body["name"]: body for body in summary.get("understood", {}).get("bodies", [])}
    rows = []
    for body in toml.get("body", []):
        mass = known.get(body["name"], {}).get("mass[kg]")
        role = "" if body.get("role", "automatic") == "automatic" else f", {body['role']}"
        rows.append((body["name"] + role, Path(str(body.get("material", ""))).stem, _word(body.get("initial_temperature", "")),
                     "" if mass is None else f"{mass:.4g} kg"))
    return rows


def _word(value):
    """A value of a case for people: a table is told by its ends."""
    if isinstance(value, dict):
        points = value.get("points")
        if points:
            return f"of {value.get('of', 'place')}, {_word(points[0][-1])} to {_word(points[-1][-1])} {value.get('unit', '')}".rstrip()
        return ", ".join(f"{key} {_word(entry)}" for key, entry in value.items())
    if isinstance(value, list):
        return ", ".join(map(_word, value))
    return re.sub(r"\bdegC\b", "°C", f"{value:g}" if isinstance(value, float) else str(value))


HEAT_KEYS = ("conductance", "contact_conductance", "exponent", "gap_law", "gas_conductivity", "gap_conductance", "slave_emissivity",
             "master_emissivity", "source")
CONDITION_KEYS = ("coefficient", "ambient", "emissivity", "temperature", "flux", "surroundings", "source")


def _listed(table, keys):
    """The keys of a section that say something, with their values."""
    return ", ".join(f"{key.replace('_', ' ')} {_word(table[key])}" for key in keys
                     if table.get(key) not in (None, "", [], 0, 0.0, "automatic"))


def contacts_of(toml):
    lines = []
    for contact in toml.get("contact", []):
        pair = f"{contact['slave']} on {contact['master']}" if contact.get("slave") else _word(contact.get("surfaces", []))
        said = _listed(contact.get("heat", {}), HEAT_KEYS)
        lines.append(f"{contact.get('name', '')}: {pair}" + (f"; {said}" if said else ""))
    return lines


def surroundings_of(toml):
    lines = []
    for condition in toml.get("thermal_condition", []):
        said = _listed(condition, CONDITION_KEYS)
        lines.append(f"{condition.get('name', '')}: {condition.get('kind', '')} on {_word(condition.get('group', condition.get('groups', '')))}"
                     + (f"; {said}" if said else ""))
    return lines


def numerics_of(toml, summary):
    """What was computed, by how many elements and steps, and what was not."""
    kinds = {"solid": "in three dimensions", "axisymmetric": "axisymmetric", "plane_strain": "in the plane (plane strain)",
             "plane_stress": "in the plane (plane stress)"}
    analysis, mesh = toml.get("analysis", {}), summary.get("mesh", {})
    physics = analysis.get("physics", "thermomechanical")
    what = {"heat": "Heat and freezing", "mechanics": "Stress and contact", "thermomechanical": "Heat, freezing, stress and gaps"}.get(physics, physics)
    elements = sum(mesh.get("elements", {}).values())
    lines = [f"{what}, {kinds.get(analysis.get('kind'), analysis.get('kind', ''))}; {mesh.get('nodes', 0)} nodes, {elements} elements, "
             f"{summary.get('steps', 0)} time steps to {summary.get('end_time[s]', 0):g} s."]
    if "relative_energy_defect" in summary:
        lines.append(f"The first law is met to {summary['relative_energy_defect']:.1e} of the heat exchanged.")
    if physics == "heat":
        lines.append("Stress, distortion and gaps that open were not computed.")
    if "filling" not in toml:
        lines.append("The mould is full at the start: how the metal flows in was not computed.")
    return [" ".join(lines)]


def _property(name):
    """A property of a card as the page calls it."""
    return "strength by place" if name == "local" else name.replace("_", " ").replace(".", ", ")


def materials_of(cards):
    """One entry a material, with its bodies."""
    found = {}
    for card in cards:
        name = card["material"]
        if name not in found:
            content = card.get("card", {})
            sources = [(_property(source["property"]), source["source"] or "no source given")
                       for source in content.get("sources", [])]
            title = content.get("title") or name
            found[name] = MaterialSources(title, [], sources or [("", card.get("missing", "no sources are given"))])
        found[name].bodies.append(card["body"])
    return list(found.values())


def report_of(results, summary, cards, template):
    """Everything but the pictures."""
    toml = automatic.read_case(results)
    title = template.text("title") or summary.get("title") or results.resolve().parent.name
    variant = summary.get("variant", "")
    outcome = f"{summary.get('case', '')}{'' if variant in ('', 'default') else ':' + variant}, {summary.get('outcome', 'not ended')}"
    date = template.text("date") or datetime.date.today().isoformat()
    warnings = [warning if isinstance(warning, str) else warning.get("text", str(warning)) for warning in summary.get("warnings", [])]
    return Report(title, date, f"Solidus {summary.get('solidus', '')}", outcome, answers_of(summary), bodies=bodies_of(toml, summary),
                  contacts=contacts_of(toml), surroundings=surroundings_of(toml), numerics=numerics_of(toml, summary),
                  materials=materials_of(cards), warnings=warnings)


def write(results, cards, template_file, output):
    """Writes the PDF, or the page where no browser writes one; the lines that tell which."""
    summary = read_summary(results)
    if summary.get("kind") == "point":
        raise ResultError(f"{results}: a material point has no part to report on; a run of a case has")
    template = read_template(find_template(template_file, summary.get("case")))
    report = report_of(results, summary, cards, template)
    pdf = Path(output) if output else results / "report.pdf"
    page = pdf.with_suffix(".print.html")
    with tempfile.TemporaryDirectory() as folder:
        report.pictures = draw_pictures(results, summary, template.pictures, Path(folder))
        page.write_text(page_of(template, report), encoding="utf-8")
    browser = chromium.find_browser()
    why = chromium.print_page(browser, page, pdf) if browser else "no Chromium, Chrome or Edge is installed"
    if why:
        return [f"No PDF: {why}. The same pages are in {page}: open it in any browser and print it to a file "
                "(A4, margins as the page has them; SOLIDUS_BROWSER names a browser of Chromium's kind)"]
    page.unlink()
    return [f"Report in {pdf} ({pdf.stat().st_size / 1e6:.1f} MB)"]


def main(arguments=None):
    parser = argparse.ArgumentParser(prog="solidus report", description=__doc__.splitlines()[0])
    parser.add_argument("results", type=Path, metavar="RUN")
    parser.add_argument("--cards", type=Path, metavar="FILE", help="the materials of the bodies as the program has them (JSON)")
    parser.add_argument("--template", metavar="FILE")
    parser.add_argument("--output", metavar="FILE")
    options = parser.parse_args(arguments)
    try:
        cards = json.loads(options.cards.read_text()) if options.cards else []
        for line in write(options.results, cards.get("bodies", []) if isinstance(cards, dict) else cards, options.template, options.output):
            print(line)
    except (ResultError, OSError, ValueError) as error:
        print(f"solidus: {sentence(error)}", file=sys.stderr)
        return 1
    return 0
