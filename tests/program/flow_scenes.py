"""Flows of metal and air on cubes by the solver of `solidus fill`, with its own dictionaries: scenes whose answers are known."""

from dataclasses import dataclass, field
from pathlib import Path

import numpy as np

from solidus_plots import filling_dictionaries as dictionaries
from solidus_plots.filling_flow import FoamRun
from solidus_plots.filling_mesh import Cubes, write_mesh

WATER = dictionaries.Melt(1000.0, 4180.0, 3e5, 100.0, 0.6, 0.6, 1e-3, 0.072)
ALUMINIUM = dictionaries.Melt(2500.0, 1100.0, 4e5, 870.0, 90.0, 160.0, 2e-3, 0.9)


@dataclass
class Scene:
    """Cubes, what is in them at the start, and the patches of their skin."""

    cells: np.ndarray  # [cube][axis] whole numbers
    edge: float  # [m]
    melt: dictionaries.Melt
    metal: object = None  # share at the start, of the centres of the cubes in edges
    gravity: tuple = (0, 0, -9.81)
    speed: tuple = (0, 0, 0)  # in the gate [m/s]
    hot: float = 980.0  # of the metal and, with no walls, of the air [K]
    air: float = 980.0
    gate: object = None  # of centres of faces in edges and of their directions, whether a face belongs to it
    vent: object = None
    walls: dict = field(default_factory=dict)  # T of "free", slipping walls; insulating without
    step: float = 2e-3  # the longest [s]

    def __post_init__(self):
        self.cubes = Cubes(np.zeros(3), self.edge, self.cells)

    def start(self, folder):
        """Writes the case; a run of it."""
        faces, directions = self.cubes.skin()
        centres = self.cubes.cells[faces] + 0.5 + 0.5 * directions
        flow = dictionaries.Flow(self.gravity, self.speed, self.hot, self.air, 0.5 / self.step, self.step)
        # The lid's last face gives the pressure its level; what is no gate and no vent is a wall.
        owner = np.zeros(len(faces), int)
        for number, chosen in ((1, self.gate), (2, self.vent)):
            if chosen is not None:
                owner[chosen(centres, directions)] = number
        high = np.lexsort((-owner, centres[:, 0] if self.vent else -centres[:, 0], centres[:, 2]))[-1]
        owner[high] = 3
        names = (("free", "wall"), ("gate", "patch"), ("vent_1", "patch"), ("leak", "patch"))
        patches = [(name, kind, faces[owner == k], directions[owner == k]) for k, (name, kind) in enumerate(names) if (owner == k).any()]
        write_mesh(folder, self.cubes, patches)
        walls = {"free": dictionaries.INSULATING, **({"vent_1": dictionaries.INSULATING} if self.vent else {}), **self.walls}
        dictionaries.write_fields(folder, flow, walls)
        dictionaries.write_materials(folder, self.melt, flow)
        dictionaries.write_numerics(folder)
        self._set_vent(folder, directions[owner == 2], int((owner == 1).sum()))
        if self.metal is not None:
            share = np.asarray(self.metal(self.cubes.cells + 0.5), float)
            for phase, values in (("melt", share), ("gas", 1 - share)):
                file = folder / f"0/alpha.{phase}"
                text = file.read_text()
                begin, end = text.index("internalField"), text.index("boundaryField")
                file.write_text(f"{text[:begin]}internalField {dictionaries.of_values(values)};\n{text[end:]}")
        self.flow = flow
        return FoamRun(folder, len(self.cubes.cells), 1)

    def _set_vent(self, folder, directions, n_gate):
        """As much gas leaves as metal comes."""
        if self.vent is None:
            return
        velocity = directions * np.linalg.norm(self.speed) * n_gate / len(directions)
        file = folder / "0/U"
        text = file.read_text()
        block = text.index("vent_1")
        begin, end = text.index("{", block), text.index("}", block)
        file.write_text(f"{text[:begin]}{{ {dictionaries.vent_velocity(velocity)} {text[end:]}")

    def frames(self, folder, end, interval):
        """Computes to a time; yields each moment that is written, as (time, read), read(field) its values in all cubes."""
        folder = Path(folder)
        run = self.start(folder)
        dictionaries.write_control(folder, self.flow, end, interval)
        run.run(lambda line: None)
        for time, name in run.times():
            if time > 0:
                yield time, lambda what, name=name: run.read(name, what)


def box(*counts):
    return np.argwhere(np.ones(counts, bool))
