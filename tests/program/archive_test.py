"""The archive that runs on any Linux: made of this build, moved, and run with nothing of the system but its kernel and a shell."""

import json
import os
from pathlib import Path
import re
import shutil
import subprocess
import unittest

from program import PROGRAM, ProgramTest

TOOLS = ("dpkg-query", "ldd", "mpirun", "cmake")
LACKING = [tool for tool in TOOLS if shutil.which(tool) is None]


@unittest.skipIf(LACKING, f"{', '.join(LACKING)} not installed")
@unittest.skipUnless(Path("/usr/lib/x86_64-linux-gnu/openmpi/lib/openmpi3").is_dir(), "the archive is made on Debian 12, with its Open MPI 4")
class Archive(ProgramTest):
    @classmethod
    def setUpClass(cls):
        from solidus_release import archive  # in python/ of the sources

        cls.place = Path(os.environ["SOLIDUS_FOLDER"]) / "archive"
        shutil.rmtree(cls.place, ignore_errors=True)
        made = cls.place / "made/solidus-x86_64"
        made.parent.mkdir(parents=True)
        cls.addClassCleanup(shutil.rmtree, cls.place)  # it is large
        cls.bill = json.loads(archive.make_tree(Path(PROGRAM).parent, made, "0.0.0", "12", 86400))
        cls.root = cls.place / "a folder with blanks/solidus"
        cls.root.parent.mkdir()
        made.rename(cls.root)

    def run_alone(self, *command, cwd=None, **variables):
        """Runs it in an empty environment."""
        return subprocess.run(command, cwd=cwd or self.folder, capture_output=True, text=True, timeout=600,
                              env={"PATH": "/usr/bin:/bin", "OMPI_ALLOW_RUN_AS_ROOT": "1", "OMPI_ALLOW_RUN_AS_ROOT_CONFIRM": "1",
                                   # Those that wait leave their core to others: tests run at the same time.
                                   "OMPI_MCA_mpi_yield_when_idle": "1", **variables})

    def test_it_runs_where_it_lies_with_its_own_libraries_and_processes(self):
        program, mpirun = self.root / "bin/solidus", self.root / "bin/mpirun"
        checked = self.run_alone(program, "doctor")
        self.assertEqual(checked.returncode, 0, checked.stdout + checked.stderr)
        for line in ("works  materials", "works  meshes", f"works  processes  '{mpirun}'"):
            self.assertIn(line, checked.stdout)
        (self.folder / "link").symlink_to(program)
        case = self.root / "share/solidus/cases/hot_spots"
        one = self.run_alone(self.folder / "link", "run", "--report", case, "-o", "one", "--set", "time.end=6 s")
        self.assertEqual(one.returncode, 0, one.stderr)
        self.assertGreater((self.folder / "one/report.html").stat().st_size, 100000)
        two = self.run_alone(mpirun, "-n", "2", "--oversubscribe", program, "run", case, "-o", "two", "--set", "time.end=6 s")
        self.assertEqual(two.returncode, 0, two.stderr)
        self.assertEqual(json.loads((self.folder / "two/summary.json").read_text())["processes"], 2)

        # A library of the system would be loaded from /lib or /usr/lib.
        libraries = self.root / "lib/solidus"
        listed = self.run_alone(libraries / "ld-linux-x86-64.so.2", "--inhibit-cache", "--library-path", libraries, "--list",
                                self.root / "libexec/solidus/programs/solidus")
        loaded = [Path(path) for path in re.findall(r"=> (/.*) \(0x", listed.stdout)]
        self.assertGreater(len(loaded), 50)
        self.assertEqual([path for path in loaded if self.root not in path.parents], [])

        # Processes of another mpirun would each run the whole case.
        foreign = self.run_alone(program, "--version", OMPI_COMM_WORLD_SIZE="2", OPAL_PREFIX="/usr")
        self.assertEqual(foreign.returncode, 1)
        self.assertIn(f"start it with {mpirun}", foreign.stderr)

        # Without a folder for temporary files Open MPI would tell so on a page.
        untold = self.run_alone(mpirun, "-n", "2", program, "--version", TMPDIR="/no/folder")
        self.assertEqual(untold.returncode, 1)
        self.assertEqual(untold.stderr, "mpirun: '/no/folder' cannot be written, where processes find each other: TMPDIR=FOLDER names another "
                                        "folder\n")

        # The Python package starts processes by the mpirun of the archive, whatever the PATH has.
        script = ("import solidus_casting as sc; "
                  f"case = sc.Case.load({str(case)!r}).copy({{'time.end': '6 s'}}); "
                  "print(sc.run(case, 'driven', processes=2).summary['processes'])")
        driven = self.run_alone("/usr/bin/python3", "-c", script, PYTHONPATH=str(self.root / "share/solidus/python"))
        self.assertEqual((driven.returncode, driven.stdout), (0, "2\n"), driven.stderr)

        # A file that was cut off is named.
        real = self.root / "libexec/solidus/programs/solidus"
        whole = real.rename(real.with_name("whole"))
        real.write_bytes(b"")
        broken = self.run_alone(program, "--version")
        self.assertEqual(broken.returncode, 1)
        self.assertIn(f"cannot start {real}", broken.stderr)
        whole.rename(real)

    def test_every_library_is_of_a_package_that_the_bill_names_with_its_licence(self):
        names = {package["name"] for package in self.bill["packages"]}
        self.assertLessEqual({"solidus", "libc6", "openmpi-bin", "libudunits2-data", "libeigen3-dev", "three"}, names)
        places = set(" ".join(package.get("comment", "") for package in self.bill["packages"]).split())
        for file in sorted((self.root / "lib").rglob("*.so*")):
            self.assertIn(str(file.relative_to(self.root)), places)
        for package in self.bill["packages"][1:]:
            if package["SPDXID"].startswith("SPDXRef-debian"):
                self.assertTrue((self.root / "share/licences" / package["name"]).exists(), package["name"])
                self.assertTrue(package["downloadLocation"].startswith("https://snapshot.debian.org/package/"))
        self.assertIn("GNU General", (self.root / "README.md").read_text())
        self.assertTrue((self.root / "share/licences/common-licenses/GPL-2").exists())
        self.assertEqual(list(self.root.rglob("_core*.so")), [])
        self.assertIn("version:", (self.root / "share/doc/solidus/CITATION.cff").read_text())


if __name__ == "__main__":
    unittest.main()
