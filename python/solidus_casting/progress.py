"""What is told of a run after every step."""

from __future__ import annotations

from dataclasses import dataclass, field


@dataclass(frozen=True)
class Progress:
    """A step that a run has committed.

    Attributes
    ----------
    time, end, step:
        Present time, end of the run (``None`` where the case has none), and size of the step [s].
    number:
        Number of the step, from one.
    row:
        The whole row of ``steps.csv``, by header.
    """

    time: float
    step: float
    number: int
    end: float | None = None
    row: dict[str, str] = field(default_factory=dict, repr=False)

    @property
    def fraction(self) -> float | None:
        """Computed fraction of the time, from 0 to 1."""
        return None if not self.end else min(1.0, self.time / self.end)
