"""A case: what is cast, in which mould, for how long. Reads, changes, checks and writes case files."""

from __future__ import annotations

import contextlib
import copy
import tempfile
import tomllib
from collections.abc import Iterator, Mapping
from pathlib import Path
from typing import Any, Callable

from . import schema as schemas, verbs, written
from .errors import InputError
from .sections import Document, Section, plain
from .toml_text import document_text, key_text, value_text


class Case(Section):
    """A case of Solidus.

    Keys are attributes with completion, ``case.time.step``, and items by path, ``case["body.casting.material"]``; both can be
    assigned. An unknown key or a value of the wrong kind raises :class:`InputError` at once; units, groups of the mesh
    and the agreement of several keys are checked by the program itself in :meth:`check` and before a run.

    Parameters
    ----------
    document:
        Keys and sections as in a case file; by default an empty case.
    folder:
        The folder to which relative paths (of meshes and materials) refer; the current one by default.

    Examples
    --------
    >>> case = Case.load("cases/hot_spots")
    >>> case.time.step = "1 s"
    >>> case.body.casting.initial_temperature = "700 degC"
    """

    def __init__(self, document: Mapping[str, Any] | None = None, *, folder: str | Path | None = None) -> None:
        own: Document = {}
        super().__init__(self, schemas.case_schema(), "", lambda _: own)
        self._set(file=None, variant="", folder=Path(folder or Path.cwd()).absolute(), loaded=None, cache=None)
        for key, value in (document or {}).items():
            self[key] = value

    def _set(self, **fields: Any) -> None:
        for name, value in fields.items():
            object.__setattr__(self, f"_{name}", value)

    @classmethod
    def load(cls, path: str | Path) -> "Case":
        """Reads a case file, the ``case.toml`` of a folder, or a variant of either, ``"CASE:VARIANT"``.

        A variant is read as a whole case. Raises :class:`InputError`.
        """
        file, variant = Path(path).absolute(), ""
        if not file.exists() and ":" in file.name:
            before, _, variant = str(path).rpartition(":")
            file = Path(before or ".").absolute()
        if file.is_dir():
            file = file / "case.toml"
        if variant:
            document = tomllib.loads(verbs.call("resolve", f"{file}:{variant}"))
            case = cls(folder=file.parent)
            case.given().update(document)
            case._set(file=file, variant=variant, loaded=copy.deepcopy(document))
            return case
        try:
            document = tomllib.loads(file.read_text(encoding="utf-8-sig"))
        except (OSError, UnicodeDecodeError, tomllib.TOMLDecodeError) as error:
            verbs.call("resolve", file)  # says what is wrong as the program does
            raise InputError(str(error), file=file) from error
        case = cls(folder=file.parent)
        case.given().update(document)
        case._set(file=file, loaded=copy.deepcopy(document))
        return case

    @property
    def file(self) -> Path | None:
        """The file that the case was read from or saved to, if there is one."""
        return self._file

    @property
    def folder(self) -> Path:
        """The folder to which relative paths refer."""
        return self._folder

    def copy(self, changes: Mapping[str, Any] | None = None) -> "Case":
        """An independent copy with some keys changed: ``case.copy({"time.step": "1 s"})``."""
        other = Case(folder=self._folder)
        other.given().update(copy.deepcopy(self.given()))
        other._set(file=self._file, variant=self._variant, loaded=copy.deepcopy(self._loaded))
        for path, value in (changes or {}).items():
            other[path] = value
        return other

    def __copy__(self) -> "Case":
        return self.copy()

    def __deepcopy__(self, memo: dict[int, Any]) -> "Case":
        return self.copy()

    def to_dict(self) -> Document:
        """The keys given in the case, as plain dictionaries, lists, strings and numbers."""
        return plain(self)

    def to_toml(self) -> str:
        """The keys given in the case, as the text of a case file. Comments of the original file are not kept."""
        return document_text(self.to_dict())

    def save(self, path: str | Path) -> Path:
        """Writes the case to a file, or as ``case.toml`` into a folder, and returns the file.

        Relative paths of meshes and materials become absolute if the folder changes.
        """
        file = Path(path).absolute()
        if file.is_dir() or not file.suffix:
            file.mkdir(parents=True, exist_ok=True)
            file = file / "case.toml"
        moved = file.parent.resolve() != self._folder.resolve()
        document = _with_absolute_paths(self.to_dict(), self._folder) if moved else self.to_dict()
        file.parent.mkdir(parents=True, exist_ok=True)
        file.write_text(document_text(document), encoding="utf-8")
        self.given().clear()
        self.given().update(document)
        self._set(file=file, variant="", folder=file.parent, loaded=copy.deepcopy(document))
        return file

    def explain(self, key: str = "") -> str:
        """The meaning of a key, its unit, default and range; without a key, of all keys."""
        return verbs.cached("explain", *([key] if key else []))

    def resolved(self) -> Document:
        """The complete case as the program reads it: with includes merged, defaults filled in and absolute paths.

        Raises :class:`InputError`. The mesh is not read; :meth:`check` reads it.
        """
        if self._cache is None:
            with self.as_arguments() as arguments:
                self._set(cache=tomllib.loads(verbs.call("resolve", *arguments)))
        return copy.deepcopy(self._cache)

    def check(self, *, physics: str | None = None) -> str:
        """Checks everything without solving: keys, materials, mesh, groups, probes. Returns the program's description
        of the case.

        Raises :class:`InputError` for the first error, with its place, the value found and the values allowed.
        """
        with self.as_arguments() as arguments:
            return verbs.call("check", *arguments, *physics_option(physics))

    def run(self, output: str | Path | None = None, **options: Any) -> Any:
        """Runs the case as a child process and returns its :class:`Results`; see :func:`solidus_casting.run`."""
        assert _run is not None, "solidus_casting.child says how cases run"
        return _run(self, output, **options)

    @contextlib.contextmanager
    def as_arguments(self) -> Iterator[list[str]]:
        """The command-line arguments that pass this case to a verb of the program.

        For a case file with some keys changed these are its name and ``--set``, so that errors name the file and its
        lines; otherwise a temporary file with the whole case, which exists within the context.
        """
        changes = self._assignments()
        if changes is not None:
            words = [f"{self._file}:{self._variant}" if self._variant else str(self._file)]
            for change in changes:
                words += ["--set", change]
            yield words
            return
        with tempfile.TemporaryDirectory(prefix="solidus_case_") as folder:
            file = Path(folder) / "case.toml"
            text = document_text(_with_absolute_paths(self.to_dict(), self._folder))
            file.write_text(text, encoding="utf-8")
            written.remember(file, text)
            try:
                yield [str(file)]
            except InputError as error:
                if error.file != file:
                    raise
                key = written.key_at(text, error.line or 0)
                raise InputError(error.found, error.allowed, key=key) from error

    def _assignments(self) -> list[str] | None:
        """What changed since the case was read, as ``path=value``; nothing where that cannot be said so."""
        if self._file is None or self._loaded is None or not self._file.exists():
            return None
        found: list[str] = []
        return found if _differences(self._loaded, self.given(), "", found) else None

    # Called by sections

    def _changed(self) -> None:
        self._set(cache=None)

    def _resolved_or_nothing(self, path: str) -> Any:
        try:
            return self._resolved_value(path)
        except KeyError:
            return None

    def _resolved_value(self, path: str) -> Any:
        try:
            place: Any = self.resolved()
        except InputError as error:
            raise KeyError(f"'{path}' is not given, and its default is not known before the case is in order: {error}") from error
        for part in path.split("."):
            if isinstance(place, list):
                place = next((entry for number, entry in enumerate(place, 1)
                              if entry.get("name", str(number)) == part), {})
            elif part in place:
                place = place[part]
            else:
                raise KeyError(f"'{path}' is not given and has no default")
        return place


