"""Mould, risers and sizes of elements as ``solidus new`` would make them, before it does."""

from __future__ import annotations

import hashlib
import json
from typing import Any

from ..errors import InputError
from .choices import Choices


def of_choices(choices: Choices) -> str:
    """A mark of the choices on which a preview depends: probes change nothing that it shows."""
    shown = {name: value for name, value in choices.items() if name not in ("probes", "gate")}
    return hashlib.sha256(json.dumps(shown, sort_keys=True).encode()).hexdigest()[:16]


def read(lines: list[str], choices: Choices) -> dict[str, Any]:
    """What ``new --preview`` has printed, with the mark of its choices. Raises :class:`InputError`."""
    try:
        found = json.loads("\n".join(lines))
    except ValueError as error:
        raise InputError(f"`solidus new --preview` printed no JSON: {error}") from error
    return {**found, "of": of_choices(choices)}
