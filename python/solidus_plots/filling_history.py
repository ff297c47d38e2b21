"""What is kept of a filling while it is computed: when and how hot metal came to each cube, and the balances."""

import json
import shutil

import numpy as np

from solidus_plots import filling_dictionaries as dictionaries
from solidus_plots.filling_age import Ages
from solidus_plots.filling_view import View

FRONT_ROUNDS = 50  # of handing volume to cubes that hold air, until each is full at most
BOTH = 0.1  # share of melt and of frozen metal from which a cube is mush
NEAR = 5.0  # that mush should be to its freezing temperature [K]
STATE = "state.npz"  # of a filling that has not come to its end


def full_volume(metal, wanted):
    """Shares of metal between 0 and 1 whose sum is the wanted one: what is missing, or too much, goes to the cubes of the front by
    m (1 - m), which leaves full cubes and air alone. Where no front is left the sum stays what it is."""
    share = np.clip(metal, 0, 1)
    for _ in range(FRONT_ROUNDS):
        missing = wanted - share.sum()
        weight = share * (1 - share)
        if abs(missing) < 1e-12 * len(share) or weight.sum() < 1e-9 * len(share):
            break
        # At most half of what a cube holds of the other in each round.
        part = np.clip(missing / weight.sum() * weight, -0.5 * share, 0.5 * (1 - share))
        share = share + part
    return share


def with_heat_of(before, after, temperature):
    """Temperatures of cubes after metal has been handed from one to another [K]: it takes its heat along, as one that is mixed with what is
    there. before, after: shares of metal [cube]. Frozen metal stays where it is. Where more metal comes than leaves, the rest has the mean
    temperature of all metal."""
    taken, given = (before - after).clip(0), (after - before).clip(0)
    if given.sum() <= 0:
        return temperature
    rest = max(given.sum() - taken.sum(), 0.0)
    mean = np.average(temperature, weights=before.clip(0)) if before.clip(0).any() else temperature.mean()
    hot = ((taken * temperature).sum() + rest * mean) / (taken.sum() + rest)
    share = np.divide(given, after, out=np.zeros_like(after), where=after > 0)
    return temperature + share * (hot - temperature)


def with_returned_heat(missing, metal, solid, temperature, melt):
    """Temperatures [K] and frozen shares of cubes after missing heat has been given back, and how much of it was. The solver loses heat
    in cubes where metal freezes while it flows: that metal is warmed up to its freezing temperature, each cube by the same part of what it
    lacks, and then melts in the same way.
    missing: in J/kg times cubes, as heat times shares is; nothing is given back if it is not positive."""
    lacks = melt.heat * metal * (melt.freezing - temperature).clip(0)
    frozen = melt.latent * solid
    warmed = min(1.0, missing / lacks.sum()) if missing > 0 and lacks.any() else 0.0
    rest = missing - warmed * lacks.sum()
    melted = min(1.0, rest / frozen.sum()) if rest > 0 and frozen.any() else 0.0
    temperature = np.where(lacks > 0, temperature + warmed * (melt.freezing - temperature), temperature)
    return temperature, (1 - melted) * solid, warmed * lacks.sum() + melted * frozen.sum()