_run: Callable[..., Any] | None = None


def run_by(run: Callable[..., Any]) -> None:
    """How :meth:`Case.run` runs a case: what runs cases knows them and their results, while a case knows neither."""
    global _run
    _run = run


def physics_option(physics: str | None) -> list[str]:
    """The option for what is computed in place of what the case says: ``"heat"`` or ``"thermomechanical"``."""
    options = {None: [], "heat": ["--heat-only"], "thermomechanical": ["--coupled"]}
    if physics not in options:
        raise InputError(f"there is no physics {physics!r}", "'heat' or 'thermomechanical'", key="physics")
    return options[physics]


def _differences(old: Document, new: Document, path: str, found: list[str]) -> bool:
    """Adds what differs to `found`; false where assignments cannot express it."""
    if old.keys() - new.keys():
        return False
    for key, value in new.items():
        here = f"{path}.{key}" if path else key
        before = old.get(key)
        if before == value and type(before) is type(value):
            continue
        if key == "include" or key_text(key) != key:
            return False
        if isinstance(value, dict) and isinstance(before, dict):
            if not _differences(before, value, here, found):
                return False
        elif _are_sections(value) or _are_sections(before):
            if not (_are_sections(value) and _are_sections(before) and _names(value) == _names(before)):
                return False
            for entry, other in zip(before, value):
                if not _differences(entry, other, f"{here}.{entry['name']}", found):
                    return False
        else:
            found.append(f"{here}={value_text(value)}")
    return True


def _are_sections(value: Any) -> bool:
    return isinstance(value, list) and bool(value) and all(isinstance(entry, dict) for entry in value)


def _names(entries: list[Document]) -> list[str] | None:
    """The names of sections where each has one that --set can write, and no two the same."""
    names = [str(entry.get("name", "")) for entry in entries]
    good = len(set(names)) == len(names) and all(name and key_text(name) == name for name in names)
    return names if good else [f"{id(entries)}"]


def _with_absolute_paths(document: Document, folder: Path) -> Document:
    """The same case, to be read from anywhere: the paths that the program resolves, seen from `folder`."""
    document = copy.deepcopy(document)

    def absolute(path: Any) -> Any:
        return str((folder / path).resolve()) if isinstance(path, str) else path

    include = document.get("include")
    if include:
        document["include"] = [absolute(path) for path in include] if isinstance(include, list) else absolute(include)
    if "file" in document.get("mesh", {}):
        document["mesh"]["file"] = absolute(document["mesh"]["file"])
    for section in [*document.get("thermal_condition", []), *document.get("body", [])]:
        for value in section.values():
            if isinstance(value, dict) and "file" in value:
                value["file"] = absolute(value["file"])
    for body in document.get("body", []):
        material = body.get("material")
        if isinstance(material, str) and (material.endswith(".toml") or "/" in material):
            body["material"] = absolute(material)
    return document
