"""Sections of a case: mappings whose keys are attributes too, known from the program's declarations."""

from __future__ import annotations

from collections.abc import Iterator, MutableMapping
from typing import Any, Callable, Protocol

from . import schema as schemas
from .errors import InputError
from .toml_text import document_text

Document = dict[str, Any]


class Whole(Protocol):
    """What sections ask of the case that they are sections of."""

    def given(self) -> Document: ...

    def _changed(self) -> None: ...

    def _resolved_value(self, path: str) -> Any: ...

    def _resolved_or_nothing(self, path: str) -> Any: ...


def plain(value: Any) -> Any:
    """Values as TOML has them: copies of sections, lists and numpy's numbers."""
    if isinstance(value, (Section, dict)):
        return {key: plain(item) for key, item in (value.given() if isinstance(value, Section) else value).items()}
    if isinstance(value, Sections):
        return [plain(item) for item in value]
    if hasattr(value, "tolist"):
        return value.tolist()
    if isinstance(value, (list, tuple)):
        return [plain(item) for item in value]
    return value


class Section(MutableMapping[str, Any]):
    """One section of a case, for example ``case.time``.

    ``section.key`` and ``section["key"]`` are the same; ``section["inner.key"]`` goes further down. A key that the case
    does not give has the value of an included file, else the program's default. Iterating goes over the keys that are given.
    """

    _case: Whole

    def __init__(self, case: Whole, schema: schemas.Schema, path: str, given: Callable[[bool], Document | None]) -> None:
        object.__setattr__(self, "_case", case)
        object.__setattr__(self, "_schema", schema)
        object.__setattr__(self, "_path", path)
        object.__setattr__(self, "_given", given)  # with True: makes it where it is not there yet

    # Reading

    def given(self) -> Document:
        """What the case itself says here, without included files and defaults."""
        found = self._given(False)
        return {} if found is None else found

    def __getitem__(self, key: str) -> Any:
        first, _, rest = str(key).partition(".")
        declared = schemas.child(self._schema, first, self._path)
        path = f"{self._path}.{first}" if self._path else first
        if schemas.is_section(declared):
            found: Any = Section(self._case, declared, path, self._maker(first, dict))
        elif schemas.is_list_of_sections(declared):
            found = Sections(self._case, declared["items"], path, self._maker(first, list))
        elif first in self.given():
            found = self.given()[first]
        else:
            found = self._case._resolved_value(path)
        return found[rest] if rest else found

    def _maker(self, key: str, kind: type) -> Callable[[bool], Any]:
        def give(create: bool) -> Any:
            inside = self._given(create)
            if inside is None:
                return None
            return inside.setdefault(key, kind()) if create else inside.get(key)

        return give

    def __getattr__(self, name: str) -> Any:
        if name.startswith("_"):
            raise AttributeError(name)
        try:
            return self[name]
        except (KeyError, InputError) as error:
            raise AttributeError(str(error)) from error

    # Writing

    def __setitem__(self, key: str, value: Any) -> None:
        first, _, rest = str(key).partition(".")
        if rest:
            self[first][rest] = value
            return
        declared = schemas.child(self._schema, first, self._path)
        path = f"{self._path}.{first}" if self._path else first
        value = plain(value)
        schemas.check_value(value, declared, path)
        self._given(True)[first] = value
        self._case._changed()

    def __setattr__(self, name: str, value: Any) -> None:
        self[name] = value

    def __delitem__(self, key: str) -> None:
        first, _, rest = str(key).partition(".")
        if rest:
            del self[first][rest]
            return
        del self.given()[first]
        self._case._changed()

    def __delattr__(self, name: str) -> None:
        del self[name]

    # Looking around

    def __iter__(self) -> Iterator[str]:
        return iter(self.given())

    def __len__(self) -> int:
        return len(self.given())

    def __bool__(self) -> bool:
        return True

    def __dir__(self) -> list[str]:
        return [*super().__dir__(), *schemas.keys(self._schema)]

    def _ipython_key_completions_(self) -> list[str]:
        return schemas.keys(self._schema)

    def __repr__(self) -> str:
        head = f"[{self._path}]\n" if self._path else ""
        return head + document_text(plain(self)).rstrip("\n")


