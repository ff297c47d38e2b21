"""DOLFINx: TEST/fenicsx.py, a script that prints lines VALUE field x y z time value, run by the Python of Debian's package."""
import os
import subprocess

import score
from codes import freefem

TESTS = ["stefan", "alloy", "corner", "clamped_cube", "weiner_boley", "closing_gap", "plastic_work", "ring_on_core", "rubbing"]
WITHOUT = {"pipe": "the answer is the balance of sinking melt, which a library for equations does not have: a script would contain "
                   "the derivation of right.py, and be compared with itself"}
PYTHON = os.environ.get("DOLFINX_PYTHON", "/usr/bin/python3")


def version():
    try:
        said = subprocess.run([PYTHON, "-c", "import dolfinx; print('DOLFINx', dolfinx.__version__)"], capture_output=True, text=True)
    except OSError:
        return None
    return said.stdout.splitlines()[-1] if said.returncode == 0 else None


def answer(test, folder):
    done = subprocess.run([PYTHON, "fenicsx.py"], cwd=score.HERE / test, capture_output=True, text=True, timeout=1800)
    (folder / "log").write_text(done.stdout + done.stderr)
    if done.returncode:
        raise RuntimeError(done.stderr[-300:])
    return freefem.values(test, done.stdout)
