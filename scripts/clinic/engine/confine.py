"""Runs a program under limits: a process of its own, started by `limits.py`, that outlives whatever it runs.

Run as a file, it takes orders on stdin, a line each, and prints what became of each, both JSON. With `--keep` it first
imports what nearly every script imports, and runs Python scripts in forks of itself, which then need not.
The program writes only below its folder (by Landlock), and makes no processes and no sockets, sets no limit of
another process and holds no memory beside its own (by a seccomp filter);
where the kernel does neither, its children, those that detach themselves too, end with it.
"""

from __future__ import annotations

import atexit
import ctypes
import json
import os
import resource
import runpy
import selectors
import signal
import subprocess
import sys
import time
import traceback
from collections.abc import Iterator
from contextlib import suppress
from errno import ENOSYS, EPERM
from pathlib import Path
from typing import Any

TICK = 0.02
LINUX = sys.platform == "linux"
PR_SET_PDEATHSIG, PR_SET_CHILD_SUBREAPER, PR_SET_NO_NEW_PRIVS = 1, 36, 38
PR_SET_SECCOMP, SECCOMP_FILTER, CLONE_THREAD = 22, 2, 0x10000
LANDLOCK_CREATE, LANDLOCK_ADD, LANDLOCK_RESTRICT = 444, 445, 446
WRITE_FILE, REFER, TRUNCATE = 1 << 1, 1 << 13, 1 << 14
MAKE_OR_REMOVE = sum(1 << bit for bit in range(4, 13))
DEVICES = ("null", "zero", "dri", "nvidia*", "kfd")  # those of OpenGL too


LOAD, EQUAL, AT_LEAST, ANY_BIT, RETURN = 0x20, 0x15, 0x35, 0x45, 0x06  # of a seccomp filter
ALLOW, REFUSE, OTHER_CALLS = 0x7FFF0000, 0x00050000, 0x40000000
SYSTEMS = {  # by machine: its number, `clone`, `prlimit64`, and the calls that make processes and sockets,
    # that set how processes are scheduled, and that hold memory which no process or folder shows
    "x86_64": (
        0xC000003E,
        56,
        302,
        {57: EPERM, 58: EPERM, 435: ENOSYS, 41: EPERM, 425: ENOSYS}
        | dict.fromkeys((141, 142, 144, 203, 251, 314), EPERM)
        | dict.fromkeys((29, 64, 68, 319), ENOSYS),
    ),
    "aarch64": (
        0xC00000B7,
        220,
        261,
        {435: ENOSYS, 198: EPERM, 425: ENOSYS}
        | dict.fromkeys((140, 118, 119, 122, 30, 274), EPERM)
        | dict.fromkeys((194, 190, 186, 279), ENOSYS),
    ),
}


class Instruction(ctypes.Structure):
    """One step of a seccomp filter."""

    _fields_ = [
        ("code", ctypes.c_uint16),
        ("if_true", ctypes.c_uint8),
        ("if_false", ctypes.c_uint8),
        ("number", ctypes.c_uint32),
    ]


class Program(ctypes.Structure):
    """A seccomp filter."""

    _fields_ = [("length", ctypes.c_uint16), ("first", ctypes.POINTER(Instruction))]


class Ruleset(ctypes.Structure):
    """What Landlock is asked to handle: file rights, TCP rights, which are left to seccomp, and what is kept inside."""

    _fields_ = [("files", ctypes.c_uint64), ("net", ctypes.c_uint64), ("scoped", ctypes.c_uint64)]


class Beneath(ctypes.Structure):
    """The rights below one folder."""

    _pack_ = 1
    _fields_ = [("files", ctypes.c_uint64), ("folder", ctypes.c_int32)]


def confine(order: dict[str, Any]) -> dict[str, Any]:
    """Runs the order's program to its end, or to the first limit.

    Returns:
        `code`, `stdout` and `stderr` (text in which a byte that is not UTF-8 is a lone surrogate), and `stopped`:
        the limit that ended it, else "".
    """
    libc = ctypes.CDLL(None, use_errno=True)
    if LINUX:
        libc.prctl(PR_SET_CHILD_SUBREAPER, 1, 0, 0, 0)
        libc.prctl(PR_SET_PDEATHSIG, signal.SIGTERM, 0, 0, 0)
    with Fork(libc, order) if order.get("script") else _started(libc, order) as process:
        try:
            said, stopped = _watch(process, order)
        finally:
            _end(process)
    made = {name: bytes(text).decode("utf-8", "surrogateescape") for name, text in said.items()}
    return {**made, "code": process.returncode, "stopped": stopped}


