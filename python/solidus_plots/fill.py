"""Fills the mould of a case by OpenFOAM: python3 -m solidus_plots.fill FOLDER, as `solidus fill` and `solidus run` do.

FOLDER/cavity holds what the program has written of the case. docs/guide/filling.md describes what comes out.
"""

import argparse
import ctypes
import hashlib
import json
import os
from pathlib import Path
import shutil
import signal
import sys
import time

import numpy as np

from solidus_plots import filling_dictionaries as dictionaries, filling_results, filling_trust
from solidus_plots.filling_cavity import cavity_of, edge_for
from solidus_plots.filling_drive import Drive, Tilt
from solidus_plots.filling_flow import FlowError, FoamRun, version
from solidus_plots.filling_gates import FEW, GOOD_SPEED, by_body, gate_of, vents_of, walls_of
from solidus_plots.filling_history import History
from solidus_plots.filling_mesh import SIDES, write_mesh
from solidus_plots.filling_walls import walls_for, wetted
from solidus_plots.many_runs import INTERRUPTED
from solidus_plots.verb import sentence
from solidus_plots.vtu import ResultError, read_fields

TESTED = "1912"
PR_SET_PDEATHSIG = 1  # of Linux, <sys/prctl.h>
CANNOT_CONTINUE = 22  # the program's 2
FRAMES = 100  # moments that are looked at while the mould fills
STRETCH = 2  # of them between two changes of what walls take
FULL = 0.985  # of the cavity at which filling ends
LATEST = 1.0  # times of the time of filling after which it ends anyway: what comes then leaves by the vents
CRAWLS = 15  # times as many steps as stretches took before, after which one is given up: air leaves by the last vents at a speed for which no step is short enough
FEWEST_STEPS = 1500  # of such a stretch
NEARLY_FULL = 0.8  # of the cavity, from which on what is there then serves; before it is a fault
TENSION = 1.0  # [N/m] of metals whose card says none: aluminium has 0.9, iron 1.8
VISCOSITY = 2e-3  # [Pa s] likewise
WORK_OF_A_PROCESS = 15000  # cubes from which a second process pays


