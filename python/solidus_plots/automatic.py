"""Pictures that every run gets without being asked: which fields, of which bodies, at which moments."""

from pathlib import Path
import tomllib

import numpy as np

from solidus_plots import fields, hot_spots, xray
from solidus_plots.cells import VOLUME
from solidus_plots.moments import nodes_of
from solidus_plots.overview import Case

NIYAMA = 0.775  # sqrt(K s)/mm
LIVES = 20  # of a die: the least one counts, and others are up to millions of times as long
NIYAMA_REMARK = ("grey: at or above {:g} √(K s)/mm, the limit of Niyama et al. (1982) for steel, "
                 "1 °C^½ min^½/cm; other alloys have others ([automatic] niyama)")
BEYOND = 0.3  # K
FREEZING = (0.3, 0.8)  # solid fractions of the casting that say most


def read_case(results):
    """The case as it was run; empty where it is not there."""
    file = results / "case.toml"
    return tomllib.loads(file.read_text()) if file.exists() else {}


def castings(run, summary, grid):
    """The bodies that are poured: as the run says, else those that show a time of freezing, else all."""
    named = [name for name in summary.get("answers", {}).get("castings", {}) if name in run.bodies]
    return named or list(run.bodies)


def _moments(times, history):
    """Two written moments while it freezes (the last one where it does not), and the last one."""
    last = float(times[-1])
    if "solid_fraction[1]" not in history:
        return [last], last
    solid = np.interp(times, history["time[s]"], history["solid_fraction[1]"])
    during = np.flatnonzero((solid > 0.02) & (solid < 0.98))
    if not during.size:
        return [last], last
    chosen = {int(during[np.abs(solid[during] - wanted).argmin()]) for wanted in FREEZING}
    return [float(times[index]) for index in sorted(chosen)], last


def _while_there(run, times, history, cast):
    """The written moments up to the last one in which castings are there, with shots those of the last of these."""
    last = next((i for i in reversed(range(len(times))) if run.body_mask(run.at(times[i]), cast).any()), None)
    if last is None:
        return []
    times = np.asarray(times)[:last + 1]
    if "time_since_pouring[s]" not in history:
        return times
    poured = times[-1] - np.interp(times[-1], history["time[s]"], history["time_since_pouring[s]"])
    return times[(times > poured) | (times == times[-1])]


def _levels(summary):
    """Liquidus and solidus of what is poured [degC], those of one alloy alone; lines lie a little beyond, because on
    the plateau of an eutectic all temperatures are the solidus but for rounding."""
    pours = summary.get("understood", {}).get("poured", [])
    pairs = {(pour["solidus[K]"], pour["liquidus[K]"]) for pour in pours if "solidus[K]" in pour}
    if len(pairs) != 1:
        return []
    solidus, liquidus = (kelvin - 273.15 for kelvin in pairs.pop())
    if solidus == liquidus:
        return [{"value": solidus - BEYOND, "label": f"melting point {solidus:.4g} °C"}]
    return [{"value": solidus - BEYOND, "label": f"solidus {solidus:.4g} °C"},
            {"value": liquidus + BEYOND, "label": f"liquidus {liquidus:.4g} °C"}]


