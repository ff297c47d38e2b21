"""Materials: properties as functions of temperature, and the constitutive law at points."""

from __future__ import annotations

import copy
import tempfile
from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np

from .core import core
from .errors import InputError, RunStopped, SolidusError
from .toml_text import document_text

ZERO_CELSIUS = 273.15
_ROOM = 293.15
_STATE = 19  # numbers of a point's history


def celsius(temperature: Any) -> Any:
    """Converts degrees Celsius to kelvin, the unit of temperature of all functions here."""
    return np.asarray(temperature, float) + ZERO_CELSIUS if np.ndim(temperature) else float(temperature) + ZERO_CELSIUS


@dataclass(frozen=True)
class Property:
    """A property of a material, a function of temperature [K]: ``m.conductivity(300.0)``.

    Attributes
    ----------
    name, unit:
        As in the material file, and the unit of the values (SI).
    source, valid:
        Source of the numbers, and their stated temperature range [K], or ``None``.
    """

    name: str
    unit: str
    source: str
    valid: tuple[float, float] | None
    _material: Any

    def __call__(self, temperature: Any) -> Any:
        values = self._material.property(self.name, np.asarray(temperature, float))
        return values if values.ndim else float(values)

    @property
    def points(self) -> tuple[np.ndarray, np.ndarray]:
        """The points of its table: temperatures [K] and values, linear between them. A constant has one point."""
        points = self._material.points(self.name)
        return np.array(points["x"]), np.array(points["y"])


class Material(Mapping[str, Property]):
    """A material of the library or a file; made by :func:`material`.

    ``m.conductivity`` and ``m["plasticity.flow_stress"]`` are functions of temperature (:class:`Property`); iterating goes
    over their names.
    """

    def __init__(self, reference: str, changes: Mapping[str, Any] | None = None) -> None:
        self._reference, self._changes = reference, dict(changes or {})
        if not self._changes:
            self._core = core().find_material(reference)
        else:
            with tempfile.TemporaryDirectory(prefix="solidus_material_") as folder:
                file = Path(folder) / "changed.toml"
                file.write_text(document_text({"like": reference, **_nested(self._changes)}), encoding="utf-8")
                self._core = core().find_material(str(file))
        self._units: dict[str, str] = self._core.properties()
        self._notes: dict[str, Any] = self._core.notes()

    @property
    def name(self) -> str:
        return self._core.name if not self._changes else f"{Path(self._reference).stem}, changed"

    @property
    def title(self) -> str:
        """Description in one line."""
        return self._core.title

    @property
    def density(self) -> float:
        """[kg/m³]"""
        return self._core.density

    @property
    def phase_changes(self) -> list[dict[str, Any]]:
        """Each with name, latent_heat [J/kg], volume_change, solidus and liquidus [K]."""
        return self._core.phase_changes()

    def __getitem__(self, name: str) -> Property:
        if name not in self._units:
            import difflib

            near = difflib.get_close_matches(name, self._units, 1)
            raise KeyError(f"'{self.name}' has no property '{name}'; " + (f"did you mean '{near[0]}'? " if near else "")
                           + "one of: " + ", ".join(self._units))
        note = self._notes.get(name, {"source": "", "valid": None})
        return Property(name, self._units[name], note["source"], note["valid"], self._core)

    def __getattr__(self, name: str) -> Property:
        if name.startswith("_"):
            raise AttributeError(name)
        try:
            return self[name]
        except KeyError as error:
            raise AttributeError(error.args[0]) from None

    def __iter__(self) -> Iterator[str]:
        return iter(self._units)

    def __len__(self) -> int:
        return len(self._units)

    def __dir__(self) -> list[str]:
        return [*super().__dir__(), *(name for name in self._units if "." not in name)]

    def _ipython_key_completions_(self) -> list[str]:
        return list(self)

    def __repr__(self) -> str:
        return f"<Material {self.name}: {self.title}>"

    def _at(self, function: Any, values: Any) -> Any:
        found = function(np.asarray(values, float))
        return found if found.ndim else float(found)

    def solid_fraction(self, temperature: Any) -> Any:
        """Solid fraction at temperatures [K]."""
        return self._at(self._core.solid_fraction, temperature)

    def enthalpy(self, temperature: Any) -> Any:
        """Sensible and latent heat [J/m³], counted from the lowest temperature of its data; at an isothermal change that of the melt."""
        return self._at(self._core.enthalpy, temperature)

    def temperature(self, enthalpy: Any) -> Any:
        """The inverse of :meth:`enthalpy` [K]."""
        return self._at(self._core.temperature, enthalpy)

    def changed(self, changes: Mapping[str, Any]) -> "Material":
        """A copy of this material with other values: ``m.changed({"plasticity.flow_stress": "80 MPa"})``.

        Keys are paths of a material file, values as in the file: a quantity with its unit, or a table. Raises
        :class:`InputError` as for a file.
        """
        return Material(self._reference, {**self._changes, **copy.deepcopy(dict(changes))})

    def tension(self, strain: Any, temperature: float = _ROOM, rate: float = 1e-3) -> np.ndarray:
        """The stress of a bar in a tensile test at constant temperature.

        Parameters
        ----------
        strain:
            Successive axial strains, from the undeformed bar; they may decrease (a cycle).
        temperature:
            [K]
        rate:
            Magnitude of the strain rate [1/s].

        Returns the axial stress at each strain [Pa]. Between two strains lies one step of the implicit integration.
        """
        return self.draw(strain, temperature, rate)["stress"]

    def draw(self, strain: Any, temperature: float = _ROOM, rate: float = 1e-3) -> dict[str, np.ndarray]:
        """As :meth:`tension`, but returns lateral strain and equivalent plastic strain in addition to the stress."""
        given = np.atleast_1d(np.asarray(strain, float))
        path = np.concatenate([[0.0], given])
        steps = np.abs(np.diff(path))
        # A strain that is given twice takes a step of no time, which is none.
        moving = np.concatenate([[True], steps > 0])
        time = np.concatenate([[0.0], np.cumsum(steps)]) / rate
        stress, lateral, plastic, stopped = core().draw(self._core, time[moving], path[moving],
                                                        np.full(int(moving.sum()), float(temperature)))
        if stopped >= 0:
            raise RunStopped(f"{self.name}: no equilibrium at the strain {path[moving][stopped]:g}; smaller steps of strain may help")
        place = np.cumsum(moving)[1:] - 1
        return {"strain": given, "stress": stress[place], "lateral_strain": lateral[place], "plastic_strain": plastic[place]}


