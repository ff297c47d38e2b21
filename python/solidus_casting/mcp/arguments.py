"""Checks the arguments of a tool against its JSON Schema: as much of JSON Schema as the schemas of the tools use."""

from __future__ import annotations

import difflib
import math
import re
from collections.abc import Mapping
from typing import Any

from ..errors import InputError

_KINDS = {"string": str, "boolean": bool, "object": Mapping, "array": list, "integer": int, "number": (int, float)}
_MOST_TEXT = 4096  # characters of an argument


def check(schema: Mapping[str, Any], arguments: Mapping[str, Any]) -> None:
    """Raises :class:`InputError` for the first argument that does not fit, with what would."""
    known = schema["properties"]
    for name in arguments:
        if name not in known:
            near = difflib.get_close_matches(name, known, 1)
            raise InputError(f"there is no argument '{name}'",
                             f"did you mean '{near[0]}'?" if near else "one of: " + ", ".join(known), key=name)
    for name in schema.get("required", ()):
        if name not in arguments:
            raise InputError(f"the argument '{name}' is missing", known[name]["description"], key=name)
    for name, value in arguments.items():
        _check_value(known[name], value, name)


def _check_value(schema: Mapping[str, Any], value: Any, name: str) -> None:
    kind = schema.get("type")
    if kind and not _is(kind, value):
        raise InputError(f"{value!r} is no {kind}"[:200], schema.get("description", f"a value of type {kind}"), key=name)
    if "enum" in schema and value not in schema["enum"]:
        raise InputError(f"'{value}' is not among the choices", "one of: " + ", ".join(schema["enum"]), key=name)
    if isinstance(value, str) and (len(value) > _MOST_TEXT or "\0" in value):
        raise InputError("the text is too long, or holds a zero", f"at most {_MOST_TEXT} characters", key=name)
    if "pattern" in schema and not re.search(schema["pattern"], value):
        raise InputError(f"{value!r} is none"[:200], schema["description"], key=name)
    if kind in ("integer", "number"):
        least, most = schema.get("minimum", -math.inf), schema.get("maximum", math.inf)
        if not least <= value <= most:
            raise InputError(f"{value:g} is out of range", f"{least:g} to {most:g}", key=name)
    if kind == "array":
        if not schema.get("minItems", 0) <= len(value) <= schema.get("maxItems", math.inf):
            raise InputError(f"{len(value)} entries", f"{schema.get('minItems', 0)} to {schema.get('maxItems', 'any number')}", key=name)
        for entry in value:
            _check_value(schema.get("items", {}), entry, name)
    if kind == "object" and isinstance(schema.get("additionalProperties"), Mapping):
        for key, entry in value.items():
            _check_value(schema["additionalProperties"], entry, f"{name}.{key}")


def _is(kind: str, value: Any) -> bool:
    if isinstance(value, bool):
        return kind == "boolean"
    if kind == "integer" and isinstance(value, float):
        return value.is_integer()
    return isinstance(value, _KINDS[kind])
