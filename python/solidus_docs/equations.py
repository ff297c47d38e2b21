"""Where the equations of the monograph are in the sources and in the theory.

    python3 -m solidus_docs.equations              writes docs/theory/equations.md
    python3 -m solidus_docs.equations 4.97         prints the places of an equation

An equation is cited in comments as (2.49a) or 4.31–4.54; ranges are spelled out here.
"""
import bisect
import pathlib
import re
import sys

ROOT = pathlib.Path(__file__).resolve().parents[2]
PAGE = ROOT / "docs/theory/equations.md"
# The last equation of each chapter of CIMNE monograph 48.
LAST = {2: 151, 3: 76, 4: 152, 5: 64, 6: 34}
CHAPTERS = {
    2: "The thermodynamic framework and the constitutive law",
    3: "Contact",
    4: "Time integration: splits and return mappings",
    5: "Contact in time",
    6: "Elements and integration",
}
NUMBER = r"[2-6]\.\d{1,3}[a-d]?"
RANGE = rf"({NUMBER})\s*[–-]\s*({NUMBER})"
# Inside parentheses any number of this form is an equation; outside of them one with a letter, and one with two digits
# behind the point after a word that introduces it, alone in its line, or in a table's column of equations.
INTRODUCED = re.compile(
    rf"(?:\b(?:of|in|to|by|and|with|from|see|for|as|equation|monograph|errata)\s+|,\s+)({NUMBER})\b(?!\.\d)")
NAMED = re.compile(rf"\b(?:equation|monograph|errata)\s+({NUMBER})\b(?!\.\d)")
LETTERED = re.compile(r"(?<![\w.,/\-×\\#])([2-6]\.\d{1,3}[a-d])\b")
PARENTHESES = re.compile(r"\(([^()]*)\)")
ALONE = re.compile(rf"[\s,;–-]*(?:{NUMBER}[\s,;–-]*)+")


def split(number):
    match = re.fullmatch(r"(\d)\.(\d+)([a-d]?)", number)
    return int(match[1]), int(match[2]), match[3]


def known(number):
    chapter, serial, _ = split(number)
    return chapter in LAST and 1 <= serial <= LAST[chapter]


def spelled_out(first, last):
    """All numbers of a range of one chapter; letters count at its ends alone."""
    (chapter, low, letter), (end, high, end_letter) = split(first), split(last)
    if chapter != end or high < low or high - low > 60:
        return [first, last]
    if low == high:
        letters = [chr(c) for c in range(ord(letter or "a"), ord(end_letter or letter or "a") + 1)]
        return [f"{chapter}.{low}{c}" for c in letters]
    return [first] + [f"{chapter}.{n}" for n in range(low + 1, high)] + [last]


def blank(match):
    return " " * len(match[0])


def ranges(text):
    """(place, equation) of all ranges in a text."""
    for match in re.finditer(RANGE, text):
        yield from ((match.start(), number) for number in spelled_out(match[1], match[2]))


def inside_parentheses(text):
    """(place, equation) of what is between two parentheses."""
    # Sections of the monograph ("4.2.3") and quantities with units are no equations.
    text = re.sub(r"\d+\.\d+\.\d+", blank, text)
    yield from ranges(text)
    rest = re.sub(RANGE, blank, text)
    number = rf"(?<![\d.,]){NUMBER}(?![\d.%])"
    if re.fullmatch(rf"[\s,;and]*(?:(?:monograph|errata|to|after|as in|as|of|remark|the|see)[\s,]*)*(?:{NUMBER}[\s,;and]*)+"
                    r"(?:[,;:].*|(?:with|but|and|of|in|for|written|without|errata|as|where|there|its|is)\b.*)?", rest):
        yield from ((match.start(), match[0]) for match in re.finditer(number, rest))
    yield from ((match.start(1), match[1]) for match in [*NAMED.finditer(rest), *LETTERED.finditer(rest)])


def cited_at(text):
    """(place, equation) of what a paragraph of comment or documentation cites."""
    found = []
    for match in PARENTHESES.finditer(text):
        found += [(match.start(1) + at, number) for at, number in inside_parentheses(match[1])]
    outside = PARENTHESES.sub(blank, text)
    found += [(at, number) for at, number in ranges(outside) if len(number) >= 4]
    rest = re.sub(RANGE, blank, outside)
    if ALONE.fullmatch(rest):
        found += [(match.start(), match[0]) for match in re.finditer(NUMBER, rest)]
    found += [(match.start(1), match[1]) for match in LETTERED.finditer(rest)]
    for match in INTRODUCED.finditer(rest):
        _, serial, letter = split(match[1])
        if serial >= 10 or letter:
            found.append((match.start(1), match[1]))
    return sorted((at, number) for at, number in found if known(number))