def material(name: str | Path) -> Material:
    """A material of the library by its name, or a material file. Raises :class:`InputError` with the nearest name."""
    reference = str(name)
    if reference.endswith(".toml"):
        reference = str(Path(reference).absolute())
    return Material(reference)


def materials() -> list[str]:
    """Names of the materials of the library."""
    return core().material_names()


def _nested(changes: Mapping[str, Any]) -> dict[str, Any]:
    document: dict[str, Any] = {}
    for path, value in changes.items():
        *sections, key = path.split(".")
        place = document
        for section in sections:
            place = place.setdefault(section, {})
        place[key] = value
    return document


@dataclass
class State:
    """The history of points; every array is [point] or [point][component], components xx, yy, zz, xy, yz, xz.

    The members are views of :attr:`values`, the array of all of them.
    """

    values: np.ndarray

    @classmethod
    def at_rest(cls, points: int) -> "State":
        """The initial state, without plastic strain."""
        return cls(np.zeros((points, _STATE)))

    @property
    def viscous_strain(self) -> np.ndarray:
        return self.values[:, 0:6]

    @property
    def plastic_strain(self) -> np.ndarray:
        return self.values[:, 6:12]

    @property
    def back_strain(self) -> np.ndarray:
        return self.values[:, 12:18]

    @property
    def hardening(self) -> np.ndarray:
        """Equivalent plastic strain."""
        return self.values[:, 18]


@dataclass
class Update:
    """Result of a law: stress [Pa], state, on request the consistent tangent [point][6][6] [Pa], dissipation [W/m³],
    solid fraction, and whether each point converged."""

    stress: np.ndarray
    state: State
    dissipation: np.ndarray
    solid_fraction: np.ndarray
    converged: np.ndarray
    tangent: np.ndarray | None = None


class Law:
    """The constitutive law of a material, for many points at once: old state in, new state out.

    Parameters
    ----------
    material:
        A :class:`Material`, or its name.
    reference_temperature:
        Temperature of zero thermal strain [K].
    """

    def __init__(self, material_: Material | str, reference_temperature: float = _ROOM) -> None:
        self.material = material_ if isinstance(material_, Material) else material(material_)
        self.reference_temperature = float(reference_temperature)

    def update(self, strain: Any, temperature: Any, dt: float, state: State | None = None, tangent: bool = False) -> Update:
        """Stress and state at the end of a step, by backward Euler.

        Parameters
        ----------
        strain:
            Total strain at its end [point][6]: xx, yy, zz, xy, yz, xz, tensor components (xy is half the engineering strain).
        temperature:
            At its end, a number or [point] [K].
        dt:
            The step [s].
        state:
            At its start; none: at rest.
        tangent:
            Also compute ∂σ/∂ε; its shear columns act on engineering strains.
        """
        strain = np.atleast_2d(np.asarray(strain, float))
        if strain.ndim != 2 or strain.shape[1] != 6:
            raise ValueError(f"strain is [point][6], not of the shape {strain.shape}")
        points = len(strain)
        temperature = np.ascontiguousarray(np.broadcast_to(np.asarray(temperature, float), (points,)))
        start = State.at_rest(points) if state is None else state
        if start.values.shape != (points, _STATE):
            raise ValueError(f"the state has {len(start.values)} points, the strain {points}")
        if not dt > 0:
            raise ValueError(f"a step of {dt} s; it must be above zero")
        if not np.all(temperature > 0):
            raise ValueError("temperatures are in kelvin, above zero")
        found = core().update(self.material._core, strain, temperature, start.values, float(dt), self.reference_temperature, tangent)
        return Update(found["stress"], State(found["state"]), found["dissipation"], found["solid_fraction"],
                      found["converged"] > 0, found.get("tangent"))

    def moduli(self, temperature: Any) -> dict[str, np.ndarray]:
        """``bulk`` and ``shear`` modulus [Pa], volumetric ``thermal_strain``, ``solid_fraction``, ``flow_stress`` [Pa]."""
        return core().moduli(self.material._core, np.asarray(temperature, float), self.reference_temperature)


__all__ = ["InputError", "Law", "Material", "Property", "SolidusError", "State", "Update", "celsius", "material", "materials"]
