"""What is computed at present, and the refusal of what cannot be done meanwhile."""

from __future__ import annotations

import time

from ..errors import SolidusError
from .children import Child


class Conflict(SolidusError):
    """The page asked for a change of something that has changed meanwhile, or while a job runs."""


class Job:
    """What is computed at present: its name, what it has printed, and how it is stopped.

    Attributes
    ----------
    number:
        Counts the jobs of a server, so that a page knows one that has ended from one before it.
    """

    def __init__(self, what: str, label: str, number: int) -> None:
        self.what, self.label, self.number, self.began = what, label, number, time.time()
        self.lines: list[str] = []
        self.child: Child | None = None
        self.stopping = False
        self.run: str | None = None
        self.watch: str | None = None
