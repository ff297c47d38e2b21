"""`solidus run` starts as many processes as pay by itself, and they behave as one: output, signals, exit codes, restart."""

import os
from pathlib import Path
import re
import signal
import subprocess
import time
import unittest

from program import PATIENCE, PROGRAM, SOURCES, ProgramTest

CASE = SOURCES / "bench/cooling_block"
MPI = ("OMPI_", "PMIX_", "PMI_", "PRTE_")
TWO = ("--processes", "2")


def environment(**more):
    """That of a user at a terminal, on two cores."""
    kept = {name: value for name, value in os.environ.items() if not name.startswith(MPI) and name != "SOLIDUS_PROCESSES"}
    return {**kept, "OMP_NUM_THREADS": "1", **more}


def block(divisions, **more):
    keys = {"mesh.block.divisions": f"[{divisions},{divisions},{divisions}]", "time.end": "3 s", **more}
    return [str(CASE), *(word for key, value in keys.items() for word in ("--set", f"{key}={value}"))]


class Processes(ProgramTest):
    def run_block(self, divisions, *words, env=None, **more):
        return subprocess.run([PROGRAM, "run", *block(divisions, **more), "--no-progress", *words], cwd=self.folder, text=True,
                              capture_output=True, env=env or environment(), timeout=PATIENCE * 120, stdin=subprocess.DEVNULL)

    def processes_of(self, folder):
        return self.summary(self.folder / folder)["processes"]

    def test_a_small_case_takes_one_and_says_so_in_its_first_line(self):
        said = self.run_block(4, "-o", "out")
        self.assertEqual(said.returncode, 0, said.stderr)
        self.assertRegex(said.stdout.splitlines()[0], r"^1 process of \d+ cores?")
        self.assertEqual(self.processes_of("out"), 1)

    def test_two_that_are_asked_for_give_the_answers_of_one(self):
        one = self.run_block(6, "-o", "one", "--processes", "1")
        two = self.run_block(6, "-o", "two", *TWO)
        self.assertEqual((one.returncode, two.returncode), (0, 0), one.stderr + two.stderr)
        self.assertRegex(two.stdout.splitlines()[0], r"^2 processes of \d+ cores?: as asked$")
        self.assertEqual((self.processes_of("one"), self.processes_of("two")), (1, 2))
        # Each line comes once and through the same output, the last one too.
        self.assertEqual(two.stdout.count("finished after"), 1)
        self.assertIn("Results in two.", two.stdout)
        self.assertEqual(two.stderr, one.stderr)
        last = [[float(cell) for cell in (self.folder / name / "history.csv").read_text().splitlines()[-1].split(",")]
                for name in ("one", "two")]
        temperature = (self.folder / "one/history.csv").read_text().splitlines()[0].split(",").index("T_corner[degC]")
        self.assertAlmostEqual(last[0][temperature], last[1][temperature], places=5)

    def test_output_goes_on_where_the_program_s_stands(self):
        with (self.folder / "log").open("w") as log:
            log.write("before\n")
            log.flush()
            subprocess.run([PROGRAM, "run", *block(4), "--heat-only", "--no-progress", "-o", "out", *TWO], cwd=self.folder,
                           stdout=log, stderr=log, env=environment(), check=True, stdin=subprocess.DEVNULL)
            log.write("behind\n")
        lines = (self.folder / "log").read_text().splitlines()
        self.assertEqual((lines[0], lines[-1]), ("before", "behind"))
        self.assertIn("Results in out", lines[-2])
        self.assertEqual(sum("heat alone, without" in line for line in lines), 1)

    def test_what_is_wrong_is_said_once_with_the_code_of_one_process(self):
        for words, code, text in ((("--processes", "0"), 1, "--processes"), (("--processes", "two"), 1, "--processes"),
                                  ((*TWO, "--set", "body.block.material=nowhere"), 1, "nowhere"),
                                  ((*TWO, "--restart"), 1, "checkpoint"),
                                  ((*TWO, "--set", "probe.T_corner.point=['9 m', '0 m', '0 m']"), 1, "T_corner")):
            said = self.run_block(4, "-o", "out", *words)
            self.assertEqual(said.returncode, code, f"{words}: {said.stdout}{said.stderr}")
            self.assertEqual(said.stderr.count("solidus: "), 1, said.stderr)
            self.assertIn(text, said.stderr)

    def test_the_environment_has_a_word_where_the_command_line_has_none(self):
        said = self.run_block(4, "-o", "out", env=environment(SOLIDUS_PROCESSES="2"))
        self.assertIn("2 processes of", said.stdout)
        said = self.run_block(4, "-o", "one", "--processes", "1", env=environment(SOLIDUS_PROCESSES="2"))
        self.assertIn("1 process of", said.stdout)
        said = self.run_block(4, "-o", "none", env=environment(SOLIDUS_PROCESSES="many"))
        self.assertEqual(said.returncode, 1)
        self.assertIn("SOLIDUS_PROCESSES: 'many' is no number of processes", said.stderr)

    def test_under_mpirun_nothing_more_is_started(self):
        env = environment(OMPI_ALLOW_RUN_AS_ROOT="1", OMPI_ALLOW_RUN_AS_ROOT_CONFIRM="1")
        under = ["mpirun", "-n", "2", "--oversubscribe", "--bind-to", "none", PROGRAM, "run", *block(4), "--no-progress", "-o", "out"]
        said = subprocess.run(under, cwd=self.folder, env=env, text=True, capture_output=True, stdin=subprocess.DEVNULL)
        self.assertEqual(said.returncode, 0, said.stderr)
        self.assertNotIn("of 2 cores", said.stdout)
        self.assertEqual(self.processes_of("out"), 2)
        said = subprocess.run([*under, *TWO], cwd=self.folder, env=env, text=True, capture_output=True, stdin=subprocess.DEVNULL)
        self.assertEqual(said.returncode, 1)
        self.assertEqual(said.stderr.count("solidus: "), 1, said.stderr)
        self.assertIn("has started the processes already", said.stderr)

    def test_without_mpirun_one_process_does_and_two_are_refused(self):
        env = environment(PATH=str(self.folder))
        said = self.run_block(4, "-o", "out", env=env)
        self.assertEqual(said.returncode, 0, said.stderr)
        self.assertRegex(said.stdout, r"^1 process of (1 core\n|\d+ cores: mpirun, which starts several, is missing)")
        said = self.run_block(4, "-o", "two", *TWO, env=env)
        self.assertEqual(said.returncode, 1)
        self.assertIn("2 processes were asked for, and mpirun, which starts them, is missing", said.stderr)

    def test_an_mpirun_that_starts_none_is_named_with_what_it_says(self):
        launcher = self.write("bin/mpirun", "#!/bin/sh\necho no slots here >&2\nexit 7\n")
        launcher.chmod(0o755)
        said = self.run_block(4, "-o", "out", *TWO, env=environment(PATH=f"{launcher.parent}:{os.environ['PATH']}"))
        self.assertEqual(said.returncode, 1)
        self.assertIn("does not start them: exit code 7: no slots here", said.stderr)
        launcher.write_text('#!/bin/sh\nshift 5\n"$@" & "$@"\nwait\n')  # two runs of one process
        said = self.run_block(4, "-o", "out", *TWO, env=environment(PATH=f"{launcher.parent}:{os.environ['PATH']}"))
        self.assertEqual(said.returncode, 1)
        self.assertIn("do not find each other", said.stderr)

    # The variables are those that Slurm 22.05 gives a job of one task on a computer "vm".
    JOB = {"SLURM_JOB_ID": "7", "SLURM_JOBID": "7", "SLURM_NODELIST": "vm", "SLURM_NNODES": "1", "SLURM_NTASKS": "1",
           "SLURM_PROCID": "0", "SLURM_NODEID": "0", "SLURM_LOCALID": "0", "SLURM_TASKS_PER_NODE": "1"}
    STEP = {"SLURM_STEP_ID": "0", "SLURM_STEPID": "0", "SLURM_STEP_NODELIST": "vm"}

    def test_a_batch_job_is_left_to_its_own_launcher(self):
        said = self.run_block(4, "-o", "out", env=environment(**self.JOB))
        self.assertEqual(said.returncode, 0, said.stderr)
        self.assertRegex(said.stdout, r"^1 process of \d+ cores?: in a batch job")

    def test_srun_starts_one_process_or_connected_ones(self):
        one = self.run_block(4, "-o", "one", env=environment(**self.JOB, **self.STEP, SLURM_STEP_NUM_TASKS="1"))
        self.assertEqual(one.returncode, 0, one.stderr)
        two = self.run_block(4, "-o", "two", env=environment(**self.JOB, **self.STEP, SLURM_STEP_NUM_TASKS="2"))
        self.assertEqual(two.returncode, 1)
        self.assertIn("srun has started 2 processes that cannot find each other", two.stderr)
        self.assertIn("`srun --mpi=pmix solidus run", two.stderr)
        self.assertFalse((self.folder / "two").exists())

    def stopped(self, send, *words):
        """Starts a long run, sends it a signal when it has taken three steps, and returns how it ended."""
        with (self.folder / "said").open("w+") as said:
            run = subprocess.Popen([PROGRAM, "run", *block(6, **{"time.end": "2000 s"}), "--no-progress", "-o", "out", *TWO, *words],
                                   cwd=self.folder, env=environment(), stdout=said, stderr=said, stdin=subprocess.DEVNULL)
            steps, until = self.folder / "out/steps.csv", time.monotonic() + PATIENCE * 60
            while time.monotonic() < until and not (steps.exists() and steps.read_text().count("\n") > 3):
                time.sleep(0.02)
            send(run)
            code = run.wait(PATIENCE * 60)
            said.seek(0)
            return code, said.read()

    def test_ctrl_c_leaves_a_checkpoint_from_which_another_count_goes_on(self):
        code, said = self.stopped(lambda run: run.send_signal(signal.SIGINT))
        self.assertEqual(code, 130, said)
        self.assertEqual(said.count("info: asked to stop"), 1, said)
        self.assertEqual(len(re.findall(r"^solidus: ", said, re.M)), 1, said)
        self.assertTrue((self.folder / "out/checkpoint/state.h5").exists())
        end = float((self.folder / "out/steps.csv").read_text().splitlines()[-1].split(",")[1]) + 2
        again = self.run_block(6, "-o", "out", "--restart", "--processes", "1", **{"time.end": f"{end:g} s"})
        self.assertEqual(again.returncode, 0, again.stderr)
        self.assertEqual(self.processes_of("out"), 1)

    def test_no_process_outlives_the_program(self):
        def kill(run):
            self.children = [int(pid) for pid in subprocess.run(["pgrep", "-f", str(self.folder / "out")], text=True,
                                                                capture_output=True).stdout.split()] or [run.pid]
            run.kill()

        code, said = self.stopped(kill, "--set", f"title={self.folder / 'out'}")
        self.assertEqual(code, -signal.SIGKILL, said)
        until = time.monotonic() + PATIENCE * 20
        left = self.children
        while left and time.monotonic() < until:
            left = [pid for pid in left if Path(f"/proc/{pid}/cmdline").exists() and Path(f"/proc/{pid}/cmdline").read_bytes()]
            time.sleep(0.1)
        self.assertEqual(left, [])


if __name__ == "__main__":
    unittest.main()
