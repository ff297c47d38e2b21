"""A precompiled header holds the headers as they are, whatever the compiler's cache has seen before."""

import os
import pathlib
import shutil
import subprocess
import tempfile
import unittest

SCRIPT = pathlib.Path(__file__).resolve().parents[2] / "cmake" / "compile_header.sh"


@unittest.skipUnless(shutil.which("ccache") and shutil.which("g++"), "needs ccache and g++")
class PrecompiledHeader(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)
        self.common = self.folder / "common.hxx"
        self.compiled = self.folder / "common.hxx.gch"
        self.environment = {**os.environ, "CCACHE_DIR": str(self.folder / "cache"), "CCACHE_SLOPPINESS": "pch_defines,time_macros"}
        self.environment.pop("CCACHE_DISABLE", None)
        self.write("common.hxx", '#include "numbers.hpp"')
        self.write("nothing.cxx", "")

    def write(self, name, text):
        """A file that is older than its compilation; ccache looks at no other."""
        file = self.folder / name
        file.write_text(text + "\n")
        os.utime(file, (1.7e9, 1.7e9))

    def compile(self, member):
        """The header where its class has this member."""
        self.write("numbers.hpp", f"#pragma once\nstruct Numbers {{ double {member}; }};")
        subprocess.run(["sh", SCRIPT, "ccache", "g++", "-fpch-preprocess", "-Winvalid-pch", "-x", "c++-header", "-include",
                        self.common, "-o", self.compiled, "-c", self.folder / "nothing.cxx"], env=self.environment, check=True)

    def test_the_header_of_one_state_of_the_sources_does_not_stand_in_for_another(self):
        self.compile("first")
        first = self.compiled.read_bytes()
        self.compile("second")
        self.compiled.write_bytes(first)  # back to the first state, and on to a third
        self.compile("third")
        self.write("use.cpp", "double third(const Numbers& n) { return n.third; }")
        use = subprocess.run(["g++", "-Winvalid-pch", "-include", self.common, "-fsyntax-only", self.folder / "use.cpp"],
                             capture_output=True, text=True)
        self.assertEqual(use.returncode, 0, use.stderr)


if __name__ == "__main__":
    unittest.main()