class Sections(list):
    """A list of sections, for example ``case.body``: by name or number, ``case.body.casting`` or ``case.body[0]``."""

    def __init__(self, case: Whole, schema: schemas.Schema, path: str, given: Callable[[bool], Any]) -> None:
        self._case, self._schema, self._path, self._given = case, schema, path, given
        super().__init__(self._section(index, entry) for index, entry in enumerate(given(False) or []))

    def _section(self, index: int, entry: Document) -> Section:
        return Section(self._case, self._schema, f"{self._path}.{entry.get('name', index + 1)}", lambda _: entry)

    def names(self) -> list[str]:
        """Names of the sections, those of included files too."""
        own = [entry["name"] for entry in self._given(False) or [] if "name" in entry]
        others = self._case._resolved_or_nothing(self._path) if self._case.given().get("include") else None
        return own + [entry["name"] for entry in others or [] if entry.get("name") not in (*own, None)]

    def __getitem__(self, key: Any) -> Any:
        if not isinstance(key, str):
            return super().__getitem__(key)
        first, _, rest = key.partition(".")
        for section in self:
            if section.given().get("name") == first:
                return section[rest] if rest else section
        if first in self.names():  # of an included file: what is changed is laid over it
            section = Section(self._case, self._schema, f"{self._path}.{first}", self._laid_over(first))
            return section[rest] if rest else section
        raise InputError(f"there is no '{first}' among the sections [[{self._path}]]", "one of: " + ", ".join(self.names()),
                         key=f"{self._path}.{first}")

    def _laid_over(self, name: str) -> Callable[[bool], Document | None]:
        def give(create: bool) -> Document | None:
            entries = self._given(True) if create else self._given(False) or []
            for entry in entries:
                if entry.get("name") == name:
                    return entry
            if not create:
                return None
            entries.append({"name": name})
            return entries[-1]

        return give

    def __getattr__(self, name: str) -> Section:
        if name.startswith("_"):
            raise AttributeError(name)
        try:
            return self[name]
        except InputError as error:
            raise AttributeError(str(error)) from error

    def __setitem__(self, key: Any, value: Any) -> None:
        if isinstance(key, str) and "." in key:
            first, _, rest = key.partition(".")
            self[first][rest] = value
            return
        raise TypeError(f"change keys of a section of [[{self._path}]], or use add() and remove()")

    def add(self, **keys: Any) -> Section:
        """Appends a section with these keys and returns it."""
        entry: Document = {}
        section = Section(self._case, self._schema, f"{self._path}.{keys.get('name', len(self) + 1)}", lambda _: entry)
        for key, value in keys.items():
            section[key] = value
        if any(known.given().get("name") == entry.get("name", self) for known in self):
            raise InputError(f"there is a '{entry['name']}' among the sections [[{self._path}]] already", "another name",
                             key=f"{self._path}.{entry['name']}")
        self._given(True).append(entry)
        super().append(self._section(len(self), entry))
        self._case._changed()
        return self[-1]

    def append(self, keys: Any) -> None:
        """As :meth:`add`, with a dictionary of the keys."""
        self.add(**plain(keys))

    def __delitem__(self, name: Any) -> None:
        self.remove(name)

    def _refuse(self, *_: Any, **__: Any) -> None:
        raise TypeError(f"[[{self._path}]] changes by add() and remove(), or as a whole: case[{self._path!r}] = [...]")

    insert = extend = pop = clear = sort = reverse = __iadd__ = __imul__ = _refuse  # type: ignore[assignment]

    def remove(self, name: Any) -> None:
        """Removes a section by its name or number."""
        section = self[name]
        entries = self._given(False) or []
        index = next((i for i, entry in enumerate(entries) if entry is section.given()), None)
        if index is None:
            raise InputError(f"'{name}' is in an included file", "leave the include out", key=f"{self._path}.{name}")
        del entries[index]
        super().__delitem__(index)
        self._case._changed()

    def __dir__(self) -> list[str]:
        return [*super().__dir__(), *(name for name in self.names() if name.isidentifier())]

    def _ipython_key_completions_(self) -> list[str]:
        return self.names()
