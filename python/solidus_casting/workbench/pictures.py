"""The skins of a part and of the bodies of a case, as ``solidus mesh-info --faces`` writes them."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path
from typing import Any

from . import skin as skins
from .case_folder import CaseFolder
from .children import Child

Call = Callable[[list[str], str], Child]  # runs a verb to its end


def of_part(call: Call, case: CaseFolder, folder: Path) -> skins.Skin:
    """The skin of the part of a case; an STL file is read as it is. Raises what the verb says."""
    assert case.part is not None
    if case.part.suffix.lower() == ".stl":
        return skins.of_stl(case.part, case.choices["unit"] or "mm")
    file = Path(f"{folder}/.{case.part.name}.faces")
    # A mesh has no unit of its own; it is read as `solidus new` reads it.
    is_mesh = case.part.suffix.lower() not in (".step", ".stp", ".iges", ".igs", ".brep")
    unit = case.choices["unit"] or ("mm" if is_mesh or case.part.suffix.lower() == ".brep" else "")
    try:
        child = call(["mesh-info", f"--faces={file}", *([f"--unit={unit}"] if unit else []), str(case.part)], "reads the part")
        return skins.of_faces(file, "\n".join(child.output))
    finally:
        file.unlink(missing_ok=True)


def of_case(call: Call, case: CaseFolder, document: dict[str, Any]) -> skins.Skin | None:
    """The skins of the bodies of a case; a section has none."""
    if document.get("analysis", {}).get("kind") != "solid":
        return None
    file = case.own("faces.vtk")
    try:
        child = call(["mesh-info", f"--faces={file}", str(case.folder)], "reads the bodies")
        return skins.of_faces(file, "\n".join(child.output))
    finally:
        file.unlink(missing_ok=True)
