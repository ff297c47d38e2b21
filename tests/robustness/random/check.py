"""Runs a random case and holds what comes out against what must hold whatever the case is."""

import csv
import filecmp
import json
import os
import random
import re
import resource
import shutil
import signal
import subprocess
import time
from pathlib import Path

DEFECT, DEFECT_AT_LOOSE_TOLERANCES = 1e-8, 1e-5  # of the first law, of the scale that the program names
FED = 1e-8  # of the room of the castings
MUCH = 10  # times what residuals explain of the functional
LAW_CLOSES = ("energy", None)  # structural_heating with which the scheme closes the first law


class Runner:
    """Starts the program; `limit` is in seconds of a processor, ten times as much may pass on a busy machine."""

    def __init__(self, program, folder, limit=60):
        self.program, self.folder, self.limit = Path(program), Path(folder), limit

    def command(self, case, results, further=()):
        command = [str(self.program), "run", str(self.folder / str(case.seed) / "case.toml"), "-o", str(results),
                   *further]
        if case.processes > 1:  # which leave their processor to each other where there are too few
            command = ["env", "OMPI_MCA_mpi_yield_when_idle=1", "mpirun", "-n", str(case.processes), "--bind-to",
                       "none", "--oversubscribe", *command]
        return command

    def write(self, case):
        folder = self.folder / str(case.seed)
        shutil.rmtree(folder, ignore_errors=True)
        folder.mkdir(parents=True)
        (folder / "case.toml").write_text(case.text)
        for name, text in case.files.items():
            (folder / name).write_text(text)
        return folder

    def start(self, command):
        environment = dict(os.environ, OMP_NUM_THREADS="1", OPENBLAS_NUM_THREADS="1")
        return subprocess.Popen(command, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, env=environment, start_new_session=True,
                                preexec_fn=lambda: resource.setrlimit(resource.RLIMIT_CPU, (self.limit, self.limit + 5)))

    def finish(self, child):
        """Exit code and what was printed; None for the code of a run that went past its limit."""
        try:
            out, _ = child.communicate(timeout=10 * self.limit)
            return None if child.returncode == -signal.SIGXCPU else child.returncode, out
        except subprocess.TimeoutExpired:
            os.killpg(child.pid, signal.SIGKILL)
            out, _ = child.communicate()
            return None, out

    def check(self, case):
        """(kind, reason): kind is "ok", "refused", "stopped" or "broken"."""
        folder = self.write(case)
        began = time.monotonic()
        code, log = self.finish(self.start(self.command(case, folder / "whole")))
        seconds = time.monotonic() - began
        (folder / "log.txt").write_text(log)
        kind, reason = self.judge(case, folder, code, log)
        if kind == "ok":
            reason = self.restart(case, folder, seconds)
            kind = "broken" if reason else "ok"
        return kind, reason

    def judge(self, case, folder, code, log):
        if code is None:
            return "broken", f"not finished after {self.limit} s of a processor"
        if code == 1:
            said = re.search(r"solidus: (\S+:\d+:\d+: .*)", log)
            return ("refused", said[1]) if said else ("broken", "refused without a place: " + log[-200:])
        if code == 2 and "has run out" in log:  # a melt that nothing holds has no equilibrium
            return "refused", re.search(r"the melt of .* has run out", log)[0]
        if code == 2:
            said = re.search(r"reason: (.*)", log)
            return "stopped", said[1] if said else log[-200:]
        if code != 0:
            return "broken", f"exit code {code}: {log[-300:]}"
        for invariant in (no_nan, first_law, bounds, functional, feeding):
            reason = invariant(case, folder / "whole", log)
            if reason:
                return "broken", reason
        return "ok", ""

    def restart(self, case, folder, seconds):
        """Kills the same run at a random moment, goes on, and compares the bits; empty where all is well.

        On one process: on several, MUMPS adds in the order in which messages come.
        """
        if case.processes > 1:
            return ""
        results = folder / "again"
        child = self.start(self.command(case, results))
        time.sleep(random.Random(case.seed).uniform(0.3, 1.0) * seconds)
        finished = child.poll() is not None
        child.kill()
        child.communicate()
        if finished:
            return different(folder / "whole", results)
        checkpoint = results / "checkpoint"
        began = any((checkpoint / name).exists() for name in ("state.h5", "previous.h5"))
        code, log = self.finish(self.start(self.command(case, results, ["--restart"] if began else [])))
        if code != 0 and not (code == 1 and "the run has reached" in log):
            return f"the run after a kill ended with code {code}: {log[-300:]}"
        return different(folder / "whole", results)


