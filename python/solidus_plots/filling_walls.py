"""Heat from the metal into the walls of a cavity while it fills.

A wall of the effusivity e = sqrt(k rho c) behind a conductance h takes from metal of a temperature T, t after it has touched it,

    q = h erfcx(h sqrt(t)/e) (T - T0),   erfcx(x) = exp(x^2) erfc(x)

(H. S. Carslaw, J. C. Jaeger, Conduction of Heat in Solids, 2nd ed. 1959, section 2.7): the flow gets the mean of h erfcx over the time
that it computes at a stretch, which is how the mould warms up.
"""

from math import erf, exp, sqrt, pi

import numpy as np

from solidus_plots.filling_mesh import SIDES

DRY = 1e-6  # part of a dry face that gives off heat: the solver divides by the conductance
PERFECT = 2e4  # conductance of bodies that share their faces [W/(m2 K)]


def erfcx(x):
    """exp(x^2) erfc(x): by the functions themselves where they do not overflow, else by the continued fraction of erfc."""
    if x < 5:
        return exp(x * x) * (1 - erf(x))
    tail = x
    for k in range(30, 0, -1):
        tail = x + 0.5 * k / tail
    return 1 / (tail * sqrt(pi))


_X = np.concatenate([[0], np.geomspace(1e-4, 1e4, 1601)])
_TAKEN = np.array([erfcx(x) - 1 + 2 * x / sqrt(pi) for x in _X])


def taken(x):
    """The integral of erfcx(sqrt(s)) from 0 to x^2: erfcx(x) - 1 + 2 x/sqrt(pi)."""
    small = x < 1e-3
    return np.where(small, x ** 2 * (1 - 4 / (3 * sqrt(pi)) * x), np.interp(x, _X, _TAKEN))


def mean_conductance(conductance, effusivity, begin, end):
    """The mean of h erfcx(h sqrt(t)/e) between two times since the metal came [W/(m2 K)]. Arrays or numbers."""
    begin, end = np.maximum(begin, 0.0), np.asarray(end, float)
    scale = effusivity ** 2 / conductance
    x0, x1 = conductance * np.sqrt(begin) / effusivity, conductance * np.sqrt(end) / effusivity
    short = (x1 - x0) * x1 < 1e-6
    step = np.where(end > begin, end - begin, 1.0)
    mean = scale * (taken(x1) - taken(x0)) / step
    return np.where(short, conductance * np.interp(x0, _X, [erfcx(x) for x in _X]), mean)


class Wall:
    """The faces of one body around the cavity, and what they have taken."""

    def __init__(self, name, body, faces, conductance, effusivity, mould, cavity):
        """body: its number, -1 for faces that touch nothing; mould: its temperature [K]."""
        self.name, self.body, self.faces, self.mould = name, body, faces, mould
        self.conductance, self.effusivity = conductance, effusivity
        self.cells = cavity.faces[faces]
        # The faces of cubes stand for another area than they have.
        self.share = cavity.area[faces] / cavity.cubes.edge ** 2
        self.area = cavity.cubes.edge ** 2
        self.contact = np.zeros(len(faces))  # since metal touched them [s]
        self.heat = np.zeros(len(faces))  # [J]
        self.shut = np.zeros(len(faces), bool)  # vents through which no gas passes, and which metal touches
        self.present = np.zeros(len(faces))  # conductance of the present stretch [W/(m2 K)] of the faces of cubes

    def passes_gas(self):
        return self.name.startswith("vent")

    def kind(self):
        """Of the patch, in OpenFOAM's words: what passes metal or gas is no wall."""
        return "patch" if self.passes_gas() else "wall"

    def insulating(self):
        return self.conductance == 0

    def begin(self, duration, wet):
        """Sets the conductance of a stretch of time. wet: the part of it and of its face that metal touches, in each cube."""
        if not self.insulating():
            mean = mean_conductance(self.conductance, self.effusivity, self.contact, self.contact + duration)
            self.present = np.maximum(wet[self.cells], DRY) * self.share * mean
        return self.present

    def end(self, moments, metal, melt, gas):
        """Adds the heat of a stretch, by the trapezoidal rule between moments of it. moments: [(time, temperatures, conductivities)] in all
        cubes, from which half a cube of metal or gas leads to the face; metal: shares in all cubes at the end; melt, gas: conductivities
        of what is on the faces of vents."""
        depth, flux = 0.5 * self.area ** 0.5, []
        for _, temperature, conductivity in moments:
            led = (np.where(self.shut, melt, gas) if self.passes_gas() else conductivity[self.cells]) / depth
            flux.append(self.present * led / (self.present + led) * (temperature[self.cells] - self.mould))
        for (start, *_), (end, *_), before, after in zip(moments, moments[1:], flux, flux[1:]):
            self.heat += 0.5 * (before + after) * self.area * (end - start)
        duration = moments[-1][0] - moments[0][0]
        self.contact = np.where(metal[self.cells] >= 0.5, self.contact + duration, self.contact)


def wetted(cubes, metal):
    """The part of a stretch of time, and of its faces, for which metal touches a cube, from the shares at its start: the mean of the share
    there and of the largest next to it, from where the front comes."""
    beside = np.stack([cubes.number(cubes.cells + np.array(side)) for side in SIDES], axis=1)
    return 0.5 * (metal + np.where(beside >= 0, metal[beside], 0).max(axis=1))


def walls_for(cavity, faces_of, cavity_file, kind="wall"):
    """The walls of a cavity. faces_of: {body: faces}; cavity_file: what the program wrote of the case; kind: "wall", or "vent" of faces
    that let gas pass and take heat as others do."""
    bodies, conductances = cavity_file["bodies"], {}
    for entry in cavity_file["interfaces"]:
        for a, b in (entry["bodies"], entry["bodies"][::-1]):
            conductances[a, b] = entry["heat_transfer"]
    walls = []
    for body, faces in faces_of.items():
        if body < 0:
            walls.append(Wall("free" if kind == "wall" else f"{kind}_free", body, faces, 0.0, 1.0, 293.15, cavity))
            continue
        # The law between this body and the one that is cast and has most of the faces.
        cast, counts = np.unique(cavity.body[cavity.faces[faces]], return_counts=True)
        conductance = conductances.get((int(cast[counts.argmax()]), body), PERFECT)
        start, material = 0.5 * (bodies[body]["coldest"] + bodies[body]["hottest"]), bodies[body]["material"]
        temperature, enthalpy = np.array(material["temperatures"]), np.array(material["enthalpy"])
        capacity = (np.interp(start + 1, temperature, enthalpy) - np.interp(start - 1, temperature, enthalpy)) / 2
        effusivity = (np.interp(start, temperature, material["conductivity"]) * capacity) ** 0.5
        walls.append(Wall(f"{kind}_{body}", body, faces, conductance, effusivity, start, cavity))
    return walls
