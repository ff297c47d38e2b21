"""The library of materials for the page: names, titles, which of them can be cast, and a card with its sources."""

from __future__ import annotations

import functools
import os
import tomllib
from collections.abc import Iterator
from pathlib import Path
from typing import Any

from .. import verbs
from ..errors import InputError


@functools.lru_cache(maxsize=1)
def materials() -> list[dict[str, Any]]:
    """All materials with their titles, as ``solidus materials`` lists them; `alloy` says whether one solidifies, and so can be cast."""
    listed = (line.split(None, 1) for line in verbs.call("materials").splitlines() if line.strip())
    cards = {path.stem: path for folder in reversed(list(_folders())) for path in folder.glob("*.toml")}
    return [{"name": name, "title": title.strip(), "alloy": name not in cards or _solidifies(cards[name])} for name, title in listed]


def _folders() -> Iterator[Path]:
    """Where the program looks for cards: the folders of the user, then its own."""
    yield from map(Path, filter(None, os.environ.get("SOLIDUS_MATERIALS", "").split(":")))
    for level in list(verbs.program().resolve().parents)[:4]:
        yield from (folder for folder in (level / "share/solidus/materials", level / "materials") if folder.is_dir())


def _solidifies(card: Path) -> bool:
    try:
        document = tomllib.loads(card.read_text(encoding="utf-8-sig"))
    except (OSError, ValueError):
        return True  # the program says what is wrong with it
    if "include" in document:
        return True
    return any(isinstance(change, dict) and change.get("solidification") for change in document.get("phase_change", []))


def card(name: str) -> str:
    """The text of a card: values, sources, and how far they may be off. Raises :class:`InputError`."""
    if all(name != known["name"] for known in materials()):
        raise InputError(f"there is no material '{name}'", "one of the list")
    return verbs.call("materials", name)
