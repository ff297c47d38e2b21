"""Whether a version is described: its notes in docs/releases and its part of the changelog."""

from __future__ import annotations

from pathlib import Path
import re
import sys

ROOT = Path(__file__).resolve().parents[2]


def part_of_changelog(text: str, version: str) -> str:
    """What the changelog says of a version, without its heading; empty where it says nothing."""
    found = re.search(rf"^## {re.escape(version)} - \d{{4}}-\d\d-\d\d\n(.*?)(?=^## |\Z)", text, re.MULTILINE | re.DOTALL)
    return found[1].strip() if found else ""


def missing(version: str, root: Path = ROOT) -> list[str]:
    """What is not there yet of what a version has to bring, a sentence each."""
    lacks = []
    notes = root / f"docs/releases/{version}.md"
    if not notes.exists():
        lacks.append(f"{notes.relative_to(root)} is missing: notes that a person reads in two minutes")
    elif len(notes.read_text().split()) < 50:
        lacks.append(f"{notes.relative_to(root)} says nothing yet")
    elif len(notes.read_text().split()) > 600:
        lacks.append(f"{notes.relative_to(root)} has more than 600 words, which take more than two minutes")
    if not part_of_changelog((root / "CHANGELOG.md").read_text(), version):
        lacks.append(f"CHANGELOG.md has no part '## {version} - YEAR-MONTH-DAY'")
    return lacks


if __name__ == "__main__":
    said = missing(sys.argv[1])
    print("".join(f"{line}\n" for line in said), end="", file=sys.stderr)
    sys.exit(1 if said else 0)
