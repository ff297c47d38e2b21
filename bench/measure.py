#!/usr/bin/env python3
"""Runs the benchmarks that are asked for and writes one table: build/bench/report.md. Called by bench/run.sh.

Every part leaves its rows in build/bench/PART.json; the report shows all that are there, so parts may be run one by one.
"""
import csv
import functools
import json
import math
import os
import re
import shutil
import statistics
import subprocess
import sys
import time
from pathlib import Path

PROGRAMS = Path(os.environ.get("SOLIDUS_BUILD", "build/release"))
WORK = Path("build/bench")
REPEAT = int(os.environ.get("REPEAT", "3"))
CUBE = (30, 60, 100)                            # divisions: 29 791, 226 981 and 1 030 301 nodes
OTHERS = {12: ("FreeFEM", "CalculiX"), 30: ("FreeFEM",)}  # divisions; CalculiX takes hours on 30
FREEFEM = Path("/usr/lib/freefem++")            # where Debian has the modules that its FreeFEM does not find
SCHEMES = ("isothermal", "isentropic", "simultaneous")
NODES = {"20k": 26, "100k": 45, "300k": 66}    # divisions: 19 683, 97 336 and 300 763 nodes
MIXED = (20, 26, 33, 46)                       # divisions: 9 261, 19 683, 39 304 and 103 823 nodes
UNKNOWNS = {"10k": 13, "100k": 29, "1m": 62}   # divisions: four unknowns at each of (divisions + 1)^3 nodes


def load():
    return os.getloadavg()[0]


def run(command, log, folder=".", **environment):
    """Seconds, the peak memory [MiB] of the largest process, and processor seconds of all."""
    start = time.monotonic()
    with open(log, "w") as out:
        process = subprocess.Popen(command, cwd=folder, stdout=out, stderr=subprocess.STDOUT,
                                   env={**os.environ, **environment})
        _, status, usage = os.wait4(process.pid, 0)
    process.returncode = os.waitstatus_to_exitcode(status)
    if process.returncode != 0:
        sys.exit(f"{' '.join(map(str, command))} failed ({process.returncode}); see {log}")
    return time.monotonic() - start, usage.ru_maxrss / 1024, usage.ru_utime + usage.ru_stime


