"""Scripts of code cases and snippets of pages run: Python and JavaScript, and the numbers they print."""

from __future__ import annotations

import re
import signal
import sys
from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np

from clinic.engine import node, sandbox
from clinic.engine.checks import Trace

OUTPUT = 256_000  # characters, of stdout and of stderr
NO_ROOM = re.compile("MemoryError|[Cc]ould not allocate|Unable to allocate|out of memory")
BY_HAND = "run it by hand and mend it"
PRINTED = re.compile(
    r"^\s*(?P<name>[a-z](?:[a-z0-9 _,()-]*[a-z0-9_,()-])?)\s*="
    r"\s*(?P<value>[-+]?(?:\d+\.?\d*|\.\d+)(?:[eE][-+]?\d+)?)(?![\w.])"
)


@dataclass(eq=False)
class ScriptError(ValueError):
    """A script that did not end well; `found` says how, `repair` what to do."""

    found: str
    repair: str

    def __str__(self) -> str:
        return f"{self.found}; {self.repair}"


def printed_numbers(output: str) -> dict[str, Trace]:
    """The numbers of the lines `name = value` of a script's output, by name; a name printed twice gives two samples.

    The time of a sample is its position, counted from 0.
    """
    values: dict[str, list[float]] = {}
    for line in output.splitlines():
        if match := PRINTED.match(line):
            values.setdefault(match["name"], []).append(float(match["value"]))
    return {name: Trace(np.arange(len(v), dtype=float), np.array(v)) for name, v in values.items()}


def run_script(code: str, files: Mapping[str, str], name: str = "script.py", seconds: float = sandbox.SECONDS) -> str:
    """Runs `code` in a temporary folder that holds `files`, and gives what it printed to stdout.

    With Node where `name` ends in `.mjs`, else with Python.

    Args:
        code: The text of the script.
        files: Texts by path below the folder; a script in JavaScript finds the checkout's packages there too.
        name: What the script is called.
        seconds: How long it may take, on the clock.

    Raises:
        ScriptError: If it breaks a limit of the sandbox or ends with an error, or there is no Node.
    """
    javascript = name.endswith(node.ENDING)
    program = node.executable() if javascript else sys.executable
    if program is None:
        raise ScriptError(*node.NO_PROGRAM)
    packages = node.modules() if javascript else None
    linked = {packages.name: packages} if packages else {}
    done = sandbox.run([program, name], {**files, name: code, **linked}, seconds)
    if max(len(done.stdout), len(done.stderr)) > OUTPUT:
        raise ScriptError(f"prints more than {OUTPUT} characters", "print what the page shows, not every step")
    if done.returncode == -signal.SIGALRM:
        raise ScriptError(f"still running after {seconds:g} s", "bound its loops by steps")
    if done.returncode:
        message, line = (node.failure if javascript else _failure)(done.stderr, name)
        at = f" (line {line} of {name})" if line else ""
        if NO_ROOM.search(message or ""):
            raise ScriptError(f"{message}{at}", f"a script may take {sandbox.MEMORY // sandbox.MIB:,} MiB of memory")
        raise ScriptError((message or f"exit code {done.returncode}") + at, BY_HAND)
    return done.stdout


def _failure(stderr: str, name: str) -> tuple[str, str | None]:
    """The last line of a traceback, empty if there is none, and the line of the script `name` it came from."""
    lines = stderr.strip().splitlines() or [""]
    at = re.findall(rf'File "[^"\n]*{re.escape(name)}", line (\d+)', stderr)
    return lines[-1], at[-1] if at else None