class Mould:
    """What is filled, from the files of the program."""

    def __init__(self, folder):
        text = (folder / "cavity" / "cavity.json").read_text()
        self.file = json.loads(text)
        grid = read_fields(folder / "cavity" / "mesh.vtu")
        self.filling, bodies = self.file["filling"], self.file["bodies"]
        self.poured = [b for b, body in enumerate(bodies) if body["poured"]]
        self.tilt = Tilt(self.filling, self.file["gravity"])
        self.up = self.tilt.up(0)
        edge = self.filling.get("cell_size") or edge_for(grid, self.poured, self.filling["cells"])
        self.cavity = cavity_of(grid, self.poured, edge)
        self.pouring = self.filling.get("pouring") or max(bodies[b]["hottest"] for b in self.poured)
        self.material = bodies[max(self.poured, key=lambda b: self.cavity.volumes[b])]["material"]
        self._set_rate()
        gating = [b for b in self.poured if bodies[b]["role"] == "gating"]
        self.gate = gate_of(self.cavity, self.filling, gating, self.up, self.flow)
        self.drive = Drive(self.filling, self.cavity, self.gate, self.material["density"], self.flow, self.tilt)
        self.time, self.speed = self.drive.time, self.drive.fastest
        found, self.vents_chosen = vents_of(self.cavity, self.filling, self.tilt.positions(), self.gate)
        self.vents, self.leak = np.sort(found[:-1]), found[-1:]
        self.walls = (walls_for(self.cavity, walls_of(self.cavity, self.gate, found), self.file)
                      + walls_for(self.cavity, by_body(self.cavity, self.vents), self.file, "vent"))
        self.air = min((wall.mould for wall in self.walls if not wall.insulating()), default=293.15)

    def _set_rate(self):
        volume, density = self.cavity.cubes.volume(), self.material["density"]
        self.wall = 2 * volume / self.cavity.true_area
        if "rate" in self.filling:
            self.flow = self.filling["rate"] / density
        else:
            # The usual rule of a foundry for the time of pouring; thickness in mm, mass in kg.
            self.flow = volume / self.filling.get("time", 1.6 * (1e3 * self.wall * density * volume) ** (1 / 3))

    def melt(self):
        """Constants of the metal between its liquidus and the gate."""
        m = self.material
        if "liquidus" not in m:
            raise ResultError(f"the material '{m['name']}' has no solidification: what fills a mould freezes")
        if self.pouring <= m["half_solid"]:
            raise ResultError(f"the metal comes at {self.pouring - 273.15:.0f} degC, below {m['half_solid'] - 273.15:.0f} degC at which "
                              "it is half solid: a higher temperature in [filling], or initial_temperature of what is cast")
        temperature, enthalpy = np.array(m["temperatures"]), np.array(m["enthalpy"])
        low, high = m["liquidus"] + 0.5, max(self.pouring, m["liquidus"] + 20)
        heat = (np.interp(high, temperature, enthalpy) - np.interp(low, temperature, enthalpy)) / (high - low) / m["density"]
        return dictionaries.Melt(m["density"], heat, m["latent_heat"], m["half_solid"],
                                 np.interp(self.pouring, temperature, m["conductivity"]),
                                 np.interp(m["solidus"] - 1, temperature, m["conductivity"]),
                                 m.get("melt_viscosity", VISCOSITY), m.get("surface_tension", TENSION))

    def described(self):
        cubes, edge = self.cavity.cubes, 1e3 * self.cavity.cubes.edge
        across = self.gate.width / self.cavity.cubes.edge
        lines = [f"{len(cubes.cells)} cubes of {edge:.3g} mm, {1e3 * self.wall / edge:.1f} across the mean wall of "
                 f"{1e3 * self.wall:.3g} mm; their edge was changed by {100 * (self.cavity.scale - 1):+.1f} % for the volume of the drawing",
                 f"gate {self.gate.chosen}: {len(self.gate.faces)} faces of cubes, {1e3 * self.gate.width:.3g} mm wide, at "
                 f"{self.speed:.2f} m/s; air leaves through {self.vents_chosen}: {len(self.vents) + 1} faces",
                 f"{1e6 * cubes.volume():.4g} cm3, {self.material['density'] * cubes.volume():.4g} kg of "
                 f"{self.pouring - 273.15:.0f} degC in {self.time:.3g} s, {self.drive.described()}" + ", the mould turns" * self.tilt.turns()]
        if self.wall < 3 * self.cavity.cubes.edge:
            lines.append("  less than three cubes across the wall: times and temperatures are a first answer; more cells give better ones")
        if across < FEW:
            lines.append(f"  the gate is {across:.1f} cubes wide, less than {FEW}: its jet is coarse")
        if self.speed > GOOD_SPEED:
            lines.append(f"  the metal enters faster than {GOOD_SPEED} m/s, at which aluminium folds oxide films in (Campbell 2003)")
        return "\n".join(lines)


def flow_of(mould, melt):
    """Steps short enough for the heat of the walls and the change of phase to be followed."""
    edge = mould.cavity.cubes.edge
    hardest = max((wall.conductance * (mould.pouring - wall.mould) for wall in mould.walls), default=0.0)
    cooling = max(3 * hardest / (edge * melt.density * melt.heat), 1.0)  # of a cube in a corner [K/s]
    step = min(mould.time / FRAMES / 4, 2.5 / cooling)
    # The change of phase relaxes within two of the longest steps: then mush is 2 steps times the cooling rate off, 5 K at most.
    rate = 0.5 * melt.heat * melt.freezing / (melt.latent * step)
    direction = mould.gate.direction * mould.speed
    return dictionaries.Flow(tuple(mould.tilt.gravity(0)), tuple(direction), mould.pouring, mould.air, rate, step)


def write_case(folder, mould, melt, flow, processes):
    """Everything that OpenFOAM reads."""
    shutil.rmtree(folder, ignore_errors=True)
    cavity = mould.cavity
    patches = [("gate", "patch", mould.gate.faces), ("leak", "patch", mould.leak)]
    patches += [(wall.name, wall.kind(), wall.faces) for wall in mould.walls]
    write_mesh(folder, cavity.cubes, [(name, kind, cavity.faces[faces], cavity.directions[faces]) for name, kind, faces in patches])
    dictionaries.write_fields(folder, flow, {wall.name: dictionaries.wall_entry(0.0, wall.mould, flow.air) for wall in mould.walls})
    dictionaries.write_materials(folder, melt, flow)
    dictionaries.write_numerics(folder, processes, int(np.ptp(cavity.cubes.cells, axis=0).argmax()))
    dictionaries.write_control(folder, flow, mould.time / FRAMES, mould.time / FRAMES)


class Crawls(Exception):
    """A stretch takes far more steps than those before it."""


