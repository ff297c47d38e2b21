"""``python -m solidus_casting ...`` and the command ``solidus`` of an installed package: the program itself."""

import os
import sys

from .errors import ProgramMissing
from .verbs import program


def main() -> None:
    try:
        path = program()
    except ProgramMissing as error:
        sys.exit(f"solidus: {error}")
    os.execv(path, [str(path), *sys.argv[1:]])


if __name__ == "__main__":
    main()
