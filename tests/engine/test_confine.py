"""Scripts that hang, fork, print or take gigabytes, or reach outside: each ended or refused with one message."""

from __future__ import annotations

import json
import subprocess
import sys
from dataclasses import asdict
from pathlib import Path

import pytest
from clinic.engine import confine, node
from clinic.engine.limits import Limits
from clinic.engine.script import ScriptError, run_node, run_python

kernel = pytest.mark.skipif(confine.landlock_version() < 1, reason="the kernel has no Landlock")


@pytest.fixture
def outside(tmp_path: Path) -> Path:
    """A file that no script may touch."""
    made = tmp_path / "outside.txt"
    made.write_text("whole", encoding="utf-8")
    return made


def refusal(code: str, time_limit: float = 60.0) -> str:
    with pytest.raises(ScriptError) as caught:
        run_python(code, {}, time_limit=time_limit)
    return caught.value.found


@pytest.mark.parametrize(
    "code",
    [
        pytest.param("while True:\n    pass", id="loops"),
        pytest.param("import time\ntime.sleep(1000)", id="sleeps"),
        pytest.param("import os, time\nos.close(1)\nos.close(2)\ntime.sleep(1000)", id="closes-its-output"),
        pytest.param(
            "import signal, time\nsignal.signal(signal.SIGTERM, signal.SIG_IGN)\ntime.sleep(1000)", id="is-deaf"
        ),
    ],
)
def test_a_script_that_hangs(code: str) -> None:
    assert refusal(code, 0.5) == "still running after 0.5 s"


