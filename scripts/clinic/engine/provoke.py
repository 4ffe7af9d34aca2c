"""Code that makes MuJoCo speak: each piece in a forked process of its own, which may crash or hang.

Run as a module, it reads `{name: code}` as JSON from stdin and writes what each printed, to stdout and stderr alike.
POSIX only, as forking is what makes it quick: MuJoCo is imported once.
"""

from __future__ import annotations

import json
import os
import re
import signal
import subprocess
import sys
import tempfile
from collections.abc import Mapping
from pathlib import Path

LIMIT = 10
"""Seconds that a piece of code may take."""
LINES = 6
"""How much of a long message is kept."""


def provoked(codes: Mapping[str, str]) -> dict[str, str]:
    """What each piece of code made MuJoCo say; addresses in memory are left out.

    A process that crashed says so in a last line of its own: `ended by signal 11`.
    """
    environment = {"MUJOCO_GL": "egl", **os.environ, "PYTHONHASHSEED": "0"}
    done = subprocess.run(
        [sys.executable, "-m", "clinic.engine.provoke"],
        input=json.dumps(dict(codes)),
        env=environment,
        check=True,
        capture_output=True,
        text=True,
    )
    return {name: tidied(text) for name, text in json.loads(done.stdout).items()}


def tidied(text: str) -> str:
    """The first lines that are not empty, without addresses."""
    lines = [line.rstrip() for line in re.sub(r"0x[0-9a-f]{6,}", "0x…", text).splitlines() if line.strip()]
    return "\n".join(lines[:LINES])


def _forked(code: str) -> str:
    with tempfile.TemporaryDirectory(prefix="clinic-") as folder:
        out = Path(folder, "said.txt")
        if (child := os.fork()) == 0:
            _speak(code, out)
        _, status = os.waitpid(child, 0)
        said = out.read_text(encoding="utf-8", errors="replace")
    return said + (f"\nended by signal {os.WTERMSIG(status)}" if os.WIFSIGNALED(status) else "")


def _speak(code: str, out: Path) -> None:
    import mujoco
    import numpy as np

    signal.alarm(LIMIT)
    os.chdir(out.parent)
    file = os.open(out, os.O_WRONLY | os.O_CREAT)
    os.dup2(file, 1)
    os.dup2(file, 2)

    def load(xml: str, files: dict[str, bytes] | None = None) -> mujoco.MjModel:
        return mujoco.MjModel.from_xml_string(xml, files or {})

    try:
        exec(compile(code, "provoke.py", "exec"), {"mujoco": mujoco, "np": np, "load": load})
    except BaseException as error:
        print(f"{type(error).__name__}: {error}")
    sys.stdout.flush()
    os._exit(0)


def main() -> None:
    """Runs what stdin names."""
    import mujoco  # noqa: F401  before forking, so that it is imported once

    json.dump({name: _forked(code) for name, code in json.load(sys.stdin).items()}, sys.stdout)


if __name__ == "__main__":
    main()
