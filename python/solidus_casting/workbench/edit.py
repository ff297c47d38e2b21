"""A change of what is open, as one step that no other page gets between."""

from __future__ import annotations

from typing import TYPE_CHECKING, Protocol

if TYPE_CHECKING:
    from .case_folder import CaseFolder


class Editable(Protocol):
    """What has a case that is changed, and lets one page at a time change it."""

    def begin_edit(self, seen: int) -> CaseFolder: ...

    def end_edit(self) -> None: ...


class Edit:
    """A change of what is open, in a ``with``: it is refused where the page does not know what it changes."""

    def __init__(self, bench: Editable, seen: int) -> None:
        self._bench, self._seen = bench, seen

    def __enter__(self) -> CaseFolder:
        return self._bench.begin_edit(self._seen)

    def __exit__(self, *_: object) -> None:
        self._bench.end_edit()
