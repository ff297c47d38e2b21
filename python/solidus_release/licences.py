"""Licences that Debian states in the copyright files of its packages, in the words of SPDX."""

from __future__ import annotations

import re

# Debian's short names that SPDX spells otherwise; a + behind a version is "or any later version".
_SPDX = {
    "apache-2.0": "Apache-2.0", "apache-2": "Apache-2.0", "artistic": "Artistic-1.0-Perl", "boost-1.0": "BSL-1.0", "bsl-1.0": "BSL-1.0",
    "bsd-2-clause": "BSD-2-Clause", "bsd-3-clause": "BSD-3-Clause", "bsd-4-clause": "BSD-4-Clause", "cc0-1.0": "CC0-1.0",
    "cecill-c": "CECILL-C", "expat": "MIT", "isc": "ISC", "mit": "MIT", "mpl-2.0": "MPL-2.0", "zlib": "Zlib", "x11": "X11",
    "curl": "curl", "libpng": "Libpng", "ijg": "IJG", "ftl": "FTL",
}


def _name(word: str) -> str:
    """One licence: its identifier of SPDX, or a reference that the bill of materials explains."""
    known = _SPDX.get(word.lower())
    if known:
        return known
    gnu = re.fullmatch(r"(A?L?GPL)-(\d)(?:\.(\d))?(\+|-or-later|-only)?", word, re.IGNORECASE)
    if gnu:
        family, major, minor, suffix = gnu.groups()
        return f"{family.upper()}-{major}.{minor or 0}-{'or-later' if suffix in ('+', '-or-later') else 'only'}"
    return "LicenseRef-" + re.sub(r"[^A-Za-z0-9.]+", "-", word).strip("-")


def expression(text: str) -> str:
    """An expression of Debian's (``GPL-2+ or MIT``) as one of SPDX. Exceptions (``with``) are part of a name of their own."""
    alternatives = []
    for alternative in re.split(r",?\s+or\s+", text.strip()):
        parts = sorted({_name(part.strip()) for part in re.split(r",?\s+and\s+|,\s*", alternative) if part.strip()})
        alternatives.append(" AND ".join(parts))
    if len(alternatives) == 1:
        return alternatives[0]
    return " OR ".join(f"({part})" if " AND " in part else part for part in alternatives)


def declared(copyright_text: str, package: str) -> str:
    """The licences of what a package holds, all of which apply.

    The file lists them by paragraphs of files (Debian's machine-readable form); what concerns the packaging alone (``debian/*``) is
    left out. A file in another form is referred to as a whole, ``LicenseRef-PACKAGE``.
    """
    found = set()
    for paragraph in re.split(r"\n\s*\n", copyright_text):
        files = re.search(r"^Files:(.*(?:\n[ \t].*)*)", paragraph, re.MULTILINE)
        licence = re.search(r"^License:[ \t]*(\S.*)$", paragraph, re.MULTILINE)
        if files and licence and not all(name.startswith("debian/") for name in files[1].split()):
            stated = expression(licence[1])
            found |= {stated} if " OR " in stated else set(stated.split(" AND "))
    if not found:
        return _name(package)
    return " AND ".join(f"({one})" if " OR " in one and len(found) > 1 else one for one in sorted(found))


def references(spdx: str) -> set[str]:
    """The names in an expression that SPDX does not know, and that a bill of materials has to explain."""
    return set(re.findall(r"LicenseRef-[A-Za-z0-9.\-]+", spdx))
