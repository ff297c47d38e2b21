"""The archive that runs on any Linux on x86-64: programs with every library that they load, the loader among them.

It is made on the Debian whose packages the programs were linked with, from what ``cmake --install`` brings.
"""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path
import os
import shutil
import subprocess

from . import bill_of_materials, libraries

HERE = Path(__file__).resolve().parent
DEBIAN = "12"  # the release that it is made on: parts of its Open MPI 4 are named below
PROGRAMS = Path("libexec/solidus/programs")
# Where each program is called, which finds its data from there.
CALLED_AT = {"solidus": "bin", "mpirun": "bin", "solidus-reader": "libexec/solidus"}
# Components of Open MPI that one machine has no use for: networks, batch systems, the OpenSHMEM library, monitoring, checkpoints.
NOT_PACKED = ("ofi", "openib", "ucx", "psm", "psm2", "slurm", "flux", "jsm", "gridengine", "simulator", "monitoring", "pessimist", "cm",
              "mpi", "buddy", "ptmalloc", "munge", "rsh")
FAMILIES_NOT_PACKED = ("mtl", "spml", "scoll", "sshmem", "memheap", "atomic", "crs", "vprotocol")
OPEN_MPI = Path("/usr/lib/x86_64-linux-gnu/openmpi/lib/openmpi3")
PMIX = Path("/usr/lib/x86_64-linux-gnu/pmix2/lib/pmix")


@dataclass
class Packed:
    """A file of a package of Debian, and where it lies in the archive."""

    place: Path
    source: Path


def open_mpi_components(folder: Path = OPEN_MPI) -> list[Path]:
    """The components of Open MPI that processes of one machine may use."""
    chosen = []
    for file in sorted(folder.glob("mca_*.so")):
        family, name = file.stem.removeprefix("mca_").split("_", 1)
        if name not in NOT_PACKED and family not in FAMILIES_NOT_PACKED:
            chosen.append(file)
    return chosen


def move_programs(prefix: Path, mpirun: Path) -> None:
    """Puts the programs aside and launchers of their names in their places."""
    folder = prefix / PROGRAMS
    folder.mkdir(parents=True)
    for name, place in CALLED_AT.items():
        called = prefix / place / name
        if name == "mpirun":
            shutil.copy(mpirun, folder / name)
        else:
            shutil.move(called, folder / name)
        text = (HERE / "launcher.sh").read_text().replace("@PLACE@", place).replace("@NAME@", name)
        called.write_text(text)
        called.chmod(0o755)


def pack_libraries(prefix: Path) -> list[Packed]:
    """Copies libraries, plugins and data of Debian's packages that the programs load or read."""
    packed = []

    def pack(source: Path, place: Path) -> None:
        (prefix / place).parent.mkdir(parents=True, exist_ok=True)
        shutil.copyfile(source, prefix / place)
        packed.append(Packed(place, source))

    plugins = [*open_mpi_components()]
    for file in plugins:
        pack(file, Path("lib/openmpi/plugins") / file.name)
    pmix = [file for file in sorted(PMIX.glob("pmix_mca_*.so")) if "slurm" not in file.name]
    for file in pmix:
        pack(file, Path("lib/pmix") / file.name)
    programs = sorted((prefix / PROGRAMS).iterdir())
    for name, file in sorted(libraries.loaded_by([*programs, *plugins, *pmix]).items()):
        pack(file, Path("lib/solidus") / name)
    (prefix / "lib/solidus" / libraries.LOADER).chmod(0o755)
    for file in sorted(Path("/usr/share/openmpi").glob("help-*.txt")):
        pack(file, Path("lib/openmpi/texts") / file.name)
    for file in sorted(Path("/usr/share/xml/udunits").glob("*.xml")):
        pack(file, Path("share/udunits") / file.name)
    packed.append(Packed(PROGRAMS / "mpirun", Path(shutil.which("mpirun") or "mpirun")))
    return packed