class History:
    def __init__(self, folder, mould, melt, made_of):
        n = len(mould.cavity.cubes.cells)
        self._folder, self._mould, self._melt, self.made_of = folder, mould, melt, made_of
        self.frame, self.name, self.time, self.full = 0, "0", 0.0, 0.0
        self.came = [(0.0, 0.0)]  # times, and the volumes that have come through the gate until then [m3]
        self.corrected = 0.0  # volume that was handed to other cubes, of the cavity's
        self.returned = 0.0  # heat that the solver lost where metal freezes, and that was given back there [J]
        self.fill_time, self.arrival = np.full(n, np.nan), np.full(n, np.nan)
        self.front_velocity = np.full((n, 3), np.nan)
        self.temperature, self.metal, self.solid = np.full(n, mould.air), np.zeros(n), np.zeros(n)
        self.rows, self.levels = [], []
        self.age, self.velocity = np.zeros(n), np.zeros((n, 3))
        cavity, gate = mould.cavity, mould.gate
        self._ages = Ages(cavity.cubes, cavity.faces[gate.faces], np.round(gate.direction))
        self.view = View(cavity.cubes)
        self.mush = [0, 0]  # cubes with melt and frozen metal at all moments, and those that were too far from its freezing temperature

    # --- what the flow has computed --------------------------------------------------------------------------

    def plan(self, duration, volume):
        """What comes in the next stretch of time [m3]."""
        self.came.append((self.time + duration, self.came[-1][1] + volume))

    def take(self, run, until):
        """Reads the frames of a stretch, which the walls have seen as one."""
        frames = [(time, name) for time, name in run.times() if time > self.time * (1 + 1e-9) + 1e-15]
        moments = [self._moment()]
        for time, name in frames:
            self._see(run, time, name)
            moments.append(self._moment())
        for wall in self._mould.walls:
            if not wall.insulating():
                wall.end(moments, self.metal, self._melt.conductivity, dictionaries.gas_conductivity())
        self._correct_volume()
        self._correct_heat()
        self._hand_back(run)
        self._observe(run)
        self.view.add(self.time, self.full, self.metal, self.temperature, self.velocity)
        self.frame = until
        self._save()
        for time, name in run.times():
            if 0 < time < self.time * (1 - 1e-9):
                run.forget(name)

    def _moment(self):
        """The time, and temperature and conductivity in each cube."""
        melt = self.metal - self.solid
        conductivity = (self._melt.conductivity * melt + self._melt.solid_conductivity * self.solid
                        + dictionaries.gas_conductivity() * (1 - self.metal))
        return self.time, self.temperature, conductivity

    def _see(self, run, time, name):
        """One frame: fronts are where the share of metal passes a half since the frame before."""
        temperature, melt, solid = (run.read(name, field) for field in ("T", "alpha.melt", "alpha.solid"))
        self._raw = melt + solid
        metal = np.clip(self._raw, 0, 1)
        new = np.flatnonzero(np.isnan(self.fill_time) & (metal >= 0.5))
        velocity = run.read(name, "U")
        self.age = self._ages.step(self.age, velocity if self.frame == 0 else self.velocity, velocity, self.metal, metal, time - self.time)
        self.velocity = velocity
        self._look_at_mush(temperature, melt, solid)
        if len(new):
            part = (0.5 - self.metal[new]) / np.maximum(metal[new] - self.metal[new], 1e-9)
            self.fill_time[new] = self.time + np.clip(part, 0, 1) * (time - self.time)
            self.arrival[new], self.front_velocity[new] = temperature[new], velocity[new]
        self.temperature, self.metal, self.solid = temperature, metal, np.clip(solid, 0, metal)
        self.time, self.name, self.full = time, name, float(metal.mean())
        self.levels.append(np.round(255 * metal).astype(np.uint8))
        self.rows.append([time, 100 * self.full, self.flowed(time), self.heat_of_walls(),
                          float(temperature[metal > 0.5].min()) if (metal > 0.5).any() else np.nan])

    def _look_at_mush(self, temperature, melt, solid):
        """Adds cubes that hold both melt and frozen metal, and those whose temperature is not that at which it freezes."""
        both = (melt > BOTH) & (solid > BOTH)
        far = both & (np.abs(temperature - self._melt.freezing) > NEAR)
        self.mush = [self.mush[0] + int(both.sum()), self.mush[1] + int(far.sum())]

    def _correct_volume(self):
        """The solver scales its three shares to a sum of one in every step, by which metal comes and goes at the front, and a cube from
        which air leaves faster than it comes ends up with more metal than it can hold. Both are set right after each stretch."""
        n = len(self.metal)
        self.metal = full_volume(self._raw, self.flowed(self.time) / self._mould.cavity.cubes.edge ** 3)
        self.solid = np.clip(self.solid, 0, self.metal)
        # What goes from one cube to another counts once, and what the solver has lost or gained.
        change = self.metal - self._raw
        self.corrected += float(max(change.clip(0).sum(), (-change).clip(0).sum())) / n
        self.temperature = with_heat_of(self._raw, self.metal, self.temperature)

    def _correct_heat(self):
        """Shares that the solver scales bring metal into cubes without its heat, and each gets the temperature of its cube: cold ones, where
        metal freezes, grow and hold ever more cold metal. What has come through the gate, less what the walls have taken and the metal
        still has, is given back there."""
        melt, unit = self._melt, self._mould.cavity.cubes.edge ** 3 * self._melt.density
        have = (melt.heat * (self.temperature - melt.freezing) * self.metal + melt.latent * (self.metal - self.solid)).sum()
        missing = (self.heat_that_came() - self.heat_of_walls()) / unit - have
        self.temperature, self.solid, returned = with_returned_heat(missing, self.metal, self.solid, self.temperature, melt)
        self.returned += float(returned) * unit

    def _hand_back(self, run):
        """The corrected fields go into the files from which the solver continues."""
        run.change_cells(self.name, "T", self.temperature)
        for field, values in (("gas", 1 - self.metal), ("melt", self.metal - self.solid), ("solid", self.solid)):
            run.change_cells(self.name, f"alpha.{field}", values)
        self.full = float(self.metal.mean())
        self.levels[-1] = np.round(255 * self.metal).astype(np.uint8)
        self.rows[-1][1] = 100 * self.full

    def _observe(self, run):
        """Tells a drive by pressure what it works against: the metal behind the gate."""
        drive, gate = self._mould.drive, self._mould.gate
        if drive.kind() == "pressure":
            (begin, before), (end, after) = self.came[-2:]
            behind = run.read(self.name, "p")[self._mould.cavity.faces[gate.faces]].mean() - dictionaries.AIR_PRESSURE
            drive.observe(self.time, self.full, behind, (after - before) / (end - begin) / drive.area)

    def flowed(self, time):
        """The volume that has come through the gate [m3]."""
        times, volumes = zip(*self.came)
        return float(np.interp(time, times, volumes))

    def heat_that_came(self):
        """Through the gate, counted from metal that has just frozen [J]."""
        melt = self._melt
        return self.flowed(self.time) * melt.density * (melt.heat * (self._mould.pouring - melt.freezing) + melt.latent)

    def heat_of_walls(self):
        return float(sum(wall.heat.sum() for wall in self._mould.walls))

    def heat_lost(self):
        """What each kilogram of the metal in a cube has given off since the gate [J/kg]."""
        share = np.divide(self.solid, self.metal, out=np.zeros_like(self.solid), where=self.metal > 1e-6)
        return self._melt.heat * (self._mould.pouring - self.temperature) + self._melt.latent * np.clip(share, 0, 1)

    # --- stopping and going on -------------------------------------------------------------------------------

    def _save(self):
        walls = {f"{wall.name}.{what}": getattr(wall, what) for wall in self._mould.walls for what in ("contact", "heat")}
        numbers = {"frame": self.frame, "name": self.name, "time": self.time, "full": self.full, "corrected": self.corrected,
                   "returned": self.returned, "came": self.came, "resistance": self._mould.drive.resistance,
                   "made_of": self.made_of, "rows": self.rows, "mush": self.mush}
        target = self._folder / STATE
        with target.with_suffix(".part").open("wb") as out:
            np.savez(out, numbers=json.dumps(numbers), levels=np.array(self.levels), fill_time=self.fill_time, arrival=self.arrival,
                     front_velocity=self.front_velocity, temperature=self.temperature, metal=self.metal, solid=self.solid,
                     age=self.age, velocity=self.velocity, **self.view.kept(), **walls)
        target.with_suffix(".part").rename(target)

    def resume(self, foam):
        """Takes up the state of a filling of the same cavity; whether there was one."""
        file = self._folder / STATE
        if not file.exists() or not foam.is_dir():
            return False
        with np.load(file) as kept:
            numbers = json.loads(str(kept["numbers"]))
            if numbers["made_of"] != self.made_of:
                return False
            self.frame, self.name, self.time, self.full = (numbers[key] for key in ("frame", "name", "time", "full"))
            self.corrected, self.rows, self.levels = numbers["corrected"], numbers["rows"], list(kept["levels"])
            self.mush, self.returned = numbers["mush"], numbers.get("returned", 0.0)  # absent in states of 0.2.0
            self.view.restore(kept)
            self.came = [tuple(entry) for entry in numbers["came"]]
            self._mould.drive.resistance = numbers["resistance"]
            for what in ("fill_time", "arrival", "front_velocity", "temperature", "metal", "solid", "age", "velocity"):
                setattr(self, what, kept[what])
            for wall in self._mould.walls:
                wall.contact, wall.heat = kept[f"{wall.name}.contact"], kept[f"{wall.name}.heat"]
        # Times beyond the state are of a stretch that was not finished.
        for part in self._parts(foam):
            for entry in part.iterdir():
                try:
                    later = float(entry.name) > self.time * (1 + 1e-9)
                except ValueError:
                    continue
                if later:
                    shutil.rmtree(entry)
        return True

    @staticmethod
    def _parts(foam):
        return sorted(foam.glob("processor*")) or [foam]

    def processes(self, foam, wanted):
        """On as many as it began with."""
        return len(list(foam.glob("processor*"))) or (wanted if self.frame == 0 else 1)