def _started(libc: Any, order: dict[str, Any]) -> subprocess.Popen[bytes]:
    return subprocess.Popen(
        order["command"],
        cwd=order["folder"],
        env=order["environment"],
        stdin=subprocess.PIPE,
        stdout=subprocess.PIPE,
        stderr=subprocess.PIPE,
        start_new_session=True,
        preexec_fn=lambda: _before(libc, order),  # noqa: PLW1509 (there are no threads)
    )


class Fork:
    """A fork of this process that runs the order's Python script; what it has in common with `Popen` is as there."""

    def __init__(self, libc: Any, order: dict[str, Any]) -> None:
        pipes = [os.pipe() for _ in range(3)]
        theirs = (pipes[0][0], pipes[1][1], pipes[2][1])
        self.returncode: int | None = None
        self.pid = os.fork()
        if not self.pid:
            os._exit(_script(libc, order, theirs))
        for end in theirs:
            os.close(end)
        self.stdin = os.fdopen(pipes[0][1], "wb", 0)
        self.stdout, self.stderr = (os.fdopen(pipe[0], "rb", 0) for pipe in pipes[1:])

    def __enter__(self) -> Fork:
        return self

    def __exit__(self, *_: object) -> None:
        for pipe in (self.stdin, self.stdout, self.stderr):
            pipe.close()

    def poll(self) -> int | None:
        """The exit code once it has ended, negative for a signal; None while it runs."""
        return self._waited(os.WNOHANG)

    def wait(self) -> int | None:
        """Its exit code, when it has ended."""
        return self._waited(0)

    def _waited(self, how: int) -> int | None:
        if self.returncode is None:
            pid, status = os.waitpid(self.pid, how)
            if pid:
                self.returncode = os.waitstatus_to_exitcode(status)
        return self.returncode


def _script(libc: Any, order: dict[str, Any], pipes: tuple[int, ...]) -> int:
    """In a fork: runs the order's script as Python would; its exit code."""
    code = 1
    try:
        os.setsid()
        for number, pipe in enumerate(pipes):
            os.dup2(pipe, number)
        os.closerange(3, os.sysconf("SC_OPEN_MAX"))
        signal.signal(signal.SIGTERM, signal.SIG_DFL)
        os.chdir(order["folder"])
        os.environ.clear()
        os.environ.update(order["environment"])
        _before(libc, order)
        sys.argv = [order["script"]]
        sys.path.insert(0, order["folder"])
        runpy.run_path(order["script"], run_name="__main__")
        code = 0
    except SystemExit as error:
        code = error.code if isinstance(error.code, int) else int(error.code is not None)
        if not isinstance(error.code, int | None):
            print(error.code, file=sys.stderr)
    except BaseException:
        traceback.print_exc()
    try:
        atexit._run_exitfuncs()
        sys.stdout.flush()
        sys.stderr.flush()
    except BaseException:
        code = code or 1
    return code & 0xFF


def _before(libc: Any, order: dict[str, Any]) -> None:
    """In the child, before the program: every limit that the kernel keeps."""
    for kind, wanted in (
        (resource.RLIMIT_DATA, order["memory"]),
        (resource.RLIMIT_FSIZE, order["file"]),
        (resource.RLIMIT_CORE, 0),
    ):
        highest = resource.getrlimit(kind)[1]
        limit = wanted if highest == resource.RLIM_INFINITY else min(wanted, highest)
        resource.setrlimit(kind, (limit, limit))
    if LINUX:
        libc.prctl(PR_SET_PDEATHSIG, signal.SIGKILL, 0, 0, 0)
        libc.prctl(PR_SET_NO_NEW_PRIVS, 1, 0, 0, 0)
        _landlock(libc, order["folder"])
        _seccomp(libc)


def landlock_version() -> int:
    """What Landlock of the kernel can do: from 1 on files, from 6 on signals; below 1, it is not there."""
    return int(ctypes.CDLL(None).syscall(LANDLOCK_CREATE, None, 0, 1)) if LINUX else -1


def _landlock(libc: Any, folder: str) -> None:
    """No writing but below `folder`, and signals only among the program's own processes."""
    version = landlock_version()
    if version < 1:
        return
    files = WRITE_FILE | MAKE_OR_REMOVE | (REFER if version >= 2 else 0) | (TRUNCATE if version >= 3 else 0)
    rules = Ruleset(files, 0, 0b11 if version >= 6 else 0)
    ruleset = libc.syscall(LANDLOCK_CREATE, ctypes.byref(rules), ctypes.sizeof(rules), 0)
    devices = [str(path) for pattern in DEVICES for path in Path("/dev").glob(pattern)]
    for path, rights in ((folder, files), *((device, WRITE_FILE) for device in devices)):
        opened = os.open(path, os.O_PATH)
        libc.syscall(LANDLOCK_ADD, ruleset, 1, ctypes.byref(Beneath(rights, opened)), 0)
        os.close(opened)
    if libc.syscall(LANDLOCK_RESTRICT, ruleset, 0):
        raise OSError("Landlock refused its rules")
    os.close(ruleset)


