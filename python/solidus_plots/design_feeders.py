"""Risers and chills of a part as `solidus design` moves them, and the file of them that `solidus new --riser` reads."""

from dataclasses import dataclass, field, replace
import math
import tomllib

from solidus_plots.vtu import ResultError

SLENDER = 1.5  # height of a riser above the part, of its diameter
SLEEVE = 0.2  # thickness of a sleeve, of the diameter: what makers of insulating sleeves sell
LEAST_SLEEVE = 6.0  # [mm]
NECK_HEIGHT = 0.1  # of a narrower neck above the part, of the diameter
LONGER = 1.5  # a riser that would have to be so many times as high to end where the highest does is closed
SIDE_NECK = 0.7  # width of the neck of a riser next to the part, of the diameter
SIDE_GAP = 0.15  # sand between such a riser and the part, of the diameter: a short neck stays warm
BELOW_NECK = 0.1  # its metal below the neck, of the diameter


@dataclass(frozen=True)
class Riser:
    """Lengths in mm. It stands upright on the part, or next to it with a level neck."""

    name: str
    foot: tuple  # x, y, z of the centre of its foot; of a riser next to the part the place in it that its neck leads to
    sunk: float  # so far the foot lies below the skin of the part
    diameter: float
    slender: float = SLENDER
    neck: float = 1.0  # width of its neck, of the diameter
    sleeve: bool = False
    beside: tuple = ()  # x and y of the level direction from that place to the riser, and the way there to the skin

    def stands_at(self):
        """x, y, z of the centre of its foot, wherever it stands."""
        if not self.beside:
            return self.foot
        along = self.beside[2] + (SIDE_GAP + 0.5) * self.diameter
        return (self.foot[0] + along * self.beside[0], self.foot[1] + along * self.beside[1],
                self.foot[2] - (0.5 * self.neck + BELOW_NECK) * self.diameter)

    def metal(self, height):
        """Volume outside of the part [mm3] with a height above its foot."""
        disc = 0.25 * math.pi * self.diameter ** 2
        if self.beside:
            return disc * (height + self.neck ** 2 * SIDE_GAP * self.diameter)
        return disc * (height - self.sunk - self.neck_height() * (1 - self.neck ** 2))

    def neck_height(self):
        """Of a narrower neck above the part."""
        return NECK_HEIGHT * self.diameter if self.neck < 1 and not self.beside else 0.0

    def height(self):
        """Above its foot, where it ends at its own height."""
        return self.sunk + self.slender * self.diameter

    def scaled(self, factor):
        return replace(self, diameter=self.diameter * factor)

    def sleeve_thickness(self):
        return max(LEAST_SLEEVE, round(SLEEVE * self.diameter, 1)) if self.sleeve else 0.0


@dataclass(frozen=True)
class Chill:
    """A block against the part, between two corners [mm]."""

    name: str
    lowest: tuple
    highest: tuple

    def volume(self):
        return math.prod(high - low for low, high in zip(self.lowest, self.highest))


@dataclass(frozen=True)
class Design:
    """What is put onto the part."""

    risers: tuple = ()
    chills: tuple = field(default=())

    def heights(self):
        """Of each riser above its foot [mm]: all end where the highest does but for those that are far below, which
        are closed."""
        feet = [riser.stands_at()[2] for riser in self.risers]
        top = round(max((foot + riser.height() for foot, riser in zip(feet, self.risers)), default=0.0), 3)
        return [top - foot if top - foot < LONGER * riser.height() else riser.height()
                for foot, riser in zip(feet, self.risers)]

    def metal(self):
        """Of the risers [mm3]."""
        return sum(riser.metal(height) for riser, height in zip(self.risers, self.heights()))

    def scaled(self, factor):
        return replace(self, risers=tuple(riser.scaled(factor) for riser in self.risers))

    def shaped(self, ratio, less):
        """With so much slimmer risers of so much less metal: with the same height over diameter, metal goes with the third
        power of the diameter."""
        factor = (less / ratio) ** (1 / 3)
        return replace(self, risers=tuple(replace(riser.scaled(factor), slender=round(riser.slender * ratio, 3))
                                          for riser in self.risers))

    def with_riser(self, number, riser):
        return replace(self, risers=(*self.risers[:number], riser, *self.risers[number + 1:]))

    def without(self, number):
        return replace(self, risers=(*self.risers[:number], *self.risers[number + 1:]))

    def text(self):
        """As one reads it in a table."""
        risers = [f"{riser.name} {riser.diameter:.1f} x {height - riser.sunk:.1f} mm"
                  + (" next to the part" if riser.beside else "")
                  + (f" in {riser.sleeve_thickness():.0f} mm of sleeve" if riser.sleeve else "")
                  + (f", neck {riser.neck * riser.diameter:.1f} mm" if riser.neck < 1 else "")
                  for riser, height in zip(self.risers, self.heights())]
        return "; ".join([*risers, *(chill.name for chill in self.chills)]) or "no riser"

    def kinds(self):
        """What two designs that differ in sizes alone have in common."""
        return tuple((riser.name, riser.foot, riser.beside, riser.sleeve, riser.neck < 1) for riser in self.risers), self.chills

    def settings(self):
        """The sizes of the risers as `--set` takes them."""
        return [f"mesh.riser.{riser.name}.{key}={value}" for riser, sizes in zip(self.risers, self._sizes())
                for key, value in sizes.items()]

    def _sizes(self):
        """Of each riser the keys of its sizes with their values."""
        for riser, height in zip(self.risers, self.heights()):
            sizes = {"diameter": _mm(riser.diameter), "height": _mm(height)}
            if riser.beside:
                # Its place moves with its diameter, as the sand between it and the part does.
                sizes["foot"] = _place(riser.stands_at())
            else:
                sizes["neck_height"] = _mm(riser.sunk + riser.neck_height())
            if riser.neck < 1:
                sizes["neck_diameter"] = _mm(riser.neck * riser.diameter)
            if riser.sleeve:
                sizes["sleeve"] = _mm(riser.sleeve_thickness())
            yield sizes

    def toml(self):
        """The file for `solidus new --riser`."""
        lines = []
        for riser, sizes in zip(self.risers, self._sizes()):
            where = [f"neck_to = {_place(riser.foot)}"] if riser.beside else [f"foot = {_place(riser.foot)}"]
            lines += ["[[riser]]", f'name = "{riser.name}"', *where, *(f"{key} = {value}" for key, value in sizes.items()), ""]
        for chill in self.chills:
            lines += ["[[chill]]", f'name = "{chill.name}"', f"lowest = {_place(chill.lowest)}",
                      f"highest = {_place(chill.highest)}", ""]
        return "\n".join(lines)


def _mm(length):
    return f'"{round(length, 3):.9g} mm"'  # to the micrometre: tops that differ by less would make slivers


def _place(point):
    return f"[{', '.join(_mm(x) for x in point)}]"


def _number(text):
    number, _, unit = text.partition(" ")
    if unit != "mm":
        raise ResultError(f"a length of a case that `solidus new` wrote is in '{unit}'")
    return float(number)


def chosen_risers(case):
    """The risers that `solidus new --riser auto` has put into a case."""
    with open(case, "rb") as file:
        entries = tomllib.load(file)["mesh"].get("riser", [])
    return tuple(Riser(entry["name"], tuple(round(_number(x), 3) for x in entry["foot"]), _number(entry["neck_height"]),
                       _number(entry["diameter"])) for entry in entries)
