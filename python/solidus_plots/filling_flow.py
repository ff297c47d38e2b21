"""A run of OpenFOAM's icoReactingMultiphaseInterFoam in pieces of time, on one or several processes.

Between two pieces fields are read and boundary conditions are changed in the files of the last time. Cells and faces keep the
numbers of the whole mesh, on however many parts the solver runs.
"""

from dataclasses import dataclass
import os
from pathlib import Path
import re
import shutil
import signal
import subprocess
import time

import numpy as np

from solidus_plots.vtu import ResultError

SOLVER = "icoReactingMultiphaseInterFoam"
PACKAGE = "Debian's package openfoam"
POLL = 0.2  # [s]


class FlowError(Exception):
    """The flow could not be computed further; the text is for the user."""


def environment():
    """That of OpenFOAM's programs: where its settings are, one thread each."""
    made = {**os.environ, "OMP_NUM_THREADS": "1", "OPENBLAS_NUM_THREADS": "1"}
    if "WM_PROJECT_DIR" not in made:
        made["WM_PROJECT_DIR"] = "/usr/share/openfoam"
    return made


def version():
    """The version of OpenFOAM that is found, "1912". Throws ResultError."""
    if shutil.which(SOLVER) is None:
        raise ResultError(f"a mould is filled by OpenFOAM, whose program {SOLVER} is not there\n  {PACKAGE}, version 1912")
    said = subprocess.run([SOLVER, "-help"], capture_output=True, text=True, env=environment(), stdin=subprocess.DEVNULL)
    found = re.search(r"(?:Using: OpenFOAM|OpenFOAM)[-\s:(]*v?(\d{4})", said.stdout + said.stderr)
    if found is None:
        raise ResultError(f"{SOLVER} does not say its version\n  {PACKAGE}, version 1912; `{SOLVER} -help` tells more")
    return found.group(1)


@dataclass
class Part:
    """What one process of the solver has."""

    folder: Path
    cells: np.ndarray  # numbers in the whole mesh
    patches: dict  # name -> numbers of its faces within the patch of the whole mesh


def numbers_of(path):
    """The list of whole numbers of a file of OpenFOAM."""
    text = path.read_text()
    body = text[text.index("}") + 1:]
    return np.array(body[body.index("(") + 1:body.rindex(")")].split(), dtype=int)


def boundary_of(folder):
    """{name: (number of faces, first face)} of a mesh."""
    text = (folder / "constant/polyMesh/boundary").read_text()
    text = text[text.index("(", text.index("}")):]
    return {name: (int(re.search(r"nFaces\s+(\d+)", entry).group(1)), int(re.search(r"startFace\s+(\d+)", entry).group(1)))
            for name, entry in re.findall(r"(\w+)\s*\{([^}]*)\}", text)}


def parts_of(folder, n_cells, processes):
    """The parts of a case: itself, or its processor folders."""
    whole = boundary_of(folder)
    if processes == 1:
        return [Part(folder, np.arange(n_cells), {name: np.arange(n) for name, (n, _) in whole.items()})]
    parts = []
    for number in range(processes):
        part = folder / f"processor{number}"
        faces = np.abs(numbers_of(part / "constant/polyMesh/faceProcAddressing")) - 1
        patches = {name: faces[start:start + n] - whole[name][1]
                   for name, (n, start) in boundary_of(part).items() if name in whole}
        parts.append(Part(part, numbers_of(part / "constant/polyMesh/cellProcAddressing"), patches))
    return parts


def values_in(text, count):
    """The values behind the word internalField or value, up to the end of their list: [count] or [count][3]. They are written as
    `uniform x;`, `nonuniform List<scalar> 3{x}`, or with all values in brackets, in one line or a line each."""
    text = text.lstrip()
    if text.startswith("uniform"):
        numbers = np.array(text[len("uniform"):text.index(";")].replace("(", " ").replace(")", " ").split(), float)
        return np.tile(numbers, (count, 1)) if len(numbers) > 1 else np.full(count, numbers[0])
    head = re.match(r"nonuniform\s+List<(\w+)>\s*(\d+)\s*([({]?)", text)
    size, vector = int(head.group(2)), head.group(1) == "vector"
    if size == 0:
        return np.zeros((0, 3) if vector else 0)
    if head.group(3) == "{":
        numbers = np.array(text[head.end():text.index("}")].replace("(", " ").replace(")", " ").split(), float)
        return np.tile(numbers, (size, 1)) if vector else np.full(size, numbers[0])
    if vector:
        # A bracket each: the list ends with the second of two.
        end = re.compile(r"\)\s*\)").search(text, head.end()).start()
        return np.array(text[head.end():end].replace("(", " ").replace(")", " ").split(), float).reshape(size, 3)
    return np.array(text[head.end():text.index(")", head.end())].split(), float)


def rewrite(file, text):
    """Replaces a file as a whole: a filling that is stopped in between goes on from it."""
    part = file.with_name(f".{file.name}.part")
    part.write_text(text)
    part.replace(file)


def patch_block(text, name):
    """Where the entries of a patch begin and end in a field."""
    start = re.search(rf"\n    {re.escape(name)}\n    \{{\n", text)
    if start is None:
        return None
    return start.end(), text.index("\n    }\n", start.end() - 1)


