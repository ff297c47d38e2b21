"""Sections of TOML as text, and numbers between bounds."""


class Writer:
    """Collects sections of TOML."""

    def __init__(self):
        self.lines = []

    def section(self, head, /, **keys):
        self.lines += ["", head]
        self.add(**keys)

    def add(self, **keys):
        self.lines += [f"{key} = {toml(value)}" for key, value in keys.items() if value is not None]


def toml(value):
    if isinstance(value, bool):
        return "true" if value else "false"
    if isinstance(value, str):
        return f'"{value}"'
    if isinstance(value, dict):
        return "{ " + ", ".join(f"{k} = {toml(v)}" for k, v in value.items()) + " }"
    if isinstance(value, (list, tuple)):
        return "[" + ", ".join(toml(v) for v in value) + "]"
    return f"{value:.6g}" if isinstance(value, float) else str(value)


def around(rng, low, high):
    """A number between two of the same sign, evenly in its logarithm."""
    return low * (high / low) ** rng.random()
