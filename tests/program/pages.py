"""What the pages of the guide hold: fenced blocks, and commands in the text."""

from dataclasses import dataclass
import re
import shlex
import textwrap

FENCE = re.compile(r"^( *)```(\w*)\n(.*?)^\1```", re.S | re.M)
COMMANDS = ("./dev", "~/solidus/dev", "solidus", "mpirun", "srun")


@dataclass
class Block:
    language: str
    text: str
    before: str  # the last words in front of it


def blocks(page):
    return [Block(match[2], textwrap.dedent(match[3]), page[:match.start()][-200:]) for match in FENCE.finditer(page)]


def commands(page):
    """Command lines of Solidus: of blocks of a shell, of indented lines and between backticks."""
    lines = []
    for match in FENCE.finditer(page):
        if match[2] in ("", "sh", "bash"):
            lines += match[3].splitlines()
    rest = FENCE.sub("", page)
    lines += [line for line in rest.splitlines() if line.startswith("    ")]
    lines += re.findall(r"`([^`\n]+)`", rest)
    found = []
    for line in lines:
        try:
            words = shlex.split(line, comments=True)
        except ValueError:  # an apostrophe of a text
            continue
        words = [word for word in words if not re.match(r"^(NP|NO_COLOR)=\d+$", word)]
        for end, word in enumerate(words):
            if word in ("|", ">", "…") or word.startswith("$("):
                words = words[:end]
                break
        if words and words[0] in COMMANDS:
            found.append(without_launcher(words))
    return [list(command) for command in dict.fromkeys(tuple(command) for command in found if command)]


def without_launcher(words):
    """`mpirun -n 4 build/release/solidus run case.toml` -> `solidus run case.toml`."""
    if words[0] in ("mpirun", "srun"):
        names = [i for i, word in enumerate(words) if word.split("/")[-1] == "solidus"]
        words = words[names[0]:] if names else []
    return ["./dev" if words[0].endswith("/dev") else "solidus", *words[1:]] if words else []


def is_pattern(word):
    """CASE, FOLDER: what a reader puts something in for."""
    return re.fullmatch(r"\[?[A-Z_]{3,}\]?", word) is not None


PROGRAMS = (r"(?:NP=\d+ |PYTHONPATH=\S+ )?(?:\./dev|~/solidus/dev|solidus|mpirun|srun|ccx|cmake|cp|cd|apt|podman|python3|/usr/bin/python3"
            r"|solidus-env/bin/pip)(?= |$)")
# A verb alone, between backticks: a name of the thing, not a line to type.
NAMED = re.compile(r"(?:solidus|\./dev)(?: (?!help|man|version|schema|explain|materials$)[a-z-]+)?(?: --log \w+ run)?")


def typed_lines(page):
    """What a reader types, in its order: lines of blocks of a shell (a script is one of them), indented lines, and commands
    between backticks that name what they work on."""
    found = []
    for match in re.finditer(FENCE.pattern + r"|^    (\S[^\n]*)$|`([^`\n]+)`", page, re.S | re.M):
        if match[3] is not None and match[2] in ("", "sh", "bash"):
            text = textwrap.dedent(match[3])
            if text.startswith("#!"):
                found.append(text)
            else:
                found += [line for line in text.splitlines() if re.match(PROGRAMS, line)]
        elif match[4] and re.match(PROGRAMS, match[4]):
            found.append(match[4])
        elif match[5] and re.match(r"(?:\./dev|~/solidus/dev|solidus|mpirun)(?= )", match[5]) and not (
                NAMED.fullmatch(match[5]) or "…" in match[5] or "..." in match[5]):
            found.append(match[5])
    return found
