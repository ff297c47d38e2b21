"""Writes a case as TOML; the standard library reads it only."""

from __future__ import annotations

import json
import re
from typing import Any, Mapping

_BARE = re.compile(r"[A-Za-z0-9_-]+")


def key_text(key: str) -> str:
    return key if _BARE.fullmatch(key) else json.dumps(key, ensure_ascii=False)


def value_text(value: Any) -> str:
    """A value on one line. Raises ``TypeError`` for what TOML cannot hold."""
    if isinstance(value, bool):
        return "true" if value else "false"
    if isinstance(value, str):
        return json.dumps(value, ensure_ascii=False).replace("\x7f", "\\u007f")
    if isinstance(value, int):
        return str(value)
    if isinstance(value, float):  # those of numpy 2 name their type in repr()
        return {"inf": "inf", "-inf": "-inf", "nan": "nan"}.get(str(value), repr(float(value)))
    if isinstance(value, Mapping):
        return "{" + ", ".join(f"{key_text(k)} = {value_text(v)}" for k, v in value.items()) + "}"
    if hasattr(value, "tolist"):  # numpy's numbers and arrays
        return value_text(value.tolist())
    if isinstance(value, (list, tuple)):
        return "[" + ", ".join(map(value_text, value)) + "]"
    raise TypeError(f"a case cannot hold {value!r}: texts, numbers, true and false, lists and sections")


def _is_sections(value: Any) -> bool:
    return isinstance(value, list) and bool(value) and all(isinstance(item, dict) for item in value)


def document_text(document: Mapping[str, Any]) -> str:
    """The whole file: plain keys first, then ``[sections]`` and ``[[lists of sections]]``."""
    lines: list[str] = []
    _write(document, "", lines)
    return "\n".join(lines).lstrip("\n") + "\n"


def _write(section: Mapping[str, Any], path: str, lines: list[str]) -> None:
    nested = {key: value for key, value in section.items() if isinstance(value, dict) or _is_sections(value)}
    lines += [f"{key_text(key)} = {value_text(value)}" for key, value in section.items() if key not in nested]
    for key, value in nested.items():
        inner = f"{path}.{key_text(key)}" if path else key_text(key)
        for item in value if isinstance(value, list) else [value]:
            lines += ["", f"[[{inner}]]" if isinstance(value, list) else f"[{inner}]"]
            _write(item, inner, lines)