def test_the_time_limit_is_read_when_a_script_runs(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("clinic.engine.script.TIME_LIMIT", 0.5)
    with pytest.raises(ScriptError, match=r"still running after 0\.5 s"):
        run_python("while True:\n    pass", {})


@pytest.mark.parametrize("stream", ["stdout", "stderr"])
def test_a_script_that_prints_without_end(stream: str) -> None:
    assert refusal(f"import sys\nwhile True:\n    sys.{stream}.write('x' * 10000)") == "prints more than 256000 bytes"


@pytest.mark.parametrize(
    ("code", "found"),
    [
        pytest.param("print('a')\nprint('b\\0')", "it prints the character U+0000 on line 2 of its output", id="nul"),
        pytest.param(
            "import os\nos.write(1, b'\\xff')", "it prints the character U+DCFF on line 1 of its output", id="bytes"
        ),
    ],
)
def test_a_script_that_prints_no_text(code: str, found: str) -> None:
    assert refusal(code) == found


def test_a_long_line_that_is_no_number_is_read_once() -> None:
    assert run_python("print('a' + ' ' * 200_000)", {}).traces() == {}


@pytest.mark.skipif(not confine.LINUX, reason="only Linux limits memory")
@pytest.mark.parametrize(
    ("code", "found"),
    [
        pytest.param("bytearray(3 * 2**30)", "MemoryError (line 1 of script.py)", id="at-once"),
        pytest.param("import numpy\nnumpy.ones(2**29)", None, id="numpy"),
    ],
)
def test_a_script_that_takes_gigabytes(code: str, found: str | None) -> None:
    said = refusal(code)
    assert said == found or (found is None and "Unable to allocate" in said)


@pytest.mark.skipif(not confine.LINUX, reason="only Linux counts shared memory")
def test_a_script_that_shares_gigabytes() -> None:
    code = "import mmap\na = mmap.mmap(-1, 4 * 2**30)\nwhile True:\n    a.write(b'x' * 2**26)\n"
    assert refusal(code) == "uses more than 2048 MiB of memory"


def test_a_file_that_grows_without_end() -> None:
    code = "f = open('big', 'wb')\nwhile True:\n    f.write(b'x' * 2**20)"
    assert refusal(code) == "OSError: [Errno 27] File too large (line 3 of script.py)"


@pytest.mark.skipif(not confine.LINUX, reason="only Linux refuses processes")
@pytest.mark.parametrize(
    "act",
    [
        "while True:\n    os.fork()",
        "os.fork() or (os.setsid(), os.fork(), os.environ.clear(), time.sleep(1000))",
        "subprocess.Popen([sys.executable, '-c', 'import time; time.sleep(1000)'], start_new_session=True)",
        "os.posix_spawn('/bin/true', ['true'], {})",
        "os.kill(os.getppid(), 9)",
    ],
)
def test_a_script_that_forks(act: str) -> None:
    assert "not permitted" in refusal(f"import os, subprocess, sys, time\n{act}")


@pytest.mark.skipif(not confine.LINUX, reason="only Linux tells of a process's descendants")
@pytest.mark.parametrize("detached", [True, False])
@pytest.mark.parametrize("ending", ["", "time.sleep(1000)"])
def test_children_end_with_their_script_where_no_filter_is_known(tmp_path: Path, detached: bool, ending: str) -> None:
    child = "import time; time.sleep(1000)"
    start = f"subprocess.Popen([sys.executable, '-c', {child!r}], start_new_session={detached}, env={{}})"
    order = {
        "command": [sys.executable, "-c", f"import subprocess, sys, time; {start}; {ending}"],
        "folder": str(tmp_path),
        "environment": {},
        "input": "",
        **asdict(Limits(seconds=1)),
    }
    code = f"from clinic import confine; confine.SYSTEMS = {{}}; print(confine.confine({order!r})['stopped'])"
    done = subprocess.run([sys.executable, "-c", code], check=True, capture_output=True, text=True)
    assert done.stdout.strip() == ("seconds" if ending else "")
    assert [cwd for cwd in Path("/proc").glob("[0-9]*/cwd") if _target(cwd) == str(tmp_path)] == []


def _target(link: Path) -> str:
    try:
        return str(link.readlink())
    except OSError:
        return ""


@kernel
@pytest.mark.parametrize(
    "act",
    [
        "open({path!r}, 'w')",
        "open({path!r}, 'a')",
        "open({path!r} + '.new', 'w')",
        "os.remove({path!r})",
        "os.rename({path!r}, 'mine')",
        "os.truncate({path!r}, 0)",
        "os.mkdir({path!r} + '.d')",
        "os.symlink('x', {path!r} + '.l')",
        "os.symlink({path!r}, 'l'); open('l', 'a')",
        "os.link({path!r}, 'l'); open('l', 'a')",
        "os.execvp('sh', ['sh', '-c', 'echo x > ' + {path!r}])",
    ],
)
def test_a_script_that_writes_elsewhere(outside: Path, act: str) -> None:
    said = refusal(f"import os, subprocess\n{act.format(path=str(outside))}")
    assert "Permission denied" in said or "cross-device" in said
    assert outside.read_text(encoding="utf-8") == "whole"
    assert list(outside.parent.iterdir()) == [outside]


@pytest.mark.skipif(not confine.LINUX, reason="only Linux refuses sockets")
@pytest.mark.parametrize(
    "act",
    [
        "socket.create_connection(('127.0.0.1', 9))",
        "socket.socket().bind(('127.0.0.1', 0))",
        "socket.socket(socket.AF_INET, socket.SOCK_DGRAM)",
        "socket.socket(socket.AF_UNIX)",
    ],
)
def test_a_script_that_opens_a_socket(act: str) -> None:
    assert "not permitted" in refusal(f"import socket\n{act}")


@pytest.mark.skipif(not confine.LINUX, reason="only Linux refuses these calls")
@pytest.mark.parametrize(
    "act",
    [
        "resource.prlimit(os.getppid(), resource.RLIMIT_CPU, (1, 1))",
        "os.setpriority(os.PRIO_PROCESS, os.getppid(), 19)",
        "os.sched_setaffinity(os.getppid(), {0})",
        "os.memfd_create('beside')",
        "assert libc.shmget(0x7E57C1, 1 << 20, 0o1666) != -1, os.strerror(ctypes.get_errno())",
        "assert libc.semget(0x7E57C1, 1, 0o1666) != -1, os.strerror(ctypes.get_errno())",
        "assert libc.msgget(0x7E57C1, 0o1666) != -1, os.strerror(ctypes.get_errno())",
    ],
)
def test_a_script_that_reaches_for_other_processes_or_memory_beside_its_own(act: str) -> None:
    said = refusal(f"import ctypes, os, resource\nlibc = ctypes.CDLL(None, use_errno=True)\n{act}")
    assert "not permitted" in said or "not implemented" in said


@pytest.mark.skipif(not confine.LINUX, reason="only Linux refuses these calls")
def test_a_script_may_limit_itself() -> None:
    code = "import resource\nresource.setrlimit(resource.RLIMIT_NOFILE, (64, 64))\nprint('x =', 1)"
    assert run_python(code, {}).text.split() == ["x", "=", "1"]


def test_what_a_script_says_at_its_end_is_short_and_without_controls() -> None:
    said = refusal('raise ValueError("\\x1b]0;pwn\\x07\\u202e" + 100_000 * "A")')
    assert said.startswith("ValueError: ]0;pwnAAA")
    assert len(said) < 400


def test_a_script_sees_nothing_of_the_environment(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("A_SECRET_TOKEN", "x")
    seen = run_python("import os\nprint(*sorted(os.environ))\nprint(os.environ['HOME'] == os.getcwd())", {}).text
    assert "A_SECRET_TOKEN" not in seen
    assert seen.endswith("True\n")


def test_a_script_has_no_input() -> None:
    assert refusal("input()") == "EOFError: EOF when reading a line (line 1 of script.py)"


@kernel
@pytest.mark.skipif(node.program() is None, reason="no Node on this machine")
@pytest.mark.parametrize(
    ("code", "found"),
    [
        pytest.param("import fs from 'fs';\nfs.writeFileSync(PATH, 'x');", "permission denied", id="writes-elsewhere"),
        pytest.param("for (;;) {}", "still running after 3 s", id="loops"),
        pytest.param(
            "for (;;) { console.error('x'.repeat(1e5)); await new Promise(setImmediate); }",
            "prints more than 256000 bytes",
            id="prints",
        ),
        pytest.param("import net from 'net';\nnet.connect(9, '127.0.0.1');", "EPERM", id="opens-a-socket"),
    ],
)
def test_node_under_the_same_limits(outside: Path, code: str, found: str) -> None:
    with pytest.raises(ScriptError) as caught:
        run_node(code.replace("PATH", json.dumps(str(outside))), {}, time_limit=3 if code == "for (;;) {}" else 60)
    assert found in caught.value.found
    assert outside.read_text(encoding="utf-8") == "whole"
