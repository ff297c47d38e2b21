"""What docs/verification/defaults.md measures: at least one row of every folder of cases/.

A row names its case, its kind ("coupled", "heat" or "point"), the keys that make its steps, or their error limits, a
quarter as large, and, where the whole run would take more than some ten minutes of a processor, the keys that
shorten it, with the words in which the page says so.
"""
from dataclasses import dataclass, field

FINER_ERROR = {"time.temperature_error": "0.25 K"}  # of 1 K by default
FINER_COUPLED = FINER_ERROR | {"time.skin_change": "0.01"}  # of 0.04


@dataclass
class Row:
    case: str
    kind: str
    finer: dict
    shorter: dict = field(default_factory=dict)
    says: str = ""


def point(name, steps):
    """A test of a material point: each of its segments with four times as many steps as the file has."""
    return Row(f"point/{name}.toml", "point", {f"segment.{i + 1}.steps": str(4 * n) for i, n in enumerate(steps)})


ROWS = [
    Row("two_blocks/case.toml", "coupled", {"time.step": "0.5 s"}),
    Row("aluminium_cylinder/case.toml", "coupled", {"time.step": "0.25 s"}),
    Row("aluminium_cylinder/plastic.toml", "coupled", {"time.step": "0.25 s"}),
    Row("thick_cylinder:te_x1_isentropic_energy", "coupled", {"time.step": "2.5 s", "time.min_step": "2.5 s"}),
    Row("thick_cylinder:tp_x1_isentropic_energy", "coupled", {"time.step": "2.5 s", "time.min_step": "2.5 s"}),
    Row("hot_spots/case.toml", "heat", {"time.step": "0.5 s"}),
    Row("billet_aa6060/case.toml", "heat", {"time.step": "0.25 s"}),
    Row("billet_al6cu/case.toml", "heat", {"time.step": "0.5 s"}),
    Row("cast_iron_in_sand/case.toml", "heat", {"time.step": "0.125 s"}),
    Row("riser_sleeve/case.toml", "heat", FINER_ERROR),
    Row("riser_and_pipe/case.toml", "heat", FINER_ERROR),
    Row("sheet_sliding:ga_980", "coupled", {"time.step": "0.25 s"}),
    Row("bracket/case.toml", "coupled", FINER_COUPLED),
    Row("bracket_from_step/case.toml", "coupled", FINER_COUPLED),
    Row("stepped_plate/case.toml", "coupled", FINER_COUPLED),
    Row("wheel_in_die/case.toml", "coupled", FINER_COUPLED, {"cycle.1.repeat": "2"}, "two shots of ten"),
    Row("wheel_from_step/case.toml", "coupled", FINER_COUPLED, {"cycle.1.repeat": "1"}, "one shot of ten"),
    Row("hot_tear_bar/case.toml", "coupled", FINER_COUPLED),
    Row("crankshaft/case.toml", "coupled", {"time.temperature_error": "2.5 K"}),
    point("tensile", [200]),
    point("relaxation", [100, 300]),
    point("creep", [40, 300]),
    point("cyclic", [80, 160, 160]),
    point("constrained_cooling", [630]),
]
