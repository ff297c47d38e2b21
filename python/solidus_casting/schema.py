"""The keys that a case may have, from the program's own declarations (``solidus schema``)."""

from __future__ import annotations

import difflib
import functools
import json
from typing import Any

from .errors import InputError
from .verbs import cached

Schema = dict[str, Any]


@functools.lru_cache(maxsize=4)
def _parsed(text: str) -> Schema:
    return json.loads(text)


def case_schema() -> Schema:
    return _parsed(cached("schema"))


def keys(schema: Schema) -> list[str]:
    """Names of the keys of a section."""
    return list(section_of(schema).get("properties", {}))


def section_of(schema: Schema) -> Schema:
    """The alternative of a value that is a section: quantities may be texts or sections."""
    for choice in (schema, *schema.get("anyOf", ())):
        if choice.get("type") == "object" or "properties" in choice:
            return choice
    return {}


def is_section(schema: Schema) -> bool:
    return schema.get("type") == "object" and bool(schema.get("properties"))


def is_list_of_sections(schema: Schema) -> bool:
    return any(choice.get("type") == "array" and is_section(choice.get("items", {}))
               for choice in (schema, *schema.get("anyOf", ())))


def child(schema: Schema, key: str, where: str) -> Schema:
    """What is declared about a key. Raises :class:`InputError` with the nearest names where there is none."""
    section = section_of(schema)
    known = section.get("properties", {})
    if key in known:
        return known[key]
    further = section.get("additionalProperties", True)
    if isinstance(further, dict):
        return further
    if further is True or not known:
        return {}
    near = difflib.get_close_matches(key, known, 1)
    path = f"{where}.{key}" if where else key
    raise InputError(f"there is no key '{key}'" + (f" in {where}" if where else ""),
                     (f"did you mean '{near[0]}'? " if near else "") + "one of: " + ", ".join(known), key=path)


def check_value(value: Any, schema: Schema, path: str) -> None:
    """Raises :class:`InputError` where a value has the wrong kind or is no choice or out of range. What the schema
    leaves open (units, names of groups, what depends on other keys) the program's readers check."""
    problem = _problem(value, schema)
    if problem:
        raise InputError(problem[0], problem[1], key=path)


_KINDS = {"object": dict, "array": (list, tuple), "string": str, "number": (int, float), "integer": int, "boolean": bool}


def _problem(value: Any, schema: Schema) -> tuple[str, str] | None:
    if "anyOf" in schema:
        problems = [_problem(value, choice) for choice in schema["anyOf"]]
        if None in problems:
            return None
        return f"{value!r} does not fit", schema.get("description", "")
    kinds = schema.get("type", [])
    kinds = [kinds] if isinstance(kinds, str) else kinds
    fits = any(isinstance(value, _KINDS[kind]) and (kind == "boolean") == isinstance(value, bool) for kind in kinds)
    if kinds and not fits:
        words = " or ".join({"string": "a text", "number": "a number", "integer": "a whole number", "array": "a list",
                             "boolean": "True or False", "object": "a section"}[kind] for kind in kinds)
        hint = ", for example \"0.5 s\"" if kinds == ["string"] and isinstance(value, (int, float)) else ""
        return f"{value!r} is not {words}", f"{words}{hint}. {schema.get('description', '')}".strip()
    choices = schema.get("enum")
    if choices and value not in choices:
        near = difflib.get_close_matches(str(value), map(str, choices), 1)
        return (f"{value!r} is none of the choices",
                (f"did you mean {near[0]!r}? " if near else "") + "one of: " + ", ".join(map(str, choices)))
    if isinstance(value, (int, float)) and not isinstance(value, bool):
        for bound, holds, word in (("minimum", value >= schema.get("minimum", value), "at least"),
                                   ("maximum", value <= schema.get("maximum", value), "at most"),
                                   ("exclusiveMinimum", value > schema.get("exclusiveMinimum", value - 1), "above"),
                                   ("exclusiveMaximum", value < schema.get("exclusiveMaximum", value + 1), "below")):
            if not holds:
                return f"{value!r} is out of range", f"{word} {schema[bound]}"
    if isinstance(value, (list, tuple)):
        for item in value:
            problem = _problem(item, schema.get("items", {}))
            if problem:
                return problem
    if isinstance(value, dict):
        for key, item in value.items():
            try:
                inner = child(schema, key, "")
            except InputError as error:
                return error.found, error.allowed
            problem = _problem(item, inner)
            if problem:
                return f"'{key}': {problem[0]}", problem[1]
    return None
