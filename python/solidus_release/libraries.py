"""Shared libraries that programs load, and the packages of Debian that they come from."""

from __future__ import annotations

from pathlib import Path
import re
import subprocess

LOADER = "ld-linux-x86-64.so.2"


def loaded_by(files: list[Path]) -> dict[str, Path]:
    """The libraries that programs and plugins load, and those that these load in turn.

    Returns the file of each by the name under which it is asked for; the loader is one of them. Raises ``SystemExit`` where one is
    missing.
    """
    found: dict[str, Path] = {}
    for file in files:
        text = subprocess.run(["ldd", file], check=True, capture_output=True, text=True).stdout
        missing = re.findall(r"^\s*(\S+) => not found", text, re.MULTILINE)
        if missing:
            raise SystemExit(f"{file}: these libraries are not found: {', '.join(missing)}")
        for name, path in re.findall(r"^\s*(?:(\S+) => )?(/\S+) \(0x", text, re.MULTILINE):
            found[Path(name or path).name] = Path(path)
    return found


def packages_of(files: list[Path]) -> dict[Path, str]:
    """The package of Debian that each file belongs to. Raises ``SystemExit`` for a file of none."""
    # Packages that are older than the union of /lib and /usr/lib list their libraries as of /lib.
    spellings = {}
    for file in files:
        real = file.resolve()
        spellings[file] = [real, Path("/", real.relative_to("/usr" if real.is_relative_to("/usr") else "/"))]
    asked = sorted({str(path) for paths in spellings.values() for path in paths})
    answer = subprocess.run(["dpkg-query", "-S", *asked], capture_output=True, text=True).stdout  # it fails for spellings of no package
    owners = {path: names.split(",")[0] for names, path in re.findall(r"^(\S[^\n]*?): (/\S+)$", answer, re.MULTILINE)
              if not names.startswith("diversion ")}
    owned = {}
    for file, paths in spellings.items():
        known = [owners[str(path)] for path in paths if str(path) in owners]
        if not known:
            raise SystemExit(f"{file}: no package of Debian has it, so that its version and licence are not known")
        owned[file] = known[0]
    return owned


def properties(package: str) -> dict[str, str]:
    """Name, version, source and version of the source of an installed package."""
    form = "${binary:Package}\\n${Version}\\n${source:Package}\\n${source:Version}\\n"
    text = subprocess.run(["dpkg-query", "-W", "-f", form, package], check=True, capture_output=True, text=True).stdout
    name, version, source, source_version = text.splitlines()[:4]
    return {"name": name.split(":")[0], "version": version, "source": source, "source_version": source_version}


def copyright_of(package: str) -> Path:
    """The file in which Debian states the licences of a package."""
    return Path("/usr/share/doc") / package.split(":")[0] / "copyright"
