"""Writes docs/reference/python.md from the docstrings of solidus_casting: `python -m solidus_docs.python_reference > FILE`."""

import inspect
import re

import solidus_casting as sc
from solidus_casting import fitting
from solidus_casting.constitutive import Property, State, Update

GROUPS = [
    ("Cases", [sc.Case]),
    ("Runs", [sc.run, sc.Progress]),
    ("Results", [sc.Results, sc.Moment, sc.Table]),
    ("Materials", [sc.material, sc.materials, sc.Material, Property, sc.Law, State, Update, sc.celsius, fitting.fit_hardening]),
    ("Simulation", [sc.Simulation, sc.Step, sc.initialize, sc.has_core]),
    ("Failures", [sc.SolidusError, sc.InputError, sc.RunStopped, sc.RunInterrupted, sc.InternalError, sc.ProgramMissing]),
    ("The program", [sc.program, sc.version]),
]


def text(thing):
    """A docstring in Markdown: headings of sections in italics, roles of Sphinx as code."""
    lines = inspect.cleandoc(thing.__doc__ or "").splitlines()
    out, example = [], False
    for line, below in zip(lines, [*lines[1:], ""]):
        if below and set(below) == {"-"}:
            out += [f"*{line}*", ""]
            example = line == "Examples"
        elif line and set(line) == {"-"}:
            continue
        elif re.fullmatch(r"[\w, ]+:", line) and not example:
            out.append(f"- `{line[:-1]}`")
        elif line.startswith("    ") and not example:
            out.append(line[2:])
        else:
            out.append(f"    {line}" if example and line.startswith((">>>", "...")) else line)
    return re.sub(r":\w+:`~?([^`]+)`", r"`\1`", "\n".join(out)).replace("``", "`")


def signature(thing):
    found = str(inspect.signature(thing)).replace("self, ", "").replace("(self)", "()").replace("cls, ", "")
    return re.sub(r": '([^']*)'", r": \1", re.sub(r" -> .*$", "", found))


def members(thing):
    for name, value in vars(thing).items():
        if name.startswith("_") or not (getattr(value, "__doc__", None) or isinstance(value, property)):
            continue
        if isinstance(value, (classmethod, staticmethod)):
            value = value.__func__
        if inspect.isfunction(value):
            yield f"{name}{signature(value)}", value
        elif isinstance(value, property) or type(value).__name__ == "cached_property":
            if value.__doc__:
                yield name, value


def reference():
    lines = ["# Reference: the Python package", "",
             "Generated from `python/solidus_casting`; [the guide](../guide/python.md) shows how to use it. Import it as `import solidus_casting as sc`."]
    for title, things in GROUPS:
        lines += ["", f"## {title}"]
        for thing in things:
            is_class = inspect.isclass(thing)
            plain = is_class and issubclass(thing, (BaseException, dict))
            lines += ["", f"### `{thing.__name__}{'' if plain else signature(thing)}`", "", text(thing)]
            for head, member in members(thing) if is_class else ():
                lines += ["", f"**`{head}`**", "", text(member)]
    return re.sub(r"\n{3,}", "\n\n", "\n".join(line.rstrip() for line in lines)) + "\n"


if __name__ == "__main__":
    print(reference(), end="")