def cited(text):
    """The equations that a text cites, in their order."""
    return list(dict.fromkeys(number for _, number in cited_at(text)))


def column_of_equations(header):
    """The place of the column of a table that holds equations, from its first line; None: there is none."""
    names = [cell.strip().lower() for cell in header.split("|")]
    return next((i for i, name in enumerate(names) if name in ("equation", "equations", "monograph", "where")), None)


def cited_in_table(rows):
    """(line, equation) of a table of a page."""
    column = column_of_equations(rows[0][1])
    for line, row in rows[2:]:
        cells = re.split(r"(?<!\\)\|", row)
        for i, cell in enumerate(cells):
            listed = i == column and ALONE.fullmatch(cell)
            yield from ((line, number) for number in cited(f"({cell})" if listed else cell if not ALONE.fullmatch(cell) else ""))


def paragraphs(path):
    """[(line number, text)] of each paragraph of comment in a source, of each paragraph and table in a page."""
    page, found = path.suffix == ".md", []
    for number, line in enumerate([*path.read_text(encoding="utf-8").splitlines(), ""], 1):
        at = 0 if page else line.find("//")
        text = line if page else line[at:].lstrip("/<").strip() if at >= 0 else ""
        ends = not text.strip() or (found and text.startswith("|") != found[-1][1].startswith("|"))
        if ends and found:
            yield found
            found = []
        if text.strip():
            found.append((number, text))


def citations(path):
    """(line, equation) of a file."""
    for lines in paragraphs(path):
        if path.suffix == ".md" and lines[0][1].startswith("|"):
            yield from cited_in_table(lines)
            continue
        starts = [0]
        for _, text in lines:
            starts.append(starts[-1] + len(text) + 1)
        for at, number in cited_at(" ".join(text for _, text in lines)):
            yield lines[bisect.bisect_right(starts, at) - 1][0], number


def sources():
    for pattern in ("src/**/*.hpp", "src/**/*.cpp"):
        yield from sorted(ROOT.glob(pattern))


def pages():
    yield from sorted(p for p in (ROOT / "docs/theory").glob("*.md") if p.name not in (PAGE.name, "errata.md"))


def places():
    """{equation: [(path relative to the root, line)]}, each path once with its first line."""
    found = {}
    for path in [*sources(), *pages()]:
        name = path.relative_to(ROOT).as_posix()
        for line, number in citations(path):
            found.setdefault(number, {}).setdefault(name, line)
    return {number: list(where.items()) for number, where in found.items()}


def order(number):
    return split(number)


def page(found):
    lines = [
        "# Where each equation is used",
        "The equations of the monograph (Chiumenti, Agelet de Saracibar and Cervera, CIMNE monograph 48, 1999) and where "
        "the sources and these pages cite them; made by `./dev docs` from the comments. `./dev equation 4.97` prints the "
        "lines of one. What is misprinted and what is used instead: [errata](errata.md).",
    ]
    for chapter, title in CHAPTERS.items():
        lines += ["", f"## {chapter} {title}", "| equation | sources | theory |", "|---|---|---|"]
        for number in sorted((n for n in found if split(n)[0] == chapter), key=order):
            code = [f"[{pathlib.Path(p).name}:{line}](../../{p}#L{line})" for p, line in found[number] if p.startswith("src/")]
            text = [f"[{pathlib.Path(p).stem}]({pathlib.Path(p).name})" for p, line in found[number] if p.startswith("docs/")]
            lines.append(f"| {number} | {', '.join(code)} | {', '.join(text)} |")
    return "\n".join(lines) + "\n"


def main():
    found = places()
    if len(sys.argv) > 1:
        for number in sys.argv[1:]:
            matches = [n for n in sorted(found, key=order) if n == number or n.rstrip("abcd") == number]
            if not matches:
                sys.exit(f"no source cites equation {number}")
            for match in matches:
                for path, line in found[match]:
                    print(f"{match}  {path}:{line}")
        return
    PAGE.write_text(page(found), encoding="utf-8")


if __name__ == "__main__":
    main()
