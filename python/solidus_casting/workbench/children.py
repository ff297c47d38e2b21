"""Verbs of the program as child processes that can be stopped."""

from __future__ import annotations

import os
import signal
import subprocess
import threading
from collections.abc import Callable, Sequence
from pathlib import Path
from typing import IO

from .. import verbs

_PATIENCE = 20.0  # seconds for a child that was asked to end


class Child:
    """Runs one verb.

    Parameters
    ----------
    words:
        Those behind ``solidus``.
    heard:
        Called with each line and whether it is of standard error, from threads of its own.
    """

    def __init__(self, words: Sequence[str], folder: Path, heard: Callable[[str, bool], None]) -> None:
        self.output: list[str] = []
        self.messages: list[str] = []
        self._process = subprocess.Popen([str(verbs.program()), *words], cwd=folder, env=verbs.environment(), text=True, errors="replace",
                                         stdin=subprocess.DEVNULL, stdout=subprocess.PIPE, stderr=subprocess.PIPE, start_new_session=True)
        self._readers = [threading.Thread(target=self._read, args=(stream, lines, heard), daemon=True)
                         for stream, lines in ((self._process.stdout, self.output), (self._process.stderr, self.messages))]
        for reader in self._readers:
            reader.start()

    def _read(self, stream: IO[str], lines: list[str], heard: Callable[[str, bool], None]) -> None:
        with stream:
            for line in stream:
                lines.append(line.rstrip("\n"))
                heard(lines[-1], lines is self.messages)

    def wait(self) -> int:
        """Waits for the end. Returns the exit code."""
        code = self._process.wait()
        for reader in self._readers:
            reader.join(timeout=5)
        return code

    def ask_to_stop(self) -> None:
        """As Ctrl-C does: a run ends behind a whole step and leaves its checkpoint."""
        if self._process.poll() is None:
            self._process.send_signal(signal.SIGINT)

    def end(self) -> None:
        """Asks to stop, and ends the child with all it has started where that takes long."""
        self.ask_to_stop()
        try:
            self._process.wait(timeout=_PATIENCE)
        except subprocess.TimeoutExpired:
            self.kill()

    def kill(self) -> None:
        try:
            os.killpg(self._process.pid, signal.SIGKILL)
        except ProcessLookupError:
            pass
