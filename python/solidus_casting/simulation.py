"""A simulation in this process, driven step by step."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping
from functools import partial
from pathlib import Path
from typing import Any

import numpy as np
from solidus_plots.vtu import Arrays, Grid

from .case import Case
from .core import closed_at_exit, core
from .errors import InputError, RunStopped, SolidusError
from .moment import Moment
from .progress import Progress
from .results import Results
from .toml_text import value_text


class Step(dict):
    """A computed step: a dictionary whose keys are also attributes.

    ``number``, ``time`` and ``step`` (its size) [s], ``reason`` for the size, ``rejected`` attempts before,
    ``shortened`` ones that ended after heat alone and the reason for the last (``rejection``), ``solid_fraction``,
    ``min_temperature`` and ``max_temperature`` [K], ``heat`` and ``mechanics`` with iterations and residuals,
    ``energy`` with the first law over the step [J].
    """

    def __getattr__(self, name: str) -> Any:
        try:
            value = self[name]
        except KeyError:
            raise AttributeError(f"a step has no '{name}'; one of: {', '.join(self)}") from None
        return Step(value) if isinstance(value, dict) else value

    def __dir__(self) -> list[str]:
        return [*super().__dir__(), *self]


class Simulation:
    """A run in this process that is controlled by the caller.

    :meth:`advance` computes a step without committing it: its fields can be read, and :meth:`repeat` computes it again,
    with another size or after a :meth:`change` of a condition. The next :meth:`advance` commits it; only then is it in
    tables, files and criteria. ``for step in simulation`` advances to the end.

    Parameters
    ----------
    case:
        A :class:`Case`, a case file or a folder.
    output:
        Folder for the results, with the same files as from the program; by default nothing is written.
    restart:
        Continue from the checkpoint in that folder.
    physics:
        ``"heat"`` or ``"thermomechanical"``, instead of the key of the case.
    trust_script:
        Run a ``.geo`` script whatever commands it contains.
    trust_laws:
        Load material laws from shared objects, in this and all later simulations of the process: this executes the code
        of their author.

    With several processes (:func:`initialize`) all of them must make every call, and fields are those of the process's
    own part.

    Examples
    --------
    >>> simulation = Simulation("cases/hot_spots")
    >>> for step in simulation:
    ...     if step.max_temperature < 850: break
    >>> simulation["temperature"].max()
    """

    def __init__(self, case: Case | str | Path, output: str | Path | None = None, *, restart: bool = False,
                 physics: str | None = None, trust_script: bool = False, trust_laws: bool = False) -> None:
        if not isinstance(case, Case):
            case = Case.load(case)
        if physics not in (None, "heat", "thermomechanical"):
            raise InputError(f"there is no physics {physics!r}", "'heat' or 'thermomechanical'", key="physics")
        self._folder = None if output is None else Path(output).absolute()
        module = core()
        with case.as_arguments() as arguments:
            self._session = module.Session(arguments[0], arguments[2::2], physics,
                                           "" if self._folder is None else str(self._folder), restart, trust_script,
                                           trust_laws)
        closed_at_exit(self)
        self._moves = 0  # fields of an earlier moment are gone
        self._moment: Moment | None = None
        self._mesh: tuple[Any, dict[str, Any]] | None = None
        self._ended = False

    # How far it has come

    @property
    def time(self) -> float:
        """Time of the present fields [s]."""
        return self._session.time

    @property
    def end(self) -> float | None:
        """End of the case [s]; ``None`` for a steady one."""
        return self._session.end

    @property
    def finished(self) -> bool:
        """Whether the end was reached."""
        return self._ended

    @property
    def pending(self) -> bool:
        """Whether the last step is not yet committed, so that it can be repeated."""
        return self._session.pending

    @property
    def step(self) -> Step:
        """The last step."""
        return Step(self._session.record)

    @property
    def bodies(self) -> list[str]:
        """Names of the bodies; ``simulation["body"]`` has their numbers."""
        return self._session.bodies

    @property
    def results(self) -> Results | None:
        """The results so far, where they are written."""
        return None if self._folder is None else Results(self._folder)

    # Going on

    def advance(self, step: float | None = None) -> Step | None:
        """Commits the previous step and computes the next one. Returns it, or ``None`` after the end.

        ``step`` is the wanted size [s], shortened where a time must be met; without it the case's step control decides.
        Steps that fail are shortened and repeated. Raises :class:`RunStopped` where no step succeeds.
        """
        return self._moved(self._session.advance(step))

    def repeat(self, step: float | None = None) -> Step | None:
        """Computes the last step again, for example with another size or after :meth:`change`."""
        return self._moved(self._session.repeat(step))

    def commit(self) -> None:
        """Commits the last step, so that criteria and tables include it; it cannot be repeated afterwards."""
        self._forget()
        self._session.commit()

    def change(self, key: str | Mapping[str, Any], value: Any = None) -> None:
        """Changes keys of thermal or mechanical conditions for the following computation.

        ``simulation.change("thermal_condition.mould.ambient", "50 degC")``, or a dictionary of such pairs. The
        following computation is the next step, or the last one again with :meth:`repeat`. Raises :class:`InputError` as
        for a case.
        """
        for path, content in (key.items() if isinstance(key, Mapping) else [(key, value)]):
            self._session.change(f"{path}={value_text(content)}")

    def run(self, until: float | None = None, progress: Callable[[Progress], Any] | None = None) -> Results | None:
        """Continues to the end, or to the first step that ends at `until` [s] or later. Returns :attr:`results`.

        Ctrl-C stops it after a whole step with :class:`RunInterrupted`.
        """
        if until is None and progress is None:
            self._forget()
            self._end(self._session.run())
            return self.results
        while until is None or self.time < until:
            step = self.advance()
            if step is None:
                break
            if progress is not None:
                progress(Progress(step.time, step.step, step.number, self.end, {k: str(v) for k, v in step.items()}))
        return self.results

    def __iter__(self) -> Iterator[Step]:
        while (step := self.advance()) is not None:
            yield step

    def _moved(self, ended: Any) -> Step | None:
        self._forget()
        self._end(ended)
        return None if ended is not None else self.step

    def _end(self, ended: Any) -> None:
        if ended is None:
            return
        finished, reason = ended
        if not finished:
            raise RunStopped(reason, self.results)
        self._ended = True

    def _forget(self) -> None:
        self._moves += 1
        self._moment = None

    # Fields

    @property
    def moment(self) -> Moment:
        """The fields at the present time of the simulation, with their mesh: arrays, probes and objects of other
        libraries.

        It belongs to this state: read the data you need before the simulation continues.
        """
        if self._moment is None:
            record = self._session.record
            key = (record["stage"], record["cycle"])
            if self._mesh is None or self._mesh[0] != key:
                self._mesh = (key, self._session.mesh())
            mesh = self._mesh[1]
            fields = self._session.fields()
            readers: dict[str, dict[str, Callable[[], np.ndarray]]] = {"nodes": {}, "elements": {}}
            for name, _, place, _ in fields:
                readers[place][name] = partial(self._read, name, self._moves)
            readers["nodes"]["node"] = lambda: mesh["node"]
            readers["elements"]["element"] = lambda: mesh["element"]
            readers["elements"]["body"] = lambda: mesh["body"]
            units = {name: unit for name, unit, _, _ in fields}
            grid = Grid(mesh["points"], mesh["types"], mesh["offsets"], mesh["connectivity"], Arrays(readers["nodes"]),
                        Arrays(readers["elements"]), units, self.time)
            self._moment = Moment(grid, self.bodies)
        return self._moment

    def _read(self, name: str, moves: int) -> np.ndarray:
        if moves != self._moves:
            raise SolidusError(f"the simulation has gone on since this moment was taken; '{name}' was not read before")
        return self._session.field(name)

    def __getitem__(self, field: str) -> np.ndarray:
        return self.moment[field]

    def fields(self) -> list[str]:
        """Names of all available fields, including those that are written to files only on request."""
        return [name for name, *_ in self._session.fields()]

    def probe(self, field: str, point: Any, body: str | None = None) -> Any:
        """A field at a point, or at each of an array of points; see :meth:`Moment.probe`."""
        return self.moment.probe(field, point, body)

    def __repr__(self) -> str:
        end = f" of {self.end:g} s" if self.end is not None else ""
        return f"<Simulation {self._session.title}: t = {self.time:g} s{end}{', a step is pending' if self.pending else ''}>"

    def close(self) -> None:
        """Frees its memory, and its folder for other runs. It cannot be used afterwards."""
        self._forget()
        self._mesh = None
        self._session = None

    def __enter__(self) -> "Simulation":
        return self

    def __exit__(self, *_: object) -> None:
        self.close()
