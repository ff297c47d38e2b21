"""python -m solidus_release BUILD RELEASES: fills RELEASES/VERSION with what is handed out of a build of the preset `portable`.

The packages of Debian that `cpack` made in BUILD/packages, the archive with its bill of materials where this is the Debian on which it
is made, the notes, and SHA256SUMS of all. Packages that another release of Debian has made of the same commit and that were laid into the
folder stay and are summed too. SOURCE_DATE_EPOCH is the date of all files. It prints the folder.
"""

from __future__ import annotations

import argparse
import hashlib
import os
from pathlib import Path
import platform
import shutil
import subprocess
import sys

from . import archive
from .notes import ROOT


def checksums(folder: Path) -> str:
    """SHA-256 of every file in a folder, as `sha256sum --check` reads them."""
    lines = []
    for file in sorted(folder.iterdir()):
        if file.is_file() and file.name != "SHA256SUMS":
            lines.append(f"{hashlib.sha256(file.read_bytes()).hexdigest()}  {file.name}\n")
    return "".join(lines)


def version_of(package: Path) -> str:
    """The version in the name of a package: solidus_0.2.0-1~deb12_amd64.deb has 0.2.0. Empty where it is no such name."""
    parts = package.name.split("_")
    return parts[1].rpartition("-")[0] if len(parts) == 3 else ""


def fill(build: Path, releases: Path, epoch: int) -> Path:
    """Makes the files of a release in a folder that is called as its version, which is returned.

    build : folder of the build, with packages/
    releases : where the folder is made, unless it is there; it may hold packages that another Debian has made of the same commit
    epoch : their date, seconds since 1970
    """
    text = subprocess.run([build / "solidus", "--version"], check=True, capture_output=True, text=True).stdout
    version = text.split()[-1]
    folder = releases / version
    folder.mkdir(parents=True, exist_ok=True)
    made = sorted(build.glob("packages/*.deb"))
    for package in [*sorted(folder.glob("*.deb")), *made]:
        if version_of(package) != version:
            raise SystemExit(f"{package} is of another version than {version}, with which it would be handed out")
    for package in made:
        shutil.copyfile(package, folder / package.name)
    system = platform.freedesktop_os_release()
    if (system["ID"], system.get("VERSION_ID")) == ("debian", archive.DEBIAN):
        pack_archive(build, folder, version, epoch)
    else:
        print(f"no archive: it is made on Debian {archive.DEBIAN}, and this is {system['PRETTY_NAME']}. Lay the packages into the folder "
              "of the same version there", file=sys.stderr)
    notes = ROOT / "docs/releases" / f"{version.split('+')[0]}.md"
    shutil.copyfile(notes, folder / f"solidus-{version}-notes.md")
    (folder / "SHA256SUMS").write_text(checksums(folder))
    return folder


def pack_archive(build: Path, folder: Path, version: str, epoch: int) -> None:
    """Makes the archive of a build and its bill of materials."""
    name = f"solidus-{version}-x86_64"
    tree = build / "archive" / name
    shutil.rmtree(tree.parent, ignore_errors=True)
    tree.parent.mkdir()
    bill = archive.make_tree(build, tree, version, archive.DEBIAN, epoch)
    (folder / f"{name}.spdx.json").write_text(bill)
    archive.compress(tree, folder / f"{name}.tar.zst", epoch)
    shutil.rmtree(tree.parent)


if __name__ == "__main__":
    parser = argparse.ArgumentParser(prog="python -m solidus_release", description=__doc__.split("\n")[0])
    parser.add_argument("build", type=Path)
    parser.add_argument("releases", type=Path)
    arguments = parser.parse_args()
    if "SOURCE_DATE_EPOCH" not in os.environ:
        parser.error("SOURCE_DATE_EPOCH is not set: the date of the files, seconds since 1970")
    print(fill(arguments.build, arguments.releases, int(os.environ["SOURCE_DATE_EPOCH"])))
