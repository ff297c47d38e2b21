"""The moments of a run that a picture asks for, and the fields of a moment in the picture's units."""

import fnmatch

import numpy as np

from solidus_plots import fields, style
from solidus_plots.vtu import ResultError, read_fields


class Moments:
    """Each file is read once."""

    def __init__(self, times, files, bodies, probes=None, stages=None):
        self._times, self._files, self.bodies, self._grids = times, files, bodies, {}
        self._stages = stages or {}  # name -> the end of its last repetition [s]
        self._probes = probes or {}  # name -> point [3] m
        self.missing = []  # what was asked for and not written, for the user

    def those_of(self, times):
        """The moments among `times` that were written; a run that stopped early lacks the later ones."""
        grids = []
        for time in times:
            try:
                grids.append(self.at(time))
            except ResultError as error:
                self.missing.append(str(error))
        if not grids:
            raise ResultError("none of the moments asked for was written")
        return grids

    def at(self, time):
        """The fields of the moment nearest to `time` ("first", "last", the end of a stage by its name); it must be a written one."""
        named = {"first": 0, "last": len(self._times) - 1}
        if isinstance(time, str) and time not in named:
            if time not in self._stages:
                raise ResultError(f"plots.toml: '{time}' is no moment and no stage that is over; these are {', '.join(self._stages) or 'none'}")
            time = self._stages[time]
        index = named[time] if time in named else int(np.argmin(np.abs(self._times - time)))
        if time not in named and abs(self._times[index] - time) > 1e-6 * max(1.0, abs(time)):
            raise ResultError(f"plots.toml: no fields were written at {time} s; there are those of "
                              f"{', '.join(f'{t:g}' for t in self._times)} s")
        if index not in self._grids:
            self._grids[index] = read_fields(self._files[index])
        return self._grids[index]

    def heading(self, time):
        """A moment as the heading of a picture, with the name of the stage that ends there."""
        ends = [name for name, end in self._stages.items() if abs(end - time) <= 1e-6 * max(1.0, abs(time))]
        return f"end of '{ends[0]}', {time:g} s" if ends else f"{time:g} s"

    def probes(self, patterns):
        """Names and points [point][3] m of the probes that a picture asks for; * is any text."""
        for pattern in patterns:
            if not fnmatch.filter(self._probes, pattern):
                raise ResultError(f"plots.toml: no probe '{pattern}' at a point; there are "
                                  f"{', '.join(self._probes)}")
        names = [name for name in self._probes if any(fnmatch.fnmatch(name, pattern) for pattern in patterns)]
        return names, np.array([self._probes[name] for name in names]).reshape(-1, 3)

    def body_mask(self, grid, names):
        """Cells of the bodies named; all when `names` is empty."""
        if not names:
            return np.ones(len(grid.cell_types), bool)
        unknown = [name for name in names if name not in self.bodies]
        if unknown:
            raise ResultError(f"plots.toml: no body {', '.join(unknown)}; there are {', '.join(self.bodies)}")
        return np.isin(grid.cell_data["body"], [self.bodies.index(name) for name in names])


def values(grid, spec, cells=None):
    """Values of the field that a picture asks for, in its unit: "point_data" or "cell_data", and the array; nan
    where the field has no value (a negative mark) or they are not `above` or `below` what the picture says. `smooth`: values
    of the cells of a mask averaged at their nodes."""
    name, component = spec["field"], spec.get("component")
    for kind in ("point_data", "cell_data"):
        if name in getattr(grid, kind):
            found = getattr(grid, kind)[name]
            if found.ndim > 1:
                if component is not None and not 0 <= component < found.shape[1]:
                    raise ResultError(f"plots.toml: field '{name}' has the components 0 to "
                                      f"{found.shape[1] - 1}, not {component}")
                found = np.linalg.norm(found, axis=1) if component is None else found[:, component]
            declared = fields.find(name)
            if declared is not None and declared.no_value is not None and declared.no_value < 0:
                found = declared.with_value(found)
            if spec.get("smooth", False) and kind == "cell_data":
                kind, found = "point_data", _at_nodes(grid, found, cells)
            found = style.convert(found, _written_unit(grid, name), unit(grid, spec))
            if "above" in spec:
                found = np.where(found > spec["above"], found, np.nan)
            return kind, np.where(found < spec["below"], found, np.nan) if "below" in spec else found
    known = [name for data in (grid.point_data, grid.cell_data) for name in data]
    raise ResultError(f"plots.toml: no field '{name}' was written; there are {', '.join(known)}")


def _at_nodes(grid, found, cells):
    size = np.diff(grid.offsets, prepend=0)
    nodes, weight = grid.connectivity, np.repeat(cells.astype(float), size)
    count = np.bincount(nodes, weight, len(grid.points))
    return np.bincount(nodes, weight * np.repeat(found, size), len(grid.points)) / np.maximum(count, 1.0)


def nodes_of(grid, cells):
    """The nodes of the cells of a mask."""
    return np.unique(grid.connectivity[np.repeat(cells, np.diff(grid.offsets, prepend=0))])


def displacement(grid):
    """[node][3] m; without the field a picture cannot show it."""
    if "displacement" not in grid.point_data:
        raise ResultError("plots.toml: a deformed shape needs the field displacement, which was not written")
    return grid.point_data["displacement"]


def _written_unit(grid, name):
    return fields.unit(name, grid.units[name])


def unit(grid, spec):
    """The unit of the values of a picture."""
    field = fields.find(spec["field"])
    return spec.get("unit") or (field.shown if field and field.is_root else grid.units[spec["field"]])


def limits(grids, masks, spec):
    """The range of the colours: what is asked for, else what the cells of the masks have."""
    if "range" in spec:
        return tuple(spec["range"])
    low, high = np.inf, -np.inf
    for grid, mask in zip(grids, masks):
        kind, found = values(grid, spec)
        shown = found[mask] if kind == "cell_data" else found[nodes_of(grid, mask)]
        low, high = min(low, shown.min(initial=np.inf)), max(high, shown.max(initial=-np.inf))
    return (low, high) if high > low else (low, low + 1.0)
