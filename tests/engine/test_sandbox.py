"""Scripts that hang, print or take gigabytes, crash, or leave something behind."""

from __future__ import annotations

import os
import resource
import select
import signal
import sys
import tempfile
from pathlib import Path
from subprocess import CompletedProcess
from typing import Any

import pytest
from clinic.engine import node, sandbox

linux = pytest.mark.skipif(sys.platform != "linux", reason="only Linux keeps this limit")
with_node = pytest.mark.skipif(node.executable() is None, reason="no Node on this machine")

TELLING = """\
import atexit, os, sys, tempfile
import mujoco
import numpy as np
print(mujoco.__version__, np.random.default_rng(0).normal(), {'a', 'b'})
atexit.register(print, 'at the end')
print(__name__, sys.argv, sys.stdin.read(), os.path.samefile(tempfile.gettempdir(), os.getcwd()))
scene = '<geom size="0.1" pos="0 0 -1"/><light/><camera name="above"/>'
model = mujoco.MjModel.from_xml_string(f'<mujoco><worldbody>{scene}</worldbody></mujoco>')
data = mujoco.MjData(model)
mujoco.mj_forward(model, data)
with mujoco.Renderer(model, 40, 60) as draw:
    draw.update_scene(data, 'above')
    print(draw.render().mean())
"""


def python(code: str, seconds: float = 60.0) -> CompletedProcess[str]:
    return sandbox.run([sys.executable, "script.py"], {"script.py": code}, seconds)


def ended(code: str) -> tuple[int, str, str]:
    done = python(code)
    return done.returncode, done.stdout, done.stderr


def javascript(code: str, seconds: float = 60.0) -> CompletedProcess[str]:
    return sandbox.run([node.executable() or "", "script.mjs"], {"script.mjs": code}, seconds)


@pytest.mark.parametrize(
    "code",
    [
        pytest.param("while True:\n    pass", id="loops"),
        pytest.param("import time\ntime.sleep(1000)", id="sleeps"),
        pytest.param("import os, time\nos.close(1)\nos.close(2)\ntime.sleep(1000)", id="closes-its-output"),
    ],
)
def test_a_script_that_never_ends(code: str) -> None:
    assert python(code, 0.5).returncode == -signal.SIGALRM


@pytest.mark.parametrize("stream", ["stdout", "stderr"])
def test_a_script_that_prints_without_end(stream: str) -> None:
    done = python(f"import sys\nwhile True:\n    sys.{stream}.write('x' * 100_000)")
    assert len(getattr(done, stream)) == sandbox.LIMITS[resource.RLIMIT_FSIZE]


@linux
@pytest.mark.parametrize("code", ["bytearray(3 * 2**30)", "import numpy\nnumpy.ones(2**29)"], ids=["bytes", "numpy"])
def test_a_script_that_takes_gigabytes(code: str) -> None:
    assert "MemoryError" in python(code).stderr.splitlines()[-1]


def test_a_file_that_grows_without_end() -> None:
    done = python("f = open('big', 'wb')\nwhile True:\n    f.write(b'x' * 2**20)")
    assert done.stderr.splitlines()[-1] == "OSError: [Errno 27] File too large"


@with_node
def test_node_under_the_same_limits() -> None:
    assert javascript("for (;;) {}", 1).returncode == -signal.SIGALRM
    assert len(javascript("for (;;) console.error('x'.repeat(1e5));", 3).stderr) > 2**20


@with_node
def test_node_that_takes_gigabytes() -> None:
    assert "out of memory" in javascript("const a = []; for (;;) a.push(new Array(1e6).fill(0.5));").stderr


