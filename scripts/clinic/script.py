"""Code run in a process of its own: the scripts of code cases, and the snippets on the pages."""

from __future__ import annotations

import os
import re
import subprocess
import sys
import tempfile
from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from clinic import node
from clinic.checks import Trace

TIME_LIMIT = 20.0
PRINTED = re.compile(
    r"^\s*(?P<name>[a-z][a-z0-9 _,()-]*?)\s*=\s*(?P<value>[-+]?(?:\d+\.?\d*|\.\d+)(?:[eE][-+]?\d+)?)(?![\w.])"
)


class ScriptError(ValueError):
    """A script that did not end well; `found` says how, `repair` what to do."""

    def __init__(self, found: str, repair: str) -> None:
        self.found, self.repair = found, repair
        super().__init__(f"{found}; {repair}")


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


def run_script(code: str, files: Mapping[str, str], time_limit: float = TIME_LIMIT, name: str = "script.py") -> Output:
    """Runs `code` in a temporary folder that holds `files`: by Node where `name` ends in `.mjs`, else by Python.

    Raises:
        ScriptError: If it does not end within `time_limit` seconds, or ends with an error.
    """
    run = run_node if name.endswith(node.ENDING) else run_python
    return run(code, files, time_limit, name)


def run_python(code: str, files: Mapping[str, str], time_limit: float = TIME_LIMIT, name: str = "script.py") -> Output:
    """Runs Python `code` in a temporary folder that holds `files`.

    Raises:
        ScriptError: If it does not end within `time_limit` seconds, or ends with an error.
    """
    with tempfile.TemporaryDirectory(prefix="clinic-") as folder:
        done = _process(sys.executable, Path(folder), {**files, name: code}, name, time_limit)
    if done.returncode:
        last = done.stderr.strip().splitlines()[-1:] or [f"exit code {done.returncode}"]
        at = re.findall(rf'File ".*{re.escape(name)}", line (\d+)', done.stderr)
        raise _failed(last[0], at[-1] if at else None, name)
    return Output(done.stdout)


def run_node(code: str, files: Mapping[str, str], time_limit: float = TIME_LIMIT, name: str = "script.mjs") -> Output:
    """Runs the JavaScript module `code` in a temporary folder that holds `files`; the checkout's packages are there.

    Raises:
        ScriptError: If there is no Node, or it does not end within `time_limit` seconds, or ends with an error.
    """
    program, modules = node.program(), node.modules()
    if program is None:
        raise ScriptError(*node.NO_PROGRAM)
    with tempfile.TemporaryDirectory(prefix="clinic-") as folder:
        if modules is not None:
            Path(folder, modules.name).symlink_to(modules)
        done = _process(program, Path(folder), {**files, name: code}, name, time_limit)
    if done.returncode:
        message, line = node.failure(done.stderr, name)
        raise _failed(message or f"exit code {done.returncode}", line, name)
    return Output(done.stdout)


def _process(
    program: str, folder: Path, files: Mapping[str, str], name: str, time_limit: float
) -> subprocess.CompletedProcess[str]:
    for file, text in files.items():
        path = folder / file
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(text, encoding="utf-8")
    environment = {**os.environ, "PYTHONHASHSEED": "0", "PYTHONDONTWRITEBYTECODE": "1"}
    environment.setdefault("MUJOCO_GL", "egl")
    try:
        return subprocess.run(
            [program, name],
            check=False,
            cwd=folder,
            env=environment,
            stdin=subprocess.DEVNULL,
            capture_output=True,
            text=True,
            timeout=time_limit,
        )
    except subprocess.TimeoutExpired:
        raise ScriptError(f"still running after {time_limit:g} s", "bound its loops by steps") from None


def _failed(found: str, line: str | None, name: str) -> ScriptError:
    return ScriptError(found + (f" (line {line} of {name})" if line else ""), "run it by hand and mend it")
