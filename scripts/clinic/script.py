"""Python run in a process of its own: the scripts of code cases, and the snippets on the pages."""

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

from clinic.checks import Trace

TIME_LIMIT = 20.0
PRINTED = re.compile(
    r"^\s*(?P<name>[a-z][a-z0-9 _,()-]*?)\s*=\s*(?P<value>[-+]?(?:\d+\.?\d*|\.\d+)(?:[eE][-+]?\d+)?)\b"
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


def run_python(code: str, files: Mapping[str, str], time_limit: float = TIME_LIMIT, name: str = "script.py") -> Output:
    """Runs `code` in a temporary folder that holds `files`.

    Raises:
        ScriptError: If it does not end within `time_limit` seconds, or ends with an error.
    """
    with tempfile.TemporaryDirectory(prefix="clinic-") as folder:
        for file, text in {**files, name: code}.items():
            path = Path(folder, file)
            path.parent.mkdir(parents=True, exist_ok=True)
            path.write_text(text, encoding="utf-8")
        environment = {**os.environ, "PYTHONHASHSEED": "0", "PYTHONDONTWRITEBYTECODE": "1"}
        environment.setdefault("MUJOCO_GL", "egl")
        try:
            done = subprocess.run(
                [sys.executable, name],
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
    if done.returncode:
        last = done.stderr.strip().splitlines()[-1:] or [f"exit code {done.returncode}"]
        at = re.findall(rf'File ".*{re.escape(name)}", line (\d+)', done.stderr)
        raise ScriptError(last[0] + (f" (line {at[-1]} of {name})" if at else ""), "run it by hand and mend it")
    return Output(done.stdout)
