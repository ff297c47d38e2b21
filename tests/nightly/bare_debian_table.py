"""One table of the releases that bare_debian.sh walked through: bare_debian_table.py FOLDER...

Each FOLDER is that of one release. A column holds what was measured there; a row that was measured nowhere is left out, and
a cell of a part that was not walked is empty.
"""

from pathlib import Path
import sys

# What a row is called, and the fact or the step of bare_debian.sh that it shows.
FACTS = [("sources", "sources"), ("compiler, CMake", "compiler, CMake"), ("PETSc, Open MPI, HDF5", "PETSc, Open MPI, HDF5"),
         ("Gmsh, matplotlib, Eigen", "Gmsh, matplotlib, Eigen"), ("packages of the bare root", "packages before"),
         ("packages after the first command", "packages"), ("first picture, seconds of the clock", "seconds to the first picture"),
         ("first command, seconds of the processor", "processor seconds of it"), ("files of pictures", "pictures"),
         ("tests passed", "tests passed"), ("tests skipped", "tests skipped"), ("tests failed", "tests failed"),
         ("skipped because", "why skipped")]


def lines(file):
    """The lines of a file of bare_debian.sh: what comes first in a line, and the rest of its columns."""
    if not file.exists():
        return {}
    return {line.split("\t")[0]: line.split("\t")[1:] for line in file.read_text().splitlines()}


def steps_of(folder):
    """How many steps went well, and the names of those that failed."""
    steps = lines(folder / "walk/steps")
    failed = [name for name, columns in steps.items() if columns[0] == "failed"]
    return f"{len(steps) - len(failed)} of {len(steps)}" + (f" (failed: {', '.join(failed)})" if failed else "")


def table(folders):
    facts = [{name: columns[0] for name, columns in lines(folder / "walk/facts").items() if columns} for folder in folders]
    rows = [["", *(fact.get("system", folder.name) for fact, folder in zip(facts, folders))]]
    rows += [[name, *(fact.get(key, "") for fact in facts)] for name, key in FACTS]
    rows += [["steps that went well", *(steps_of(folder) for folder in folders)]]
    rows = [row for number, row in enumerate(rows) if number == 0 or any(row[1:])]
    rows.insert(1, ["---"] * len(rows[0]))
    return "".join(f"| {' | '.join(row)} |\n" for row in rows)


if __name__ == "__main__":
    if len(sys.argv) < 2:
        sys.exit("usage: bare_debian_table.py FOLDER...")
    sys.stdout.write(table([Path(folder) for folder in sys.argv[1:]]))
