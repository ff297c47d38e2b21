"""Takes from this process, and from all that it starts, the right to files outside of a few folders, by Linux' Landlock.

Landlock (Linux 5.13 and newer, where it is switched on) refuses to open, make, rename or remove what no rule names. It
cannot be undone, not even by a defect of what runs here. Since Linux 6.7 it refuses connections by TCP as well. It does not hide that
a file exists, nor its size.
"""

from __future__ import annotations

import ctypes
import os
import stat
from collections.abc import Iterable
from pathlib import Path

# Numbers of the system calls, the same on every kind of processor, and of include/uapi/linux/landlock.h.
_CREATE_RULESET, _ADD_RULE, _RESTRICT_SELF = 444, 445, 446
_VERSION, _PATH_BENEATH = 1, 1
_NO_NEW_PRIVILEGES = 38  # of prctl

_EXECUTE, _WRITE_FILE, _READ_FILE, _READ_DIR = (1 << bit for bit in range(4))
_REMOVE_DIR, _REMOVE_FILE, _MAKE_DIR, _MAKE_REGULAR, _MAKE_SOCKET = 1 << 4, 1 << 5, 1 << 7, 1 << 8, 1 << 9
_REFER, _TRUNCATE = 1 << 13, 1 << 14
_RIGHTS_OF_VERSION = {1: 13, 2: 14, 3: 15, 4: 15, 5: 16}  # so many rights to files; version 5 adds one to devices
_BIND_AND_CONNECT = 3  # of TCP, since version 4

READ = _EXECUTE | _READ_FILE | _READ_DIR
# Nothing in there can be started, and no link, device or pipe be made.
WORK = _READ_FILE | _READ_DIR | _WRITE_FILE | _TRUNCATE | _REMOVE_DIR | _REMOVE_FILE | _MAKE_DIR | _MAKE_REGULAR | _REFER
TEMPORARY = WORK | _MAKE_SOCKET
_OF_FILES = _EXECUTE | _READ_FILE | _WRITE_FILE | _TRUNCATE


class _Ruleset(ctypes.Structure):
    _fields_ = [("files", ctypes.c_uint64), ("network", ctypes.c_uint64)]


class _Beneath(ctypes.Structure):
    _pack_ = 1
    _fields_ = [("allowed", ctypes.c_uint64), ("folder", ctypes.c_int32)]


def _system_call(number: int, *arguments: object) -> int:
    library = ctypes.CDLL(None, use_errno=True)
    result = library.syscall(ctypes.c_long(number), *arguments)
    if result < 0:
        raise OSError(ctypes.get_errno(), os.strerror(ctypes.get_errno()))
    return int(result)


def version() -> int:
    """The version of Landlock that the kernel has; 0: none, or switched off."""
    try:
        return _system_call(_CREATE_RULESET, None, ctypes.c_size_t(0), ctypes.c_uint32(_VERSION))
    except (OSError, AttributeError):
        return 0


def restrict(allowed: Iterable[tuple[Path, int]]) -> bool:
    """Leaves this process and its later children the rights named, each to a file or to all below a folder, and no others.

    What does not exist is passed over. Call it before threads are started: it binds the one that calls. Returns whether TCP is refused
    too. Raises ``OSError`` where the kernel does not do it.
    """
    has = version()
    if has == 0:
        raise OSError("the kernel has no Landlock")
    handled = (1 << _RIGHTS_OF_VERSION[min(has, 5)]) - 1
    without_network = has >= 4
    asked = _Ruleset(handled, _BIND_AND_CONNECT)
    size = ctypes.sizeof(_Ruleset) if without_network else 8
    rules = _system_call(_CREATE_RULESET, ctypes.byref(asked), ctypes.c_size_t(size), ctypes.c_uint32(0))
    try:
        for path, rights in allowed:
            _allow(rules, path, rights & handled)
        if ctypes.CDLL(None, use_errno=True).prctl(_NO_NEW_PRIVILEGES, *map(ctypes.c_ulong, (1, 0, 0, 0))) != 0:
            raise OSError(ctypes.get_errno(), os.strerror(ctypes.get_errno()))
        _system_call(_RESTRICT_SELF, ctypes.c_int(rules), ctypes.c_uint32(0))
    finally:
        os.close(rules)
    return without_network


def _allow(rules: int, path: Path, rights: int) -> None:
    try:
        place = os.open(path, os.O_PATH | os.O_CLOEXEC)
    except OSError:
        return
    try:
        if not stat.S_ISDIR(os.fstat(place).st_mode):
            rights &= _OF_FILES
        beneath = _Beneath(rights, place)
        _system_call(_ADD_RULE, ctypes.c_int(rules), ctypes.c_int(_PATH_BENEATH), ctypes.byref(beneath), ctypes.c_uint32(0))
    finally:
        os.close(place)
