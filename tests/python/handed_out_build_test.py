"""What is handed out is the same to the byte wherever the sources lie, also in a folder with a blank in its name."""

from pathlib import Path
import shutil
import subprocess
import tempfile
import unittest

OPTIONS = Path(__file__).resolve().parents[2] / "cmake/compile_options.cmake"
PROJECT = """cmake_minimum_required(VERSION 3.25)
project(place LANGUAGES CXX)
include({options})
add_library(place STATIC place.cpp)
target_link_libraries(place PRIVATE solidus_options)
"""


@unittest.skipUnless(shutil.which("cmake") and shutil.which("ninja") and shutil.which("clang++"), "needs cmake, ninja and clang++")
class HandedOutBuild(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = Path(folder.name)

    def library(self, name, knows_sources):
        """A library, built in a folder of this name, whose function returns the file that it is in."""
        tree = self.folder / name
        tree.mkdir()
        (tree / "CMakeLists.txt").write_text(PROJECT.format(options=OPTIONS))
        (tree / "place.cpp").write_text("const char* place();\nconst char* place() { return __FILE__; }\n")
        for command in (["-G", "Ninja", "-B", tree / "build", "-S", tree, "-DCMAKE_BUILD_TYPE=Release", "-DCMAKE_CXX_COMPILER=clang++",
                         f"-DSOLIDUS_KNOWS_SOURCES={knows_sources}"], ["--build", tree / "build"]):
            done = subprocess.run(["cmake", *command], capture_output=True, text=True)
            self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
        return (tree / "build/libplace.a").read_bytes()

    def test_packages_and_archive_know_no_folder_of_the_machine_that_built_them(self):
        one = self.library("one", "OFF")
        self.assertEqual(self.library("another folder", "OFF"), one)
        self.assertNotIn(str(self.folder).encode(), one)

    def test_a_program_of_ones_own_names_its_sources_in_full(self):
        self.assertIn(str(self.folder / "one/place.cpp").encode(), self.library("one", "ON"))


if __name__ == "__main__":
    unittest.main()
