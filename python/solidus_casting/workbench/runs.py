"""The runs of a case, as their folders of results tell."""

from __future__ import annotations

import csv
import functools
import json
import re
from pathlib import Path
from typing import Any

from ..errors import InputError
from . import findings

NAME = re.compile(r"run_[0-9]{1,6}")
_MOST_ROWS = 400  # of a curve
_PRINTED = ("report.pdf", "report.print.html")  # for the customer; the second where no Chromium is there
_LAST_BYTES = 65536  # of a table of which the last row is wanted


def next_name(folder: Path) -> str:
    """The name of a run that is not there yet."""
    numbers = [int(path.name[4:]) for path in folder.glob("run_*") if NAME.fullmatch(path.name)]
    return f"run_{max(numbers, default=0) + 1}"


def all_runs(folder: Path) -> list[dict[str, Any]]:
    """What the runs of a folder answer, the newest last."""
    found = [path for path in folder.glob("run_*") if NAME.fullmatch(path.name) and (path / "steps.csv").exists()]
    return [one_run(path) for path in sorted(found, key=lambda path: int(path.name[4:]))]


def one_run(folder: Path) -> dict[str, Any]:
    """Outcome, answers with their errors and warnings of a run; of one that has not ended its name alone."""
    stamps = []
    for name in ("summary.json", "report.html", *_PRINTED):
        try:
            stamps.append((folder / name).stat().st_mtime_ns)
        except OSError:
            stamps.append(0)
    return _read(folder, tuple(stamps))


def printed(folder: Path) -> str | None:
    """The file with the pages for the customer, where they have been printed: the newest."""
    there = [folder / name for name in _PRINTED if (folder / name).is_file()]
    return max(there, key=lambda path: path.stat().st_mtime).name if there else None


@functools.lru_cache(maxsize=500)
def _read(folder: Path, stamps: tuple[int, ...]) -> dict[str, Any]:
    """As :func:`one_run`, read again only when the files have changed, which `stamps` tell."""
    del stamps
    run: dict[str, Any] = {"name": folder.name, "outcome": "not ended", "answers": [], "verdicts": [], "warnings": [],
                           "report": (folder / "report.html").exists(), "printed": printed(folder)}
    try:
        summary = json.loads((folder / "summary.json").read_text(encoding="utf-8"))
        from solidus_plots.answers import answers, bands, places

        errors, found_at = bands(summary), places(summary)
        run["answers"] = [{**named(name), "value": value, "error": errors.get(name), "at": found_at.get(name)}
                          for name, value in answers(summary).items()]
        run["verdicts"] = verdicts(summary.get("answers", {}))
        run["warnings"] = [findings.finding("warning", str(warning), "", {}) for warning in summary.get("warnings", [])]
        run["outcome"] = str(summary.get("outcome", "not ended"))
        run["time"], run["steps"] = summary.get("end_time[s]"), summary.get("steps")
        json.dumps(run, allow_nan=False)
    except FileNotFoundError:
        pass
    except (ValueError, TypeError, AttributeError, KeyError) as error:
        return {"name": folder.name, "outcome": "damaged", "answers": [], "verdicts": [], "warnings": [findings.finding("error", f"its summary.json cannot be read: {error!r}", "", {})],
                "report": run["report"], "printed": run["printed"]}
    return run


def verdicts(answers: dict[str, Any]) -> list[dict[str, Any]]:
    """Whether each riser outlived the part, as the end of a run says it, and whether melt was cut off from what feeds it; ``good`` is nothing
    where the errors or the size do not let it be told."""
    cut_off = answers.get("pools_cut_off", {})
    number = cut_off.get("number", 0)
    pools = [] if not number else [{"good": None, "text": f"{number} pool{'s' if number > 1 else ''} of melt cut off from what feeds the part; "
                                                          f"the largest had {1e6 * cut_off['largest[m3]']:.3g} cm³."}]
    return _of_risers(answers.get("castings", {})) + pools


