#!/usr/bin/env python3
"""Strong and weak scaling of the cooling block, and the model that is fitted to it (docs/log/scaling.md).

    bench/scaling.py strong 45 66       # the same block on one and on two processes
    bench/scaling.py weak 36 52         # twice the nodes on two processes
    PROCESSES="1 2 4" REPEAT=3 STEPS=10 bench/scaling.py strong 66

Prints a table of the least wall-clock time of REPEAT runs, the processor seconds of all processes, phases, iterations and memory,
and for strong scaling the fit T(P) = serial + work/P: the serial part holds what does not become faster, the memory's bandwidth included.
"""

import csv
import json
import math
import os
import pathlib
import resource
import subprocess
import sys
import time

ROOT = pathlib.Path(__file__).resolve().parent.parent
PROGRAM = pathlib.Path(os.environ.get("SOLIDUS", ROOT / "build/release/solidus"))
OUT = ROOT / "build/bench/scaling"
PROCESSES = [int(p) for p in os.environ.get("PROCESSES", "1 2").split()]
REPEAT = int(os.environ.get("REPEAT", "1"))
STEPS = int(os.environ.get("STEPS", "10"))
ELEMENT = os.environ.get("ELEMENT", "hex8")


def one_run(divisions: int, processes: int) -> dict:
    folder = OUT / f"{ELEMENT}_{divisions}_on_{processes}"
    command = [str(PROGRAM), "run", str(ROOT / "bench/cooling_block"), "-o", str(folder), "--no-progress"]
    for setting in (f"mesh.block.divisions=[{divisions},{divisions},{divisions}]", f'time.end="{STEPS} s"', f'mesh.element="{ELEMENT}"', 'mechanics.simplices="displacement"'):
        command += ["--set", setting]
    if processes > 1:
        command = ["mpirun", "-n", str(processes), "--bind-to", "none", "--oversubscribe", *command]
    environment = {**os.environ, "OMPI_MCA_mpi_yield_when_idle": "1"} if processes > (os.cpu_count() or 1) else None
    before = resource.getrusage(resource.RUSAGE_CHILDREN)
    start = time.monotonic()
    subprocess.run(command, check=True, stdout=subprocess.DEVNULL, env=environment)
    wall = time.monotonic() - start
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    summary = json.loads((folder / "summary.json").read_text())
    with open(folder / "steps.csv") as f:
        rows = list(csv.DictReader(f))
    iterations = sum(float(value) for row in rows for name, value in row.items() if name.startswith("mechanics_linear"))
    return {
        "divisions": divisions,
        "processes": processes,
        "unknowns": 4 * summary["mesh"]["nodes"],
        "wall": wall,
        "cpu": after.ru_utime - before.ru_utime + after.ru_stime - before.ru_stime,
        "iterations": iterations,
        "memory": summary["peak_memory[bytes]"],
        "balance": summary["balance"],
        "seconds": summary["seconds"],
    }


def measure(divisions: int, processes: int) -> dict:
    return min((one_run(divisions, processes) for _ in range(REPEAT)), key=lambda row: row["wall"])


PHASES = ["mesh", "set_up", "heat", "mechanics_assembly", "mechanics_residual", "mechanics_solver", "output"]


def table(rows: list) -> str:
    head = ["divisions", "unknowns", "processes", "wall [s]", "CPU [s]", *PHASES, "iterations", "kB/unknown", "nodes", "computed again"]
    lines = ["| " + " | ".join(head) + " |", "|" + "---|" * len(head)]
    for r in rows:
        cells = [str(r["divisions"]), str(r["unknowns"]), str(r["processes"]), f"{r['wall']:.2f}", f"{r['cpu']:.2f}"]
        cells += [f"{r['seconds'].get(phase, 0):.2f}" for phase in PHASES]
        cells += [f"{r['iterations']:.0f}", f"{r['memory']['all_processes'] / 1e3 / r['unknowns']:.2f}",
                  f"{r['balance']['largest_over_mean']['nodes']:.3f}", f"{r['balance']['elements_computed_again']:.3f}"]
        lines.append("| " + " | ".join(cells) + " |")
    return "\n".join(lines)


def fit(rows: list) -> str:
    """T(P) = a + b/P through the first and the last row of a size."""
    one, many = rows[0], rows[-1]
    p = many["processes"] / one["processes"]
    work = (one["wall"] - many["wall"]) / (1 - 1 / p)
    return (f"{one['unknowns']} unknowns: {one['wall'] / many['wall']:.2f} times faster on {many['processes']}; "
            f"serial part {one['wall'] - work:.2f} s of {one['wall']:.2f} s")


def main() -> None:
    kind, sizes = sys.argv[1], [int(s) for s in sys.argv[2:]]
    for name, value in {"OMP_NUM_THREADS": "1", "OPENBLAS_NUM_THREADS": "1", "OMPI_ALLOW_RUN_AS_ROOT": "1",
                        "OMPI_ALLOW_RUN_AS_ROOT_CONFIRM": "1"}.items():
        os.environ.setdefault(name, value)
    OUT.mkdir(parents=True, exist_ok=True)
    rows, fits = [], []
    for size in sizes:
        # Weak: the nodes of a process stay as many.
        of_size = [measure(size if kind == "strong" else round((size + 1) * math.cbrt(p)) - 1, p) for p in PROCESSES]
        rows += of_size
        if kind == "strong" and len(of_size) > 1:
            fits.append(fit(of_size))
        elif len(of_size) > 1:
            fits.append(f"efficiency {of_size[0]['wall'] / of_size[-1]['wall']:.2f}")
    report = table(rows) + "\n\n" + "\n".join(fits) + "\n"
    (OUT / f"{kind}.md").write_text(report)
    print(report)


if __name__ == "__main__":
    if len(sys.argv) < 3 or sys.argv[1] not in ("strong", "weak"):
        sys.exit(__doc__)
    main()
