"""Runs a script in a process of its own: under limits, in a temporary folder, and ended with all that it started.

A script of a case is reviewed code, as a test is. The limits are there for its mistakes, not against an attacker: it
may read and write what the user may, open sockets, and leave behind a process in a session of its own.

Scripts in Python are forks of a process that has NumPy and MuJoCo imported, for the imports take 0.3 s and most scripts
a tenth of that. This process is the file itself, run as a program: stdin gives it a line of JSON for every script to
run, and it answers each on stdout with how the script ended.
"""

from __future__ import annotations

import json
import os
import re
import resource
import runpy
import signal
import subprocess
import sys
import tempfile
from collections.abc import Mapping
from contextlib import suppress
from functools import cache
from pathlib import Path
from subprocess import CompletedProcess
from typing import Any

SECONDS = 20.0  # on the clock
MIB = 2**20
MEMORY = 2048 * MIB
LIMITS = {resource.RLIMIT_DATA: MEMORY, resource.RLIMIT_FSIZE: 64 * MIB, resource.RLIMIT_CORE: 0}
SEEN = re.compile("PATH|LANG|LD_LIBRARY_PATH|MUJOCO_GL|PYOPENGL_|LIBGL_|EGL_|__EGL_|__GLX_|MESA_|GALLIUM_")
FORKS = sys.platform == "linux"  # elsewhere a fork may not use what MuJoCo's import has loaded
QUIET = "ignore:This process:DeprecationWarning"  # Python warns of forks beside threads; those of NumPy bear it


def run(command: list[str], files: Mapping[str, str | Path], seconds: float = SECONDS) -> CompletedProcess[str]:
    """Runs a script in a temporary folder, which is its home too, without input.

    SIGALRM ends one that takes too long. One that asks for more memory, or a larger file, than LIMITS allow meets an
    error of its own. Of what it prints, bytes that are not UTF-8 are replaced.

    Args:
        command: A program, and the script's name in the folder.
        files: What the folder holds, by path: texts, and what is linked to.
        seconds: How long the script may take, on the clock.
    """
    with tempfile.TemporaryDirectory(prefix="clinic-", ignore_cleanup_errors=True) as folder:
        home = Path(folder, "home")
        for name, content in files.items():
            path = home / name
            path.parent.mkdir(parents=True, exist_ok=True)
            if isinstance(content, Path):
                path.symlink_to(content)
            else:
                path.write_text(content, encoding="utf-8")
        order = {"command": command, "folder": folder, "seconds": seconds}
        code = _ask(json.dumps(order))
        printed = [Path(folder, name).read_text(encoding="utf-8", errors="replace") for name in ("stdout", "stderr")]
    return CompletedProcess(command, code, *printed)


def _ask(order: str) -> int:
    """Has a script run; its exit code."""
    starter = _starter()
    assert starter.stdout is not None
    try:
        print(order, file=starter.stdin, flush=True)
        if answer := starter.stdout.readline():
            return int(answer)
        raise ConnectionError("the process that starts scripts was killed: run this again")
    except BaseException:  # else the next script would get this one's answer
        _starter.cache_clear()
        starter.kill()
        starter.communicate()
        raise


@cache
def _starter() -> subprocess.Popen[str]:
    """The process that starts scripts; it ends when this one does.

    It and the scripts see of this process's environment where programs and OpenGL are, and no more.
    """
    seen = {name: value for name, value in os.environ.items() if SEEN.match(name)}
    own = {"PYTHONHASHSEED": "0", "PYTHONDONTWRITEBYTECODE": "1"}
    return subprocess.Popen(
        [sys.executable, "-P", "-s", "-W", QUIET, __file__],
        stdin=subprocess.PIPE,
        stdout=subprocess.PIPE,
        env={"PATH": os.defpath, "LANG": "C.UTF-8", "MUJOCO_GL": "egl", **seen, **own},
        text=True,
        start_new_session=True,
    )


def _wait_for_order() -> dict[str, Any]:
    """Forks for every order on stdin, and waits for the fork to end; returns in the fork, with the order."""
    for line in sys.stdin:
        order: dict[str, Any] = json.loads(line)
        if not (script := os.fork()):
            return order
        code = os.waitstatus_to_exitcode(os.waitpid(script, 0)[1])
        with suppress(ProcessLookupError):
            os.killpg(script, signal.SIGKILL)  # what it has left running
        print(code, flush=True)
    sys.exit()


def _start(command: list[str], folder: str, seconds: float) -> None:
    """Turns this process into the script's."""
    os.setsid()
    for number, file in enumerate((os.devnull, f"{folder}/stdout", f"{folder}/stderr")):
        os.dup2(os.open(file, os.O_RDWR | os.O_CREAT), number)
    os.chdir(f"{folder}/home")
    for kind, limit in LIMITS.items():
        with suppress(ValueError):  # a lower one holds already
            resource.setrlimit(kind, (limit, limit))
    signal.setitimer(signal.ITIMER_REAL, seconds)  # SIGALRM ends it
    os.environ |= {"HOME": os.getcwd(), "TMPDIR": os.getcwd()}
    program, script = command
    if program != sys.executable or not FORKS:
        os.execv(program, command)
    sys.argv = [script]
    sys.path.insert(0, os.getcwd())
    runpy.run_path(script, run_name="__main__")


if __name__ == "__main__":
    if FORKS:
        import mujoco  # noqa: F401
    _start(**_wait_for_order())
