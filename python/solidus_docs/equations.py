"""Where the equations of the monograph stand in the sources and in the theory.

    python3 -m solidus_docs.equations              writes docs/theory/equations.md
    python3 -m solidus_docs.equations 4.97         prints the places of an equation

An equation is cited in comments as (2.49a) or 4.31–4.54; ranges are spelled out here.
"""
import pathlib
import re
import sys

ROOT = pathlib.Path(__file__).resolve().parents[2]
PAGE = ROOT / "docs/theory/equations.md"
# The last equation of each chapter of CIMNE monograph 48.
LAST = {2: 151, 3: 76, 4: 152, 5: 63, 6: 34}
CHAPTERS = {
    2: "The thermodynamic framework and the constitutive law",
    3: "Contact",
    4: "Time integration: splits and return mappings",
    5: "Contact in time",
    6: "Elements and integration",
}
NUMBER = r"[2-6]\.\d{1,3}[a-d]?"
RANGE = rf"({NUMBER})\s*[–-]\s*({NUMBER})"
# Inside parentheses any number of this form is an equation; outside of them one with two digits behind the point
# or a letter, after a word that introduces it.
INTRODUCED = re.compile(rf"(?:\b(?:of|in|to|by|and|with|from|see|for|as|equation|monograph|errata)\s|,\s)({NUMBER})\b")
PARENTHESES = re.compile(r"\(([^()]*)\)")


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


def cited(text):
    """The equations that a line of comment or documentation cites."""
    found = []
    for inside in PARENTHESES.findall(text):
        # Sections of the monograph ("4.2.3") and quantities with units are no equations.
        inside = re.sub(r"\d+\.\d+\.\d+", " ", inside)
        for first, last in re.findall(RANGE, inside):
            found += spelled_out(first, last)
        rest = re.sub(RANGE, " ", inside)
        if re.fullmatch(rf"[\s,;and]*(?:(?:monograph|errata|to|after|as in|as|of|remark|the|see)[\s,]*)*(?:{NUMBER}[\s,;and]*)+"
                        r"(?:[,;:].*|(?:with|but|and|of|in|for|written|without|errata|as|where|there|its|is)\b.*)?", rest):
            found += re.findall(rf"(?<![\d.,]){NUMBER}(?![\d.%])", rest)
    outside = PARENTHESES.sub(" ", text)
    for first, last in re.findall(RANGE, outside):
        if len(first) >= 4 and len(last) >= 4:
            found += spelled_out(first, last)
    for number in INTRODUCED.findall(re.sub(RANGE, " ", outside)):
        _, serial, letter = split(number)
        if serial >= 10 or letter:
            found.append(number)
    return [n for n in dict.fromkeys(found) if known(n)]


def comments(path):
    """(line number, text) of what is comment in a source, of everything in a page."""
    text = path.read_text(encoding="utf-8").splitlines()
    if path.suffix == ".md":
        yield from enumerate(text, 1)
        return
    for number, line in enumerate(text, 1):
        at = line.find("//")
        if at >= 0:
            yield number, line[at:]


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
        for line, text in comments(path):
            for number in cited(text):
                where = found.setdefault(number, {})
                where.setdefault(name, line)
    return {number: list(where.items()) for number, where in found.items()}


def order(number):
    return split(number)


def page(found):
    lines = [
        "# Where each equation stands",
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
