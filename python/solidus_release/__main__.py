"""python -m solidus_release BUILD FOLDER: fills a folder with what is handed out of a build of the preset `portable`.

The packages of Debian that `cpack` made in BUILD/packages, the archive, its bill of materials, the notes, and SHA256SUMS of all. Packages
of other releases of Debian that were laid into the folder stay and are summed too. SOURCE_DATE_EPOCH is the date of all files.
"""

from __future__ import annotations

import argparse
import hashlib
import os
from pathlib import Path
import platform
import shutil
import subprocess

from . import archive
from .notes import ROOT


def checksums(folder: Path) -> str:
    """SHA-256 of every file in a folder, as `sha256sum --check` reads them."""
    lines = []
    for file in sorted(folder.iterdir()):
        if file.is_file() and file.name != "SHA256SUMS":
            lines.append(f"{hashlib.sha256(file.read_bytes()).hexdigest()}  {file.name}\n")
    return "".join(lines)


def fill(build: Path, folder: Path, epoch: int) -> None:
    """Makes the files of a release.

    build : folder of the build, with packages/
    folder : for the files; made where it is not there
    epoch : their date, seconds since 1970
    """
    folder.mkdir(parents=True, exist_ok=True)
    text = subprocess.run([build / "solidus", "--version"], check=True, capture_output=True, text=True).stdout
    version = text.split()[-1]
    for package in sorted(build.glob("packages/*.deb")):
        shutil.copyfile(package, folder / package.name)
    name = f"solidus-{version}-x86_64"
    tree = build / "archive" / name
    shutil.rmtree(tree.parent, ignore_errors=True)
    tree.parent.mkdir()
    release = platform.freedesktop_os_release()["VERSION_ID"]
    bill = archive.make_tree(build, tree, version, release, epoch)
    (folder / f"{name}.spdx.json").write_text(bill)
    archive.compress(tree, folder / f"{name}.tar.zst", epoch)
    shutil.rmtree(tree.parent)
    notes = ROOT / "docs/releases" / f"{version.split('+')[0]}.md"
    shutil.copyfile(notes, folder / f"solidus-{version}-notes.md")
    (folder / "SHA256SUMS").write_text(checksums(folder))


if __name__ == "__main__":
    parser = argparse.ArgumentParser(prog="python -m solidus_release", description=__doc__.split("\n")[0])
    parser.add_argument("build", type=Path)
    parser.add_argument("folder", type=Path)
    arguments = parser.parse_args()
    if "SOURCE_DATE_EPOCH" not in os.environ:
        parser.error("SOURCE_DATE_EPOCH is not set: the date of the files, seconds since 1970")
    fill(arguments.build, arguments.folder, int(os.environ["SOURCE_DATE_EPOCH"]))
