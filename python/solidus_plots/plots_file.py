"""plots.toml, the file next to a case that says what is drawn of it (docs/guide/plots.md)."""

from pathlib import Path
import tomllib

from solidus_plots.vtu import ResultError

# What plots.toml may say; anything else is a typo.
FIELD_KEYS = {"quantity", "field", "component", "unit", "contours", "levels", "bands", "colours", "range",
              "above", "below", "smooth"}
SHEET_KEYS = {"file", "only", "title", "times", "columns", "bodies", "magnification", "probes"}
KEYS = {"curves": {"file", "only", "title", "quantity", "lines", "levels", "moments", "until", "name",
                   "compare"},
        "graphs": {"file", "only", "title", "table", "x", "x_quantity", "part", "quantity", "lines", "each",
                   "values", "keep", "from_zero"},
        "measured": {"file", "only", "title", "table", "each", "values", "x", "x_quantity", "quantity", "travel",
                     "shift", "lines"},
        "maps": {"file", "only", "title", "quantity", "field", "component", "unit", "times", "mirror",
                 "magnification", "bodies", "contours", "range"},
        "deformed": {"file", "only", "title", "time", "mirror", "magnification", "bodies"},
        "sections": FIELD_KEYS | SHEET_KEYS | {"planes", "mesh"},
        "surfaces": FIELD_KEYS | SHEET_KEYS | {"plain", "ghost", "clip", "clip_bodies", "view", "up", "edges",
                                               "dimensions"}}
REQUIRED = {"curves": ("file", "lines"), "graphs": ("file", "x", "lines"),
            "measured": ("file", "table", "each", "x", "lines"), "maps": ("file", "field"),
            "deformed": ("file",), "sections": ("file", "field", "planes"), "surfaces": ("file",)}
AUTOMATIC = {"draw", "niyama"}  # of the section of pictures that are drawn unasked
# Keys of a picture that change nothing without another one.
NEEDS = {"surfaces": {"clip_bodies": "clip", **dict.fromkeys(FIELD_KEYS - {"field"}, "field")}}


class Mistake(str):
    """What is wrong with a plots.toml, in words."""


def _number(value):
    return isinstance(value, (int, float)) and not isinstance(value, bool)


def _all(values, fits):
    return isinstance(values, list) and all(fits(value) for value in values)


def _moment(value):
    return _number(value) or (_text(value) and value != "")


def _text(value):
    return isinstance(value, str)


def _table(value):
    return isinstance(value, dict)


# What the value of a key must be: keys, test, words.
VALUES = [
    (("file", "title", "quantity", "field", "unit", "colours", "up", "edges", "table", "x", "name"), _text, "a text"),
    (("only", "bodies", "plain", "ghost", "clip_bodies", "probes"), lambda v: _all(v, _text), "a list of texts"),
    (("times",), lambda v: _all(v, _moment) and v, 'a list of moments [s], "first", "last", names of stages'),
    (("time",), _moment, 'a moment [s], "first", "last" or the name of a stage'),
    (("component", "columns", "bands"), lambda v: _number(v) and v == int(v) and v >= 0, "a whole number"),
    (("magnification", "above", "below", "shift", "until"), _number, "a number"),
    (("range", "view"), lambda v: _all(v, _number) and len(v) == 2, "two numbers"),
    (("contours",), lambda v: _number(v) or _all(v, _number), "a number of lines, or a list of values"),
    (("planes",), lambda v: _all(v, _table) and v, "a list of planes"),
    (("levels", "moments"), lambda v: _all(v, lambda e: _table(e) and _number(e.get("value"))),
     'a list of { value = 1, label = "..." }'),
    (("clip", "keep"), _table, "a table"),
    (("travel",), lambda v: _table(v) and _number(v.get("from")) and _number(v.get("speed")),
     "{ from = 600, speed = -2.5 }"),
    (("smooth", "mesh", "mirror", "dimensions", "from_zero"), lambda v: isinstance(v, bool), "true or false"),
]


def _check_values(path, section, picture):
    for keys, fits, words in VALUES:
        for key in set(keys) & set(picture):
            if not fits(picture[key]):
                raise ResultError(f"{path}: [[{section}]] '{picture['file']}': '{key}' must be {words}, not "
                                  f"{picture[key]!r}")


def find_spec(results, summary):
    """plots.toml next to the case file the run was made of, else cases/CASE/plots.toml of this repository."""
    repository = Path(__file__).resolve().parents[2]
    case_file = Path(summary.get("case", ""))
    places = [case_file.parent, repository / case_file.parent] if case_file.name else []
    places.append(repository / "cases" / results.resolve().parent.name)
    return next((place / "plots.toml" for place in places if (place / "plots.toml").exists()), None)


def read_spec(path):
    """What a plots.toml asks for, and its mistakes: a picture with a mistake is left out, the others stay."""
    try:
        wanted = tomllib.loads(path.read_text(encoding="utf-8-sig"))
    except (tomllib.TOMLDecodeError, UnicodeDecodeError) as error:
        return {}, [Mistake(f"{path}: {error}")]
    spec, mistakes = {}, []
    for section, pictures in wanted.items():
        try:
            if section == "automatic":
                _check_automatic(path, pictures)
                spec[section] = pictures
                continue
            if section not in KEYS:
                raise ResultError(f"{path}: unknown section '{section}'; there are automatic, {', '.join(KEYS)}")
            if not _all(pictures, _table):
                raise ResultError(f"{path}: '{section}' is a list of pictures; write [[{section}]]")
        except ResultError as error:
            mistakes.append(Mistake(error))
            continue
        spec[section] = []
        for picture in pictures:
            try:
                _check_picture(path, section, picture)
                spec[section].append(picture)
            except ResultError as error:
                mistakes.append(Mistake(error))
    return spec, mistakes


def _check_picture(path, section, picture):
    unknown = set(picture) - KEYS[section]
    if unknown:
        raise ResultError(f"{path}: unknown key '{sorted(unknown)[0]}' in [[{section}]]; there are "
                          f"{', '.join(sorted(KEYS[section]))}")
    for key in REQUIRED[section]:
        if key not in picture:
            raise ResultError(f"{path}: a [[{section}]] lacks its '{key}'")
    for key, needed in NEEDS.get(section, {}).items():
        if key in picture and needed not in picture:
            raise ResultError(f"{path}: [[{section}]] '{picture['file']}': '{key}' needs '{needed}'")
    _check_values(path, section, picture)


def _check_automatic(path, wishes):
    unknown = set(wishes) - AUTOMATIC if _table(wishes) else {"list"}
    if unknown:
        raise ResultError(f"{path}: [automatic] knows {', '.join(sorted(AUTOMATIC))}, not '{sorted(unknown)[0]}'")
    if not isinstance(wishes.get("draw", True), bool):
        raise ResultError(f"{path}: [automatic] 'draw' must be true or false")
    if not (_number(wishes.get("niyama", 1)) and wishes.get("niyama", 1) > 0):
        raise ResultError(f"{path}: [automatic] 'niyama' must be a number above zero")


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
