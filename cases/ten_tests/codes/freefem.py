"""FreeFEM: TEST/freefem.edp, a script that prints lines VALUE field x y z time value."""
import os
import shutil
import subprocess

import score

TESTS = ["stefan", "alloy", "corner", "clamped_cube", "ring_on_core"]
WITHOUT = dict.fromkeys(["weiner_boley", "closing_gap", "plastic_work", "pipe", "rubbing"],
                        "a language for equations: plasticity, contact and feeding must be written by the user; no script here")


def version():
    if shutil.which("FreeFem++") is None:
        return None
    said = subprocess.run(["FreeFem++"], capture_output=True, text=True).stdout
    return "FreeFEM " + next((word for line in said.splitlines() if "ersion" in line for word in line.split()
                              if word[:1].isdigit()), "of unknown version")


def values(test, printed):
    """The numbers that a test asks for out of lines VALUE field x y z time value."""
    lines = [line.split()[1:] for line in printed.splitlines() if line.startswith("VALUE")]
    found = {}
    for row in score.right(test):
        numbers = [float(row[c]) for c in ("x", "y", "z", "time")]
        chosen = [v for v in lines if v[0] == row["field"] and all(abs(float(a) - b) < 1e-7 + 1e-4 * abs(b)
                                                                  for a, b in zip(v[1:5], numbers))]
        found[row["name"]] = float(chosen[0][5])
    return found


def answer(test, folder):
    libraries = "/usr/lib/freefem++;;"
    done = subprocess.run(["FreeFem++", "-nw", "freefem.edp"], cwd=score.HERE / test, capture_output=True, text=True,
                          env={"FF_LOADPATH": libraries, **os.environ}, timeout=1800)
    (folder / "log").write_text(done.stdout + done.stderr)
    if done.returncode:
        raise RuntimeError(done.stdout[-300:])
    if "\nSTUCK" in done.stdout:
        raise RuntimeError("Newton's method got stuck")
    return values(test, done.stdout)