def median(rows):
    """The row of the median total, with the spread of the totals and the load when they were taken."""
    rows = sorted(rows, key=lambda r: r["total"])
    middle = dict(rows[(len(rows) - 1) // 2])
    middle["spread"] = [rows[0]["total"], rows[-1]["total"]]
    middle["runs"], middle["load"] = len(rows), max(r["load"] for r in rows)
    return middle


def solidus(name, case, settings, processes=1):
    folder = WORK / re.sub(r"\W+", "_", f"{name}_{processes}")
    before = load()
    command = [PROGRAMS / "solidus", "run", case, "-o", folder, "--no-progress"]
    for key, value in settings.items():
        command += ["--set", f"{key}={value}"]
    if processes > 1:
        command = ["mpirun", "-n", str(processes), "--bind-to", "none", "--oversubscribe", *command]
    wall, _, processor = run(command, WORK / "log.txt")
    summary = json.loads((folder / "summary.json").read_text())
    s = summary["seconds"]
    return {"name": name, "program": "Solidus", "processes": processes, "total": wall, "load": before,
            "processor": processor, "steps": summary["steps"], "prepare": s["mesh"] + s["set_up"], "heat": s.get("heat", 0.0), "mechanics": s.get("mechanics", 0.0),
            "output": s["output"], "memory": summary["peak_memory[bytes]"]["all_processes"] / 2**20,
            "final": summary["final"], "seconds": s, "profile": summary["profile[s]"], "nodes": summary["mesh"]["nodes"]}


def calculix(name, divisions, element, solver, threads=1, step=1.0):
    """Total seconds of both runs of CalculiX; each reads its input and writes its results."""
    folder = WORK / re.sub(r"\W+", "_", f"calculix_{name}_{solver}_{threads}")
    subprocess.run([sys.executable, "bench/cooling_block/calculix_input.py", str(divisions), element, solver, folder, str(step)],
                   check=True)
    before, n = load(), str(threads)
    ccx = shutil.which("ccx") or sys.exit("calculix-ccx is not installed")
    times, processor = {}, {}
    memory = 0
    for phase in ("heat", "mechanics"):
        times[phase], peak, processor[phase] = run([ccx, phase], folder / f"{phase}.log", folder, OMP_NUM_THREADS=n,
                                                      CCX_NPROC_EQUATION_SOLVER=n, CCX_NPROC_STIFFNESS=n, CCX_NPROC_RESULTS=n)
        memory = max(memory, peak)
    probe = str((divisions + 1) ** 3)  # the corner is the last node

    def corner(phase):
        lines = [line.split() for line in (folder / f"{phase}.dat").read_text().split("\n")]
        values = [float(words[1]) for words in lines if words and words[0] == probe]
        if len(set(values)) != 10:
            sys.exit(f"CalculiX' {phase} did not take ten different steps; see {folder}")
        return values[-1]

    row = {"name": name, "program": f"CalculiX, {solver}", "processes": threads, "total": sum(times.values()), "load": before,
           "processor": sum(processor.values()), **times, "memory": memory, "final": {"T_corner[degC]": corner("heat"), "u_corner[um]": 1e6 * corner("mechanics")}}
    for file in ("heat.frd", "mechanics.frd", "heat.inp", "mechanics.inp"):
        (folder / file).unlink(missing_ok=True)
    return row


def block(divisions, element, **more):
    """Tetrahedra with one constant strain, as CalculiX' C3D4: the default for a steel that yields is the mixed element."""
    n = divisions
    return {"mesh.element": element, "mesh.block.divisions": f"[{n},{n},{n}]", "output.every": "1000 s",
            **({"mechanics.simplices": "displacement"} if element == "tet4" else {}), **more}


def micro():
    rows = []
    for program in ("material_bench", "mechanics_bench", "heat_bench"):
        before = load()
        out = WORK / f"{program}.json"
        run([(PROGRAMS / "bench" / program).resolve(), f"--benchmark_repetitions={REPEAT}", "--benchmark_min_time=0.3",
             f"--benchmark_out={out}", "--benchmark_out_format=json"], WORK / "log.txt")
        for b in json.loads(out.read_text())["benchmarks"]:
            if b.get("aggregate_name", "median" if REPEAT == 1 else "") == "median":
                what = next(key for key in ("per_point", "per_node", "per_element") if key in b)
                rows.append({"program": program.removesuffix("_bench"), "name": b["run_name"],
                             "ns": 1e9 * b[what], "of": what.removeprefix("per_"), "load": before})
    return rows


def case():
    return [median([solidus(f"aluminium_cylinder, {label}", "cases/aluminium_cylinder", settings, p) for _ in range(REPEAT)])
            for label, settings, p in (("tri3", {}, 1), ("tri3", {}, 2), ("quad4", {"mesh.element": "quad4"}, 1))]


def coupling():
    """Processor time per step by each scheme, the runs of all schemes in alternation: the machine may be busy, and not evenly."""
    rows = []
    cases = [("aluminium_cylinder, tri3", "cases/aluminium_cylinder", {}, SCHEMES[:2])]
    cases += [(f"casting block 100k, {element}", "bench/casting_block", block(UNKNOWNS["100k"], element, **{"time.end": "6 s"}), SCHEMES)
              for element in ("hex8", "tet4")]
    for name, case_folder, settings, schemes in cases:
        runs = {scheme: [] for scheme in schemes}
        for _ in range(REPEAT):
            for scheme in schemes:
                runs[scheme].append(solidus(f"{name} {scheme}", case_folder, {**settings, "coupling.scheme": scheme}))
        best = {scheme: min(r["processor"] / r["steps"] for r in runs[scheme]) for scheme in schemes}
        for scheme in schemes:
            rows.append({"name": name, "scheme": scheme, "steps": runs[scheme][0]["steps"], "per_step": best[scheme],
                         "ratio": best[scheme] / best["isothermal"], "load": max(r["load"] for r in runs[scheme])})
    return rows


def check():
    """Both programs on a block with 13^3 nodes, ten steps of 10 s. Solidus' mechanical phase sees the temperature before a
    step, so its displacement after one step more belongs to CalculiX's."""
    rows = []
    n, step = 12, 10.0
    for element in ("hex8", "tet4"):
        rows.append(calculix(f"check {element}", n, element, "direct", step=step))
        for rule in ("closed", "open"):
            settings = block(n, element, **{"time.step": f"{step} s", "heat.integration": rule})
            at = solidus(f"check {element}, {rule}", "bench/cooling_block", {**settings, "time.end": f"{10 * step} s"})
            later = solidus(f"check {element}, {rule}", "bench/cooling_block", {**settings, "time.end": f"{11 * step} s"})
            at["final"]["u_corner[um]"] = later["final"]["u_corner[um]"]
            rows.append(at)
    return rows


def side_by_side(size):
    """Both programs on the same block in alternation. Solidus takes eleven steps: the mechanical phase of the first has nothing to do."""
    rows, n = [], NODES[size]
    for element in ("hex8", "tet4"):
        name = f"block {size} nodes, {element}"
        for p in (1, 2):
            rows.append(solidus(name, "bench/cooling_block", block(n, element, **{"time.end": "11 s"}), p))
        rows.append(calculix(name, n, element, "iterative", 1))
    return [median([row]) for row in rows]


def mixed():
    """The default tetrahedron of a steel that yields, with a pressure, along with the one of the displacement alone, in alternation; and
    CalculiX on the second size. Solidus takes eleven steps, as in side_by_side()."""
    rows = []
    for n in MIXED:
        runs = {"displacement": [], "mixed": []}
        for _ in range(REPEAT):
            for simplices, of in runs.items():
                settings = block(n, "tet4", **{"time.end": "11 s", "mechanics.simplices": simplices})
                of.append(solidus(f"block {(n + 1) ** 3} nodes, tet4 {simplices}", "bench/cooling_block", settings))
        rows += [median(of) for of in runs.values()]
    rows.append(median([calculix(f"block {(MIXED[1] + 1) ** 3} nodes, tet4", MIXED[1], "tet4", "iterative")]))
    return rows


def scaling():
    """Processor time and memory of Solidus by the number of unknowns."""
    return [median([solidus(f"block {size} unknowns, {element}", "bench/cooling_block", block(n, element, **{"time.end": "11 s"}))])
            for element in ("hex8", "tet4") for size, n in UNKNOWNS.items()]


def cylinder():
    """The axisymmetric cylinder, 100 x 100 quads, 100 coupled steps."""
    return [median([solidus("cylinder 100 x 100, quad4", "bench/cylinder", {}) for _ in range(REPEAT)])]


def freezing_cube(n, variant="case", processes=1):
    """Solidus on the freezing cube, heat alone: processor time, iterations of the nonlinear and the linear solver, memory."""
    name = f"freezing cube {(n + 1) ** 3} nodes" + ("" if variant == "case" else f", {variant}")
    row = solidus(name, f"bench/freezing_cube/{variant}.toml", {"mesh.block.divisions": f"[{n},{n},{n}]"}, processes)
    with open(WORK / re.sub(r"\W+", "_", f"{name}_{processes}") / "steps.csv") as file:
        steps = list(csv.DictReader(file))
    iterations = [int(step["heat_iterations[1]"]) for step in steps]
    return median([row]) | {"iterations": sum(iterations) / len(steps), "worst": max(iterations),
                            "rejected": sum(int(step["rejected[1]"]) for step in steps),
                            "linear": sum(int(step["heat_linear_iterations[1]"]) for step in steps) / len(steps)}


def cube_of_freefem(n):
    """The same with FreeFEM: Newton's method with a line search."""
    if not shutil.which("FreeFem++"):
        print("FreeFem++ is not there (Debian: freefem++, libfreefem++): left out", file=sys.stderr)
        return []
    before, log = load(), WORK / "freefem.txt"
    wall, memory, processor = run(["FreeFem++", "-nw", "-v", "0", "bench/freezing_cube/freezing_cube.edp", str(n), "20"], log,
                                  FF_LOADPATH=f"{FREEFEM};;")
    words = next(line for line in log.read_text().split("\n") if line.startswith("RESULT")).split()
    found = dict(zip(words[1::2], map(float, words[2::2])))
    return [median([{"name": f"freezing cube {(n + 1) ** 3} nodes, linear", "program": "FreeFEM", "processes": 1, "total": wall,
                     "load": before, "processor": processor, "memory": memory, "nodes": (n + 1) ** 3, "steps": 20,
                     "iterations": found["iterations"] / 20, "worst": int(found["worst"]), "rejected": 0,
                     "final": {"T_far[degC]": found["far"], "T_edge[degC]": found["edge"]}}])]


def cube_of_calculix(n):
    """The same with CalculiX: specific heat with the latent heat in it, increments of its own choice."""
    if not shutil.which("ccx"):
        print("ccx is not there (Debian: calculix-ccx): left out", file=sys.stderr)
        return []
    folder = WORK / "calculix_freezing_cube"
    subprocess.run([sys.executable, "bench/freezing_cube/calculix_input.py", str(n), folder], check=True)
    before = load()
    wall, memory, processor = run(["ccx", "heat"], folder / "log.txt", folder, OMP_NUM_THREADS="1")
    increments = [line.split() for line in (folder / "heat.sta").read_text().split("\n")[2:] if line.strip()]
    iterations = [int(words[3]) for words in increments]
    accepted = sum(not words[2].endswith("U") for words in increments)
    last = [line.split() for line in (folder / "heat.dat").read_text().split("\n") if line.strip()][-2:]
    row = median([{"name": f"freezing cube {(n + 1) ** 3} nodes, linear", "program": "CalculiX", "processes": 1, "total": wall,
                   "load": before, "processor": processor, "memory": memory, "nodes": (n + 1) ** 3, "steps": accepted,
                   "iterations": sum(iterations) / accepted, "worst": max(iterations), "rejected": len(increments) - accepted,
                   "final": {"T_far[degC]": float(last[0][1]), "T_edge[degC]": float(last[1][1])}}])
    for file in ("heat.inp", "heat.frd"):
        (folder / file).unlink(missing_ok=True)
    return [row]


def heat():
    """The freezing cube of three sizes, on two processes too, and along with other programs with a linear freezing range."""
    rows = [freezing_cube(n) for n in CUBE]
    rows += [freezing_cube(CUBE[1], processes=2)]
    for n, programs in OTHERS.items():
        rows.append(freezing_cube(n, "linear"))
        if "FreeFEM" in programs:
            rows += cube_of_freefem(n)
        if "CalculiX" in programs:
            rows += cube_of_calculix(n)
    return rows


PARTS = {"micro": micro, "heat": heat, "case": case, "coupling": coupling, "check": check, "cylinder": cylinder, "mixed": mixed, "scaling": scaling,
         **{f"nodes{size}": functools.partial(side_by_side, size) for size in NODES}}


def table(header, rows):
    return "\n".join(["| " + " | ".join(header) + " |", "|" + "---|" * len(header)] +
                     ["| " + " | ".join(row) + " |" for row in rows]) + "\n"


def report(parts):
    text = ["# Benchmarks\n"]
    cpu = next((line.split(":")[1].strip() for line in open("/proc/cpuinfo") if line.startswith("model name")), "?")
    text.append(f"{cpu}, {os.cpu_count()} cores; {time.strftime('%Y-%m-%d')}. Load is the machine's load average when a run started.\n")
    if "micro" in parts:
        text.append(table(["phase", "benchmark", "ns", "per", "load"],
                          [[r["program"], r["name"], f"{r['ns']:.1f}", r["of"], f"{r['load']:.1f}"] for r in parts["micro"]]))
    if "check" in parts:
        text.append(table(["", "program", "corner [degC]", "displacement [um]"],
                          [[r["name"], r["program"], f"{r['final']['T_corner[degC]']:.4f}", f"{r['final']['u_corner[um]']:.3f}"]
                           for r in parts["check"]]))
    if "coupling" in parts:
        text.append(table(["", "scheme", "steps", "processor time per step [s]", "of isothermal", "load"],
                          [[r["name"], r["scheme"], str(r["steps"]), f"{r['per_step']:.3f}", f"{r['ratio']:.2f}", f"{r['load']:.1f}"]
                           for r in parts["coupling"]]))
    runs = [r for name in PARTS if name in parts and name not in ("micro", "coupling", "check") for r in parts[name]]
    if runs:
        seconds = lambda r, key: f"{r[key]:.2f}" if key in r else ""
        text.append(table(["", "program", "processes", "total [s]", "processor", "prepare", "heat", "mechanics", "output", "memory [MiB]",
                           "runs: fastest–slowest [s]", "load"],
                          [[r["name"], r["program"], str(r["processes"]), seconds(r, "total"), seconds(r, "processor"), seconds(r, "prepare"),
                            seconds(r, "heat"), seconds(r, "mechanics"), seconds(r, "output"), f"{r['memory']:.0f}",
                            f"{r['runs']}: {r['spread'][0]:.1f}–{r['spread'][1]:.1f}", f"{r['load']:.1f}"] for r in runs]))
    profiles = [r for r in runs if "profile" in r]
    if profiles:
        names = list(dict.fromkeys(name for r in profiles for name in r["profile"] if r["profile"][name] > 0.01 * r["profile"]["total"]))
        text.append("Where the wall time goes [s], parts above one per cent somewhere:\n")
        text.append(table(["", "processes", *names], [[r["name"], str(r["processes"]), *(f"{r['profile'].get(name, 0):.2f}" for name in names)]
                                                      for r in profiles]))
    if "heat" in parts:
        before = None
        lines = []
        for r in parts["heat"]:
            grows = before is not None and "linear" in r and before["name"].count(",") == r["name"].count(",") and r["nodes"] > before["nodes"]
            lines.append([r["name"], r["program"], str(r["processes"]), f"{r['processor']:.1f}", f"{r['total']:.1f}",
                          exponent(before, r) if grows else "", str(r["steps"]), f"{r['iterations']:.2f}", str(r["worst"]), str(r["rejected"]),
                          f"{r['linear']:.0f}" if "linear" in r else "", f"{r['memory'] * 2**20 / 1000 / r['nodes']:.2f}",
                          f"{r['final']['T_edge[degC]']:.1f}"])
            before = r if r["program"] == "Solidus" else before
        text.append(table(["", "program", "processes", "processor [s]", "wall [s]", "exponent", "steps", "iterations a step", "worst", "rejected",
                           "linear iterations a step", "memory [kB a node]", "T_edge [degC]"], lines))
    if "scaling" in parts:
        text.append(cost(parts["scaling"]))
    return "\n".join(text)


def exponent(a, b):
    """Of the processor time in the number of nodes."""
    return f"{math.log(b['processor'] / a['processor']) / math.log(b['nodes'] / a['nodes']):.2f}"


def cost(rows):
    """The exponent of the processor time between the sizes, and the memory per unknown."""
    lines = []
    for element in ("hex8", "tet4"):
        of = [r for r in rows if r["name"].endswith(element)]
        lines += [[a["name"], b["name"], exponent(a, b),
                   f"{b['memory'] * 2**10 / (4 * b['nodes']):.2f}"] for a, b in zip(of, of[1:])]
    return table(["from", "to", "exponent of processor time", "memory of the latter [KiB per unknown]"], lines)


def main():
    asked = sys.argv[1:] or [part for part in PARTS if part != "nodes300k"]
    if unknown := [part for part in asked if part not in PARTS]:
        sys.exit(f"unknown part {', '.join(unknown)}; there are: {', '.join(PARTS)}")
    WORK.mkdir(parents=True, exist_ok=True)
    for part in asked:
        print(f"==> {part}", file=sys.stderr, flush=True)
        rows = PARTS[part]()
        (WORK / f"part_{part}.json").write_text(json.dumps(rows, indent=1))
    done = {part: json.loads(f.read_text()) for part in PARTS if (f := WORK / f"part_{part}.json").exists()}
    text = report(done)
    (WORK / "report.md").write_text(text)
    print(text)
    print(f"written to {WORK / 'report.md'}", file=sys.stderr)


main()