def share_equal_files(folder: Path) -> None:
    """Names of one library become links to one file."""
    first: dict[bytes, Path] = {}
    for file in sorted(folder.iterdir()):
        content = file.read_bytes()
        if content in first:
            file.unlink()
            file.symlink_to(first[content].name)
        else:
            first[content] = file


def write_settings(prefix: Path) -> None:
    """Settings of Open MPI in place of those of the system, and an empty folder of profiles."""
    folder = prefix / "lib/openmpi/settings"
    folder.mkdir(parents=True)
    (folder / "openmpi-mca-params.conf").write_text("# Processes of one machine reach each other through its memory.\n"
                                                    "btl = self,vader\npml = ob1\nplm = isolated\n"
                                                    "btl_base_warn_component_unused = 0\n")


def copy_licences(prefix: Path, packages: list[str]) -> None:
    """Copyright files of packages, and the texts that they refer to."""
    folder = prefix / "share/licences"
    folder.mkdir(parents=True)
    for package in packages:
        shutil.copyfile(libraries.copyright_of(package), folder / package.split(":")[0])
    common = folder / "common-licenses"
    common.mkdir()
    for file in sorted(Path("/usr/share/common-licenses").iterdir()):
        shutil.copyfile(file, common / file.name)  # of links what they lead to


def debian_components(packed: list[Packed], release: str) -> list[bill_of_materials.Component]:
    """The packages of what was packed, and of the headers that were compiled in."""
    headers = [Path(header) for header in bill_of_materials.HEADERS if Path(header).exists()]
    owner = libraries.packages_of([one.source for one in packed] + headers)
    places: dict[str, list[str]] = {package: [] for package in owner.values()}
    for one in packed:
        if one.place.suffix != ".txt":
            places[owner[one.source]].append(str(one.place))
    components = []
    for package, files in sorted(places.items()):
        component = bill_of_materials.debian_component(package, release)
        component.files = files
        components.append(component)
    return components


def make_tree(build: Path, prefix: Path, version: str, release: str, epoch: int) -> str:
    """Makes the folder that is packed, and returns its bill of materials.

    build : folder of a build of the preset `portable`
    prefix : the folder, which must not be there
    release : number of the release of Debian that this is
    """
    subprocess.run(["cmake", "--install", build, "--component", "program", "--prefix", prefix, "--strip"], check=True,
                   stdout=subprocess.DEVNULL)
    for module in prefix.rglob("_core*.so"):  # for one version of Debian's Python, and linked with its libraries
        module.unlink()
    shutil.rmtree(prefix / "lib/python3", ignore_errors=True)
    mpirun = Path(shutil.which("mpirun") or "/usr/bin/mpirun").resolve()
    move_programs(prefix, mpirun)
    packed = pack_libraries(prefix)
    share_equal_files(prefix / "lib/solidus")
    write_settings(prefix)
    components = debian_components(packed, release)
    copy_licences(prefix, sorted(component.name for component in components))
    manifest = HERE.parents[1] / "web/report/package.json"
    bill = bill_of_materials.document(version, components + bill_of_materials.script_components(manifest), epoch)
    (prefix / "bill_of_materials.spdx.json").write_text(bill)
    text = (HERE / "archive_readme.md").read_text().replace("@VERSION@", version).replace("@DEBIAN@", release)
    (prefix / "README.md").write_text(text)
    return bill


def compress(prefix: Path, archive: Path, epoch: int) -> None:
    """Packs a folder so that the same files give the same bytes: in order of names, of one date, of no user."""
    tar = ["tar", "--create", "--sort=name", f"--mtime=@{epoch}", "--owner=0", "--group=0", "--numeric-owner", "--mode=u+rw,go+r-w,a+X",
           "--format=gnu", "--directory", prefix.parent, prefix.name]
    with archive.open("wb") as file:
        packing = subprocess.Popen(tar, stdout=subprocess.PIPE, env={**os.environ, "LC_ALL": "C"})
        subprocess.run(["zstd", "-10", "--long=27", "-T2", "--no-progress", "-q"], stdin=packing.stdout, stdout=file, check=True)
        packing.stdout.close()
        if packing.wait() != 0:
            raise SystemExit(f"{archive}: tar failed")
