"""Python in a process of its own."""

from __future__ import annotations

import math
import os
import signal
import subprocess
import sys
from pathlib import Path

import pytest
from clinic.engine.limits import Limits, run, written
from clinic.engine.script import Output, ScriptError, run_python


@pytest.mark.parametrize(
    ("line", "name", "value"),
    [
        pytest.param("error = 1.5", "error", 1.5, id="plain"),
        pytest.param("error=-2", "error", -2, id="without-spaces"),
        pytest.param("  tip error = +3.25e-02 m", "tip error", 0.0325, id="with-unit-and-exponent"),
        pytest.param("error = .5", "error", 0.5, id="without-a-zero"),
        pytest.param("error = 2.", "error", 2, id="without-decimals"),
        pytest.param("error = 7, of 8", "error", 7, id="with-more-behind"),
        pytest.param("after 3 steps = 7", "after 3 steps", 7, id="digits-in-the-name"),
        pytest.param("angle (upper, lower) = 0", "angle (upper, lower)", 0, id="parentheses-in-the-name"),
    ],
)
def test_printed_number(line: str, name: str, value: float) -> None:
    traces = Output(f"before\n{line}\nafter\n").traces()
    assert {key: trace.value.tolist() for key, trace in traces.items()} == {name: [value]}


@pytest.mark.parametrize(
    "line",
    [
        pytest.param("error 1.5", id="no-equals"),
        pytest.param("error == 1.5", id="comparison"),
        pytest.param("error = about 1.5", id="text"),
        pytest.param("error = [1.5]", id="list"),
        pytest.param("Error = 1.5", id="capital"),
        pytest.param("error = 10ms", id="whole-number-that-runs-into-a-word"),
        pytest.param("error = 1.5ms", id="number-that-runs-into-a-word"),
        pytest.param("version = 4.0.1", id="version"),
        pytest.param("= 1.5", id="no-name"),
    ],
)
def test_no_printed_number(line: str) -> None:
    assert Output(line).traces() == {}


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


def test_a_name_printed_again_gives_another_sample() -> None:
    traces = Output("x = 1\ny = 5\nx = 2\nx = 4\n").traces()
    assert traces["x"].value.tolist() == [1, 2, 4]
    assert traces["x"].time.tolist() == [0, 1, 2]
    assert traces["y"].value.tolist() == [5]


def test_output_is_what_was_printed_to_stdout() -> None:
    assert run_python("import sys\nprint('héllo')\nprint('no', file=sys.stderr)", {}).text == "héllo\n"


def test_files_lie_beside_the_script() -> None:
    code = "print(open('a.txt').read(), open('cases/x/b.txt').read())"
    assert run_python(code, {"a.txt": "one", "cases/x/b.txt": "two"}).text == "one two\n"


def test_code_stands_in_for_the_file_of_its_name() -> None:
    code = "print(open('script.py').read() == 'x')"
    assert run_python(code, {"script.py": "x"}).text == "False\n"


def test_order_of_sets_is_the_same_every_time() -> None:
    code = "print({'one', 'two', 'three', 'four', 'five'})"
    assert len({run_python(code, {}).text for _ in range(3)}) == 1


def test_nothing_is_left_of_its_folder() -> None:
    folder = run_python("import os\nopen('made.txt', 'w').close()\nprint(os.getcwd())", {}).text.strip()
    check = run_python(f"import os\nprint(os.path.exists({folder!r}))", {}).text
    assert check == "False\n"


@pytest.mark.parametrize(
    ("code", "found"),
    [
        pytest.param(
            "def f():\n    raise KeyError('x')\n\nf()", "KeyError: 'x' (line 2 of script.py)", id="raises-in-a-function"
        ),
        pytest.param("x = 1\nraise ValueError('too big')", "ValueError: too big (line 2 of script.py)", id="raises"),
        pytest.param(
            "import json\n\njson.loads('x')",
            "json.decoder.JSONDecodeError: Expecting value: line 1 column 1 (char 0) (line 3 of script.py)",
            id="raises-in-a-library",
        ),
        pytest.param("x = (", "SyntaxError: '(' was never closed (line 1 of script.py)", id="syntax"),
        pytest.param("import sys\nsys.exit('no model')", "no model", id="exits-with-a-message"),
        pytest.param("import sys\nsys.exit(3)", "exit code 3", id="exits-with-a-code"),
        pytest.param("import os\nos.kill(os.getpid(), 9)", "exit code -9", id="is-killed"),
    ],
)
def test_script_that_does_not_end_well(code: str, found: str) -> None:
    with pytest.raises(ScriptError) as caught:
        run_python(code, {})
    assert caught.value.found == found
    assert caught.value.repair == "run it by hand and mend it"


def test_script_that_does_not_end() -> None:
    with pytest.raises(ScriptError) as caught:
        run_python("while True:\n    pass", {}, time_limit=0.2)
    assert (caught.value.found, caught.value.repair) == ("still running after 0.2 s", "bound its loops by steps")


def test_script_has_no_input_even_where_there_is_some() -> None:
    outer = "from clinic.script import run_python\nprint(run_python('import sys; print(sys.stdin.read())', {}).text)"
    done = subprocess.run([sys.executable, "-c", outer], input="typed", check=True, capture_output=True, text=True)
    assert done.stdout.strip() == ""


def test_numbers_survive_printing() -> None:
    assert run_python("import math\nprint('pi =', repr(math.pi))", {}).traces()["pi"].value[0] == math.pi


def test_a_script_finds_nothing_of_the_one_before() -> None:
    run_python("import math, os, sys\nmath.pi = 3\nos.environ['LEFT'] = 'x'\nsys.modules['left'] = sys\nleft = 1", {})
    seen = run_python(
        "import math, os, sys\nprint(math.pi, 'LEFT' in os.environ, 'left' in sys.modules, 'left' in globals())", {}
    )
    assert seen.text == f"{math.pi} False False False\n"


def test_a_script_prints_the_same_alone_and_in_a_process_that_stays() -> None:
    with written({"script.py": TELLING}) as folder:
        alone = run([sys.executable, "script.py"], Path(folder), Limits())
    assert alone.code == 0, alone.stderr
    assert run_python(TELLING, {}).text == alone.stdout


def test_folders_in_folders_by_the_thousand_are_deleted() -> None:
    with written({}) as folder:
        run_in = "import os\nfor _ in range(3000):\n    os.mkdir('d')\n    os.chdir('d')\n"
        subprocess.run([sys.executable, "-c", run_in], cwd=folder, check=True)
    assert not os.path.lexists(folder)


@pytest.mark.skipif(sys.platform != "linux", reason="no process stays elsewhere")
def test_a_process_that_stays_is_replaced_when_it_is_gone() -> None:
    parent = "import os\nprint(os.getppid())"
    first = int(run_python(parent, {}).text)
    assert int(run_python(parent, {}).text) == first
    os.kill(first, signal.SIGKILL)
    assert int(run_python(parent, {}).text) != first