class Watch:
    """Prints how full the mould is, and how long it will take. Throws Crawls where steps have become far shorter than they were."""

    def __init__(self, history, goal):
        self._steps, self._before, self._stretches = 0, 0, 0
        self._history, self._goal, self._begin, self._shown = history, goal, time.monotonic(), -1
        self._terminal = sys.stdout.isatty()
        self._first = None

    def __call__(self, line):
        if not line.startswith("Time = "):
            return
        self._steps += 1
        if self._stretches > 3 and self._steps > max(FEWEST_STEPS, CRAWLS * self._before / self._stretches):
            raise Crawls
        now = float(line.split()[2])
        part = min(now / self._goal, 1.0)
        if self._first is None:
            self._first = part
        spent = time.monotonic() - self._begin
        left = spent * (1 - part) / (part - self._first) if part > self._first + 0.01 else None
        text = f"  {100 * part:3.0f} % of the time of filling, {now:.3g} s" + (f", {left:.0f} s to go" if left is not None else "")
        if self._terminal:
            print(f"\r{text}   ", end="", flush=True)
        elif int(10 * part) > self._shown:
            self._shown = int(10 * part)
            print(text, flush=True)

    def next_stretch(self):
        self._before += self._steps
        self._stretches += self._steps > 0
        self._steps = 0

    def done(self):
        if self._terminal:
            print()


def stretch_end(at):
    """The number of the frame at which the next stretch ends: short ones at the start, where the gate is, and at the end."""
    return at + (STRETCH if 1 <= at < FRAMES - 6 else 1)


def air_near(cubes, metal, cells):
    """The share of air in cubes at vents. Where none of them holds any, that of the cubes around, and so on: air that has not come up yet
    leaves by the vents above it."""
    air = 1 - np.asarray(metal, float)
    for _ in range(int(np.ptp(cubes.cells, axis=0).max()) + 1):
        if (air[cells] >= dictionaries.SHUT_SHARE).any():
            break
        beside = np.stack([cubes.number(cubes.cells + np.array(side)) for side in SIDES], axis=1)
        air = np.maximum(air, np.where(beside >= 0, air[beside], 0).mean(axis=1))
    return air[cells]


def set_speeds(mould, run, history, flow):
    """Sets the speed of the metal in the gate, which brings a flow [m3/s], and that of the gas through each face of vents for the next
    stretch."""
    cavity, area = mould.cavity, mould.cavity.cubes.edge ** 2
    speeds = dictionaries.vent_speeds(air_near(cavity.cubes, history.metal, cavity.faces[mould.vents]), flow, area) if len(mould.vents) else []
    if mould.drive.kind() != "rate":
        velocity = mould.gate.direction * flow / mould.drive.area
        run.change_patch(history.name, "U", "gate", lambda _: dictionaries.gate_velocity(velocity))
    for wall in mould.walls:
        if wall.passes_gas():
            of_wall = speeds[np.searchsorted(mould.vents, wall.faces)]
            velocities = of_wall[:, None] * cavity.directions[wall.faces]
            run.change_patch(history.name, "U", wall.name, lambda faces, v=velocities: dictionaries.vent_velocity(v[faces]))
            wall.shut = of_wall == 0
            for phase, shares in (("gas", ~wall.shut), ("melt", wall.shut)):
                run.change_patch(history.name, f"alpha.{phase}", wall.name,
                                 lambda faces, s=shares.astype(float): dictionaries.vent_share(s[faces]))


def short_number(interval, whole):
    """A time between moments with so few digits that the names of moments are exact: OpenFOAM lengthens others on the way, and a later run
    does not find them."""
    digits = 6 - int(np.floor(np.log10(whole)))
    return max(round(interval, digits), 10.0 ** -digits)


def set_walls(mould, run, flow, history, duration):
    """Sets what walls take for the next stretch."""
    wet = wetted(mould.cavity.cubes, history.metal)
    for wall in mould.walls:
        conductance = wall.begin(duration, wet)
        if history.frame > 0:
            run.change_patch(history.name, "T", wall.name, lambda faces, w=wall, h=conductance: dictionaries.wall_entry(
                h[faces], w.mould, flow.air))


