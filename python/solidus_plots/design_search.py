"""The search for the least metal of risers with which a part is sound. It knows runs by their judgements alone.

Soundness is yes or no and jumps: there is no slope to follow, and a run costs the same however far it is from the
border. So sizes are found by section: as many runs at a time as there are cores divide the range between the largest
that is not sound and the smallest that is. What a run says of the places of its defects decides where a riser or a chill
is added. docs/decisions/0079-risers-by-search.md says why no library does it.
"""

from dataclasses import dataclass, replace
import math

import numpy as np

from solidus_plots.design_feeders import SIDE_NECK, Chill, Design, Riser

CLOSE = 1.035  # sizes that differ by less are one
LEAST, MOST = 0.3, 2.3  # of the sizes that `solidus new` chooses
NARROW = 0.7  # width of a neck that is tried, of the diameter
CHILL = 0.6  # thickness of a chill over the diameter of the place that it cools
SLIMMER = 1.25  # times as high over their diameter are risers of the next shape
STOUTEST, SLIMMEST = 0.8, 2.6  # heights over diameters that are tried
LESS = (0.8, 0.9, 0.955)  # of the metal, with which other shapes are tried
STAYS = 0.85  # holes that are still so large after risers grew by a third do not go away with their size


@dataclass
class Trial:
    what: str
    design: Design
    judgement: object = None  # nothing: not run, or failed
    failure: str = ""

    def sound(self):
        return self.judgement is not None and self.judgement.sound


class Stopped(Exception):
    """Ctrl-C, or no runs are left."""


