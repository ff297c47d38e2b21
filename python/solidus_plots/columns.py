"""What the program says of the columns of its tables: labels, charts, marks for "no value".

`tables.json` is what `solidus explain --tables --json` prints:

    columns.label("stored_heat[J]")               # "Stored heat"
    columns.label("interface_normal_force[N]")    # "interface: normal force"
    columns.label("T_center[degC]")               # "T center", of a probe
"""

import json
from pathlib import Path

_DECLARED = json.loads((Path(__file__).parent / "tables.json").read_text(encoding="utf-8"))
_TABLES = _DECLARED["tables"]
ANSWERS = _DECLARED["answers"]  # of summary.json, in the order of tables of several runs


def _parts(header):
    name, _, unit = header.partition("[")
    return name, unit.rstrip("]")


def find(header, table="history"):
    """The declaration of a column; None for a probe. One that begins with "_" is of a contact, a channel or a source."""
    name, unit = _parts(header)
    rows = [row for row in _TABLES.get(table, []) if row["unit"] == unit]
    exact = next((row for row in rows if row["name"] == name), None)
    return exact or max((row for row in rows if row["name"].startswith("_") and name.endswith(row["name"])),
                        key=lambda row: len(row["name"]), default=None)


def label(header, table="history"):
    row, (name, _) = find(header, table), _parts(header)
    if row is None:
        return name.replace("_", " ")
    return row["label"] if row["name"] == name else f"{name.removesuffix(row['name']).replace('_', ' ')}: {row['label']}"
