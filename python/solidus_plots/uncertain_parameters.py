"""What of a case is uncertain: parameters with their spreads, as `solidus uncertain CASE --parameters` lists them.

A parameter is moved by its share u of the half width that holds 95 % of its values: u = z/2, z of the standard normal
distribution, so that u = 1 is two standard deviations up. docs/theory/uncertainty.md has the equations.
"""

from dataclasses import dataclass, field
import math
import re


MOST = 50.0  # a factor beyond it, or below its reciprocal, is cut: the tail of a distribution that no data have


@dataclass
class Parameter:
    """One thing that may be off: a factor or a shift at one or several places of the case."""

    label: str  # "conductivity of green_sand"
    group: str  # casting, mould, interface, start, surroundings
    mechanical: bool
    spread: str  # in words, "10 %"
    origin: str  # stated, estimate, usual
    source: str = ""
    kind: str = "relative"  # relative, factor, shift
    amount: float = 0.0
    places: list = field(default_factory=list)  # (key, value that the case itself has)
    members: list = field(default_factory=list)  # of parameters that are moved together

    def changes(self, u):
        """What follows --set, at the share u of the half width: KEY=VALUE."""
        if self.members:
            return [change for member in self.members for change in member.changes(u)]
        return [f"{key}={self._moved(value, u)}" for key, value in self.places]

    def _moved(self, value, u):
        if self.kind == "shift":
            return f"{value + u * self.amount:.9g} K"
        factor = self.amount ** u if self.kind == "factor" else 1.0 + u * self.amount
        return f"{value * min(max(factor, 1 / MOST), MOST):.9g}"

    def slug(self):
        """For the name of a folder."""
        return re.sub(r"[^A-Za-z0-9]+", "_", self.label).strip("_")[:60]


def parameter_of(entry):
    kind = next(kind for kind in ("relative", "factor", "shift[K]") if kind in entry)
    return Parameter(entry["label"], entry["group"], entry["mechanical"], entry["spread"], entry["origin"],
                     entry["source"], kind.removesuffix("[K]"), entry[kind],
                     [(place["key"], place["value"]) for place in entry["places"]])


def together(label, members):
    """Parameters that are moved at once, all up or all down."""
    flat = [one for member in members for one in (member.members or [member])]
    origins = ("usual", "estimate", "stated")
    return Parameter(label, members[0].group, all(member.mechanical for member in members), "together",
                     min((member.origin for member in flat), key=origins.index), members=flat)


def _of(parameter):
    """The material, card or name that a parameter belongs to."""
    return parameter.label.rsplit(" of ", 1)[-1]


def _by_owner(parameters, label, chosen):
    """Bunches (label, members) of the chosen parameters, one for each material or card."""
    found = {}
    for parameter in parameters:
        if chosen(parameter):
            found.setdefault(_of(parameter), []).append(parameter)
    return [(f"{label} of {owner}", members) for owner, members in found.items()]


def _all(label, chosen):
    return lambda parameters: [(label, [parameter for parameter in parameters if chosen(parameter)])]


def _heat(group):
    return lambda parameter: parameter.group == group and not parameter.mechanical


def _mechanics_of_moulds(parameter):
    return parameter.group == "mould" and parameter.mechanical


def _stiffness(parameter):
    return parameter.label.startswith(("Young's modulus", "Poisson's ratio"))


# From what blurs the result least: each step makes bunches (label, members) of what surrounds the casting.
STEPS = (
    lambda parameters: _by_owner(parameters, "stiffness", _stiffness),
    lambda parameters: _by_owner(parameters, "stiffness and expansion", _mechanics_of_moulds),
    _all("what surrounds the case, together", _heat("surroundings")),
    lambda parameters: _by_owner(parameters, "heat transfer", _heat("interface")),
    lambda parameters: _by_owner(parameters, "conductivity and heat capacity", _heat("mould")),
    _all("temperatures at the start, together", _heat("start")),
    _all("heat transfer of all interfaces together", _heat("interface")),
    _all("conductivity and heat capacity of all moulds together", _heat("mould")),
    _all("stiffness and expansion of all moulds together", _mechanics_of_moulds),
)


def _width(parameter):
    """How far a parameter is off, as a share; of temperatures against a hundred kelvin."""
    if parameter.members:
        return root_of_squares(_width(member) for member in parameter.members)
    return {"factor": parameter.amount - 1.0, "shift": 0.01 * parameter.amount}.get(parameter.kind, parameter.amount)


def _dispensable(parameter):
    """Order in which parameters are kept: those of heat, of the criteria, of mechanics."""
    return 2 if parameter.mechanical else 1 if parameter.label.startswith(("arm spacing", "viscosity of the melt")) else 0


def merged(parameters, most):
    """At most so many parameters, as far as moving things together goes: those left, and those left out.

    Bunches are made one after the other, in each step that of the least known data last.
    """
    for step in STEPS:
        for label, members in sorted(step(parameters), key=lambda bunch: root_of_squares(map(_width, bunch[1]))):
            if len(parameters) > most and len(members) > 1:
                place = parameters.index(members[0])
                parameters = [parameter for parameter in parameters if parameter not in members]
                parameters.insert(place, together(label, members))
    kept = sorted(parameters, key=_dispensable)[:most]
    return [one for one in parameters if one in kept], [one for one in parameters if one not in kept]


def root_of_squares(values):
    return math.sqrt(sum(value * value for value in values))
