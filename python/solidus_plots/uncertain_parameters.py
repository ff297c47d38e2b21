"""What of a case is uncertain: parameters with their spreads, as `solidus uncertain CASE --parameters` lists them.

A parameter is moved by its share u of the half width that holds 95 % of its values: u = z/2, z of the standard normal
distribution, so that u = 1 is two standard deviations up. docs/theory/uncertainty.md has the equations.
"""

from dataclasses import dataclass, field
import math
import re


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
        """What stands behind --set, at the share u of the half width: KEY=VALUE."""
        if self.members:
            return [change for member in self.members for change in member.changes(u)]
        return [f"{key}={self._moved(value, u)}" for key, value in self.places]

    def _moved(self, value, u):
        if self.kind == "shift":
            return f"{value + u * self.amount:.9g} K"
        factor = self.amount ** u if self.kind == "factor" else 1.0 + u * self.amount
        return f"{value * factor:.9g}"

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
    if len(members) == 1:
        return members[0]
    origins = ("usual", "estimate", "stated")
    return Parameter(label, members[0].group, all(member.mechanical for member in members), "together",
                     min((member.origin for member in members), key=origins.index), members=members)


def _materials(parameters, mechanical):
    """Labels of moulds: material -> its parameters, those of mechanics or the others."""
    found = {}
    for parameter in parameters:
        if parameter.group == "mould" and parameter.mechanical == mechanical:
            found.setdefault(parameter.label.split(" of ", 1)[1], []).append(parameter)
    return found


def _replaced(parameters, bunches):
    """The list with each bunch (label, members) in the place of its first member."""
    bunch_of = {id(member): (label, members) for label, members in bunches for member in members}
    result, done = [], set()
    for parameter in parameters:
        label, members = bunch_of.get(id(parameter), ("", None))
        if members is None:
            result.append(parameter)
        elif label not in done:
            done.add(label)
            result.append(together(label, members))
    return result


def _group(parameters, group, label):
    members = [parameter for parameter in parameters if parameter.group == group and not parameter.mechanical]
    return [(label, members)] if len(members) > 1 else []


# From what blurs the result least: each step moves more of what surrounds the casting together.
STEPS = (
    lambda all_of: [(f"stiffness and expansion of {name}", members) for name, members in _materials(all_of, True).items()],
    lambda all_of: _group(all_of, "surroundings", "what surrounds the case, together"),
    lambda all_of: [(f"conductivity and heat capacity of {name}", members)
                    for name, members in _materials(all_of, False).items()],
    lambda all_of: _group(all_of, "interface", "heat transfer of all interfaces together"),
    lambda all_of: _group(all_of, "mould", "conductivity and heat capacity of all moulds together"),
    lambda all_of: [("stiffness and expansion of all moulds together",
                     [one for one in all_of if one.group == "mould" and one.mechanical])],
)


def merged(parameters, most):
    """At most so many parameters, as far as moving things together goes: those left, and those left out."""
    for step in STEPS:
        if len(parameters) <= most:
            break
        parameters = _replaced(parameters, step(parameters))
    return parameters[:most], parameters[most:]


def root_of_squares(values):
    return math.sqrt(sum(value * value for value in values))
