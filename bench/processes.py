#!/usr/bin/env python3
"""One process, the default and a fixed count in comparison: what more processes gain, and what they cost where cores are taken.

    bench/processes.py                      # everything: free cores, small cases, one core taken by another program
    bench/processes.py free small taken     # or some of it
    bench/processes.py model                # seconds of a step by nodes and physics, for src/run/process_count.cpp
    REPEAT=3 bench/processes.py free        # medians of three

Every row is a pair that is run in alternation. It prints wall clock and processor seconds and the load of the machine before, and writes
build/bench/processes.md. The bars: at most 0.65 of one process on two free cores, 1.02 for small cases, 1.3 where one core is taken.
"""

import csv
import json
import os
import resource
import statistics
import subprocess
import sys
import time
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
PROGRAM = Path(os.environ.get("SOLIDUS", ROOT / "build/release/solidus"))
OUT = ROOT / "build/bench/processes"
REPEAT = int(os.environ.get("REPEAT", "1"))
ONE, DEFAULT = ("--processes", "1"), ()


def setting(**keys):
    return [word for key, value in keys.items() for word in ("--set", f"{key.replace('__', '.')}={value}")]


def cube(n):
    return ["bench/freezing_cube", *setting(mesh__block__divisions=f"[{n},{n},{n}]")]


LARGE = {
    "crankshaft": ["cases/crankshaft"],
    "stepped plate": ["cases/stepped_plate"],
    "wheel": ["cases/wheel_from_step"],
    "freezing cube, 226 981 nodes": cube(60),
}
SMALL = {
    "hot spots": ["cases/hot_spots"],
    "aluminium cylinder": ["cases/aluminium_cylinder"],
    "two blocks": ["cases/two_blocks"],
    "freezing cube, 2 197 nodes": cube(12),
    "cooling block, 1 331 nodes": ["bench/cooling_block", *setting(mesh__block__divisions="[10,10,10]")],
}


def one_run(name, words, how):
    """Wall clock, processor seconds, what the program said of its processes, and the folder."""
    folder = OUT / "".join(c if c.isalnum() else "_" for c in f"{name} {' '.join(how)}")
    before, start = resource.getrusage(resource.RUSAGE_CHILDREN), time.monotonic()
    done = subprocess.run([PROGRAM, "run", *words, "-o", folder, "--no-progress", *how], cwd=ROOT, capture_output=True, text=True)
    wall, after = time.monotonic() - start, resource.getrusage(resource.RUSAGE_CHILDREN)
    if done.returncode != 0:
        sys.exit(f"{name}: {done.stderr or done.stdout[-2000:]}")
    return {"wall": wall, "cpu": after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime,
            "said": done.stdout.split("\n", 1)[0], "folder": folder}


def pair(name, words, one=ONE, other=DEFAULT):
    """Medians of both, run in alternation, and the row of the table."""
    load = os.getloadavg()[0]
    runs = [(one_run(name, words, one), one_run(name, words, other)) for _ in range(REPEAT)]
    first, second = (statistics.median(run[i]["wall"] for run in runs) for i in (0, 1))
    ratio = statistics.median(b["wall"] / a["wall"] for a, b in runs)
    a, b = runs[-1]
    row = [name, b["said"], f"{first:.2f}", f"{second:.2f}", f"{ratio:.2f}", f"{a['cpu']:.1f}", f"{b['cpu']:.1f}", f"{load:.1f}"]
    print(" | ".join(row), flush=True)
    return row


HEAD = ["case", "default", "one process [s]", "other [s]", "ratio", "CPU [s]", "CPU [s]", "load"]


def free():
    return "Two free cores: the default and one process, at most 0.65", HEAD, [pair(*case) for case in LARGE.items()]


def small():
    return "Small cases: the default and one process, at most 1.02", HEAD, [pair(*case) for case in SMALL.items()]


def taken():
    """Another program takes one core: before the run begins, which the default sees, and with two processes all the same, as where it
    begins later."""
    rows = []
    busy = subprocess.Popen([sys.executable, "-c", "while True: pass"])
    try:
        time.sleep(1)
        for name, words in {"stepped plate": LARGE["stepped plate"], "freezing cube, 226 981 nodes": cube(60),
                            "freezing cube, 29 791 nodes": cube(30)}.items():
            rows.append(pair(name, words))
            rows.append(pair(f"{name}, two processes", words, ONE, ("--processes", "2")))
    finally:
        busy.kill()
        busy.wait()
    return "One core taken by another program: at most 1.3", HEAD, rows


def step_seconds(name, words, how):
    run = one_run(name, words, how)
    summary = json.loads((run["folder"] / "summary.json").read_text())
    with open(run["folder"] / "steps.csv") as file:
        steps = len(list(csv.DictReader(file)))
    seconds = summary["seconds"]
    working = sum(seconds.get(phase, 0) for phase in ("heat", "mechanics"))
    return summary["mesh"]["nodes"], steps, run["wall"], run["cpu"], working


def model():
    rows = []
    sizes = {"freezing cube": ("bench/freezing_cube", (12, 20, 30, 44), {}),
             "cooling block": ("bench/cooling_block", (8, 14, 20, 28), {}),
             "cooling block, tetrahedra": ("bench/cooling_block", (8, 12, 18), {"mesh__element": "tet4"})}
    for name, (case, divisions, more) in sizes.items():
        for n in divisions:
            words = [case, *setting(mesh__block__divisions=f"[{n},{n},{n}]", **more)]
            one, two = (step_seconds(f"{name} {n}", words, ("--processes", p)) for p in ("1", "2"))
            nodes, steps, *_ = one
            rows.append([f"{name}, {nodes} nodes", str(steps), f"{one[2]:.2f}", f"{two[2]:.2f}", f"{two[2] / one[2]:.2f}",
                         f"{one[3]:.2f}", f"{two[3]:.2f}", f"{1e6 * one[4] / steps / nodes:.1f}"])
            print(" | ".join(rows[-1]), flush=True)
    return ("What a step costs", ["case", "steps", "one [s]", "two [s]", "ratio", "CPU of one [s]", "CPU of two [s]",
                                  "a node and step on one [us]"], rows)


def table(head, rows):
    return "\n".join("| " + " | ".join(row) + " |" for row in [head, ["---"] * len(head), *rows])


def main():
    parts = {"free": free, "small": small, "taken": taken, "model": model}
    wanted = sys.argv[1:] or ["free", "small", "taken"]
    if set(wanted) - set(parts):
        sys.exit(__doc__)
    os.environ.pop("SOLIDUS_PROCESSES", None)
    OUT.mkdir(parents=True, exist_ok=True)
    texts = []
    for part in wanted:
        title, head, rows = parts[part]()
        texts.append(f"## {title}\n\n{table(head, rows)}\n")
    (OUT.parent / "processes.md").write_text("\n".join(texts))
    print("\n" + "\n".join(texts))


if __name__ == "__main__":
    main()
