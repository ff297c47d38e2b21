"""The age of the metal in a mould that fills: the time since it passed the gate.

The age follows the metal as a passive scalar, da/dt + u . grad a = 1 with a = 0 in the gate. From one moment that OpenFOAM has written to
the next, the middle of each cube is followed back along the velocity, which goes by straight lines in time and between the middles of
cubes: where the path leaves through the gate the age is the time since then, else it is the age at the place where the path began, and the
time between the moments (a semi-Lagrangian step). It takes no part in the flow.
"""

import numpy as np

PART = 0.8  # of a cube that a point moves in one step, at most
MOST_STEPS = 30  # between two moments
SOME = 0.05  # share of metal from which a cube has an age
CORNERS = [(i, j, k) for i in (0, 1) for j in (0, 1) for k in (0, 1)]
ROUNDS = 2  # cubes by which ages reach into the air ahead of the front


class Ages:
    """Follows the metal in a set of cubes from a gate."""

    def __init__(self, cubes, gate_cells, direction):
        """gate_cells: numbers of the cubes behind the gate; direction: of the flow there, a whole-number vector."""
        self._edge, self._n = cubes.edge, len(cubes.cells)
        self._low = cubes.cells.min(axis=0) - 2
        # A dense grid with two layers around it tells the number of the cube at a place, n where there is none.
        self._grid = np.full(np.ptp(cubes.cells, axis=0) + 5, self._n)
        self._cells = cubes.cells - self._low
        self._grid[tuple(self._cells.T)] = np.arange(self._n)
        self._direction = np.asarray(direction, int)
        # Places outside from which the gate leads in have the numbers after n: an age against that of the cube behind makes zero in the gate.
        outside = self._cells[gate_cells] - self._direction
        open_ = self._grid[tuple(outside.T)] == self._n
        self._gate, outside = np.asarray(gate_cells)[open_], outside[open_]
        self._with_gate = self._grid.copy()
        self._with_gate[tuple(outside.T)] = self._n + 1 + np.arange(len(outside))

    @staticmethod
    def _between(grid, places, values, weights):
        """Values [cube] or [cube][axis] at places in edges of the grid, straight between the middles of cubes, by the weights of these [cube];
        NaN where all of them have none."""
        base = np.floor(places - 0.5).astype(int)
        part = places - 0.5 - base
        x, y, z = (np.stack([1 - part[:, d], part[:, d]]) for d in range(3))
        flat = grid.ravel()
        first = (base[:, 0] * grid.shape[1] + base[:, 1]) * grid.shape[2] + base[:, 2]
        total, weight = np.zeros((len(places), *values.shape[1:])), np.zeros(len(places))
        for i, j, k in CORNERS:
            number = flat[first + (i * grid.shape[1] + j) * grid.shape[2] + k]
            w = x[i] * y[j] * z[k] * weights[number]
            total += (w[:, None] if values.ndim == 2 else w) * values[number]
            weight += w
        none = weight <= 1e-9
        weight[none] = np.nan
        return total / (weight[:, None] if values.ndim == 2 else weight)

    def _padded(self, values):
        return np.concatenate([values, np.zeros((1, *values.shape[1:]))])

    def _ahead(self, ages, metal):
        """Ages and weights of cubes, with those next to the metal: what is around a path that ends at the front."""
        known = self._padded(metal * (metal > SOME))
        ages = self._padded(np.where(metal > SOME, ages, 0.0))
        beside = np.stack([self._grid[tuple((self._cells + side).T)] for side in np.concatenate([np.eye(3, dtype=int), -np.eye(3, dtype=int)])],
                          axis=1)
        for _ in range(ROUNDS):
            total = (known > 0)[beside].sum(axis=1)
            new = np.flatnonzero((known[:-1] == 0) & (total > 0))
            ages[new] = (ages * (known > 0))[beside[new]].sum(axis=1) / total[new]
            known[new] = 1e-6  # counts where nothing better is near
        return np.append(ages, -ages[self._gate]), np.append(known, np.ones(len(self._gate)))

    def step(self, ages, before, after, metal_before, metal_after, duration):
        """The ages at the end of a time between two moments [s]. ages, metal: [cube]; before, after: velocities [cube][axis] [m/s]."""
        chosen = np.flatnonzero(metal_after > SOME)
        place, entered = self._cells[chosen] + 0.5, np.full(len(chosen), np.nan)
        fastest = max(np.abs(before).max(), np.abs(after).max())
        steps = int(np.clip(np.ceil(fastest * duration / (PART * self._edge)), 1, MOST_STEPS))
        part, there = duration / steps, np.append(np.ones(self._n), 0.0)
        before, after = self._padded(before), self._padded(after)
        for k in range(steps):
            moving = np.flatnonzero(np.isnan(entered))
            if not len(moving):
                break
            # By the velocity in the middle of the step of time, at the middle of the way (Runge and Kutta, second order).
            when = 1 - (k + 0.5) / steps
            velocity = before + when * (after - before)
            here = place[moving]
            half = here - 0.5 * part / self._edge * self._inside(self._between(self._grid, here, velocity, there))
            new = here - part / self._edge * self._inside(self._between(self._grid, self._kept(half, here)[0], velocity, there))
            kept, passed = self._kept(new, here)
            # Where the path passes the plane of the gate tells when.
            axis = int(np.abs(self._direction).argmax())
            plane = np.floor(here[:, axis]) + (self._direction[axis] < 0)
            way = new[:, axis] - here[:, axis]
            share = np.divide(plane - here[:, axis], way, out=np.ones(len(way)), where=way != 0).clip(0, 1)
            entered[moving[passed]] = (k + share[passed]) * part
            place[moving] = kept
        known, weights = self._ahead(ages, metal_before)
        old = self._between(self._with_gate, place, known, weights)
        new = np.zeros(self._n)
        found = np.where(np.isnan(entered), old + duration, entered)
        # Metal that has come where none was near: as old as that around it.
        found = np.where(np.isnan(found), np.nanmean(found) if np.isfinite(found).any() else duration, found)
        new[chosen] = found
        return new

    @staticmethod
    def _inside(velocity):
        return np.nan_to_num(velocity)

    def _kept(self, new, here):
        """Places that a path may have: what leads into a wall stays before it, axis by axis. And which paths have left through the gate."""
        index = np.floor(new).astype(int).clip(0, np.array(self._grid.shape) - 1)
        passed = self._with_gate[tuple(index.T)] > self._n
        kept = here.copy()
        for axis in range(3):
            tried = kept.copy()
            tried[:, axis] = new[:, axis]
            at = np.floor(tried).astype(int).clip(0, np.array(self._grid.shape) - 1)
            free = self._grid[tuple(at.T)] < self._n
            kept = np.where(free[:, None], tried, kept)
        return kept, passed
