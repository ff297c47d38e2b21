"""random CASES [--seed S] [--program P] [--folder F] [--jobs J] [--limit SECONDS] [--processes P]
                [--allow N] [--also SEED ...] [--physics PHYSICS] [--grow]

Runs cases made from the seeds S, S + 1, ... and says what of them broke an invariant, stopped (exit code 2) or was
refused. Folders of cases that went well are removed; the others stay, for `solidus run FOLDER/SEED/case.toml`.
Exit code 1 where more than N cases broke or stopped.
"""

import argparse
import collections
import shutil
import sys
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

sys.path.insert(0, str(Path(__file__).parent))

from case import random_case  # noqa: E402
from check import Runner  # noqa: E402


def main():
    root = Path(__file__).resolve().parents[3]
    parser = argparse.ArgumentParser(prog="random", description=__doc__,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("cases", type=int, help="how many")
    parser.add_argument("--seed", type=int, default=1, help="of the first one")
    parser.add_argument("--program", default=root / "build/release/solidus")
    parser.add_argument("--folder", default=root / "build/random")
    parser.add_argument("--jobs", type=int, default=1)
    parser.add_argument("--limit", type=int, default=60, help="of one run [s of a processor]")
    parser.add_argument("--processes", type=int, default=2, help="at most, of a run: 1 where others use the machine")
    parser.add_argument("--allow", type=int, default=0, help="how many may break or stop")
    parser.add_argument("--also", type=int, nargs="*", default=[], help="further seeds, of cases that were mended")
    parser.add_argument("--physics", default="", choices=["heat", "mechanics", "thermomechanical"],
                        help="that all cases have; default: what each draws")
    parser.add_argument("--grow", action="store_true", help="heat alone, of a body that grows")
    arguments = parser.parse_args()

    runner = Runner(arguments.program, arguments.folder, arguments.limit)
    count, reasons = collections.Counter(), collections.defaultdict(list)

    def run(seed):
        case = random_case(seed, arguments.physics, arguments.grow)
        case.processes = min(case.processes, arguments.processes)
        return case, runner.check(case)

    with ThreadPoolExecutor(arguments.jobs) as pool:
        seeds = [*range(arguments.seed, arguments.seed + arguments.cases), *arguments.also]
        for case, (kind, reason) in pool.map(run, seeds):
            count[kind] += 1
            if kind in ("ok", "refused"):
                shutil.rmtree(runner.folder / str(case.seed), ignore_errors=True)
            if kind == "refused":
                reasons[reason.split(": ", 1)[-1][:60]].append(case.seed)
            if kind in ("stopped", "broken"):
                facts = {k: v for k, v in case.facts.items() if k not in ("temperatures", "insulated", "heated")}
                print(f"seed {case.seed}: {kind}: {reason.strip()}\n  {facts}", flush=True)
    for reason, refused in reasons.items():
        print(f"refused {len(refused)}, for example seed {refused[0]}: {reason}")
    print(f"{len(seeds)} cases: " + ", ".join(f"{n} {kind}" for kind, n in sorted(count.items())))
    return 1 if count["stopped"] + count["broken"] > arguments.allow else 0


sys.exit(main())
