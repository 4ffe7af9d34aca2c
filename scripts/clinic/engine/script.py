"""Code run in a process of its own: the scripts of code cases, and the snippets on the pages."""

from __future__ import annotations

import re
import sys
from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from clinic.engine import node
from clinic.engine.checks import Trace
from clinic.engine.limits import Done, LimitError, Limits, ProgramError, run, written
from clinic.record.yaml_lines import CONTROL

TIME_LIMIT = 20.0
LONGEST = 300  # characters of an error
BY_HAND = "run it by hand and mend it"
REFUSED = "let it write in its own folder only, start no program and open no socket"
PRINTED = re.compile(
    r"^\s*(?P<name>[a-z](?:[a-z0-9 _,()-]*[a-z0-9_,()-])?)\s*="
    r"\s*(?P<value>[-+]?(?:\d+\.?\d*|\.\d+)(?:[eE][-+]?\d+)?)(?![\w.])"
)


class ScriptError(ProgramError):
    """A script that did not end well."""


@dataclass(frozen=True)
class Output:
    """What a script printed to stdout."""

    text: str

    def traces(self) -> dict[str, Trace]:
        """The numbers of the lines `name = value`, by name; a name printed twice gives two samples.

        The time of a sample is its position, counted from 0.
        """
        values: dict[str, list[float]] = {}
        for line in self.text.splitlines():
            if match := PRINTED.match(line):
                values.setdefault(match["name"], []).append(float(match["value"]))
        return {name: Trace(np.arange(len(v), dtype=float), np.array(v)) for name, v in values.items()}


def run_script(code: str, files: Mapping[str, str], time_limit: float | None = None, name: str = "script.py") -> Output:
    """Runs `code` in a temporary folder that holds `files`: by Node where `name` ends in `.mjs`, else by Python.

    Args:
        code: The text of the script.
        files: Texts by path below the folder.
        time_limit: In s on the clock; TIME_LIMIT when absent.
        name: What the script is called.

    Raises:
        ScriptError: If it breaks a limit of `limits.py`, or ends with an error.
    """
    run = run_node if name.endswith(node.ENDING) else run_python
    return run(code, files, time_limit, name)


def run_python(code: str, files: Mapping[str, str], time_limit: float | None = None, name: str = "script.py") -> Output:
    """Runs Python `code` in a temporary folder that holds `files`, as `run_script` does.

    Raises:
        ScriptError: If it breaks a limit of `limits.py`, or ends with an error.
    """
    with written({**files, name: code}) as folder:
        done = _process(sys.executable, Path(folder), name, time_limit, name)
    if done.code:
        last = done.stderr.strip().splitlines()[-1:] or [f"exit code {done.code}"]
        at = re.findall(rf'File "[^"\n]*{re.escape(name)}", line (\d+)', done.stderr)
        raise _failed(last[0], at[-1] if at else None, name)
    return Output(done.stdout)


def run_node(code: str, files: Mapping[str, str], time_limit: float | None = None, name: str = "script.mjs") -> Output:
    """Runs the JavaScript module `code` in a temporary folder that holds `files`; the checkout's packages are there.

    Raises:
        ScriptError: If there is no Node, or it breaks a limit of `limits.py`, or ends with an error.
    """
    program, modules = node.program(), node.modules()
    if program is None:
        raise ScriptError(*node.NO_PROGRAM)
    with written({**files, name: code}) as folder:
        if modules is not None:
            Path(folder, modules.name).symlink_to(modules)
        done = _process(program, Path(folder), name, time_limit)
    if done.code:
        message, line = node.failure(done.stderr, name)
        raise _failed(message or f"exit code {done.code}", line, name)
    return Output(done.stdout)


def _process(program: str, folder: Path, name: str, time_limit: float | None, script: str = "") -> Done:
    limits = Limits(seconds=TIME_LIMIT if time_limit is None else time_limit)
    try:
        return run([program, name], folder, limits, script=script)
    except LimitError as error:
        raise ScriptError(error.found, error.repair) from None


def _failed(said: str, line: str | None, name: str) -> ScriptError:
    found = CONTROL.sub("", said)
    found = found if len(found) <= LONGEST else found[:LONGEST] + " ..."
    repair = REFUSED if re.search("permi(tted|ssion denied)|EACCES|EPERM", found, re.IGNORECASE) else BY_HAND
    return ScriptError(found + (f" (line {line} of {name})" if line else ""), repair)
