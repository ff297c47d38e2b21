"""What drives the metal into a mould: a steady rate, a speed over time, or a pressure, and how the mould turns meanwhile.

A filling is computed in stretches that bring equal volumes. For each the drive tells how long it takes; within it the gate has one speed.

A pressure P in the gate, that of a head of metal or of a furnace, has to lift the metal that is there, to make it move and to
overcome what resists it in the cavity:

    P(t) = rho g (z - z_gate) + (rho/2 + R) v^2

with z the height up to which the metal would fill the cavity if it lay still. R follows from the pressure that the flow has had behind
the gate at the end of the stretch before: frozen metal in the way makes it large. Where P does not suffice the metal stands.
"""

import numpy as np

from solidus_plots.vtu import ResultError

PATIENCE = 60.0  # beyond the last of the times [s], for which a drive is waited for when a filling is planned
STANDS = 0.3  # of the planned time of filling: metal that needs longer for one stretch stands
LEVELS = 100  # heights between the bottom and the top of the cavity
ROUNDS = 80  # of halving an interval


def turned(vector, axis, angle):
    """A vector turned about an axis through an angle [rad], by Rodrigues' formula."""
    axis = np.asarray(axis, float) / np.linalg.norm(axis)
    return vector * np.cos(angle) + np.cross(axis, vector) * np.sin(angle) + axis * (axis @ vector) * (1 - np.cos(angle))


class Tilt:
    """Gravity over time, seen from the mould, which turns."""

    def __init__(self, filling, gravity):
        self._gravity, self._times = np.asarray(gravity, float), filling.get("times", [])
        self._angles, self._axis = filling.get("tilt"), filling.get("tilt_axis")

    def turns(self):
        return bool(self._angles)

    def gravity(self, time):
        if not self._angles:
            return self._gravity
        return turned(self._gravity, self._axis, -np.interp(time, self._times, self._angles))

    def up(self, time):
        g = self.gravity(time)
        return -g / np.linalg.norm(g)

    def positions(self):
        """Directions upward that the mould has on its way, the last one last."""
        return [self.up(time) for time in np.linspace(0, self._times[-1], 9)] if self.turns() else [self.up(0)]


class Drive:
    def __init__(self, filling, cavity, gate, density, flow, tilt):
        """flow: the steady rate where nothing else is given [m3/s]; gate: with faces."""
        cubes = cavity.cubes
        self.area, self.volume = len(gate.faces) * cubes.edge ** 2, cubes.volume()
        self._density, self._flow, self._tilt = density, flow, tilt
        self._centres, self._gate = cubes.centres(), cavity.face_centres()[gate.faces].mean(axis=0)
        self._edge = cubes.edge
        self._upright = self._levels(tilt.up(0))
        self._times, self._speed, self._pressure = filling.get("times"), filling.get("speed"), filling.get("pressure")
        if "head" in filling:
            self._times, self._pressure = [0.0], [density * np.linalg.norm(tilt.gravity(0)) * filling["head"]]
        self.resistance = 0.0  # R [kg/m3]
        self.limit = PATIENCE + (self._times[-1] if self._times else 0.0)
        self.time, self.fastest = self._planned()
        self.limit = STANDS * self.time

    def kind(self):
        return "speed" if self._speed else "pressure" if self._pressure else "rate"

    def described(self):
        return {"rate": "at a steady rate", "speed": "at the given speeds", "pressure": "driven by pressure"}[self.kind()]

    def _levels(self, up):
        """(shares, heights): how full the cavity is when metal that lies still reaches a height [m]. Cubes fill from below."""
        middles = self._centres @ up
        heights = np.linspace(middles.min() - 0.5 * self._edge, middles.max() + 0.5 * self._edge, LEVELS)
        shares = np.array([np.clip((height - middles) / self._edge + 0.5, 0, 1).mean() for height in heights])
        return shares, heights

    def _lifted(self, time, full):
        """The pressure that lifts the metal of a part of the cavity above the gate [Pa]."""
        up = self._tilt.up(time)
        level = np.interp(full, *(self._levels(up) if self._tilt.turns() else self._upright))
        return self._density * np.linalg.norm(self._tilt.gravity(time)) * max(level - self._gate @ up, 0.0)

    def _speed_by_pressure(self, time, full):
        spare = np.interp(time, self._times, self._pressure) - self._lifted(time, full)
        return np.sqrt(max(spare, 0.0) / (0.5 * self._density + self.resistance))

    def _brought(self, time, duration, full):
        """The volume that comes within a duration [m3]."""
        if self.kind() == "rate":
            return self._flow * duration
        if self.kind() == "pressure":
            # What is there at the end of the stretch counts: a pressure that rises is waited for.
            return self.area * self._speed_by_pressure(time + duration, full) * duration
        # Exact for straight lines: trapezoids between the times of the table.
        end = time + duration
        points = np.array([time, *[t for t in self._times if time < t < end], end])
        speeds = np.interp(points, self._times, self._speed)
        return self.area * float((0.5 * (speeds[1:] + speeds[:-1]) * np.diff(points)).sum())

    def next(self, time, came, wanted):
        """How long a volume [m3] takes from a time on, where another has come [s]; None where it does not come: the metal stands."""
        waits = max(self._times[-1] - time, 0.0) if self._times else 0.0
        low, high = 0.0, self.limit + waits if self.kind() != "rate" else 2 * wanted / self._flow
        full = (came + wanted) / self.volume
        if self._brought(time, high, full) < wanted:
            return None
        for _ in range(ROUNDS):
            middle = 0.5 * (low + high)
            low, high = (middle, high) if self._brought(time, middle, full) < wanted else (low, middle)
        return high

    def observe(self, time, full, behind, speed):
        """Sets what resists, from the pressure behind the gate above that of the air [Pa] at the end of a stretch with this speed of the
        gate [m/s]."""
        if self.kind() == "pressure" and speed > 0:
            found = max(behind - self._lifted(time, full), 0.0) / speed ** 2
            # Drag that goes by the speed makes R fall with it: the mean of both in powers comes to rest, where the last alone would swing.
            self.resistance = np.sqrt(found * self.resistance) if min(found, self.resistance) > 0 else 0.5 * (found + self.resistance)

    def _planned(self, parts=50):
        """The time of filling without what resists, and the highest speed in the gate. Throws ResultError."""
        time, fastest, part = 0.0, 0.0, self.volume / parts
        for k in range(parts):
            duration = self.next(time, k * part, part)
            if duration is None:
                if k == 0:
                    raise ResultError("no metal comes: the pressure in [filling] does not lift it, or its speed is zero")
                if self.kind() == "speed":
                    raise ResultError(f"the speeds in [filling] bring {100 * k / parts:.0f} % of the cavity: later times, or higher speeds")
                # A head that is too low: the metal will stand, which the flow shows.
                time *= parts / k
                break
            fastest = max(fastest, part / duration / self.area)
            time += duration
        return time, fastest
