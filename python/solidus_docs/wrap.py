"""Wraps the text of Markdown pages at 120 columns.

    python3 -m solidus_docs.wrap           wraps the pages that are written by hand
    python3 -m solidus_docs.wrap --check   prints the lines that would change, and fails if there are any

Paragraphs, list items and quotations are wrapped. Headings, tables, blocks of code, formulas on lines of their own, HTML and the
head of a page stay as they are. A line never ends inside `code`, $formula$ or the target of a link, and never begins with what
Markdown would take for a list, a heading or a quotation.
"""
import argparse
import pathlib
import re
import sys

from solidus_docs import links

WIDTH = 120
GENERATED = ("docs/reference", "docs/theory/equations.md", "docs/verification/defaults.md")  # their programs write them again

FENCE = re.compile(r" *(```+|~~~+)")
LIST = re.compile(r"( *)([-*+]|\d+[.)])( +)(?=\S)")
QUOTE = re.compile(r"> ?")
ALONE = re.compile(r" {0,3}(#{1,6} |\||<|\[[^\]]+\]: |!!! |\?\?\? |([-*_] *){3,}$|=+$|-+$)")  # lines that are no text
ATOM = re.compile(r"(`+)(?:(?!\1).)+?\1|\$[^$\n]+\$|\]\([^)\s]*(?:\s\"[^\"]*\")?\)|\S")
STARTS = re.compile(r"([-+*>|=:]|#{1,6}|\d+[.)])$|[<>|]|```|~~~|\$\$")  # words that must not begin a line


def words(text):
    """The words of a text; what is in code, in a formula or in the target of a link belongs to one word."""
    found, start, end = [], None, 0
    for atom in ATOM.finditer(text):
        if start is not None and atom.start() > end:
            found.append(text[start:end])
            start = None
        if start is None:
            start = atom.start()
        end = atom.end()
    if start is not None:
        found.append(text[start:end])
    return found


def filled(text, first, further):
    """Lines of at most 120 columns; `first` and `further` are written before the first line and before the others."""
    lines, line = [], first
    empty = True
    for word in words(text):
        if not empty and len(line) + 1 + len(word) > WIDTH and not STARTS.match(word):
            lines.append(line)
            line, empty = further, True
        line += word if empty else " " + word
        empty = False
    return lines + [line]


class Wrapper:
    """Reads a page line by line; `lines` is the wrapped page."""

    def __init__(self):
        self.lines = []
        self.paragraph = []  # its lines as they are read, without what is before them
        self.first = self.further = ""  # what is before its first line, and before the others
        self.ends = None  # tells of a line whether it ends the block that is left as it is

    def read(self, line, number):
        if self.ends:
            self.ends = None if self.ends(line) else self.ends
            self.lines.append(line)
        elif self.begins_block(line, number) or not line.strip() or ALONE.match(line) or self.is_indented_code(line):
            self.end_paragraph()
            self.lines.append(line)
        else:
            self.read_text(line)

    def begins_block(self, line, number):
        """The head of a page, a block of code or a formula on lines of its own: all up to its end stays as it is."""
        fence = FENCE.match(line)
        if number == 0 and line == "---":
            self.ends = lambda later: later == "---"
        elif fence:
            self.ends = re.compile(rf" *{re.escape(fence[1])}[`~]*\s*$").match
        elif line.lstrip().startswith("$$"):
            if line.count("$$") == 1:
                self.ends = lambda later: later.rstrip().endswith("$$")
        else:
            return False
        return True

    def is_indented_code(self, line):
        return not self.paragraph and re.match(r" {4,}|\t", line) and not LIST.match(line) and not inside_list(self.lines)

    def read_text(self, line):
        item, quote = LIST.match(line), QUOTE.match(line)
        before = item or quote or re.match(r" *", line)
        if item:
            self.end_paragraph()
        if not self.paragraph:
            self.first = before[0]
            self.further = " " * len(before[0]) if item else before[0]
        self.paragraph.append(line[before.end():])

    def end_paragraph(self):
        part, first = [], self.first
        for number, line in enumerate(self.paragraph, 1):
            part.append(line.strip())
            is_break = line.endswith(("  ", "\\"))  # Markdown's two ways to end a line
            if is_break or number == len(self.paragraph):
                self.lines += filled(" ".join(part), first, self.further)
                self.lines[-1] += "  " if line.endswith("  ") else ""
                part, first = [], self.further
        self.paragraph = []


def wrapped(text):
    """A page, wrapped."""
    wrapper = Wrapper()
    for number, line in enumerate(text.split("\n")):
        wrapper.read(line, number)
    wrapper.end_paragraph()
    return "\n".join(wrapper.lines)


def inside_list(lines):
    """Whether what is indented belongs to a list item above it."""
    for line in reversed(lines):
        if LIST.match(line):
            return True
        if line.strip() and not line.startswith(" "):
            return False
    return False


def by_hand(root=links.ROOT):
    """The pages that people write."""
    return [page for page in links.pages(root) if not str(page.relative_to(root)).startswith(GENERATED)]


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--check", action="store_true", help="say what would change, change nothing")
    check = parser.parse_args().check
    changed = []
    for page in by_hand():
        text = page.read_text()
        better = wrapped(text)
        if better == text:
            continue
        changed.append(page)
        if check:
            was, now = text.split("\n"), better.split("\n")
            number = next((n for n, (a, b) in enumerate(zip(was, now), 1) if a != b), min(len(was), len(now)))
            print(f"{page.relative_to(links.ROOT)}:{number}: not wrapped at {WIDTH} columns; ./dev format wraps it")
        else:
            page.write_text(better)
    return 1 if check and changed else 0


if __name__ == "__main__":
    sys.exit(main())
