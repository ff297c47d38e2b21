"""What a filling leaves: temperatures to start from, heat of the moulds, fields, a table, a summary, and answers in words."""

import json

import numpy as np

from solidus_plots import filling_film, filling_picture, filling_view
from solidus_plots.compare import write_csv
from solidus_plots.filling_history import NEAR
from solidus_plots.filling_mesh import HEADER, SIDES, Cubes, corners_of, write_mesh
from solidus_plots.vtu import Grid
from solidus_plots.vtu_writer import write_grid

GOOD_SPEED = 0.5  # [m/s], J. Campbell, Castings, 2nd ed. 2003, section 2.1
MUCH_CORRECTED = 0.05  # of the cavity, beyond which what was set right at fronts is warned of
MUCH_HEAT = 0.01  # of the heat that came, beyond which the balance of heat is warned of
MANY = 0.1  # of cubes of freezing metal that are told of where they are off its freezing temperature
NEARLY = 0.93  # of the cavity, from which on it counts as full when the time of filling is over
MOST_WALLS = 4000  # entries of the heat of the moulds
CORNERS = ((0, 0, 0), (1, 0, 0), (1, 1, 0), (0, 1, 0), (0, 0, 1), (1, 0, 1), (1, 1, 1), (0, 1, 1))  # VTK's hexahedron


def spread_into_air(cubes, values, known):
    """Values of cubes that hold air: the mean of their neighbours, from the metal inward."""
    values, known = values.copy(), known.copy()
    neighbours = np.stack([cubes.number(cubes.cells + np.array(side)) for side in SIDES], axis=1)
    while not known.all():
        near = np.where(neighbours >= 0, known[neighbours], False) & ~known[:, None]
        count = near.sum(axis=1)
        if not count.any():
            values[~known] = values[known].mean()
            break
        sums = np.where(near, values[neighbours], 0).sum(axis=1)
        new = count > 0
        values[new], known[new] = sums[new] / count[new], True
    return values


def start_of(mould, history):
    """The enthalpy per volume of each cube by the card [J/m3], and the temperature and solid fraction that follow from it. Air that is
    left counts as metal of its surroundings; the mean is that of the metal of the flow."""
    material = mould.material
    temperature, enthalpy = np.array(material["temperatures"]), np.array(material["enthalpy"])
    lost, metal = history.heat_lost(), history.metal
    mean = np.average(lost, weights=metal)
    lost = spread_into_air(mould.cavity.cubes, lost, metal > 0.5)
    # Bodies keep their drawn volumes, and their cubes do not have them to the last digit: one number makes the sum right.
    weights = np.zeros(len(lost))
    for body, volume in mould.cavity.volumes.items():
        of = mould.cavity.body == body
        weights[of] = volume / max(of.sum(), 1)
    lost += mean - np.average(lost, weights=weights)
    h = np.interp(mould.pouring, temperature, enthalpy) - material["density"] * lost
    return h, *state_at(h, temperature, enthalpy)


def state_at(h, temperature, enthalpy):
    """Temperature and how far a change at one temperature has come, by the table."""
    above = np.clip(np.searchsorted(enthalpy, h, side="right"), 1, len(enthalpy) - 1)
    low, high = enthalpy[above - 1], enthalpy[above]
    part = np.clip((h - low) / (high - low), 0, 1)
    flat = temperature[above] == temperature[above - 1]
    return temperature[above - 1] + part * (temperature[above] - temperature[above - 1]), np.where(flat, 1 - part, 0.0)


def foam_field(path, values, dimensions):
    path.parent.mkdir(parents=True, exist_ok=True)
    with path.open("w") as out:
        out.write(HEADER.format(kind="volScalarField", location=path.parent.name, name=path.name))
        out.write(f"dimensions {dimensions};\ninternalField nonuniform List<scalar>\n{len(values)}\n(\n")
        np.savetxt(out, values, fmt="%.17g")
        out.write(")\n;\nboundaryField\n{\n}\n")