class Search:
    def __init__(self, evaluate, surface, jobs, most, beside=lambda place, taken: None):
        """evaluate: fills the judgements of trials, which may run at a time; surface: of a place [mm] the heights of the
        part below and above it [mm] and the radius of the largest ball there; most: runs in all; beside: where a riser may
        stand next to the part (Surface.beside)."""
        self._evaluate, self._surface, self._jobs, self._left = evaluate, surface, jobs, most
        self._beside = beside
        self.trials = []

    def tried(self, wanted):
        """The trials of [(what, design)], those that ran before not again. Those beyond the number of runs are left
        out; without any left Stopped is thrown."""
        known = {trial.design: trial for trial in self.trials}
        new = [Trial(what, design) for what, design in dict((d, (w, d)) for w, d in wanted).values() if design not in known]
        if new and self._left == 0:
            raise Stopped
        new = new[:self._left]
        self._left -= len(new)
        self.trials += new
        if new:
            self._evaluate(new)
        known.update({trial.design: trial for trial in new})
        return [known[design] for _, design in wanted if design in known]

    def best(self):
        """The sound trial with the least metal; nothing where none is sound."""
        return min((trial for trial in self.trials if trial.sound()), key=lambda trial: trial.design.metal(), default=None)

    def run(self, risers, sleeves):
        """The best trial; nothing where none was sound.

        risers: those that `solidus new` chooses for the part; sleeves: whether risers may have them."""
        if self.tried([("no riser", Design())])[0].sound():
            return self.trials[0]
        try:
            start = Design(tuple(replace(riser, sleeve=sleeves) for riser in risers))
            for _ in range(4):
                largest = self._common_size(start)
                if self.best():
                    break
                changed = self._fed_elsewhere(start, largest)
                if changed is None:
                    # Nothing besides the risers helps: what is left is their size.
                    self._common_size(start, to_the_end=True)
                    break
                start = changed
            if not self.best():
                return None
            self._fewer()
            self._each_smaller()
            self._shapes()
            self._narrow_necks()
        except Stopped:
            pass
        return self.best()

    def _common_size(self, design, to_the_end=False):
        """Finds the smallest sound size by one factor for all risers; the trial with the largest factor.

        to_the_end: grows also where holes stay as they are"""
        first = first_factors(design)
        tried = {}

        def run(factors):
            wanted = {factor: design.scaled(factor) for factor in factors}
            done = {trial.design: trial
                    for trial in self.tried([(f"all risers x {factor:.3g}", one) for factor, one in wanted.items()])}
            tried.update({factor: done[one] for factor, one in wanted.items() if one in done})

        def smallest_sound():
            return min((factor for factor, trial in tried.items() if trial.sound()), default=None)

        run(first)
        while smallest_sound() is None and max(tried) < MOST:
            largest = tried[max(tried)]
            # A hole that lies away from every riser does not go away with their size.
            if largest.judgement and largest.judgement.defects and len(tried) >= 2 and not to_the_end and (
                    self._far_from_all(largest) or self._stays(tried)):
                return largest
            run([min(MOST, max(tried) * 1.3), min(MOST, max(tried) * 1.7)][:max(1, min(2, self._jobs))])
        while smallest_sound() is not None and smallest_sound() == min(tried) and min(tried) > LEAST:
            run([max(LEAST, min(tried) * 0.75)])
        while smallest_sound() is not None:
            high = smallest_sound()
            low = max((factor for factor, trial in tried.items() if factor < high), default=high)
            if low == high or high / low < CLOSE:
                break
            number = max(1, min(3, self._jobs))
            run([low * (high / low) ** ((i + 1) / (number + 1)) for i in range(number)])
        return tried[max(tried)]

    @staticmethod
    def _stays(tried):
        """Whether the two largest of {factor: trial} leave holes alike."""
        smaller, larger = (tried[factor].judgement for factor in sorted(tried)[-2:])
        return smaller is not None and larger.holes > STAYS * smaller.holes

    def _far_from_all(self, trial):
        place = 1e3 * trial.judgement.defects[0].place
        return all(math.hypot(place[0] - riser.foot[0], place[1] - riser.foot[1]) > 0.8 * riser.diameter
                   for riser in trial.design.risers)

    def _fed_elsewhere(self, start, trial):
        """The design with one more riser where the largest defect is, or a chill below it where a riser stands; nothing
        where the run says of no defect."""
        if trial.judgement is None or not trial.judgement.defects:
            return None
        place = 1e3 * np.asarray(trial.judgement.defects[0].place)
        low, high, radius = self._surface(place)
        if self._far_from_all(trial) or not start.risers:
            # As wide as a bar of the place's thickness asks for: 1.2 times its modulus, half of the radius.
            diameter = max(1.2 * 0.5 * radius / 0.214, 2.0)
            sunk = 0.05 * diameter
            sleeve = start.risers[0].sleeve if start.risers else False
            foot = tuple(round(float(x), 3) for x in (place[0], place[1], high - sunk))
            added = Riser(f"riser_{len(start.risers) + 1}", foot, sunk, diameter, sleeve=sleeve)
            named = tuple(replace(riser, name=f"riser_{i + 1}") for i, riser in enumerate(start.risers))
            return replace(start, risers=(*named, added))
        return self._helped(start, trial, place, low, radius)

    def _helped(self, start, trial, place, low, radius):
        """The design with a chill below a place over which a riser stands, or with a riser next to it: of those that can be,
        the one with which a run leaves less; nothing where none can."""
        added = []
        if not any(chill.lowest[0] < place[0] < chill.highest[0] and chill.lowest[1] < place[1] < chill.highest[1]
                   for chill in start.chills):
            chill = chill_below(place, low, radius, len(start.chills) + 1)
            added.append(("a chill below", lambda design: replace(design, chills=(*design.chills, chill))))
        taken = [(*riser.stands_at()[:2], 0.5 * riser.diameter + riser.sleeve_thickness(), riser.stands_at()[2])
                 for riser in trial.design.risers]
        found = self._beside(place, taken)
        if found and not any(riser.beside and math.dist(riser.foot, found[0]) < riser.diameter for riser in start.risers):
            foot = tuple(round(float(x), 3) for x in found[0])

            def with_riser(design):
                # In the design whose sizes are found by one factor it is so large that the second factor tried gives it this
                # size.
                factor = first_factors(design)[1] if design is start else 1.0
                named = tuple(replace(riser, name=f"riser_{i + 1}") for i, riser in enumerate(design.risers))
                beside = Riser(f"riser_{len(named) + 1}", foot, 0.0, round(found[1] / factor, 1), neck=SIDE_NECK,
                               beside=found[2])
                return replace(design, risers=(*named, beside))
            added.append(("a riser beside", with_riser))
        # The risers that are there already are as large as they were, which feeds what can be fed from above.
        if not added:
            return None
        trials = self.tried([(f"{what} the hole", add(trial.design)) for what, add in added])
        judged = [(not one.sound(), one.judgement.holes, i) for i, one in enumerate(trials)
                  if one.sound() or one.judgement and one.judgement.holes < STAYS * trial.judgement.holes]
        return added[min(judged)[2]][1](start) if judged else None

    def _fewer(self):
        """Leaves out risers one by one; where none can be left out, cools the place by a chill that is missed least."""
        design = self.best().design
        if len(design.risers) < 2:
            return
        # The smallest risers feed least: what they feed is most likely fed without them.
        order = sorted(range(len(design.risers)), key=lambda i: design.risers[i].diameter)[:max(2, self._jobs)]
        trials = self.tried([(f"without {design.risers[i].name}", design.without(i)) for i in order])
        if not trials or any(trial.sound() for trial in trials):
            return
        least = order[min(range(len(trials)), key=lambda k: defects_of(trials[k]))]
        riser, fewer = design.risers[least], design.without(least)
        low, _, radius = self._surface(np.array([riser.foot[0], riser.foot[1], riser.foot[2] + riser.sunk]))
        chill = chill_below(np.array(riser.foot), low, radius, len(design.chills) + 1)
        self.tried([(f"a chill for {riser.name}", replace(fewer, chills=(*fewer.chills, chill)))])

    def _each_smaller(self):
        """Makes risers smaller one by one, then all together that could be."""
        for factor in (0.85, 0.93):
            design = self.best().design
            if len(design.risers) < 2:
                return
            smaller = [design.with_riser(i, riser.scaled(factor)) for i, riser in enumerate(design.risers)]
            trials = self.tried([(f"{riser.name} x {factor:g}", one) for riser, one in zip(design.risers, smaller)])
            could = [i for i, trial in enumerate(trials) if trial.sound()]
            if len(could) > 1:
                together = design
                for i in could:
                    together = together.with_riser(i, design.risers[i].scaled(factor))
                self.tried([(f"{len(could)} risers x {factor:g}", together)])

    def _shapes(self):
        """Slimmer and stouter risers with less metal, for as long as one of them is sound: a slim one stands deeper over its
        pipe, a stout one keeps its heat longer, and which counts depends on the part. The first two trials say which of both
        is nearer to sound; from then on shapes go in that direction alone, by one and by two steps where none was sound."""
        left, ratios, towards = list(LESS), (SLIMMER, 1 / SLIMMER), None
        while left:
            design = self.best().design
            if not design.risers:  # a chill alone was enough
                return
            shapes = {design.shaped(ratio, left[0]): ratio for ratio in ratios}
            wanted = [(f"{one.risers[0].slender:.3g} diameters high, metal x {left[0]:g}", one) for one in shapes
                      if all(STOUTEST <= riser.slender <= SLIMMEST for riser in one.risers)]
            trials = self.tried(wanted)
            if towards is None and trials:
                towards = shapes[min(trials, key=defects_of).design]
            if self.best().design != design:
                ratios = (1.0, towards)
                continue
            del left[0]
            if towards is not None and 1.0 not in ratios:
                ratios = (towards, towards ** 2)

    def _narrow_necks(self):
        """Narrow necks save metal and work, and are kept where the part stays sound."""
        design = self.best().design
        narrow = tuple(riser if riser.beside else replace(riser, neck=NARROW) for riser in design.risers)
        self.tried([("narrow necks", replace(design, risers=narrow))])


def defects_of(trial):
    """By what of two trials one is nearer to sound: holes first, then what is left of the risers."""
    judged = trial.judgement
    return (math.inf, 0.0) if judged is None else (0.0 if judged.sound else judged.holes, -judged.left)


def first_factors(design):
    """Sizes that are tried first, of those that `solidus new` chooses: in a sleeve a riser lasts longer."""
    return (0.62, 0.82) if any(riser.sleeve for riser in design.risers) else (0.85, 1.05)


def chill_below(place, low, radius, number):
    """A block below a place [mm] of the part, whose lowest skin there is at `low` and whose largest ball has `radius`."""
    half, thick = max(radius, 3.0), max(2 * CHILL * radius, 4.0)
    return Chill(f"chill_{number}", (place[0] - half, place[1] - half, low - thick),
                 (place[0] + half, place[1] + half, low + 0.05 * thick))
