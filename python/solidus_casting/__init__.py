"""Solidus from Python: how a metal casting solidifies in its mould.

    import solidus_casting as sc

    case = sc.Case.load("cases/hot_spots")
    case.body.casting.initial_temperature = "720 degC"
    results = sc.run(case, "results/hot_spots/hotter")
    results.history["T_max"], results.units["T_max"]

:class:`Case` reads, changes, checks and writes cases; :func:`run` runs them as a child process; :class:`Results` reads what a
run left. :func:`material`, :class:`Law` and :class:`Simulation` work in this process and need the compiled part of the package,
which the build makes with ``-DSOLIDUS_PYTHON=ON``; :func:`has_core` tells whether it is there.
"""

from .case import Case
from .child import run
from .core import has_core, initialize
from .errors import InputError, InternalError, ProgramMissing, RunInterrupted, RunStopped, SolidusError
from .constitutive import Law, Material, celsius, material, materials
from .moment import Moment
from .progress import Progress
from .verbs import program, version
from .results import Results
from .simulation import Simulation, Step
from .table import Table

__all__ = ["Case", "InputError", "InternalError", "Law", "Material", "Moment", "ProgramMissing", "Progress", "Results",
           "RunInterrupted", "RunStopped", "Simulation", "SolidusError", "Step", "Table", "celsius", "has_core", "initialize",
           "material", "materials", "program", "run", "version"]