def write_start(folder, mould, temperature, solid):
    """The temperatures of each body on cubes of its own, as a time of OpenFOAM that the program reads."""
    cavity = mould.cavity
    for body, volume in cavity.volumes.items():
        of = np.flatnonzero(cavity.body == body)
        if not len(of):
            # A body that is smaller than a cube has the temperatures of all of them around it.
            of = np.arange(len(cavity.body))
        edge, cells = cavity.cubes.edge, cavity.cubes.cells[of]
        scale = (volume / (len(of) * edge ** 3)) ** (1 / 3)
        middle = cavity.cubes.centres()[of].mean(axis=0)
        cubes = Cubes(middle + scale * (cavity.cubes.origin - middle), scale * edge, cells)
        faces, directions = cubes.skin()
        target = folder / f"body_{body}"
        write_mesh(target, cubes, [("skin", "wall", faces, directions)])
        order = cavity.cubes.number(cubes.cells)
        foam_field(target / "start" / "T", temperature[order], "[0 0 0 1 0 0 0]")
        foam_field(target / "start" / "solid_fraction", solid[order], "[0 0 0 0 0 0 0]")


def write_mould_heat(folder, mould, lost):
    """The heat of faces, joined where there are many: places and times of contact are then means by the heat. All of it together is what
    the metal has lost [J]."""
    rows, centres = [], mould.cavity.face_centres()
    whole = sum(wall.heat.sum() for wall in mould.walls)
    factor = lost / whole if whole != 0 else 1.0
    for wall in mould.walls:
        if wall.insulating() or not len(wall.faces):
            continue
        took = np.flatnonzero(wall.heat != 0)
        if not len(took):
            continue
        block = np.ceil((max(len(took) / MOST_WALLS, 1)) ** 0.5)
        key = (mould.cavity.cubes.cells[wall.cells[took]] // block).astype(int)
        _, group = np.unique(np.hstack([key, mould.cavity.directions[wall.faces[took]]]), axis=0, return_inverse=True)
        group, weight = group.ravel(), np.abs(wall.heat[took])
        total = np.bincount(group, weight)
        place = [np.bincount(group, weight * centres[wall.faces[took]][:, d]) / total for d in range(3)]
        contact = np.bincount(group, weight * wall.contact[took]) / total
        heat = np.bincount(group, factor * wall.heat[took])
        rows += [[wall.body, *(f"{p[i]:.9g}" for p in place), f"{heat[i]:.17g}", f"{contact[i]:.9g}"] for i in range(len(heat))]
    write_csv(folder / "mould_heat.csv", ["body", "x[m]", "y[m]", "z[m]", "heat[J]", "contact[s]"], rows)


def grid_of(cubes):
    """The cubes as a grid of VTK."""
    corners = cubes.cells[:, None, :] + np.array(CORNERS)
    points, numbers = np.unique(corners.reshape(-1, 3), axis=0, return_inverse=True)
    n = len(cubes.cells)
    return Grid(cubes.origin + points * cubes.edge, np.full(n, 12), 8 * np.arange(1, n + 1), numbers.ravel())


def joins(mould, history):
    """Cubes at which two fronts met: both neighbours along an axis were filled earlier, and moved towards each other."""
    cubes, found = mould.cavity.cubes, np.zeros(len(mould.cavity.body), bool)
    time = np.where(np.isnan(history.fill_time), np.inf, history.fill_time)
    for axis in range(3):
        step = np.eye(3, dtype=int)[axis]
        low, high = cubes.number(cubes.cells - step), cubes.number(cubes.cells + step)
        both = (low >= 0) & (high >= 0)
        earlier = np.maximum(time[low], time[high]) < time
        u = np.nan_to_num(history.front_velocity[:, axis])
        found |= both & earlier & (u[low] > 0) & (u[high] < 0) & np.isfinite(time)
    return found


def air_closed_in(mould, history):
    """Volumes of air that hangs together and reaches no vent [m3], with their places."""
    cubes, air = mould.cavity.cubes, history.metal < 0.5
    label = np.where(air, np.arange(len(air)), len(air))
    neighbours = np.stack([cubes.number(cubes.cells + np.array(side)) for side in SIDES], axis=1)
    while True:
        others = np.where(neighbours >= 0, label[neighbours], len(air)).min(axis=1)
        new = np.where(air, np.minimum(label, others), len(air))
        if (new == label).all():
            break
        label = new
    vented = {int(label[cell]) for cell in mould.cavity.faces[np.append(mould.vents, mould.leak)]}
    found = []
    for name in np.unique(label[air]):
        if int(name) not in vented:
            of = label == name
            found.append((float((1 - history.metal[of]).sum() * cubes.edge ** 3), cubes.centres()[of].mean(axis=0)))
    return sorted(found, key=lambda one: -one[0])


def place_text(place):
    return "(" + ", ".join(f"{1e3 * x:.0f}" for x in place) + ") mm"


def balances(mould, melt, history):
    """Volume and heat that came through the gate against what is there; heat counted from the metal's freezing to solid."""
    edge3 = mould.cavity.cubes.edge ** 3
    came, there = history.flowed(history.time), float(history.metal.sum() * edge3)
    lost = float((history.heat_lost() * history.metal).sum() * edge3 * melt.density)
    return {"came": came, "there": there, "lost": lost, "walls": history.heat_of_walls(), "brought": history.heat_that_came(),
            "corrected": history.corrected, "returned": history.returned}


def places_of(mould, history):
    """What a foundry looks at, with its place: [{kind, text, at [m], cold}], kind: coldest, misrun, joint, cold_shut or air."""
    degrees, cubes, liquidus = 273.15, mould.cavity.cubes, mould.material["liquidus"]
    centres, found = cubes.centres(), []

    def add(kind, text, at):
        found.append({"kind": kind, "text": f"{text} at {place_text(at)}", "at": [float(x) for x in at]})

    arrival = np.where(np.isnan(history.fill_time), np.inf, history.arrival)
    coldest = int(arrival.argmin())
    cold = arrival[coldest] < liquidus
    add("misrun" if cold else "coldest", f"coldest arrival {arrival[coldest] - degrees:.0f} degC", centres[coldest])
    found[-1]["text"] += (f", below the liquidus of {liquidus - degrees:.0f} degC: misrun" if cold else
                          f", {arrival[coldest] - liquidus:.0f} K above the liquidus")
    met = np.flatnonzero(joins(mould, history))
    if len(met):
        worst = met[history.arrival[met].argmin()]
        cold = history.arrival[worst] < liquidus
        add("cold_shut" if cold else "joint", f"fronts met at {len(met)} cubes, the coldest with {history.arrival[worst] - degrees:.0f} degC", centres[worst])
        found[-1]["text"] += ", below the liquidus: cold shut" if cold else ""
    for volume, place in air_closed_in(mould, history)[:3]:
        if volume > 0.5 * cubes.edge ** 3:
            add("air", f"air closed in: {1e6 * volume:.3g} cm3", place)
    return found


def how_it_ended(mould, history, ended):
    """A sentence."""
    if ended == "crawls":
        return (f"{100 * history.full:.1f} % of the cavity are full after {history.time:.3g} s, where the flow was given up: the air that is left "
                "goes by the last vents, too fast for its steps; freezing starts from the temperatures there")
    if ended == "stands":
        return (f"NOT filled: the metal stands at {100 * history.full:.1f} % of the cavity since {history.time:.3g} s: the pressure lifts it no higher, "
                "or it has frozen on its way")
    if ended == "full" or history.full >= NEARLY:
        return (f"filled after {history.time:.3g} s: {100 * history.full:.1f} % of the cavity"
                + ("" if ended == "full" else ", the rest is air that found no way out"))
    return (f"NOT filled: {100 * history.full:.1f} % after {history.time:.3g} s, {history.time / mould.time:.2f} times the time of "
            "filling; air has no way out, or the cubes are too coarse")


def answers(mould, history, ended, balance, places):
    """Sentences for whoever pours."""
    lines = [how_it_ended(mould, history, ended)] + [place["text"] for place in places]
    lines.append(f"the metal enters at {mould.speed:.2f} m/s"
                 + (f", above {GOOD_SPEED} m/s: folded oxide films in aluminium (Campbell)" if mould.speed > GOOD_SPEED else ""))
    came, there = balance["came"], balance["there"]
    lines.append(f"through the gate {1e6 * came:.5g} cm3, in the mould {1e6 * there:.5g} cm3: {100 * (there / came - 1):+.2f} %; "
                 f"{100 * balance['corrected']:.2g} % of the cavity were set right at fronts, where the solver loses or gains metal")
    if balance["corrected"] > MUCH_CORRECTED:
        lines.append(f"that is more than the usual 0.1 to {100 * MUCH_CORRECTED:.0f} %: the last air was not at a vent, and metal was handed to the cubes "
                     "that held it; where and when the last tenth of the cavity fills is not sure. More cells, vents where the air is, or a slower "
                     "rate help")
    lines.append(f"heat that the metal has lost {balance['lost']:.5g} J, that walls have taken {balance['walls']:.5g} J: a difference of "
                 f"{100 * (balance['lost'] - balance['walls']) / balance['brought']:+.2f} % of the heat that came above solid metal")
    if balance["returned"] > MUCH_HEAT * balance["brought"]:
        lines.append(f"{100 * balance['returned'] / balance['brought']:.2g} % of it was given back to metal that freezes on its way, where the solver "
                     "loses heat: temperatures there are rough; more cells, hotter metal or a faster filling help")
    if abs(balance["lost"] - balance["walls"]) > MUCH_HEAT * balance["brought"]:
        lines.append(f"that is more than {100 * MUCH_HEAT:.0f} %: where metal freezes at the front the solver loses or gains heat, and the "
                     "temperatures there are wrong; more cells, hotter metal or a faster filling help")
    mush, far = history.mush
    if mush > 0:
        lines.append(f"freezing metal was within {NEAR:.0f} K of the temperature at which it is half solid in {100 * (1 - far / mush):.0f} % of its cubes and "
                     "moments" + ("; the others are at fronts, where temperatures are rough" if far > MANY * mush else ""))
    return lines


def write(folder, mould, melt, history, ended, seconds):
    """Writes everything; the answers as text."""
    h, temperature, solid = start_of(mould, history)
    write_start(folder, mould, temperature, solid)
    balance = balances(mould, melt, history)
    write_mould_heat(folder, mould, balance["lost"])
    grid = grid_of(mould.cavity.cubes)
    last_air = 1 - history.metal
    grid.cell_data = {"fill_time": np.nan_to_num(history.fill_time, nan=history.time),
                      "temperature_at_arrival": np.where(np.isnan(history.arrival), temperature, history.arrival),
                      "speed_of_front": np.nan_to_num(np.linalg.norm(history.front_velocity, axis=1)),
                      "age": history.age, "last_air": last_air, "temperature": temperature, "body": mould.cavity.body.astype("i4")}
    grid.units = {"fill_time": "s", "temperature_at_arrival": "K", "speed_of_front": "m/s", "age": "s", "last_air": "1", "temperature": "K"}
    grid.time = history.time
    write_grid(folder / "filling.vtu", grid)
    write_csv(folder / "filling.csv", ["t[s]", "full[%]", "through the gate[m3]", "heat of the walls[J]", "coldest metal[K]"], history.rows)
    places = places_of(mould, history)
    lines = answers(mould, history, ended, balance, places)
    summary = {"made_of": history.made_of, "ended": ended, "driven": mould.drive.kind(), "time": history.time, "full": history.full, "gate_speed": mould.speed,
               "cells": len(mould.cavity.body), "edge": mould.cavity.cubes.edge, "seconds": round(seconds, 2), "balance": balance,
               "mush": history.mush, "places": places, "answers": lines}
    (folder / "filling.json").write_text(json.dumps(summary, indent=2) + "\n")
    nothing = np.where(history.metal > 0.5, 0.0, np.nan)
    filling_view.write(folder, mould, melt, history, {
        "fill_time": (history.fill_time, "s"), "temperature_at_arrival": (history.arrival, "K"), "age": (history.age + nothing, "s"),
        "speed_of_front": (np.linalg.norm(history.front_velocity, axis=1), "m/s")}, places, lines)
    filling_picture.draw(folder / "filling.png", mould, grid)
    filling_film.draw(folder / "filling.gif", mould, [row[0] for row in history.rows], history.levels)
    return "\n".join(lines) + f"\nFilling in {folder}, in {seconds:.0f} s."