def _seccomp(libc: Any) -> None:
    """No processes but threads, no sockets, no limits for others, no memory that nobody counts."""
    if os.uname().machine not in SYSTEMS:
        return
    system, clone, prlimit, refused = SYSTEMS[os.uname().machine]
    steps = [(LOAD, 0, 0, 4), (EQUAL, 1, 0, system), (RETURN, 0, 0, REFUSE | EPERM)]
    steps += [(LOAD, 0, 0, 0), (AT_LEAST, 0, 1, OTHER_CALLS), (RETURN, 0, 0, REFUSE | EPERM)]
    for call, error in refused.items():
        steps += [(EQUAL, 0, 1, call), (RETURN, 0, 0, REFUSE | error)]
    steps += [(EQUAL, 0, 3, clone), (LOAD, 0, 0, 16), (ANY_BIT, 1, 0, CLONE_THREAD), (RETURN, 0, 0, REFUSE | EPERM)]
    steps += [(EQUAL, 0, 3, prlimit), (LOAD, 0, 0, 16), (EQUAL, 1, 0, 0), (RETURN, 0, 0, REFUSE | EPERM)]  # 0: itself
    steps += [(RETURN, 0, 0, ALLOW)]
    made = (Instruction * len(steps))(*(Instruction(*step) for step in steps))
    if libc.prctl(PR_SET_SECCOMP, SECCOMP_FILTER, ctypes.byref(Program(len(steps), made)), 0, 0):
        raise OSError("seccomp refused its filter")


def _watch(process: subprocess.Popen[bytes] | Fork, order: dict[str, Any]) -> tuple[dict[str, bytearray], str]:
    """What the program printed, and the limit that it broke; reads no more than the limit on output."""
    said = {"stdout": bytearray(), "stderr": bytearray()}
    given = memoryview(order["input"].encode())
    deadline = time.monotonic() + order["seconds"]
    with selectors.DefaultSelector() as ready:
        for name in said:
            ready.register(getattr(process, name), selectors.EVENT_READ, name)
        assert process.stdin is not None
        if given:
            ready.register(process.stdin, selectors.EVENT_WRITE, "stdin")
        else:
            process.stdin.close()
        while process.poll() is None or ready.get_map():
            if process.poll() is not None:
                _end(process)  # what it leaves running holds its output open
            for key, _ in ready.select(TICK):
                if key.data == "stdin":
                    given = _give(key.fd, given)
                    if not given:
                        ready.unregister(process.stdin)
                        process.stdin.close()
                    continue
                part = os.read(key.fd, 1 << 16)
                if not part:
                    ready.unregister(key.fileobj)
                said[key.data] += part
                if len(said[key.data]) > order["output"]:
                    return said, "output"
            if time.monotonic() > deadline:
                return said, "seconds"
            if broken := _excess(order):
                return said, broken
    return said, ""


def _give(pipe: int, text: memoryview) -> memoryview:
    """What is left to write; nothing when the program does not read."""
    try:
        return text[os.write(pipe, text[: 1 << 12]) :]
    except BrokenPipeError:
        return text[:0]


def _excess(order: dict[str, Any]) -> str:
    """The limit that all processes together break."""
    pages = sum(int(_read(f"/proc/{pid}/statm", "0 0").split()[1]) for pid in _descendants())
    return "memory" if pages * resource.getpagesize() > order["memory"] else ""


def _end(process: subprocess.Popen[bytes] | Fork) -> None:
    """Kills the program and everything that came of it."""
    _kill(-process.pid)
    process.wait()
    while left := list(_descendants()):
        for pid in left:
            _kill(pid)
        for pid in left:
            with suppress(ChildProcessError):
                os.waitpid(pid, os.WNOHANG)


def _kill(pid: int) -> None:
    with suppress(ProcessLookupError, PermissionError):
        os.kill(pid, signal.SIGKILL)


def _descendants() -> Iterator[int]:
    """The processes below this one; none where the system does not tell."""
    stack = [os.getpid()]
    while stack:
        parent = stack.pop()
        for task in Path(f"/proc/{parent}/task").glob("*/children") if LINUX else ():
            children = [int(pid) for pid in _read(str(task), "").split()]
            yield from children
            stack += children


def _read(path: str, otherwise: str) -> str:
    try:
        return Path(path).read_text(encoding="ascii") or otherwise
    except OSError:
        return otherwise


def _stop(*_: object) -> None:
    sys.exit(1)


if __name__ == "__main__":
    signal.signal(signal.SIGTERM, _stop)
    if "--keep" in sys.argv:
        import mujoco  # noqa: F401
    for line in sys.stdin:
        print(json.dumps(confine(json.loads(line))), flush=True)