class FoamRun:
    """The solver on a case that has been written into a folder."""

    def __init__(self, folder, n_cells, processes):
        self.folder, self.processes, self.n_cells = folder, processes, n_cells
        self.log = folder / "log.txt"
        if processes > 1 and not (folder / "processor0").exists():
            self._tool(["decomposePar", "-case", str(folder)])
        self.parts = parts_of(folder, n_cells, processes)
        self.seconds = 0.0

    def _tool(self, command):
        done = subprocess.run(command, capture_output=True, text=True, env=environment(), stdin=subprocess.DEVNULL)
        if done.returncode != 0:
            raise FlowError(f"OpenFOAM's {command[0]} failed: {reason_in(done.stdout + done.stderr)}")

    def times(self):
        """The times that are written, rising, with the names of their folders."""
        names = [entry.name for entry in self.parts[0].folder.iterdir() if re.fullmatch(r"[0-9.]+(e-?\d+)?", entry.name)]
        return sorted((float(name), name) for name in names)

    def run(self, watch):
        """Computes until the end of system/controlDict. watch(line): for each line that the solver says. Throws FlowError."""
        command = [SOLVER, "-case", str(self.folder)]
        if self.processes > 1:
            command = ["mpirun", "-n", str(self.processes), "--bind-to", "none", "--oversubscribe", *command, "-parallel"]
        begin = time.monotonic()
        with self.log.open("ab") as out:
            start = out.tell()
            child = subprocess.Popen(command, stdout=out, stderr=subprocess.STDOUT, stdin=subprocess.DEVNULL, env=environment(),
                                     start_new_session=True)
        try:
            with self.log.open("r", errors="replace") as said:
                said.seek(start)
                ended = False
                while not ended:
                    ended = child.poll() is not None
                    for line in said:
                        watch(line)
                    if not ended:
                        time.sleep(POLL)
        except BaseException:
            os.killpg(child.pid, signal.SIGTERM)
            child.wait()
            raise
        self.seconds += time.monotonic() - begin
        with self.log.open("r", errors="replace") as said:
            said.seek(start)
            text = said.read()
        if child.returncode != 0 or "\nEnd" not in text:
            raise FlowError(f"{reason_in(text)}\n  {self.log} holds all that OpenFOAM said")

    def read(self, name, field):
        """A field of a time in all cells."""
        whole = None
        for part in self.parts:
            text = (part.folder / name / field).read_text()
            text = text[text.index("internalField") + len("internalField"):]
            values = values_in(text, len(part.cells))
            if whole is None:
                whole = np.zeros((self.n_cells, *values.shape[1:]))
            whole[part.cells] = values
        return whole

    def read_patch(self, name, field, patch, count):
        """The values of a field on a patch."""
        whole = np.zeros(count)
        for part in self.parts:
            faces = part.patches.get(patch, np.zeros(0, int))
            if not len(faces):
                continue
            text = (part.folder / name / field).read_text()
            begin, end = patch_block(text, patch)
            block = text[begin:end + 1]
            whole[faces] = values_in(block[re.search(r"\n?\s*value\s", block).end():], len(faces))
        return whole

    def change_patch(self, name, field, patch, entries):
        """Replaces the entries of a patch. entries(faces): the text for these faces of it."""
        for part in self.parts:
            file = part.folder / name / field
            if not file.exists():
                continue
            text = file.read_text()
            place = patch_block(text, patch)
            if place is not None:
                faces = part.patches.get(patch, np.zeros(0, int))
                rewrite(file, f"{text[:place[0]]}        {entries(faces)}{text[place[1]:]}")

    def change_cells(self, name, field, values):
        """Replaces the values of a field in all cells [cell]."""
        for part in self.parts:
            file = part.folder / name / field
            text = file.read_text()
            begin, end = text.index("internalField"), text.index("boundaryField")
            numbers = "\n".join(f"{value:.10g}" for value in values[part.cells])
            rewrite(file, f"{text[:begin]}internalField nonuniform List<scalar>\n{len(part.cells)}\n(\n{numbers}\n);\n\n{text[end:]}")

    def forget(self, name):
        """Removes the fields of a time."""
        for part in self.parts:
            shutil.rmtree(part.folder / name, ignore_errors=True)


def reason_in(text):
    """Why OpenFOAM ended, from what it said."""
    fatal = re.search(r"--> FOAM FATAL (?:IO )?ERROR\s*:?[^\n]*\n(.*?)(?:\n\s*\n|\n\s*(?:From|file:))", text, re.DOTALL)
    if fatal:
        return "OpenFOAM stopped: " + " ".join(fatal.group(1).split())
    if "sigFpe" in text or "Floating point exception" in text:
        times = re.findall(r"^Time = (\S+)", text, re.MULTILINE)
        return (f"the flow blew up at {times[-1] if times else '0'} s: a slower rate or a wider gate helps, and so do more cells "
                "across the gate and thin walls")
    last = [line for line in text.splitlines() if line.strip()]
    return "OpenFOAM ended early" + (f": {last[-1].strip()}" if last else "")
