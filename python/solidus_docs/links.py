"""What is wrong with the links of the pages: Markdown as it is in the repository.

    python3 -m solidus_docs.links          prints what is wrong, one a line

A link leads to a file or folder of the repository, or to a heading of a page, by the rules of GitHub; addresses of the web are
not visited. Every page leads on to another page. A path in `code` that names sources, from the root of the repository or from
src/ (`room/file`), names some that are there.
"""
import itertools
import pathlib
import re
import sys

ROOT = pathlib.Path(__file__).resolve().parents[2]
FENCE = re.compile(r"^( *)(```+|~~~+).*?^\1\2[ \t]*$", re.S | re.M)
CODE = re.compile(r"(`+)(?:(?!\1).)+\1")
LINK = re.compile(r"!?\[(?:[^\[\]]|\[[^\]]*\])*\]\(([^()\s]*(?:\([^()\s]*\)[^()\s]*)*)(?:\s+\"[^\"]*\")?\)")
HEADING = re.compile(r"^ {0,3}(#{1,6})\s+(.*?)\s*#*$", re.M)
WEB = re.compile(r"^[a-z][a-z+.-]*:")
PATH = re.compile(r"(?<!`)`([\w.*{},-]+(?:/[\w.*{},-]+)+/?)`(?!`)")
SOURCES = {"src", "tests", "bench", "cmake", "python", "web", "examples", "docs"}  # of every page; these name rooms besides:
OF_DEVELOPERS = ("docs/decisions", "docs/developers", "docs/theory", "docs/verification")
MADE = {"build", "results", "plots", "verification"}  # folders that runs and builds write


def pages(root=ROOT):
    """The pages of the site, as they lie in the repository: documents, cases, and pages elsewhere to which those link."""
    found = sorted(root.glob("*.md"))
    found += sorted((root / "docs").rglob("*.md")) + sorted((root / "cases").rglob("*.md"))
    for page in found:  # which grows
        places = [resolved(page, target)[0] for target in links(page)]
        found += sorted({place for place in places if place.suffix == ".md" and place.exists()} - set(found))
    return found


def text_of(page):
    """The text without blocks of code."""
    return FENCE.sub("", page.read_text())


def slug(heading):
    """The anchor that GitHub gives a heading."""
    heading = re.sub(r"!?\[([^\]]*)\]\([^)]*\)", r"\1", heading)
    heading = re.sub(r"[`*]", "", heading).strip().lower()
    return re.sub(r"[^\w\- ]", "", heading).replace(" ", "-")


def anchors(page):
    found, times = set(), {}
    for _, heading in HEADING.findall(text_of(page)):
        name = slug(heading)
        times[name] = times.get(name, -1) + 1
        found.add(name if times[name] == 0 else f"{name}-{times[name]}")
    return found


def links(page):
    """Targets as they are written, without those of the web."""
    text = CODE.sub("``", text_of(page))
    return [target for target in LINK.findall(text) if not WEB.match(target)]


def resolved(page, target):
    """File or folder, and anchor."""
    path, _, anchor = target.partition("#")
    return ((page.parent / path).resolve() if path else page), anchor


def alternatives(path):
    """a/{b,c} means a/b and a/c."""
    parts = [part.split(",") for part in re.split(r"[{}]", path)]
    return ["".join(chosen) for chosen in itertools.product(*parts)]


def dead_paths(page, root=ROOT):
    """Paths of sources in code that are not there. Words in capitals and my_... stand for what a reader would write."""
    name = str(page.relative_to(root))
    found = []
    for path in PATH.findall(text_of(page)):
        first = path.split("/")[0]
        named = first in SOURCES or (name.startswith(OF_DEVELOPERS) and first not in MADE)
        if not named or re.search(r"\b[A-Z]{3,}\b|\bmy_", path):
            continue
        places = (root, root / "src", root / "python", root / "cases", root / "tests", root / "tests/verification", page.parent)
        if not all(any(found_below(place, one) for place in places) for one in alternatives(path)):
            found.append(path)
    return found


def found_below(folder, path):
    """`path` may leave the end of a file's name out (a header and its source), and have the stars of a shell."""
    return any(True for end in ("", ".[ch]pp") for _ in folder.glob(path.rstrip("/") + end))


def mistakes(root=ROOT):
    found, known = [], {}
    for page in pages(root):
        name = page.relative_to(root)
        leads_on = False
        for target in links(page):
            place, anchor = resolved(page, target)
            if not place.exists():
                found.append(f"{name}: '{target}' does not exist")
                continue
            if place.suffix == ".md":
                leads_on = leads_on or place != page
                if place not in known:
                    known[place] = anchors(place)
                if anchor and anchor not in known[place]:
                    found.append(f"{name}: '{target}': the page has no such heading")
        found += [f"{name}: `{path}` is not among the sources" for path in dead_paths(page, root)]
        if not leads_on:
            found.append(f"{name}: no link leads on to another page")
    return found


if __name__ == "__main__":
    wrong = mistakes()
    print("\n".join(wrong))
    sys.exit(1 if wrong else 0)
