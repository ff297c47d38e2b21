"""An installed program, moved to another folder, finds what it brought; ./dev works from any folder."""

import os
from pathlib import Path
import shutil
import subprocess
import sys
import unittest

from program import PROGRAM, SOURCES, ProgramTest


class Installed(ProgramTest):
    def packed(self):
        """Debian's package of this build, by cpack as ./dev package calls it; None where its tools are missing."""
        if any(shutil.which(tool) is None for tool in ("dpkg-deb", "dpkg-shlibdeps", "file")):
            return None
        done = subprocess.run(["cpack", "--config", Path(PROGRAM).parent / "CPackConfig.cmake", "-B", self.folder / "packages",
                               "-D", "CPACK_COMPONENTS_ALL=program", "-D", "CPACK_DEBIAN_COMPRESSION_TYPE=none"],
                              cwd=self.folder, capture_output=True, text=True)
        self.assertEqual(done.returncode, 0, done.stdout[-2000:] + done.stderr[-2000:])
        package, = (self.folder / "packages").glob("solidus_*_amd64.deb")
        return package

    def installed(self):
        """A prefix that was made in one place and lies in another: what the package holds, or what cmake installs."""
        package = self.packed()
        if package is None:
            prefix = self.folder / "prefix"
            subprocess.run(["cmake", "--install", Path(PROGRAM).parent, "--component", "program", "--prefix", prefix], check=True,
                           capture_output=True)
            return prefix.rename(self.folder / "moved")
        needed = subprocess.run(["dpkg-deb", "-f", package, "Depends"], check=True, capture_output=True, text=True).stdout
        self.assertIn("libopenblas0-serial | libopenblas0", needed)
        for library in ("libpetsc-real", "libopenmpi", "libhdf5-openmpi-", "libmetis"):  # the release numbers them
            self.assertRegex(needed, rf"(^|, ){library}\d")
        unpacked = self.folder / "unpacked"
        subprocess.run(["dpkg-deb", "-x", package, unpacked], check=True)
        shutil.rmtree(self.folder / "packages")  # it is large
        # Debian's Python is told of our package, and forgets one that is installed here.
        site = unpacked / "usr/lib/python3/dist-packages"
        code = ("import site, sys; sys.path = [path for path in sys.path if '/usr/share/solidus' not in path];"
                f"site.addsitedir({str(site)!r}); import solidus_casting as sc; print(sc.__file__, sc.program());"
                "print(sys.modules['solidus_casting._core'].__file__ if sc.has_core() else 'none')")
        environment = {name: value for name, value in os.environ.items() if name not in ("SOLIDUS_PROGRAM", "PYTHONPATH")}
        where = subprocess.run([sys.executable, "-c", code], check=True, capture_output=True, text=True, env=environment).stdout.split()
        self.assertEqual([Path(path).resolve() for path in where[:2]],
                         [unpacked / "usr/share/solidus/python/solidus_casting/__init__.py", unpacked / "usr/bin/solidus"])
        if "SOLIDUS_EXPECT_CORE" in os.environ:  # pybind11 was there, so that `material` and `Simulation` are in the package
            self.assertEqual(Path(where[2]).resolve().parent, unpacked / "usr/share/solidus/python/solidus_casting")
        return unpacked / "usr"

    def test_a_package_or_prefix_holds_all_of_it_and_may_be_moved(self):
        moved = self.installed()
        for file in ("bin/solidus", "share/bash-completion/completions/solidus", "share/zsh/site-functions/_solidus",
                     "share/fish/vendor_completions.d/solidus.fish", "share/man/man1/solidus.1",
                     "share/solidus/schema/case.schema.json", "share/solidus/python/solidus_plots/plot_case.py",
                     "share/solidus/python/solidus_casting/case.py",
                     "share/doc/solidus/README.md", "share/doc/solidus/docs/guide/getting_started.md",
                     "share/solidus/cases/hot_spots/case.toml"):
            self.assertGreater((moved / file).stat().st_size, 0, file)

        # Only the moved prefix has this material and this greeting.
        shared = moved / "share/solidus"
        text = (shared / "materials/green_sand.toml").read_text()
        (shared / "materials/my_sand.toml").write_text(text)
        with (shared / "python/solidus_plots/__init__.py").open("a") as module:
            module.write('\nprint("the installed one")\n')
        self.write("results/history.csv", "time[s],T_a[degC]\n0,20\n10,30\n")

        def said(*arguments):
            return subprocess.run([moved / "bin/solidus", *arguments], cwd=self.folder, capture_output=True, text=True,
                                  check=True).stdout

        self.assertIn("my_sand", said("materials"))
        drawn = said("plot", "results")
        self.assertIn("the installed one", drawn)
        self.assertTrue((self.folder / "results/plots/history_degC.png").exists())
        # So does the Python package, without a word about where the program is.
        environment = {name: value for name, value in os.environ.items() if name != "SOLIDUS_PROGRAM"}
        found = subprocess.run([sys.executable, "-c", "import solidus_casting as sc; print(sc.program(), sc.version())"],
                               env={**environment, "PYTHONPATH": str(shared / "python")}, capture_output=True, text=True, check=True)
        self.assertEqual(Path(found.stdout.split()[-2]), (moved / "bin/solidus").resolve())
        (moved / "bin/solidus").unlink()  # it is large

    def test_a_program_of_ones_own_links_the_installed_libraries(self):
        """The example of docs/guide/install.md is built with find_package against an installed copy, and runs a case."""
        prefix = self.folder / "prefix"
        subprocess.run(["cmake", "--install", Path(PROGRAM).parent, "--component", "development", "--prefix", prefix], check=True,
                       capture_output=True)
        example = prefix / "share/doc/libsolidus-dev/examples/embed"
        build = self.folder / "build"
        for command in (["cmake", "-G", "Ninja", "-S", example, "-B", build, f"-DCMAKE_PREFIX_PATH={prefix}",
                         "-DCMAKE_BUILD_TYPE=Release"], ["cmake", "--build", build]):
            done = subprocess.run(command, capture_output=True, text=True)
            self.assertEqual(done.returncode, 0, done.stdout[-3000:] + done.stderr[-3000:])
        self.assertNotIn(str(SOURCES / "src"), (build / "build.ninja").read_text())
        done = subprocess.run([build / "freeze", SOURCES / "cases/hot_spots", "results"], cwd=self.folder, capture_output=True,
                              text=True, env={**os.environ, "SOLIDUS_MATERIALS": str(SOURCES / "materials")})
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertIn("finished", done.stdout)
        self.assertTrue((self.folder / "results/summary.json").exists())
        wrong = subprocess.run([build / "freeze", "nowhere.toml", "results"], cwd=self.folder, capture_output=True, text=True)
        self.assertEqual(wrong.returncode, 1)
        self.assertIn("nowhere.toml", wrong.stderr)
        shutil.rmtree(prefix)  # it is large

    def test_dev_sees_files_from_the_folder_of_the_call(self):
        self.write("mine/history.csv", "time[s],T_a[degC]\n0,20\n10,30\n")
        dev = [SOURCES / "dev", "plot", "mine"]
        subprocess.run(dev, cwd=self.folder, check=True, capture_output=True)
        self.assertTrue((self.folder / "mine/plots/history_degC.png").exists())
        dev[-1] = "yours"
        wrong = subprocess.run(dev, cwd=self.folder, capture_output=True, text=True)
        self.assertEqual(wrong.returncode, 1)
        self.assertIn("there is no folder 'yours'", wrong.stderr)
        # `run` finds the case that lies there, and says so before anything is built where it finds none.
        wrong = subprocess.run([SOURCES / "dev", "run", "nowhere.toml"], cwd=self.folder, capture_output=True, text=True)
        self.assertIn("there is no case 'nowhere.toml'", wrong.stderr)


if __name__ == "__main__":
    unittest.main()
