"""The changes that the pages for developers show, as changes of files.

A block of a page in the format `diff` whose first line names its file shows a change that can be made:

     // src/check/findings/thin_walls.cpp from tests/laws/thin_walls.cpp
    -const AddFindings k_thin_walls{thin_walls()};
    …

With `from` the file is a copy of another one of the tree, else it is there already. A line with an ellipsis alone stands for lines that are left
out; between such lines the lines of a change follow each other as in the file.
"""

from dataclasses import dataclass
from pathlib import Path
import re

BLOCK = re.compile(r"^```diff\n(.*?)^```", re.DOTALL | re.MULTILINE)
FILE = re.compile(r"^ // (\S+)(?: from (\S+))?$")
LEFT_OUT = {"…", "..."}


@dataclass
class Change:
    """The change of one file."""

    file: str
    source: str | None  # it is a copy of this file
    parts: list[tuple[list[str], list[str]]]  # lines before, lines after

    def apply(self, root):
        """Changes the file below a folder. Throws ValueError where lines are not there, or more than once."""
        root = Path(root)
        text = (root / (self.source or self.file)).read_text(encoding="utf-8")
        for before, after in self.parts:
            old = "\n" + "\n".join(before) + "\n"
            if ("\n" + text).count(old) != 1:
                raise ValueError(f"{self.source or self.file} has {('once' if old in text else 'not')} what the page shows:{old}")
            text = ("\n" + text).replace(old, "\n" + "\n".join(after) + "\n")[1:]
        (root / self.file).parent.mkdir(parents=True, exist_ok=True)
        (root / self.file).write_text(text, encoding="utf-8")


def _part(lines):
    """Lines before and after, of lines that begin with what becomes of them."""
    for line in lines:
        if line and line[0] not in " +-":
            raise ValueError(f"a line of a change begins with none of ' +-': {line}")
    return [line[1:] for line in lines if line[:1] != "+"], [line[1:] for line in lines if line[:1] != "-"]


def changes(page):
    """The changes that the text of a page shows, in their order."""
    found = []
    for block in BLOCK.findall(page):
        change, lines = None, []
        for line in [*block.splitlines(), " …"]:
            if named := FILE.match(line):
                change = Change(named[1], named[2], [])
                found.append(change)
            elif change is not None and line.strip() in LEFT_OUT:
                if lines:
                    change.parts.append(_part(lines))
                lines = []
            elif change is not None:
                lines.append(line)
    return found