def _of_risers(castings: dict[str, Any]) -> list[dict[str, Any]]:
    frozen = {name: casting["last_melt_froze"] for name, casting in castings.items() if "last_melt_froze" in casting}
    parts = [name for name, casting in castings.items() if not casting.get("riser") and not casting.get("gating")]
    if not parts or any(name not in frozen for name in parts):
        return []
    part = max(frozen[name]["value[s]"] for name in parts)
    of_parts = max(frozen[name].get("error[s]", 0.0) for name in parts)
    found: list[dict[str, Any]] = []
    for name in (name for name in frozen if castings[name].get("riser")):
        later, error = frozen[name]["value[s]"] - part, max(of_parts, frozen[name].get("error[s]", 0.0))
        size = f"{abs(later):.4g}" + (f" ± {error:.2g}" if error > 0 else "") + " s"
        if abs(later) < error:
            found.append({"text": f"{name} froze {size} {'after' if later > 0 else 'before'} the part: too close to tell whether it fed to the end", "good": None})
        elif later > 0:
            found.append({"text": f"{name} outlived the part by {size}.", "good": True})
        else:
            found.append({"text": f"{name} froze {size} before the part: it could not feed to the end.", "good": False})
    return found


def named(header: str) -> dict[str, str]:
    """Name and unit of a header such as ``time[s]``."""
    name, bracket, unit = header.partition("[")
    return {"name": name.strip(), "unit": unit.rstrip("]") if bracket else "1"}


def last_row(file: Path) -> dict[str, str]:
    """The last whole row of a table that a run writes; empty where there is none yet."""
    try:
        with file.open("rb") as table:
            header = table.readline()
            table.seek(0, 2)
            size = table.tell()
            table.seek(max(len(header), size - _LAST_BYTES))
            rest = table.read().decode(errors="replace")
    except OSError:
        return {}
    rows = rest[:rest.rfind("\n") + 1].splitlines()
    if not rows or not header.endswith(b"\n"):
        return {}
    names, values = next(csv.reader([header.decode(errors="replace").rstrip("\n")])), next(csv.reader([rows[-1]]))
    return dict(zip(names, values)) if len(names) == len(values) else {}


def progress(folder: Path, end: float | None, until_solid: bool) -> dict[str, Any]:
    """How far a run is: time, step, share that is solid, and the share of the whole that is done."""
    row = last_row(folder / "steps.csv")
    if not row:
        return {}
    time, solid = _number(row.get("time[s]")), _number(row.get("solid_fraction[1]"))
    done = solid if until_solid and solid is not None else (None if not end or time is None else min(1.0, time / end))
    return {"time": time, "step": _number(row.get("step[1]")), "solid": solid, "hottest": _number(row.get("T_max[degC]")), "done": done}


def _number(text: str | None) -> float | None:
    try:
        value = float(text or "")
    except ValueError:
        return None
    return value if value == value and abs(value) != float("inf") else None


def end_time(document: dict[str, Any]) -> float | None:
    """The end of the run [s]; nothing where its unit is not a plain one."""
    number, _, unit = str(document.get("time", {}).get("end", "")).partition(" ")
    factor = {"s": 1.0, "ms": 1e-3, "min": 60.0, "h": 3600.0, "hour": 3600.0}.get(unit.strip())
    value = _number(number)
    return None if factor is None or value is None else value * factor


def curves(folder: Path) -> dict[str, Any]:
    """The temperatures of the probes and the solid fraction over time, thinned out to what a screen shows."""
    try:
        with (folder / "history.csv").open(newline="", encoding="utf-8") as table:
            rows = list(csv.reader(table))
    except OSError:
        return {"columns": [], "rows": []}
    header, rows = rows[0] if rows else [], [row for row in rows[1:] if row]
    wanted = [i for i, name in enumerate(header) if name == "time[s]" or name.startswith(("T_", "solid_fraction")) and not name.startswith("T_min")][:12]
    step = max(1, len(rows) // _MOST_ROWS)
    kept = [row for number, row in enumerate(rows) if (len(rows) - 1 - number) % step == 0 and len(row) == len(header)]
    return {"columns": [named(header[i]) for i in wanted], "rows": [[_number(row[i]) for i in wanted] for row in kept]}


def differences(file: Path) -> list[dict[str, Any]]:
    """Rows of the table of answers that ``compare`` writes."""
    try:
        with file.open(newline="", encoding="utf-8") as table:
            rows = list(csv.reader(table))[1:]
    except OSError:
        return []
    return [{**named(row[0]), "first": _number(row[1]), "second": _number(row[2]), "difference": _number(row[3])}
            for row in rows if len(row) >= 4]


def folder_of(root: Path, name: Any) -> Path:
    """The folder of a run by its name, which cannot lead elsewhere. Raises :class:`InputError`."""
    if not isinstance(name, str) or not NAME.fullmatch(name):
        raise InputError(f"{name!r} is no name of a run", "run_1, run_2, …")
    folder = root / name
    if folder.is_symlink() or not folder.is_dir():
        raise InputError(f"there is no run {name}", "one of the list")
    return folder
