"""What is told of a run after every step."""

from __future__ import annotations

from dataclasses import dataclass, field


@dataclass(frozen=True)
class Progress:
    """A step that a run has committed.

    Attributes
    ----------
    time, end, step:
        How far the run has come, where it ends (``None`` where the case does not say), and the size of the step [s].
    number:
        Of the step, from one.
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
        """How much of the time is done, from 0 to 1."""
        return None if not self.end else min(1.0, self.time / self.end)