def rows(path):
    with open(path, newline="") as file:
        return list(csv.reader(file))


def no_nan(case, results, log):
    for name in ("history.csv", "steps.csv"):
        for row in rows(results / name)[1:]:
            if any(cell.lower().lstrip("+-") in ("nan", "inf") for cell in row):
                return f"{name} holds what is not a number"
    for field in (results / "fields").glob("*.vtu"):
        if b'"nan"' in field.read_bytes():
            return f"{field.name} holds what is not a number"
    return ""


def first_law(case, results, log):
    if case.facts["physics"] == "mechanics" or case.facts.get("form") not in LAW_CLOSES:
        return ""
    defect = json.loads((results / "summary.json").read_text())["relative_energy_defect"]
    said = re.search(r"the first law is violated by .*", log)
    allowed = DEFECT if case.facts["tight"] else DEFECT_AT_LOOSE_TOLERANCES
    return f"the first law is off by {defect:.2g}" if said or not defect <= allowed else ""


def bounds(case, results, log):
    """No temperature leaves the range of all initial and surrounding ones by more than deformation can do.

    Castings that stay elastic while they are quenched and held carry gigapascals: their elastic energy warms and
    cools by some per cent of the range. The open rule over- and undershoots, most in quadratic elements.
    """
    if case.facts["physics"] == "mechanics" or case.facts.get("heated"):
        return ""
    header, *table = rows(results / "history.csv")
    low, high = header.index("T_min[degC]"), header.index("T_max[degC]")
    allowed = 0.01 if case.facts["closed"] else 0.01 + 0.6 * spread(case)
    if case.facts["physics"] == "thermomechanical":
        allowed += 20 + 0.1 * spread(case)
    least, greatest = min(case.facts["temperatures"]), max(case.facts["temperatures"])
    for row in table:
        beyond = max(least - float(row[low]), float(row[high]) - greatest)
        if not beyond <= allowed:
            return f"a temperature is {beyond:.3g} K beyond all initial and surrounding ones"
    return ""


def spread(case):
    return max(case.facts["temperatures"]) - min(case.facts["temperatures"])


def functional(case, results, log):
    """L of 2.24 does not rise where nothing feeds it; the isothermal split may let it."""
    said = re.search(r"the functional L of stability grew by (\S+) J .* thermal phase; (\S+) J are .*", log)
    grown = said and float(said[1]) > MUCH * float(said[2]) and case.facts["scheme"] != "isothermal"
    return said[0][:120] if grown else ""


def feeding(case, results, log):
    """What shrinks is what pipes, sinks, cavities, pores and the outside have got, to 1e-8 of the castings."""
    table = results / "feeding.csv"
    if not table.exists():
        return ""
    header, *values = rows(table)
    defect = max(abs(float(row[header.index("balance_defect[1]")])) for row in values)
    return "" if defect <= FED else f"the balance of feeding is off by {defect:.2g}"


def different(one, other):
    tables = [name for name in ("history.csv", "feeding.csv", "fields.pvd") if (one / name).exists()]
    for name in tables:
        if (one / name).read_bytes() != (other / name).read_bytes():
            return f"{name} differs after a restart"
    here = sorted(p.name for p in (one / "fields").iterdir())
    if here != sorted(p.name for p in (other / "fields").iterdir()):
        return "other fields after a restart"
    _, mismatch, errors = filecmp.cmpfiles(one / "fields", other / "fields", here, shallow=False)
    return f"{(mismatch + errors)[0]} differs after a restart" if mismatch or errors else ""