def plan(run, times, summary, history, results, wishes):
    """The case and the list of sheets. `wishes`: [automatic] of plots.toml."""
    toml, whole = read_case(results), times
    cast = castings(run, summary, run.at("last"))
    times = _while_there(run, times, history, cast)
    if not len(times):  # it was never there when fields were written
        return None, []
    grid = run.at(times[-1])
    mask = run.body_mask(grid, cast)
    kind = toml.get("analysis", {}).get("kind", "solid")
    materials = {body["name"]: Path(body["material"]).stem for body in toml.get("body", [])}
    alloy = ", ".join(dict.fromkeys(materials[name] for name in cast if name in materials))
    title = summary.get("title") or results.resolve().parent.name
    variant = summary.get("variant", "")
    case = Case(" · ".join(filter(None, [title, alloy if alloy not in title else "", variant if variant != "default" else "",
                                         summary.get("solidus") and f"Solidus {summary['solidus']}"])),
                bool(np.isin(grid.cell_types, VOLUME).any()), ("r", "z") if kind == "axisymmetric" else ("x", "y"),
                hot_spots.hottest(grid, mask), hot_spots.all_of(grid, mask))
    during, last = _moments(times, history)
    others = [name for name in run.bodies if name not in cast]
    limit = wishes.get("niyama", NIYAMA)
    sheets, written = [], {*grid.point_data, *grid.cell_data}

    considered = set()

    def add(field, file=None, when=None, **spec):
        """A sheet of a field that was written, where `when` holds of its values; title and unit are those of its declaration
        unless `spec` has others. `telling`: what a customer asks first has the lowest number, of which a printed report shows
        some."""
        considered.add(field)
        if field in written and (when is None or when()):
            declared = {"title": fields.label(field), **_shown(field)}
            sheets.append({"file": file or f"overview_{field}", "field": field, "times": [last], "bodies": cast, **declared, **spec})

    def frozen():
        return "solidified_at" in written and (grid.point_data["solidified_at"] >= 0).any()

    def feeds_badly():
        niyama = grid.point_data["niyama"]
        return frozen() and ((niyama > 0) & (1e-3 * niyama < limit)).any()

    add("temperature", title="Temperature of the casting" if others else "Temperature", unit="degC", times=during,
        levels=_levels(summary), telling=8)
    if during != [last] or others:
        add("temperature", "overview_temperature_end", bodies=list(run.bodies),
            title="Temperature at the end" if times[-1] == whole[-1] else "Temperature before the casting leaves")
    if during != [last] or _melt(grid, mask):
        add("solid_fraction", unit="%", times=during, range=[0, 100], levels=[])
    add("solidified_at", when=frozen, title="Time of solidification, with hot spots", quantity="Solid after", above=-0.5,
        hot_spots=True, timeless=True, telling=1)
    add("niyama", when=feeds_badly, title=f"Niyama below {limit:g} √(K s)/mm", quantity="Niyama", above=0, below=limit,
        timeless=True, remark=NIYAMA_REMARK.format(limit), telling=5)
    add("shrinkage_porosity", when=lambda: frozen() and (grid.point_data["shrinkage_porosity"] > 0).any(),
        title="Estimate of shrinkage porosity", timeless=True, telling=3)
    add("pore_fraction", when=lambda: grid.cell_data["pore_fraction"][mask].any(), title="Shrinkage that nothing fed (pores)",
        quantity="Pores", telling=2)
    add("gap", when=lambda: "displacement" in written and (grid.point_data["gap"] > 0).any(),
        title="Gap between casting and mould", skin_alone=True, contours=0)
    add("distortion", when=lambda: np.any(grid.point_data["distortion"]), telling=4)
    add("displacement", when=lambda: "distortion" not in written)
    add("von_mises", when=lambda: grid.cell_data["von_mises"][mask].any(),
        title="Residual stress, von Mises" if cast != list(run.bodies) or case.spots else "Stress, von Mises",
        quantity="von Mises stress", smooth=True,
        remark="averaged at the nodes; the largest and least values are those of elements", telling=6)
    # Zones are worth a picture where more than one pool fed the castings.
    add("feeding_zone", when=lambda: np.unique(grid.point_data["feeding_zone"][nodes_of(grid, mask)]).size > 1,
        title="Feeding zones: pools of melt that fed a place last", quantity="Pool", above=0, timeless=True, contours=0)
    for field in fields.known():
        if field.group == "criteria" and field.pictured and field.name not in considered and field.name in written:
            _add_criterion(field, run, grid, cast, add)
    if kind != "plane_strain" and kind != "plane_stress" and any(values[mask_of].any() for values, mask_of in _holes(grid, mask)):
        sheets.append({"file": "overview_xray", "kind": "xray", "times": [last], "bodies": cast, "title": "As on a radiograph", "telling": 2})
    return case, sheets


def _shown(field):
    """The unit in which people read a field, where files have another."""
    declared = fields.find(field)
    return {} if declared is None or declared.shown == declared.unit else {"unit": declared.shown}


def _holes(grid, mask):
    """Fields of holes with the nodes and the cells that count."""
    at_nodes, of_cells = xray.holes(grid)
    return (at_nodes, nodes_of(grid, mask)), (of_cells, mask)


def _add_criterion(field, run, grid, cast, add):
    """A sheet of a criterion that has no particular one, of the castings; where it has no value there, as the life of a die, of
    the other bodies that have one, with cuts through its worst place."""
    at_nodes = field.name in grid.point_data
    values = field.with_value(grid.point_data[field.name] if at_nodes else grid.cell_data[field.name])

    def places(bodies):
        """Nodes or cells of the bodies that have a value; none where all are zero."""
        mask = run.body_mask(grid, bodies)
        chosen = nodes_of(grid, mask) if at_nodes else np.flatnonzero(mask)
        found = chosen[np.isfinite(values[chosen])]
        return found if np.any(values[found]) else found[:0]

    spec = {"title": field.label, "unit": field.shown, "timeless": True, **({} if field.no_value != 0 else {"above": 0}), **_beyond(field)}
    others = [name for name in run.bodies if name not in cast and len(places([name]))]
    if len(places(cast)):
        add(field.name, **spec)
    elif others:
        found = places(others)
        worst = found[values[found].argmin() if field.worst == "least" else values[found].argmax()]
        least = field.factor * values[worst]
        if field.worst == "least" and 0 < LIVES * least < field.factor * values[found].max():
            spec |= {"range": [0, LIVES * least], "remark": f"the colours end at {LIVES} times the least value"}
        add(field.name, bodies=others, through=grid.points[worst] if at_nodes else hot_spots.centres(grid)[worst], **spec)


def _beyond(field):
    """Colours that tell what is beyond a threshold: extremes at a thermal centre are hundreds of times as large."""
    if field.threshold is None:
        return {}
    limit = field.threshold * field.factor
    return {"range": [0, 2 * limit], "contours": [limit], "remark": f"threshold {limit:g}: beyond it lies what is bad"}


def _melt(grid, mask):
    solid = grid.point_data.get("solid_fraction")
    return solid is not None and solid.min() < 1.0
