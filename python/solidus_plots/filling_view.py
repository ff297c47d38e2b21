"""What the report shows of a filling: metal, its temperature and velocity over time, maps, and places, small enough for a page.

    report.json   times, ranges, places and where each array lies in the other file
    report.bin    cubes (16-bit whole numbers, axis by axis), then bytes: for each moment the state of each cube, 0 where air is and 1 ... 255
                  for the temperature of metal, and three bytes of its velocity, 128 at rest; maps, 0 where there is no value

Where the cavity has more cubes than CUBES, cubes are joined by two, three ... along each axis, with the means of their metal.
"""

import json

import numpy as np

CUBES = 16000  # at most
BYTES = 2_400_000  # of all moments, at most
MOMENTS = 50
PER_CUBE = 4  # bytes of a moment
VALUES = 254  # that a byte tells beside "none"
COLD = 100  # below freezing that temperatures are told [K]
FILES = ("report.json", "report.bin")


class View:
    """Keeps moments of a filling as means over joined cubes."""

    def __init__(self, cubes):
        self.factor = 1
        while True:
            joined = cubes.cells // self.factor
            self.cells, self._of = np.unique(joined, axis=0, return_inverse=True)
            if len(self.cells) <= CUBES:
                break
            self.factor += 1
        self._of = self._of.ravel()
        self.moments = []  # (time, how full, share of metal, temperature, velocity), of joined cubes
        self.edge, self.origin = self.factor * cubes.edge, cubes.origin
        self._sizes = np.bincount(self._of)

    def mean(self, values, weights):
        """Of joined cubes; NaN where the weights are zero."""
        total = np.bincount(self._of, weights, len(self.cells))
        with np.errstate(invalid="ignore", divide="ignore"):
            return np.where(total > 0, np.bincount(self._of, np.nan_to_num(values) * weights, len(self.cells)) / total, np.nan)

    def add(self, time, full, metal, temperature, velocity):
        """One moment."""
        share = self.mean(metal, np.ones(len(metal)))
        hot = np.nan_to_num(self.mean(temperature, metal))
        moving = np.stack([np.nan_to_num(self.mean(velocity[:, d], metal)) for d in range(3)], axis=1)
        self.moments.append((time, full, share.astype("f2"), hot.astype("f4"), moving.astype("f4")))

    def kept(self):
        """The moments as arrays, for the state of a filling that is stopped."""
        names = ("time", "full", "share", "hot", "moving")
        return {f"view.{name}": np.array([moment[k] for moment in self.moments]) for k, name in enumerate(names)}

    def restore(self, kept):
        arrays = [kept[f"view.{name}"] for name in ("time", "full", "share", "hot", "moving")]
        self.moments = [(float(one[0]), float(one[1]), *one[2:]) for one in zip(*arrays)]


def to_bytes(values, low, high):
    """1 ... 255 for what lies between two ends, 0 where there is no value."""
    part = np.clip((np.nan_to_num(values) - low) / ((high - low) or 1.0), 0, 1)
    return np.where(np.isnan(values), 0, 1 + np.round(VALUES * part)).astype(np.uint8)


def write(folder, mould, melt, history, maps, places, lines):
    """maps: {name: (values [cube] with NaN, unit)}; places: [{kind, text, at}]; lines: the answers."""
    view, cavity = history.view, mould.cavity
    count = int(min(MOMENTS, max(2, BYTES // (PER_CUBE * len(view.cells))), len(view.moments)))
    chosen = [view.moments[i] for i in np.unique(np.linspace(0, len(view.moments) - 1, count).round().astype(int))]
    low, high = melt.freezing - COLD, mould.pouring
    fastest = max((np.abs(moving[share >= 0.5]).max(initial=0) for _, _, share, _, moving in chosen), default=0.0) or 1.0
    arrays, parts, length = [], {}, 0

    def put(name, bytes_):
        nonlocal length
        parts[name] = [length, len(bytes_)]
        arrays.append(bytes_)
        length += len(bytes_)

    put("cells", view.cells.T.astype("<i2").tobytes())
    states, velocities = [], []
    for _, _, share, hot, moving in chosen:
        metal = share >= 0.5
        states.append(to_bytes(np.where(metal, hot, np.nan), low, high))
        velocities.append(np.where(metal[:, None], 128 + np.round(127 * np.clip(moving / fastest, -1, 1)), 128).astype(np.uint8))
    put("state", np.concatenate(states).tobytes())
    put("velocity", np.concatenate(velocities).T.tobytes())
    described = {}
    for name, (values, unit) in maps.items():
        joined = view.mean(values, (~np.isnan(values)).astype(float))
        ends = [float(np.nanmin(joined)), float(np.nanmax(joined))] if np.isfinite(joined).any() else [0.0, 1.0]
        put(name, to_bytes(joined, *ends).tobytes())
        described[name] = {"unit": unit, "range": ends}
    gate = cavity.face_centres()[mould.gate.faces].mean(axis=0)
    page = {"format": 1, "cubes": len(view.cells), "edge": view.edge, "origin": view.origin.tolist(), "up": mould.up.tolist(),
            "joined": view.factor, "times": [one[0] for one in chosen], "full": [one[1] for one in chosen], "temperature": [low, high],
            "liquidus": mould.material["liquidus"], "fastest": float(fastest), "parts": parts, "maps": described,
            "gate": {"at": gate.tolist(), "direction": np.asarray(mould.gate.direction, float).tolist(), "width": mould.gate.width},
            "places": places, "answers": lines}
    (folder / FILES[1]).write_bytes(b"".join(arrays))
    (folder / FILES[0]).write_text(json.dumps(page))
