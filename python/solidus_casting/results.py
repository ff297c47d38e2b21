"""What a run left in its folder."""

from __future__ import annotations

import functools
import json
import math
import os
import xml.etree.ElementTree as ElementTree
from collections.abc import Iterator, Sequence
from pathlib import Path
from typing import Any

import numpy as np

from . import verbs
from .case import Case
from .errors import SolidusError
from .moment import Moment, Place
from .table import Table

_LARGEST_PLACES = 64  # of probes, kept for further fields


class Results(Sequence[Moment]):
    """The results of a run: tables, fields over time and the summary.

    A sequence of :class:`Moment`: ``results[-1]`` is the last one, ``results.at(60)`` that at 60 s. The folder may be
    that of a run in progress; :meth:`reload` reads it again.

    Examples
    --------
    >>> results = Results("results/hot_spots/default")
    >>> results.history["T_max"].max(), results.units["T_max"]
    >>> results.probe("temperature", (0.1, 0.02))
    """

    def __init__(self, folder: str | Path) -> None:
        #: where they lie
        self.folder = Path(os.path.abspath(folder))
        if not self.folder.is_dir():
            raise SolidusError(f"{self.folder}: there is no such folder")
        if not any((self.folder / name).exists() for name in ("steps.csv", "history.csv", "fields.pvd", "summary.json")):
            raise SolidusError(f"{self.folder}: no run of Solidus has left its results here")
        self.reload()

    def reload(self) -> None:
        """Discards the data read so far, so that the present state of a run in progress is read."""
        for name in ("history", "steps", "summary", "case", "_collection", "_bodies"):
            self.__dict__.pop(name, None)
        self._moments: dict[Path, Moment] = {}
        self._places: dict[Any, Place] = {}

    # Tables

    @functools.cached_property
    def history(self) -> Table:
        """``history.csv``: probes, contact and heat balance, one row per step."""
        return Table.read(self.folder / "history.csv")

    @functools.cached_property
    def steps(self) -> Table:
        """``steps.csv``: every step, its size and the reason for it, iterations, residuals."""
        return Table.read(self.folder / "steps.csv")

    @property
    def units(self) -> dict[str, str]:
        """Units of the columns of :attr:`history`."""
        return self.history.units

    def table(self, name: str) -> Table:
        """Another table by its name, for example ``"pools"`` or that of a profile."""
        return Table.read(self.folder / (name if name.endswith(".csv") else f"{name}.csv"))

    @property
    def tables(self) -> list[str]:
        """Names of the existing tables."""
        return sorted(file.stem for file in self.folder.glob("*.csv"))

    # The summary

    @functools.cached_property
    def summary(self) -> dict[str, Any]:
        """``summary.json``: how the run ended, sizes, times, warnings, answers. Empty during the run."""
        file = self.folder / "summary.json"
        return json.loads(file.read_text(encoding="utf-8")) if file.exists() else {}

    @property
    def answers(self) -> dict[str, Any]:
        """The answers of the run for the engineer: freezing time, gap, distortion and others, with their errors."""
        return self.summary.get("answers", {})

    @property
    def criteria(self) -> dict[str, Any]:
        """The minimum and maximum of every criterion with their places; the units are in the names."""
        return self.summary.get("criteria", {})

    @property
    def fields(self) -> dict[str, dict[str, Any]]:
        """Properties of the fields written by the run, by name: label, unit, display unit, marker for "no value"."""
        return self.summary.get("fields", {})

    @property
    def warnings(self) -> list[str]:
        """Warnings of the run."""
        return self.summary.get("warnings", [])

    @property
    def finished(self) -> bool:
        """Whether the run reached its end."""
        return self.summary.get("outcome") == "finished"

    @functools.cached_property
    def case(self) -> Case:
        """The case of the run, with every default filled in; it can be changed and run again."""
        return Case.load(self.folder / "case.toml")

    # Fields

    @functools.cached_property
    def _collection(self) -> dict[str, list[tuple[float, Path]]]:
        """Times and files of the bodies ("") and of each contact surface."""
        file = self.folder / "fields.pvd"
        if not file.exists():
            return {"": []}
        found: dict[str, list[tuple[float, Path]]] = {"": []}
        for entry in ElementTree.parse(file).getroot().iter("DataSet"):
            path = self.folder / entry.get("file", "")
            part = entry.get("part", "0")
            surface = "" if part == "0" else path.stem.removeprefix("surface_").rpartition("_")[0]
            found.setdefault(surface, []).append((float(entry.get("timestep", "0")), path))
        return found

    @functools.cached_property
    def _bodies(self) -> list[str]:
        """Names of the bodies in the order of the case, which numbers them."""
        file = self.folder / "case.toml"
        if not file.exists():
            return []
        import tomllib

        return [body["name"] for body in tomllib.loads(file.read_text(encoding="utf-8")).get("body", [])]

    @property
    def times(self) -> np.ndarray:
        """Times at which fields were written [s]."""
        return np.array([time for time, _ in self._collection[""]])

    @property
    def surfaces(self) -> list[str]:
        """Names of the contact surfaces with fields."""
        return [name for name in self._collection if name]

    def surface(self, name: str, index: int = -1) -> Moment:
        """The fields of a contact surface at the moment `index` of :attr:`times`."""
        if name not in self.surfaces:
            raise KeyError(f"there is no surface '{name}'; one of: {', '.join(self.surfaces)}")
        return Moment.read(self._collection[name][index][1])

    def __len__(self) -> int:
        return len(self._collection[""])

    def __getitem__(self, index: Any) -> Any:
        if isinstance(index, slice):
            return [self[number] for number in range(*index.indices(len(self)))]
        files = self._collection[""]
        if not -len(files) <= index < len(files):
            raise IndexError(f"there are {len(files)} moments with fields")
        file = files[index][1]
        if file not in self._moments:
            if len(self._moments) >= 4:  # a moment of a large run is large
                self._moments.pop(next(iter(self._moments)))
            self._moments[file] = Moment.read(file, self._bodies)
        return self._moments[file]

    def __iter__(self) -> Iterator[Moment]:
        return (self[index] for index in range(len(self)))

    def at(self, time: float, nearest: bool = False) -> Moment:
        """The moment at a time [s]; with `nearest` the closest one."""
        times = self.times
        if not times.size:
            raise SolidusError(f"{self.folder}: no fields were written yet")
        index = int(np.argmin(np.abs(times - time)))
        if not nearest and not math.isclose(times[index], time, rel_tol=1e-9, abs_tol=1e-12):
            raise KeyError(f"there are no fields at {time:g} s; the nearest are at {times[index]:g} s (nearest=True takes them)")
        return self[index]

    # Probes after the fact

    def probe(self, field: str, point: Any, body: str | None = None) -> np.ndarray:
        """A field at a point over :attr:`times`: [time], of vectors and tensors [time][component].

        Nodal fields are interpolated with the shape functions of the element, element fields are constant in it.
        ``point`` has two or three coordinates in the undeformed bodies [m]; for an array of points the result is
        [time][point].
        """
        given = np.asarray(point, float)
        if given.ndim == 2:
            return np.stack([self.probe(field, each, body) for each in given], 1)
        return np.array([moment.probe(field, self._place(moment, given, body)) for moment in self])

    def _place(self, moment: Moment, point: np.ndarray, body: str | None) -> Place:
        # Bodies leave, and the others are numbered again: the number of cells tells.
        key = (tuple(point.tolist()), body, len(moment["body"]) if "body" in moment else 0)
        if key not in self._places:
            if len(self._places) >= _LARGEST_PLACES:
                self._places.pop(next(iter(self._places)))
            self._places[key] = moment.place(point, body)
        return self._places[key]

    def __repr__(self) -> str:
        outcome = self.summary.get("outcome", "not ended")
        title = self.summary.get("title", "")
        span = f", fields at {len(self)} moments up to {self.times[-1]:g} s" if len(self) else ""
        return f"<Results {self.folder}: {title + ', ' if title else ''}{outcome}{span}>"

    def report(self, output: str | Path | None = None) -> Path:
        """Writes the page ``report.html`` and returns its path."""
        file = Path(output).absolute() if output else self.folder / "report.html"
        verbs.call("report", self.folder, "-o", file)
        return file

    def plot(self) -> Path:
        """Draws the pictures of the run as ``solidus plot`` does and returns their folder."""
        verbs.call("plot", self.folder)
        return self.folder / "plots"
