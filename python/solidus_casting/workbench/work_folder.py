"""The folder that the workbench works in: parts, cases next to them, and names that do not lead out of it."""

from __future__ import annotations

from pathlib import Path
from typing import Any

from ..errors import InputError
from .case_folder import CaseFolder

PARTS = (".step", ".stp", ".iges", ".igs", ".brep", ".stl", ".msh", ".inp", ".unv", ".med", ".bdf", ".nas", ".vtu", ".vtk", ".mesh")


class WorkFolder:
    """One folder.

    Attributes
    ----------
    folder:
        Its full path, links followed.
    """

    def __init__(self, folder: Path) -> None:
        self.folder = folder.resolve()

    def name(self, path: Path) -> str:
        """A path as seen from the folder."""
        return str(path.relative_to(self.folder)) if path.is_relative_to(self.folder) else str(path)

    def files(self) -> dict[str, list[str]]:
        """Parts and cases that the folder holds."""
        parts = sorted(path.name for path in self.folder.iterdir() if path.suffix.lower() in PARTS and path.is_file())
        cases = sorted(path.parent.name for path in self.folder.glob("*/case.toml"))
        return {"parts": parts[:500], "cases": cases[:500]}

    def case_of(self, given: str) -> CaseFolder:
        """The case folder that a part or a case of this folder means. Raises :class:`InputError`."""
        path = self.inside(given)
        if path.is_file() and path.suffix.lower() in PARTS:
            return self._case_of_part(path)
        if (path / "case.toml").is_file() or path.name == "case.toml" and path.is_file():
            folder = path if path.is_dir() else path.parent
            return CaseFolder(folder, self._part_of_case(folder))
        raise InputError(f"'{given}' is no part and no case", f"a file that ends in {', '.join(PARTS[:6])} …, or a folder with a case.toml")

    def _case_of_part(self, part: Path) -> CaseFolder:
        """The folder of the case of a part: next to it, with its name, or with a number where that is taken by something else."""
        for number in range(1, 100):
            folder = self.folder / (part.stem if number == 1 else f"{part.stem}_{number}")
            if not folder.exists() or (folder / "case.toml").exists() or (folder / "open").exists() or not any(folder.iterdir()):
                return CaseFolder(folder, part)
        raise InputError(f"there are too many folders that are called {part.stem}", "another name of the part")

    def _part_of_case(self, folder: Path) -> Path | None:
        """The geometry next to the folder, of which the case was made, where it is still there."""
        beside = [path for path in self.folder.iterdir() if path.suffix.lower() in PARTS and path.is_file() and path.stem == folder.name]
        return beside[0] if beside else None

    def inside(self, given: Any) -> Path:
        """The path that a name means, which has to lie in the folder. Raises :class:`InputError`."""
        try:
            path = (self.folder / str(given)).resolve()
        except (OSError, RuntimeError, ValueError) as error:
            raise InputError(f"{given!r} is no path: {error}") from error
        if not path.is_relative_to(self.folder):
            raise InputError(f"'{given}' lies outside of {self.folder}", "a file of that folder")
        return path

    def place_of_upload(self, name: str) -> Path:
        """Where a file goes that the page brings: into the folder, under its own name, which has to be that of a part."""
        if not name or Path(name).name != name or name.startswith(".") or not name.isprintable() or len(name) > 120:
            raise InputError(f"{name!r} is no name of a file", "letters, digits, one ending")
        if Path(name).suffix.lower() not in PARTS:
            raise InputError(f"'{name}' is no part", f"a file that ends in {', '.join(PARTS)}")
        place = self.folder / name
        number = 2
        while place.exists():
            place = self.folder / f"{Path(name).stem}_{number}{Path(name).suffix}"
            number += 1
        return place
