"""The tools that assistants see: names, what they take and what they give."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

from ..errors import InputError, InternalError, ProgramMissing, RunStopped, SolidusError
from .protocol import Work
from .room import Room
from .work import Workshop

Schema = dict[str, Any]

_TEXT: Schema = {"type": "string"}
_NUMBER: Schema = {"type": "number"}
_MAYBE: Schema = {"type": ["number", "null"]}


def _text(description: str, **more: Any) -> Schema:
    return {"type": "string", "description": description, **more}


def _list(items: Schema, description: str = "") -> Schema:
    return {"type": "array", "items": items, **({"description": description} if description else {})}


def _object(required: list[str], **properties: Schema) -> Schema:
    return {"type": "object", "properties": properties, "required": required, "additionalProperties": False}


_FINDING = _object(["severity", "message"], severity=_text("warning", enum=["warning"]), message=_TEXT, file=_TEXT, line={"type": "integer"})
_FINDINGS = _list(_FINDING, "What looks wrong; tell the user")
_CHECKED = _object(["text", "findings", "notes"], text=_text("What the program understood, an estimate of the freezing time, effort"),
                   findings=_FINDINGS, notes=_list(_TEXT))
_ANSWER = _object(["name", "unit", "value", "error"], name=_TEXT, unit=_TEXT, value=_NUMBER,
                  error={**_MAYBE, "description": "Half width of the error by step and mesh; null: the run states none. It says nothing "
                                                  "of uncertain data"})
_ANSWERS = _object(["results", "outcome", "end_time_s", "steps", "answers", "places_si", "energy_defect", "findings"],
                   results=_text("Folder of the results"), outcome=_TEXT, end_time_s=_MAYBE, steps=_MAYBE, answers=_list(_ANSWER),
                   places_si={"type": "object", "description": "The same in SI with places and parts of the errors"},
                   energy_defect={**_MAYBE, "description": "Of the heat exchanged"}, findings=_FINDINGS)
_DIFFERENCE = _object(["name", "unit", "first", "second", "difference", "error_of_first", "error_of_second", "clear"],
                      name=_TEXT, unit=_TEXT, first=_MAYBE, second=_MAYBE, difference=_MAYBE, error_of_first=_MAYBE, error_of_second=_MAYBE,
                      clear={"type": ["boolean", "null"], "description": "Whether the difference is larger than both errors together; "
                                                                         "null: not known"})
_CURVE = _object(["name", "unit", "first", "second", "largest_difference", "at_s", "rms"], name=_TEXT, unit=_TEXT,
                 first={**_MAYBE, "description": "At the last time that both have"}, second=_MAYBE, largest_difference=_MAYBE, at_s=_MAYBE,
                 rms={**_MAYBE, "description": "Root mean square over time"})
_FIELD = _object(["name", "unit", "largest_difference", "x_mm", "y_mm", "z_mm", "rms"], name=_TEXT, unit=_TEXT, largest_difference=_MAYBE,
                 x_mm=_MAYBE, y_mm=_MAYBE, z_mm=_MAYBE, rms={**_MAYBE, "description": "Root mean square over the bodies"})
_ERROR = _object(["kind", "message"], kind=_text("Whose it is", enum=["input", "stopped", "program", "missing"]), message=_TEXT,
                 file=_TEXT, line={"type": "integer"}, column={"type": "integer"}, key=_TEXT, found=_TEXT,
                 allowed=_text("What would be accepted"))

_CASE = _text("A case file or a folder with a case.toml; CASE:VARIANT for a variant")
_SET: Schema = {"type": "object", "description": "Keys to change, by path: {\"time.step\": \"0.5 s\"}. Quantities are texts with units. "
                                                 "`explain` tells of keys"}
_PHYSICS = _text("In place of what the case says: heat alone is quick", enum=["heat", "thermomechanical"])


@dataclass(frozen=True)
class Tool:
    """A tool: its declaration, and the function that does it."""

    name: str
    title: str
    description: str
    input: Schema
    output: Schema
    work: Work
    room: Room
    reads_only: bool = False

    def declaration(self) -> Schema:
        """As ``tools/list`` gives it. A result is what the schema says, or an error."""
        good = self.output
        output = {"type": "object", "properties": {**good["properties"], "error": _ERROR},
                  "anyOf": [{"required": good["required"]}, {"required": ["error"]}], "additionalProperties": False}
        return {"name": self.name, "title": self.title, "description": self.description, "inputSchema": self.input, "outputSchema": output,
                "annotations": {"title": self.title, "readOnlyHint": self.reads_only, "destructiveHint": False,
                                "idempotentHint": self.reads_only, "openWorldHint": False}}

    def failure(self, error: SolidusError | OSError) -> Schema:
        """The result for an error, paths as seen from the folder."""
        kinds = {InputError: "input", RunStopped: "stopped", InternalError: "program", ProgramMissing: "missing"}
        found: Schema = {"kind": kinds.get(type(error), "input"), "message": self.room.text(str(error))}
        if isinstance(error, InputError):
            place: Mapping[str, Any] = {"file": None if error.file is None else self.room.text(str(error.file)), "line": error.line,
                                        "column": error.column, "key": error.key, "found": self.room.text(error.found),
                                        "allowed": self.room.text(error.allowed) or None}
            found |= {name: value for name, value in place.items() if value is not None}
        return {"error": found}


def tools(room: Room) -> list[Tool]:
    """All tools, for a folder."""
    shop = Workshop(room)

    def tool(name: str, title: str, description: str, given: Schema, output: Schema, reads_only: bool = False) -> Tool:
        return Tool(name, title, description, given, output, getattr(shop, name), room, reads_only)

    return [
        tool("new", "Case from a part", "Makes a case that runs from the geometry of a casting: mould, mesh, temperatures, interfaces, probes. "
             "Gives what `check` finds in it too. Takes seconds to minutes.",
             _object(["part", "alloy"], part=_text("STEP, BREP, IGES or STL file, or a mesh"),
                     alloy=_text("What is cast: a name that `materials` lists, or a file"),
                     process=_text("Default sand", enum=["sand", "shell", "gravity_die", "high_pressure"]),
                     riser={"type": "boolean", "description": "Put a riser on the thickest place"},
                     symmetry=_text("Keep the half below the middle", enum=["x", "y", "z"]),
                     roles={"type": "object", "additionalProperties": _text("A role", enum=[
                         "casting", "riser", "gating", "mould", "core", "chill", "sleeve", "die", "insulation"]),
                            "description": "What bodies of the file are: {\"Box_2\": \"chill\"}"},
                     shots={"type": "integer", "minimum": 1, "maximum": 10000, "description": "Castings in a row into one die"},
                     unit=_text("Of length, of BREP, STL and mesh files; default mm"),
                     fineness={"type": "number", "minimum": 0.3, "maximum": 5, "description": "So many times as many elements along each edge"},
                     folder=_text("Where the case goes; default the name of the part")),
             _object(["case", "text", "notes", "check"], case=_TEXT, text=_text("What was measured and chosen"), notes=_list(_TEXT),
                     check=_CHECKED)),
        tool("check", "Check a case", "Everything but solving: keys, materials, mesh, groups, probes, and whether numbers are plausible. A case that is "
             "wrong is an error with its place and what is allowed; what looks wrong is a finding.",
             _object(["case"], case=_CASE, set=_SET, physics=_PHYSICS), _CHECKED, True),
        tool("run", "Run a case", "Computes a case to its end and gives its answers with their errors: when and where it froze last, pools of melt that "
             "are cut off, Niyama, gap, distortion, stress. A case that `check` refuses is not run. Sends progress; cancelled, it stops behind "
             "a whole step, and `restart` goes on. Minutes, for stress up to hours: `check` says how long.",
             _object(["case"], case=_CASE, set=_SET, physics=_PHYSICS, output=_text("Folder of the results; default results/CASE"),
                     restart={"type": "boolean", "description": "Go on from the checkpoint in that folder"},
                     sure={"type": "boolean", "description": "Run twice more, coarser, for the errors: up to two and a half times as long"}),
             _ANSWERS),
        tool("report", "Write the report", "One page of one or more runs for any browser, in the folder; the user opens it. Gives their answers too.",
             _object(["results"], results={"type": "array", "items": _text("A folder of results"), "minItems": 1, "maxItems": 16,
                                           "description": "Folders of results; two are shown side by side"},
                     output=_text("The page; default report.html in the first folder")),
             _object(["page", "bytes", "notes", "runs"], page=_TEXT, bytes={"type": "integer"}, notes=_list(_TEXT), runs=_list(_ANSWERS))),
        tool("compare", "Compare two runs", "What changed from one run to another: answers, curves and fields, second less first. A difference that is not "
             "clear is no difference: it is smaller than what step and mesh may be off.",
             _object(["results", "other"], results=_text("Folder of results"), other=_text("Another one"),
                     output=_text("Folder for the tables; default in the first")),
             _object(["folder", "answers", "curves", "fields", "findings"], folder=_text("Where the tables are"), answers=_list(_DIFFERENCE),
                     curves=_list(_CURVE, "Columns of history.csv"),
                     fields=_list(_FIELD, "At the last moment that both have written"), findings=_FINDINGS)),
        tool("materials", "Materials", "The material library, or one card: values, sources, and how far they may be off.",
             _object([], name=_text("A material, or a material file; without it the list", pattern=r"^[^-].*$")),
             {**_object([], materials=_list(_object(["name", "title"], name=_TEXT, title=_TEXT)), text=_TEXT,
                        spread=_list(_object(["property", "half_width", "source"], property=_TEXT, half_width=_TEXT, source=_TEXT),
                                     "Half the width that holds 95 %"))}, True),
        tool("explain", "Explain a key", "What a key means, its unit, default and range.",
             _object([], key=_text("For example time.step, or a section; without it all keys", pattern=r"^\w[\w.]*$"),
                     file=_text("Default case", enum=["case", "material", "point"])),
             _object(["file", "text"], file=_TEXT, text=_TEXT), True)]
