"""``python3 -P -m solidus_casting.mcp FOLDER``, which ``solidus mcp FOLDER`` calls."""

from __future__ import annotations

import argparse
import logging
import os
import shutil
import signal
import sys
import tempfile
from pathlib import Path
from typing import BinaryIO

from .. import verbs
from ..errors import SolidusError
from .protocol import VERSIONS, Server
from .room import Room
from .tools import tools

_INSTRUCTIONS = """\
Solidus simulates how metal castings solidify. From a part: new, check, run, report; compare two runs.
Paths are seen from the folder of the server; other files are refused. Computing is done one request after the other.
Tell the user every finding, and every number with its error: "62 s +- 4 s". An error is of step and mesh alone; material data and
heat transfer at the mould are often known to a third. Where a finding doubts the case, change the case (its file, or `set`) and
check again before a run. Heat alone (physics "heat") answers where and when it freezes; "thermomechanical" adds gaps, distortion
and stress and takes far longer."""


def main() -> int:
    parser = argparse.ArgumentParser(prog="solidus mcp", description="Serves assistants: the Model Context Protocol over standard input and output, "
                                     f"versions {', '.join(VERSIONS)}")
    parser.add_argument("folder", metavar="FOLDER", nargs="?", default=".", help="the only folder that is worked in; default the present one")
    parser.add_argument("--trust-files", action="store_true",
                        help="serve where the system cannot refuse other files: only the paths of cases are looked at")
    options = parser.parse_args()
    logging.basicConfig(stream=sys.stderr, level=logging.WARNING, format="solidus mcp: %(message)s")
    if not sys.flags.safe_path:
        return _refuse("Python would take modules from the present folder: solidus mcp, or python3 -P -m solidus_casting.mcp")
    temporary = Path(tempfile.mkdtemp(prefix="solidus_mcp_"))
    # The server may not touch what lies around its folders: another process, which reads nothing, takes this one away.
    child = os.fork()
    if child == 0:
        return _serve(options.folder, temporary, options.trust_files)
    signal.signal(signal.SIGINT, signal.SIG_IGN)
    signal.signal(signal.SIGTERM, lambda *_: os.kill(child, signal.SIGTERM))
    _, status = os.waitpid(child, 0)
    shutil.rmtree(temporary, ignore_errors=True)
    code = os.waitstatus_to_exitcode(status)
    return code if code >= 0 else 128 - code


def _serve(folder: str, temporary: Path, trust_files: bool) -> int:
    try:
        room = Room(folder)
        information = {"name": "solidus", "title": "Solidus", "version": verbs.version()}
        os.environ.update(TMPDIR=str(temporary), MPLCONFIGDIR=str(temporary), PYTHONSAFEPATH="1")
        tempfile.tempdir = str(temporary)
        os.chdir(room.folder)
        if not _confined(room, temporary, trust_files):
            return 1
        server = Server(tools(room), information, _INSTRUCTIONS, _own_output())
        signal.signal(signal.SIGTERM, _leave)
        server.serve(sys.stdin.buffer)
        return 0
    except SolidusError as error:
        return _refuse(str(error))
    except KeyboardInterrupt:
        return 130


def _confined(room: Room, temporary: Path, trust: bool) -> bool:
    try:
        without_network = room.confine(temporary)
    except OSError as error:
        if not trust:
            _refuse(f"the system cannot keep this server in {room.folder}: {error}\n"
                    "  Linux 5.13 or newer with Landlock; or --trust-files, where every file of the folder is your own")
            return False
        logging.getLogger("solidus_casting.mcp").warning("the system does not refuse other files (%s): trusted as asked", error)
        return True
    refused = "other files, programs in it, and connections by TCP" if without_network else "other files, and programs in it"
    print(f"solidus mcp: works in {room.folder}; the system refuses {refused}", file=sys.stderr, flush=True)
    return True


def _own_output() -> BinaryIO:
    """Standard output for messages alone: what else is written there, by a library or a child, goes to standard error."""
    output = os.fdopen(os.dup(sys.stdout.fileno()), "wb")
    os.dup2(sys.stderr.fileno(), sys.stdout.fileno())
    sys.stdout = sys.stderr
    return output


def _leave(number: int, frame: object) -> None:
    del frame
    sys.exit(128 + number)


def _refuse(message: str) -> int:
    print(f"solidus: {message}", file=sys.stderr)
    return 1


if __name__ == "__main__":
    sys.exit(main())
