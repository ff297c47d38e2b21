"""The template of a customer's report: a TOML file with logo, names and words (docs/guide/customer.md)."""

import base64
from dataclasses import dataclass, field
from pathlib import Path
import re
import tomllib

from solidus_plots.vtu import ResultError

NAME = "customer.toml"  # next to the case
IMAGES = {".png": "image/png", ".jpg": "image/jpeg", ".jpeg": "image/jpeg", ".svg": "image/svg+xml", ".gif": "image/gif"}
LARGEST_LOGO = 2_000_000  # bytes
LONGEST_INTRODUCTION = 900  # characters, for which the first page has room

# Every word that stands on the page whatever was computed; [words] of a template replaces them, in another language too.
WORDS = {
    "report": "Report on a casting simulation", "customer": "Customer", "order": "Order", "part": "Part", "author": "Author",
    "date": "Date", "program": "Program", "outcome": "The run", "summary": "In short", "pictures": "Pictures", "answers": "Answers",
    "answer": "Answer", "value": "Value", "error": "Error by step and mesh (±)", "no_error": "not estimated",
    "assumptions": "Assumptions", "bodies": "Bodies", "body": "Body", "material": "Material", "start": "At the start",
    "mass": "Mass", "contacts": "Heat between bodies", "surroundings": "Surroundings", "numerics": "How it was computed",
    "materials": "Materials and sources", "property": "Property", "source": "Source", "warnings": "Warnings of the program",
    "remarks": "Remarks", "limits": "What the numbers are",
    "limits_text": "The errors are estimates of what time step and mesh change in an answer, half widths. They do not hold what is "
                   "uncertain in the data of materials and surroundings; the sources on the last page tell where those come from, and "
                   "the word \"estimate\" marks values that were not measured for this alloy.",
    "page": "Page",
}
TEXTS = ("title", "company", "address", "logo", "customer", "order", "part", "author", "date", "introduction", "remarks", "footer",
         "colour")


@dataclass
class Template:
    """What a template says; empty texts where it does not."""

    texts: dict = field(default_factory=dict)
    words: dict = field(default_factory=lambda: dict(WORDS))
    pictures: list = field(default_factory=list)  # fields to show, in their order; empty: chosen by the program
    logo: str = ""  # as a data URI

    def text(self, name):
        return self.texts.get(name, "")


def find_template(named, case_file):
    """The template that was named, else customer.toml next to the case, else none. Throws ResultError for a name without file."""
    if named:
        if not Path(named).is_file():
            raise ResultError(f"{named}: there is no such file; --template takes a TOML file such as {NAME}")
        return Path(named)
    beside = Path(case_file).parent / NAME if case_file else None
    return beside if beside and beside.is_file() else None


def read_template(path):
    """Throws ResultError, which names the file, the key and what is allowed."""
    if path is None:
        return Template()
    try:
        given = tomllib.loads(path.read_text(encoding="utf-8-sig"))
    except (tomllib.TOMLDecodeError, UnicodeDecodeError) as error:
        raise ResultError(f"{path}: {error}") from error
    words, pictures = given.pop("words", {}), given.pop("pictures", [])
    _check(path, "key", given, TEXTS + ("pictures", "[words]"))
    if not isinstance(words, dict):
        raise ResultError(f"{path}: 'words' must be a section [words] with texts")
    _check(path, "word in [words]", words, tuple(WORDS))
    if not (isinstance(pictures, list) and all(isinstance(name, str) for name in pictures)):
        raise ResultError(f"{path}: 'pictures' must be a list of names of fields, not {pictures!r}")
    if "colour" in given and not re.fullmatch(r"#[0-9a-fA-F]{6}", given["colour"]):
        raise ResultError(f"{path}: 'colour' must be like \"#1f4e79\", not {given['colour']!r}")
    if len(given.get("introduction", "")) > LONGEST_INTRODUCTION:
        raise ResultError(f"{path}: 'introduction' has {len(given['introduction'])} characters; {LONGEST_INTRODUCTION} are allowed, "
                          "'remarks' on the third page may be longer")
    logo = _logo(path, given["logo"]) if given.get("logo") else ""
    return Template(given, {**WORDS, **words}, pictures, logo)


def _check(path, what, given, allowed):
    """All names are known and all values are texts."""
    for key, value in given.items():
        if key not in allowed:
            raise ResultError(f"{path}: unknown {what} '{key}'; there are {', '.join(allowed)}")
        if not isinstance(value, str):
            raise ResultError(f"{path}: '{key}' must be a text, not {value!r}")


def _logo(path, name):
    """The image file, whose path counts from the template, as a data URI."""
    file = path.parent / name
    kind = IMAGES.get(file.suffix.lower())
    if kind is None:
        raise ResultError(f"{path}: 'logo' must be an image ({', '.join(IMAGES)}), not '{name}'")
    if not file.is_file():
        raise ResultError(f"{path}: the logo '{file}' is not there")
    content = file.read_bytes()
    if len(content) > LARGEST_LOGO:
        raise ResultError(f"{path}: the logo '{file}' has {len(content) / 1e6:.1f} MB; {LARGEST_LOGO / 1e6:g} MB are allowed")
    return f"data:{kind};base64,{base64.b64encode(content).decode()}"
