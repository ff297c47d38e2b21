"""`solidus doctor` tries what runs need of a machine and says what it lacks."""

import os
import shutil
import subprocess
import unittest

from program import PROGRAM, ProgramTest, solidus


class Doctor(ProgramTest):
    def found(self, text):
        """What it says of each subject: whether it works, and the rest of the line."""
        return {words[1]: (words[0], line) for line in text.splitlines() if (words := line.split())[0] in ("works", "lacks", "fails")}

    def test_a_machine_that_runs_the_tests_lacks_nothing(self):
        said = self.found(self.done("doctor"))
        self.assertEqual({subject: kind for subject, (kind, _) in said.items()},
                         dict.fromkeys(("machine", "materials", "meshes", "results", "processes", "pictures"), "works"), said)
        self.assertRegex(said["materials"][1], r" [1-9]\d cards")
        self.assertRegex(said["pictures"][1], r"numpy \d.*matplotlib \d")

    def test_without_mpirun_and_python_cases_run_all_the_same(self):
        said = self.found(self.done("doctor", env={"PATH": str(self.folder), "SOLIDUS_PYTHON": "/no/python"}))
        self.assertEqual((said["processes"][0], said["pictures"][0], said["meshes"][0]), ("lacks", "lacks", "works"))
        self.assertIn("'mpirun' does not start them (No such file or directory)", said["processes"][1])
        self.assertIn("'/no/python' with numpy and matplotlib (No such file or directory)", said["pictures"][1])

    def test_an_mpirun_of_another_mpi_is_told_from_ours(self):
        launcher = self.write("bin/mpirun", '#!/bin/sh\nshift 5\n"$@" && "$@"\n')  # two runs of one process
        launcher.chmod(0o755)
        said = self.found(self.done("doctor", env={"PATH": f"{launcher.parent}:{os.environ['PATH']}"}))
        self.assertEqual(said["processes"][0], "lacks")
        self.assertIn("do not find each other", said["processes"][1])

    def test_folders_that_cannot_be_written_are_told_from_those_that_runs_need(self):
        nowhere = self.write("home", "a file where a folder would be")
        said = self.found(self.done("doctor", env={"TMPDIR": str(nowhere), "HOME": str(nowhere)}))
        self.assertEqual((said["meshes"][0], said["pictures"][0]), ("works", "works"), said)
        self.assertRegex(said["pictures"][1], r"^works  pictures   Python \d")
        if said["processes"][0] != "works":  # Open MPI 4 needs the folder that TMPDIR names
            self.assertIn(f"'{nowhere}' cannot be written: TMPDIR=FOLDER", said["processes"][1])

    def test_a_python_without_numpy_is_named_with_its_last_words(self):
        python = self.write("python", "#!/bin/sh\necho No module named numpy >&2\nexit 1\n")
        python.chmod(0o755)
        said = self.found(self.done("doctor", env={"SOLIDUS_PYTHON": str(python)}))
        self.assertIn("(exit code 1: No module named numpy)", said["pictures"][1])

    def test_a_program_without_its_reader_cannot_run_cases(self):
        alone = self.folder / "alone/solidus"
        alone.parent.mkdir()
        shutil.copy(PROGRAM, alone)
        result = subprocess.run([alone, "doctor"], capture_output=True, text=True, cwd=self.folder)
        self.assertEqual(result.returncode, 1, result.stderr)
        said = self.found(result.stdout)
        self.assertEqual(said["meshes"][0], "fails")
        self.assertIn("'solidus-reader', is missing", said["meshes"][1])
        self.assertIn("Cases cannot be run here", result.stdout)
        alone.unlink()

    def test_it_takes_no_argument(self):
        result = solidus("doctor", "surplus")
        self.assertEqual(result.returncode, 1)


if __name__ == "__main__":
    unittest.main()
