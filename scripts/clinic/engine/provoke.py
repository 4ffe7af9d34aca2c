"""Makes MuJoCo say what it warns of and complains about, each time in a process of its own, which may crash or hang.

`python -m clinic.engine.provoke`, run by the Python that has a release installed, answers stdin's codes with its texts.
The processes are copies of that one, which has MuJoCo imported: to import it for each would take ten times as long.
"""

from __future__ import annotations

import contextlib
import json
import os
import re
import signal
import subprocess
import sys
import tempfile
from collections.abc import Mapping

SECONDS = 10.0
LINES = 6  # of a long message are kept


def provoke(codes: Mapping[str, str], python: str = sys.executable) -> dict[str, str]:
    """What each piece of Python printed, to stdout and stderr alike, by its name.

    A piece has `mujoco`, `np` and `load(xml, files)`, which compiles a model. Where it ended by a signal, a crash or
    more than SECONDS, a last line says so: `ended by signal 11`.

    Args:
        codes: The pieces by name.
        python: The Python that runs them.

    Raises:
        RuntimeError: If that Python cannot run this module.
    """
    command = [python, "-m", "clinic.engine.provoke"]
    done = subprocess.run(
        command, check=False, capture_output=True, text=True, input=json.dumps([SECONDS, dict(codes)])
    )
    if done.returncode:
        raise RuntimeError(f"{python}: {done.stderr.strip()[-500:]}")
    said: dict[str, str] = json.loads(done.stdout)
    return said


def tidied(text: str) -> str:
    """The first LINES lines that are not empty, each once, without addresses in memory.

    A warning is said twice where the compiler meets what a step meets again.
    """
    lines = [line.rstrip() for line in re.sub(r"0x[0-9a-f]{6,}", "0x…", text).splitlines() if line.strip()]
    return "\n".join(list(dict.fromkeys(lines))[:LINES])


def _said(code: str, seconds: float) -> str:
    """What a copy of this process prints when it runs the code."""
    with tempfile.TemporaryFile() as out, tempfile.TemporaryDirectory() as folder:
        child = os.fork()
        if child == 0:
            os.chdir(folder)  # MuJoCo appends to a log there
            os.dup2(out.fileno(), 1)
            os.dup2(out.fileno(), 2)
            signal.setitimer(signal.ITIMER_REAL, seconds)
            _run(code)
            os._exit(0)
        _, status = os.waitpid(child, 0)
        out.seek(0)
        ended = f"\nended by signal {os.WTERMSIG(status)}" if os.WIFSIGNALED(status) else ""
        return tidied(out.read().decode(errors="replace") + ended)


def _run(code: str) -> None:
    import mujoco
    import numpy as np

    def load(xml: str, files: Mapping[str, bytes] | None = None) -> mujoco.MjModel:
        return mujoco.MjModel.from_xml_string(xml, files or {})

    names = {"mujoco": mujoco, "np": np, "load": load}
    try:
        exec(compile(code, "code.py", "exec"), names)
    except BaseException as error:
        print(f"{type(error).__name__}: {error}", flush=True)  # before what destructors say
    names.clear()
    with contextlib.suppress(OSError):
        sys.stdout.flush()
        sys.stderr.flush()


if __name__ == "__main__":
    import mujoco  # once, for all copies

    limit, given = json.load(sys.stdin)
    print(json.dumps({name: _said(code, limit) for name, code in given.items()}))
