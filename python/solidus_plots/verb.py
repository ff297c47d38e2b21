"""Runs a verb of the program that is written in Python: python3 -m solidus_plots.verb MODULE ARGUMENT...

A Python that lacks numpy or matplotlib is told in one sentence, not by the trace of an import.
"""

import errno
import importlib
import sys

NO_WRITING = {errno.EROFS, errno.ENOSPC, errno.EDQUOT}


def sentence(error):
    """The error for whoever typed the verb; that of the system with the file first, and what was done with it where the
    error tells."""
    if not isinstance(error, OSError) or error.strerror is None:
        return str(error)
    if error.filename is None:
        return error.strerror
    what = "cannot be written: " if error.errno in NO_WRITING else ""
    return f"{error.filename}: {what}{error.strerror}"


def main(arguments):
    module, *rest = arguments
    try:
        verb = importlib.import_module(f"solidus_plots.{module}")
    except ImportError as error:
        print(f"solidus: pictures and comparisons need numpy and matplotlib, and {sys.executable} has no "
              f"'{error.name or error}'\n  Debian's python3-numpy and python3-matplotlib; SOLIDUS_PYTHON names another Python",
              file=sys.stderr)
        return 1
    except OSError as error:  # matplotlib wants a folder for temporary files as soon as it is imported
        print(f"solidus: {sentence(error)}", file=sys.stderr)
        return 1
    return verb.main(rest)


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
