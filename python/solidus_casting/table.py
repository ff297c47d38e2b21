"""Tables of a run: columns by name with their units, as numpy and, where it is there, pandas."""

from __future__ import annotations

import csv
from collections.abc import Iterator
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from .errors import SolidusError

if TYPE_CHECKING:
    import pandas


class Table:
    """A table with a name and a unit for each column.

    ``table["T_center"]`` (or ``table["T_center[degC]"]``, or ``table.T_center``) is a column, a view of :attr:`array`;
    ``table.units["T_center"]`` its unit; ``table.array`` the whole as numpy structured array.
    """

    def __init__(self, array: np.ndarray, units: dict[str, str]) -> None:
        #: numpy structured array, a row a record
        self.array = array
        #: unit of each column, "1" of mere numbers, empty of texts
        self.units = units

    @classmethod
    def read(cls, file: str | Path) -> "Table":
        """Reads a table written by Solidus. An incomplete last row, of a run in progress, is left out."""
        file = Path(file)
        if not file.exists():
            raise SolidusError(f"{file}: there is no such file")
        with file.open(newline="", encoding="utf-8") as stream:
            rows = list(csv.reader(stream))
        if not rows:
            raise SolidusError(f"{file}: the table is empty")
        header, body = rows[0], [row for row in rows[1:] if len(row) == len(rows[0])]
        bare = [name.partition("[")[0] for name in header]
        # Two columns may differ in their unit alone: they keep it in their name.
        names = [short if bare.count(short) == 1 else name for short, name in zip(bare, header)]
        columns = [_column([row[index] for row in body], "[" in name) for index, name in enumerate(header)]
        array = np.empty(len(body), [(name, column.dtype) for name, column in zip(names, columns)])
        for name, column in zip(names, columns):
            array[name] = column
        return cls(array, {name: full.partition("[")[2].rstrip("]") for name, full in zip(names, header)})

    @property
    def columns(self) -> list[str]:
        """Names of the columns."""
        return list(self.array.dtype.names or ())

    def __getitem__(self, key: Any) -> np.ndarray:
        if not isinstance(key, str):
            return self.array[key]
        names = self.array.dtype.names or ()
        if key in names:
            return self.array[key]
        name, _, unit = key.partition("[")
        if name in names and self.units[name] == unit.rstrip("]"):
            return self.array[name]
        import difflib

        near = difflib.get_close_matches(key, names, 1)
        raise KeyError(f"there is no column '{key}'; " + (f"did you mean '{near[0]}'? " if near else "")
                       + "one of: " + ", ".join(names))

    def __getattr__(self, name: str) -> np.ndarray:
        if name.startswith("_"):
            raise AttributeError(name)
        try:
            return self[name]
        except KeyError as error:
            raise AttributeError(error.args[0]) from None

    def __dir__(self) -> list[str]:
        return [*super().__dir__(), *(name for name in self.columns if name.isidentifier())]

    def _ipython_key_completions_(self) -> list[str]:
        return self.columns

    def __contains__(self, name: object) -> bool:
        return name in self.columns

    def __iter__(self) -> Iterator[str]:
        return iter(self.columns)

    def __len__(self) -> int:
        return len(self.array)

    def __array__(self, dtype: Any = None, copy: bool | None = None) -> np.ndarray:
        array = self.array if dtype is None else self.array.astype(dtype)
        return array.copy() if copy else array

    def to_pandas(self, index: str | None = None) -> "pandas.DataFrame":
        """The table as pandas' DataFrame, its units in ``frame.attrs["units"]``; `index` is the column used as index.
        Needs pandas (Debian: python3-pandas)."""
        try:
            import pandas
        except ImportError as error:
            raise ImportError("to_pandas() needs pandas: apt install python3-pandas, or pip install pandas") from error
        frame = pandas.DataFrame({name: self.array[name] for name in self.columns})
        frame.attrs["units"] = dict(self.units)
        return frame.set_index(index) if index else frame

    def __repr__(self) -> str:
        shown = ", ".join(f"{name} [{self.units[name]}]" if self.units[name] else name for name in self.columns)
        return f"<Table of {len(self)} rows: {shown}>"


def _column(texts: list[str], number: bool) -> np.ndarray:
    """Numbers; text where a column without a unit holds some."""
    try:
        return np.array(texts, dtype=float)
    except ValueError:
        if number:
            return np.array([float(text) if text else np.nan for text in texts])
        return np.array(texts, dtype=object)
