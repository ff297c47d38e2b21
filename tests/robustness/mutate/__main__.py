"""mutate RUNS [--seed S] [--program P] [--folder F] [--jobs J]

Damages files of the corpus (the project's cases, materials, point files, and corpus/) at random and gives them to
the program's verbs. Whatever the file, the program must end by itself within 20 s of a processor and 2 GB with exit
code 0, 1 (with a message that names a place) or 2. What does not is kept in FOLDER/SEED. Exit code 1 if there is any.
"""

import argparse
import os
import random
import re
import resource
import shutil
import signal
import subprocess
import sys
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

ROOT = Path(__file__).resolve().parents[3]
SECONDS, BYTES = 20 * int(os.environ.get("SOLIDUS_TEST_PATIENCE", "1")), 2 << 30
TOKENS = [b"-1", b"0", b"1e308", b"nan", b"inf", b"1e-300", b"99999999999999999999", b"\"\"", b"[]", b"{}", b"[[", b"]]", b"=", b"\"",
          b"'''", b"\x00", b"\xff\xfe", b"\x1b[31m", b"#", b"\n", b"true", b"\"1 m/m\"", b"\"-5 degC\"", b"\"1 parsec\"", b"..", b"/dev/zero",
          b"include = \"case.toml\"\n", b"[mesh]\n", b"1.2.3", b"\"" + b"x" * 5000 + b"\"", b"a." * 300, b"[" * 2000]


def corpus():
    """(verb, file): what may be damaged, and the verb that reads it."""
    seeds = [("run", p) for p in sorted((ROOT / "tests/robustness/mutate/corpus").glob("*.toml"))]
    seeds += [("check", p) for p in sorted((ROOT / "cases").glob("*/*.toml")) if p.name not in ("plots.toml", "variants.toml") and p.parent.name != "point"]
    seeds += [("materials", p) for p in sorted((ROOT / "materials").glob("*.toml"))]
    seeds += [("point", p) for p in sorted((ROOT / "cases/point").glob("*.toml"))]
    seeds += [("mesh-info", p) for p in sorted((ROOT / "tests/robustness/mutate/corpus").glob("mesh.*"))]
    return seeds


def mutate(rng, data, others):
    data = bytearray(data)
    for _ in range(rng.choice([1, 1, 2, 4, 16])):
        at = rng.randrange(len(data) + 1)
        length = min(len(data) - at, rng.choice([1, 2, 8, 40, 200]))
        what = rng.randrange(7)
        if what == 0 and at < len(data):
            data[at] ^= 1 << rng.randrange(8)
        elif what == 1:
            del data[at : at + length]
        elif what == 2:
            data[at:at] = rng.choice(TOKENS)
        elif what == 3:
            data[at:at] = data[at : at + length]
        elif what == 4:
            other = rng.choice(others)
            start = rng.randrange(len(other) + 1)
            data[at:at] = other[start : start + 10 * length]
        elif what == 5:  # another number where one is
            numbers = list(re.finditer(rb"[-+]?\d+(\.\d*)?([eE][-+]?\d+)?", bytes(data)))
            if numbers:
                number = rng.choice(numbers)
                data[number.start() : number.end()] = rng.choice(TOKENS[:7] + [b"%g" % (10 ** rng.uniform(-12, 12))])
        else:  # a line somewhere else
            lines = bytes(data).split(b"\n")
            line = lines.pop(rng.randrange(len(lines)))
            lines.insert(rng.randrange(len(lines) + 1), line)
            data = bytearray(b"\n".join(lines))
    return bytes(data)


def limits():
    resource.setrlimit(resource.RLIMIT_CPU, (SECONDS, SECONDS + 5))
    resource.setrlimit(resource.RLIMIT_FSIZE, (1 << 30, 1 << 30))


class Driver:
    def __init__(self, program, folder):
        self.program, self.folder = program, Path(folder)
        self.seeds = corpus()
        self.texts = [path.read_bytes() for _, path in self.seeds]

    def arguments(self, verb, file, folder):
        return {"run": ["run", file, "-o", folder / "results"], "point": ["point", file, "-o", folder / "results"],
                "materials": ["materials", file]}.get(verb, [verb, file])

    def run(self, seed):
        """Empty, or what went wrong."""
        rng = random.Random(seed)
        number = rng.randrange(len(self.seeds))
        verb, path = self.seeds[number]
        folder = self.folder / str(seed)
        shutil.rmtree(folder, ignore_errors=True)
        shutil.copytree(path.parent, folder, ignore=shutil.ignore_patterns("*.png", "results"))
        (folder / path.name).write_bytes(mutate(rng, self.texts[number], self.texts))
        environment = dict(os.environ, OMP_NUM_THREADS="1", OPENBLAS_NUM_THREADS="1",
                           SOLIDUS_MATERIALS=str(ROOT / "materials"))
        command = [str(a) for a in (self.program, *self.arguments(verb, folder / path.name, folder))]
        child = subprocess.Popen(command, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, env=environment,
                                 cwd=folder, preexec_fn=limits)
        out = child.stdout.read().decode(errors="replace")
        _, status, usage = os.wait4(child.pid, 0)
        child.returncode = code = os.waitstatus_to_exitcode(status)
        reason = ""
        if code == -signal.SIGXCPU:
            reason = f"more than {SECONDS} s" if verb != "run" else ""  # a case may be made longer by its damage
        elif code not in (0, 1, 2):
            reason = f"exit code {code}"
        elif code == 1 and not re.search(r"solidus: .", out):
            reason = "refused without a message"
        elif usage.ru_maxrss * 1024 > BYTES:
            reason = f"{usage.ru_maxrss / 1048576:.1f} GB"
        elif re.search(r"\x1b", out):
            reason = "control sequences reach the terminal"
        if reason:
            (folder / "log.txt").write_text(out)
            return f"seed {seed}: {verb} {path.relative_to(ROOT)}: {reason}: {out[-200:]!r}"
        shutil.rmtree(folder, ignore_errors=True)
        return ""


def main():
    parser = argparse.ArgumentParser(prog="mutate", description=__doc__,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("runs", type=int)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--program", default=ROOT / "build/release/solidus")
    parser.add_argument("--folder", default=ROOT / "build/mutate")
    parser.add_argument("--jobs", type=int, default=1)
    arguments = parser.parse_args()
    driver = Driver(arguments.program, arguments.folder)
    wrong = 0
    with ThreadPoolExecutor(arguments.jobs) as pool:
        for text in pool.map(driver.run, range(arguments.seed, arguments.seed + arguments.runs)):
            if text:
                wrong += 1
                print(text, flush=True)
    print(f"{arguments.runs} runs on {len(driver.seeds)} files, {wrong} wrong")
    return 1 if wrong else 0


sys.exit(main())
