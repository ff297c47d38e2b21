"""Measured history in pages that say what holds: dates, seeds of random cases, and what else a machine computed meanwhile.

    python3 -m solidus_docs.diary          prints what is found, one a line

Such history is kept in docs/log. Left out are pages whose subject are versions, which have dates, and text in code.
"""
import re
import sys

from solidus_docs.links import CODE, ROOT, pages, text_of

ELSEWHERE = ("docs/log/", "docs/releases/", "docs/reference/", "CHANGELOG.md")
MONTHS = "January|February|March|April|May|June|July|August|September|October|November|December"
HISTORY = re.compile(rf"""\b20\d\d-\d\d-\d\d\b|\b\d{{1,2}}\ (?:{MONTHS})\b|\b(?:{MONTHS})\ 20\d\d\b  # a day, a month
    |\b[Ss]eeds?\ \d|\b[Cc]ases?\ \d{{5,6}}\b|\b\d{{5,6}}(?:,|\ and)\ \d{{5,6}}\b   # of random cases
    |\b[Ll]oads?\ (?:of\ )?\d+(?:\ to\ \d+)?\b(?!\ ?(?:%|[kM]?N\b|[kMG]?Pa\b))  # of a machine, not of a body
    |\b(?:busy|busier|idle|quieter)\ machine|\bbeside\ (?:much\ )?other\ work|\bother\ work\ beside
    |\b(?:added|measured)\ later\)""", re.X)


def history(text):
    """What a page tells of when, and along with what else, something was measured."""
    return HISTORY.findall(re.sub(r"\s+", " ", CODE.sub("``", text)))


def mistakes(root=ROOT):
    """Page and words, for every page that keeps such history outside the log."""
    return [f"{page.relative_to(root)}: '{words}'" for page in pages(root)
            if not str(page.relative_to(root)).startswith(ELSEWHERE) for words in history(text_of(page))]


if __name__ == "__main__":
    found = mistakes()
    print("\n".join(found))
    sys.exit(1 if found else 0)
