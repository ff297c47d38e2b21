"""``python3 -P -m solidus_casting.workbench [PART]``, which ``solidus open`` calls."""

from __future__ import annotations

import argparse
import os
import signal
import sys
import threading
import time
import webbrowser
from pathlib import Path

from ..errors import SolidusError


def main() -> int:
    parser = argparse.ArgumentParser(prog="solidus open", description="A page in which a case is made, checked, run and judged")
    parser.add_argument("part", metavar="PART", nargs="?", default="", help="a part, a mesh or a case")
    parser.add_argument("--no-browser", action="store_true", help="print the address and start no browser")
    options = parser.parse_args()
    try:
        from .server import Server
    except ImportError as error:
        return _refuse(f"the workbench needs numpy, and {sys.executable} has no '{error.name or error}'\n"
                       "  Debian's python3-numpy; SOLIDUS_PYTHON names another Python")
    part = Path(options.part)
    if options.part and not part.exists():
        return _refuse(f"there is no '{options.part}'\n  a part (STEP, BREP, IGES, STL), a mesh, or a case")
    # A part is worked on in its folder; a case is in the folder next to its part.
    if part.name == "case.toml":
        part = part.parent
    folder = part.resolve().parent if options.part else Path.cwd()
    try:
        server = Server(folder)
        if options.part:
            server.bench.open(part.resolve().name)
    except (SolidusError, OSError) as error:
        return _refuse(str(error))
    print(f"Open this address in a browser on this machine; Ctrl-C ends it:\n  {server.address}", flush=True)
    if not options.no_browser and (os.environ.get("DISPLAY") or os.environ.get("WAYLAND_DISPLAY")):
        webbrowser.open(server.address)
    threading.Thread(target=_end_with, args=(os.getppid(),), daemon=True).start()
    signal.signal(signal.SIGTERM, lambda *_: signal.raise_signal(signal.SIGINT))
    try:
        server.serve()
    except KeyboardInterrupt:
        print("\nends what is computed …", flush=True)
    finally:
        signal.signal(signal.SIGINT, signal.SIG_IGN)
        server.close()
    return 0


def _end_with(parent: int) -> None:
    """Ends as Ctrl-C does when the program that has started this one is gone, which a signal to it alone may bring about."""
    while os.getppid() == parent:
        time.sleep(0.5)
    signal.raise_signal(signal.SIGINT)


def _refuse(message: str) -> int:
    print(f"solidus: {message}", file=sys.stderr)
    return 1


if __name__ == "__main__":
    sys.exit(main())
