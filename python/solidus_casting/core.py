"""Finds and starts the compiled part of the package."""

from __future__ import annotations

import atexit
import importlib
import importlib.machinery
import importlib.util
import logging
import os
import sys
import weakref
from types import ModuleType
from typing import Any

from .errors import ProgramMissing
from .verbs import program, version
from .written import with_keys

_NAME = "solidus_casting._core"
_logger = logging.getLogger("solidus_casting")
_started = False
_open: "weakref.WeakSet[Any]" = weakref.WeakSet()  # simulations, which must end before PETSc does


def _load() -> ModuleType:
    if _NAME in sys.modules:
        return sys.modules[_NAME]
    try:
        return importlib.import_module(_NAME)  # where the package is installed
    except ModuleNotFoundError as error:
        if error.name != _NAME:
            raise
    # Next to the program that was built, or in its prefix.
    beside = program().parent
    for file in [*sorted(beside.glob("python/_core*.so")),
                 *sorted(beside.parent.glob("share/solidus/python/solidus_casting/_core*.so"))]:
        if not any(file.name.endswith(suffix) for suffix in importlib.machinery.EXTENSION_SUFFIXES):
            continue  # of another Python
        spec = importlib.util.spec_from_file_location(_NAME, file)
        module = importlib.util.module_from_spec(spec)
        sys.modules[_NAME] = module
        spec.loader.exec_module(module)
        return module
    raise ProgramMissing(f"the compiled part of solidus_casting is not there for {sys.executable} ({sys.version.split()[0]}): "
                         "build with -DSOLIDUS_PYTHON=ON and pybind11 (./dev python), for the Python that shall use it")


def has_core() -> bool:
    """Whether the compiled part is there: :func:`material`, :class:`Law` and :class:`Simulation` need it."""
    try:
        _load()
    except (ProgramMissing, ImportError):
        return False
    return True


def initialize(communicator: Any = None, options: list[str] | tuple[str, ...] = ()) -> None:
    """Starts MPI, unless it is running, and PETSc. Called without arguments by everything that needs it.

    Call it yourself, before anything else of this package, to run on several processes or to give PETSc options.

    Parameters
    ----------
    communicator:
        A communicator of mpi4py, for example ``MPI.COMM_WORLD``; all its processes must call this and every function of
        :class:`Simulation` together.
    options:
        Of PETSc, for example ``["-heat_ksp_monitor"]``.
    """
    global _started
    if _started:
        if communicator is not None or options:
            raise RuntimeError("solidus_casting has started PETSc already; call initialize() before anything else")
        return
    # Set before BLAS is loaded, which would start a thread for each core of every process.
    os.environ.setdefault("OMP_NUM_THREADS", "1")
    os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")
    core = _load()
    if os.geteuid() == 0:
        os.environ.setdefault("OMPI_ALLOW_RUN_AS_ROOT", "1")
        os.environ.setdefault("OMPI_ALLOW_RUN_AS_ROOT_CONFIRM", "1")
    try:
        if version() == core.version:  # the reader of meshes next to it must be of the same build
            core.use_program(str(program()))
        else:
            _logger.warning("the program %s is of version %s, this package of %s: no meshes are read from files", program(),
                            version(), core.version)
    except ProgramMissing:
        _logger.info("without the program 'solidus' no meshes are read from files")
    core.set_sink(_message)
    core.initialize(None if communicator is None else communicator.py2f(), list(options))
    atexit.register(_finalize)
    _started = True


def _finalize() -> None:
    for simulation in list(_open):
        simulation.close()
    _load().finalize()


def closed_at_exit(simulation: Any) -> None:
    """Has ``close()`` called before PETSc ends."""
    _open.add(simulation)


def _message(level: str, text: str) -> None:
    _logger.log({"warning": logging.WARNING, "info": logging.INFO}.get(level, logging.DEBUG), with_keys(text))


def core() -> Any:
    """The compiled module, ready for use. Raises :class:`ProgramMissing`."""
    if not _started:
        initialize()
    return _load()