def fill(mould, run, flow, history, watch):
    """Computes until the mould is full; the reason why it ended."""
    part = mould.drive.volume / FRAMES
    while True:
        at = history.frame
        if history.full >= FULL:
            return "full"
        if at >= LATEST * FRAMES:
            return "late"
        # A stretch brings a volume; the drive tells how long that takes.
        until = stretch_end(at)
        volume = part * (until - at)
        duration = mould.drive.next(history.time, history.flowed(history.time), volume)
        if duration is None:
            return "stands"
        interval = short_number(duration / (until - at), mould.time)
        duration = interval * (until - at)
        history.plan(duration, volume)
        set_walls(mould, run, flow, history, duration)
        set_speeds(mould, run, history, volume / duration)
        if mould.tilt.turns():
            dictionaries.write_gravity(run.folder, mould.tilt.gravity(history.time + 0.5 * duration))
        dictionaries.write_control(run.folder, flow, history.time + duration, interval)
        watch.next_stretch()
        try:
            run.run(watch)
        except Crawls:
            if history.full >= NEARLY_FULL:
                return "crawls"
            raise FlowError(f"steps became {CRAWLS} times shorter when {100 * history.full:.0f} % of the mould was full: air leaves too fast "
                            "for them; a slower rate, more vents, or another gate helps") from None
        history.take(run, until)


def processes_for(option, cells):
    if option:
        return int(option)
    asked = os.environ.get("SOLIDUS_PROCESSES", "")
    if asked.isdigit() and int(asked) > 0:
        return int(asked)
    cores = int(os.environ.get("SOLIDUS_CORES") or len(os.sched_getaffinity(0)))
    return max(1, min(cores, 1 + cells // WORK_OF_A_PROCESS)) if shutil.which("mpirun") else 1


def fingerprint(folder):
    """What the filling follows from."""
    digest = hashlib.sha256()
    for name in ("cavity.json", "mesh.vtu"):
        digest.update((folder / "cavity" / name).read_bytes())
    return digest.hexdigest()


def parser():
    made = argparse.ArgumentParser(prog="solidus fill", description=__doc__.splitlines()[0])
    made.add_argument("folder", type=Path, metavar="FOLDER")
    made.add_argument("--processes", default="")
    made.add_argument("--restart", action="store_true")
    return made


def run(options):
    """The exit code."""
    folder, made_of = options.folder, fingerprint(options.folder)
    summary = folder / "filling.json"
    if summary.exists() and json.loads(summary.read_text()).get("made_of") == made_of:
        print(f"The mould is filled already: {folder}")
        return 0
    found = version()
    mould = Mould(folder)
    print(mould.described())
    if found != TESTED:
        print(f"OpenFOAM {found} is not the version that was tested, {TESTED}: what it gives is not known to be right", file=sys.stderr)
    print(f"OpenFOAM {found}: {filling_trust.told(filling_trust.errors(found))}", flush=True)
    processes = processes_for(options.processes, len(mould.cavity.cubes.cells))
    melt = mould.melt()
    flow = flow_of(mould, melt)
    history = History(folder, mould, melt, made_of)
    foam = folder / "openfoam"
    if not (options.restart and history.resume(foam)):
        summary.unlink(missing_ok=True)
        write_case(foam, mould, melt, flow, processes)
    print(f"OpenFOAM {found} on {processes} process{'es' * (processes > 1)}; {foam / 'log.txt'} holds what it says", flush=True)
    watch = Watch(history, mould.time)
    try:
        flow_run = FoamRun(foam, len(mould.cavity.cubes.cells), history.processes(foam, processes))
        ended = fill(mould, flow_run, flow, history, watch)
    except KeyboardInterrupt:
        watch.done()
        print("solidus fill: stopped; what has been computed is kept, --restart goes on", file=sys.stderr)
        return INTERRUPTED
    watch.done()
    print(filling_results.write(folder, mould, melt, history, ended, flow_run.seconds))
    return 0


def end_with_the_program():
    """A signal that ends the program, or its end for another reason, ends the flow too: it must not write into a folder later on."""

    def stop(*_):
        # Not by SIGINT, which shells turn off for what they start in the background.
        raise KeyboardInterrupt

    signal.signal(signal.SIGTERM, stop)
    ctypes.CDLL(None).prctl(PR_SET_PDEATHSIG, signal.SIGTERM)


def main(given=None):
    options = parser().parse_args(given)
    end_with_the_program()
    try:
        return run(options)
    except FlowError as error:
        print(f"solidus fill: {error}", file=sys.stderr)
        return CANNOT_CONTINUE
    except (ResultError, OSError) as error:
        print(f"solidus fill: {sentence(error)}", file=sys.stderr)
        return 1


if __name__ == "__main__":
    sys.exit(main())
