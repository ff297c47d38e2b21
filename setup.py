"""Puts the program and the compiled part into the wheel of solidus_casting.

SOLIDUS_BUILD names the build folder that they come from; by default build/release where it has them, else they are built in
build/pip, which takes as long as building the program does. SOLIDUS_BUILD=none: Python files alone, for a program that is
installed otherwise.
"""

import os
from pathlib import Path
import re
import shutil
import subprocess

from setuptools import Distribution, setup
from setuptools.command.build_py import build_py

ROOT = Path(__file__).resolve().parent
CHOSEN = os.environ.get("SOLIDUS_BUILD", "")
VERSION = re.search(r"project\(solidus VERSION ([\d.]+)", (ROOT / "CMakeLists.txt").read_text())[1]


def built(folder):
    return (folder / "solidus").exists() and list(folder.glob("python/_core*.so"))


def build_folder():
    """The folder of a build with program and compiled part; it is made where there is none."""
    if CHOSEN:
        folder = Path(CHOSEN).absolute()
        if not built(folder):
            raise SystemExit(f"SOLIDUS_BUILD={CHOSEN}: there is no build with program and compiled part (./dev python makes one)")
        return folder
    if built(ROOT / "build/release"):
        return ROOT / "build/release"
    folder = ROOT / "build/pip"
    subprocess.run(["cmake", "--preset", "portable", "-B", folder, "-DSOLIDUS_TESTS=OFF", "-DSOLIDUS_PYTHON=ON"], cwd=ROOT,
                   check=True)
    subprocess.run(["cmake", "--build", folder, "--parallel", str(len(os.sched_getaffinity(0)))], check=True)
    if not built(folder):
        raise SystemExit("the compiled part was not built: pybind11 is missing (Debian: pybind11-dev, python3-dev)")
    return folder


class WithProgram(build_py):
    """The Python files and, below solidus_casting/installed, what `cmake --install` brings."""

    def run(self):
        shutil.rmtree(self.build_lib, ignore_errors=True)  # where a file that is gone from the sources would linger
        super().run()
        if CHOSEN == "none":
            return
        prefix = Path(self.build_lib).absolute() / "solidus_casting/installed"
        shutil.rmtree(prefix, ignore_errors=True)
        subprocess.run(["cmake", "--install", build_folder(), "--prefix", prefix, "--strip"], check=True,
                       stdout=subprocess.DEVNULL)
        for unwanted in ("share/doc", "share/man", "share/bash-completion", "share/zsh", "share/fish"):
            shutil.rmtree(prefix / unwanted, ignore_errors=True)


class OfThisMachine(Distribution):
    def has_ext_modules(self):
        return CHOSEN != "none"


setup(version=VERSION, cmdclass={"build_py": WithProgram}, distclass=OfThisMachine)
