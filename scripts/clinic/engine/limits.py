"""Programs run under limits on time, memory, output and files, in a folder of their own that is deleted.

On Linux a program can start no other, open no socket (x86-64, ARM64), and change nothing outside its folder (with
Landlock, 5.13 or newer). What cannot be kept from it without being root: reading what the user can read, changing the
mode and the times of the user's files, and filling its own folder until its time is up. Elsewhere only the limits on
time, output and the size of a file hold.
"""

from __future__ import annotations

import json
import os
import subprocess
import sys
import tempfile
from collections.abc import Iterator, Mapping, Sequence
from contextlib import contextmanager
from dataclasses import asdict, dataclass
from pathlib import Path

from clinic.engine.keeper import Keeper
from clinic.record.yaml_lines import CONTROL, named

CONFINE = Path(__file__).with_name("confine.py")
MIB = 2**20
KEPT = ("PATH", "LANG", "LD_LIBRARY_PATH", "MUJOCO_GL", "PYOPENGL_PLATFORM")
KEPT_FAMILIES = ("LIBGL_", "EGL_", "__EGL_", "__GLX_", "MESA_", "GALLIUM_")


class ProgramError(ValueError):
    """A program that did not end well; `found` says how, `repair` what to do."""

    def __init__(self, found: str, repair: str) -> None:
        self.found, self.repair = found, repair
        super().__init__(found, repair)

    def __str__(self) -> str:
        return f"{self.found}; {self.repair}"


class LimitError(ProgramError):
    """A program that broke a limit; `found` says which."""


@dataclass(frozen=True)
class Limits:
    """What a program may use.

    Args:
        seconds: Time on the clock.
        memory: Bytes, of each process and of all together; a program that needs more sees its allocation fail.
        output: Bytes on stdout, and on stderr.
        file: Bytes of a file that it writes.
    """

    seconds: float = 20.0
    memory: int = 2048 * MIB
    output: int = 256_000
    file: int = 64 * MIB


@dataclass(frozen=True)
class Done:
    """How a program ended: its exit code, negative for a signal, and what it printed."""

    code: int
    stdout: str
    stderr: str


def run(command: Sequence[str], folder: Path, limits: Limits, given: str = "", script: str = "") -> Done:
    """Runs a program in `folder`, with `given` on its stdin, its home and its temporary files in `folder`.

    Args:
        command: The program; what a message says of it.
        folder: Where it runs.
        limits: What it may use.
        given: What it reads.
        script: A Python script: run in place of the program by a process that has NumPy and MuJoCo
            imported, and stays for the next one.

    Raises:
        LimitError: If it breaks a limit, or prints what is not text.
    """
    order = {
        "command": list(command),
        "folder": str(folder),
        "environment": environment(folder),
        "input": given,
        "script": script if sys.platform == "linux" else "",
        **asdict(limits),
    }
    done = json.loads((_kept if order["script"] else _once)(json.dumps(order)))
    if done["stopped"]:
        raise LimitError(*_broken(done["stopped"], limits))
    return Done(done["code"], _text(done["stdout"]), done["stderr"].encode(errors="replace").decode())


def _once(order: str) -> str:
    with subprocess.Popen(
        [sys.executable, "-I", "-S", str(CONFINE)],
        stdin=subprocess.PIPE,
        stdout=subprocess.PIPE,
        stderr=subprocess.PIPE,
        text=True,
    ) as process:
        try:
            answer, wrong = process.communicate(order)
        finally:
            process.terminate()
    if process.returncode:
        raise LimitError(f"not run: {(wrong.splitlines() or ['killed'])[-1]}", "run it again")
    return answer


def _kept(order: str) -> str:
    if answer := KEEPER.ask(order):
        return answer
    raise LimitError("not run: killed", "run it again")


def _keeper() -> subprocess.Popen[str]:
    """The process for scripts in Python."""
    home = Path(tempfile.gettempdir())
    return subprocess.Popen(
        [sys.executable, "-P", "-s", str(CONFINE), "--keep"],
        stdin=subprocess.PIPE,
        stdout=subprocess.PIPE,
        stderr=subprocess.DEVNULL,
        env=environment(home),
        cwd=home,
        text=True,
    )


KEEPER = Keeper(_keeper)


def environment(folder: Path) -> dict[str, str]:
    """What a program sees of this one's environment: where programs and OpenGL are, and no more."""
    kept = {name: value for name, value in os.environ.items() if name in KEPT or name.startswith(KEPT_FAMILIES)}
    kept.setdefault("MUJOCO_GL", "egl")
    own = {"HOME": str(folder), "TMPDIR": str(folder), "PYTHONHASHSEED": "0", "PYTHONDONTWRITEBYTECODE": "1"}
    return {"PATH": os.defpath, "LANG": "C.UTF-8", **kept, **own}


@contextmanager
def written(files: Mapping[str, str]) -> Iterator[str]:
    """A temporary folder that holds `files`."""
    made = tempfile.TemporaryDirectory(prefix="clinic-")
    try:
        for file, text in files.items():
            path = Path(made.name, file)
            path.parent.mkdir(parents=True, exist_ok=True)
            path.write_text(text, encoding="utf-8")
        yield made.name
    finally:
        try:
            made.cleanup()
        except (OSError, RecursionError):  # what cannot be deleted; folders in folders, by the thousand
            subprocess.run(["rm", "-rf", made.name], check=False, capture_output=True)


def _text(said: str) -> str:
    text = said.replace("\r\n", "\n")
    if strange := CONTROL.search(text):
        raise LimitError(
            f"it prints {named(strange[0])} on line {text.count(chr(10), 0, strange.start()) + 1} of its output",
            "print text in UTF-8",
        )
    return text


def _broken(limit: str, limits: Limits) -> tuple[str, str]:
    return {
        "seconds": (f"still running after {limits.seconds:g} s", "bound its loops by steps"),
        "output": (f"prints more than {limits.output} bytes", "print what the page shows, not every step"),
        "memory": (f"uses more than {limits.memory // MIB} MiB of memory", "keep less of what it computes"),
    }[limit]