@linux
@pytest.mark.parametrize("ending", ["", "time.sleep(1000)"], ids=["script-ends", "script-hangs"])
def test_a_child_process_is_ended_with_its_script(ending: str) -> None:
    child = "[sys.executable, '-c', 'import time; time.sleep(1000)']"
    done = python(f"import subprocess, sys, time\nprint(subprocess.Popen({child}).pid, flush=True)\n{ending}", 2)
    assert done.returncode == (-signal.SIGALRM if ending else 0)
    try:
        running = os.pidfd_open(int(done.stdout))
    except ProcessLookupError:
        return
    assert select.select([running], [], [], 60)[0], "it still runs"


def test_nothing_is_left_of_its_folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(tempfile, "tempdir", str(tmp_path))
    done = python("import os\nos.makedirs('a/b')\nopen('a/b/c', 'w').close()\nos.chmod('a', 0)\nprint(os.getcwd())")
    assert Path(done.stdout.strip()).parent.parent == tmp_path
    assert list(tmp_path.iterdir()) == []


def test_its_folder_holds_files_and_links(tmp_path: Path) -> None:
    (tmp_path / "x.txt").write_text("linked", encoding="utf-8")
    code = "print(open('a.txt').read(), open('cases/x/b.txt').read(), open('link/x.txt').read())"
    files = {"script.py": code, "a.txt": "one", "cases/x/b.txt": "two", "link": tmp_path}
    assert sandbox.run([sys.executable, "script.py"], files).stdout == "one two linked\n"


def test_exit_codes_and_signals() -> None:
    assert ended("print('well')") == (0, "well\n", "")
    assert ended("import sys\nsys.exit('no model')") == (1, "", "no model\n")
    assert ended("import sys\nprint('before')\nsys.exit(3)") == (3, "before\n", "")
    assert python("import os\nos.abort()").returncode == -6


def test_output_that_is_not_utf_8_is_replaced() -> None:
    assert python("import os\nos.write(1, b'a\\xffb')").stdout == "a\ufffdb"


def test_a_script_sees_nothing_of_the_environment(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("OMP_NUM_THREADS", "7")
    seen = python("import os\nprint(*sorted(os.environ))\nprint(os.environ['HOME'] == os.getcwd())").stdout
    assert "OMP_NUM_THREADS" not in seen
    assert seen.endswith("True\n")


def test_a_script_has_no_input() -> None:
    assert python("input()").stderr.splitlines()[-1] == "EOFError: EOF when reading a line"


def test_a_script_finds_nothing_of_the_one_before() -> None:
    python("import math, os, sys\nmath.pi = 3\nos.environ['LEFT'] = 'x'\nsys.modules['left'] = sys\nleft = 1")
    code = "import math, os, sys\nprint(math.pi > 3, 'LEFT' in os.environ, 'left' in sys.modules, 'left' in globals())"
    assert python(code).stdout == "True False False False\n"


def test_a_script_prints_the_same_in_a_fork_and_in_a_process_of_its_own() -> None:
    alone = "import subprocess, sys\nsubprocess.run([sys.executable, 'telling.py'], check=True)"
    done = sandbox.run([sys.executable, "script.py"], {"script.py": alone, "telling.py": TELLING})
    assert done.returncode == 0, done.stderr
    assert python(TELLING).stdout == done.stdout.replace("telling.py", "script.py")


def test_the_process_that_starts_scripts_is_replaced_when_it_is_gone() -> None:
    with pytest.raises(ConnectionError, match="run this again"):
        python("import os, signal\nos.kill(os.getppid(), signal.SIGKILL)")
    assert python("print('again')").stdout == "again\n"


def test_an_interrupted_script_leaves_no_answer_to_the_next(monkeypatch: pytest.MonkeyPatch) -> None:
    def send_and_stop(*text: str, **options: Any) -> None:
        print(*text, **options)
        raise KeyboardInterrupt

    with monkeypatch.context() as patch:
        patch.setattr(sandbox, "print", send_and_stop, raising=False)
        with pytest.raises(KeyboardInterrupt):
            python("raise SystemExit(5)")
    assert ended("print('next')") == (0, "next\n", "")
