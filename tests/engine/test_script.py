"""Scripts run, and the numbers that they print."""

from __future__ import annotations

import pytest
from clinic.engine import node
from clinic.engine.script import ScriptError, printed_numbers, run_script


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
    traces = printed_numbers(f"before\n{line}\nafter\n")
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
    assert printed_numbers(line) == {}


def test_a_name_printed_again_gives_another_sample() -> None:
    traces = printed_numbers("x = 1\ny = 5\nx = 2\nx = 4\n")
    assert traces["x"].value.tolist() == [1, 2, 4]
    assert traces["x"].time.tolist() == [0, 1, 2]
    assert traces["y"].value.tolist() == [5]


def test_output_is_what_was_printed_to_stdout() -> None:
    assert run_script("import sys\nprint('héllo')\nprint('no', file=sys.stderr)", {}) == "héllo\n"


def test_code_stands_in_for_the_file_of_its_name() -> None:
    code = "print(open('script.py').read() == 'x')"
    assert run_script(code, {"script.py": "x"}) == "False\n"


def test_order_of_sets_is_the_same_every_time() -> None:
    code = "print({'one', 'two', 'three', 'four', 'five'})"
    assert len({run_script(code, {}) for _ in range(3)}) == 1


@pytest.mark.parametrize(
    ("code", "found"),
    [
        pytest.param(
            "def f():\n    raise KeyError('x')\n\nf()", "KeyError: 'x' (line 2 of script.py)", id="raises-in-a-function"
        ),
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
        run_script(code, {})
    assert (caught.value.found, caught.value.repair) == (found, "run it by hand and mend it")


@pytest.mark.skipif(node.executable() is None, reason="no Node on this machine")
@pytest.mark.parametrize(
    ("code", "found"),
    [
        pytest.param(
            "const x = 1;\nthrow new Error('no model');", "Error: no model (line 2 of script.mjs)", id="throws"
        ),
        pytest.param("const x = ;", "SyntaxError: Unexpected token ';' (line 1 of script.mjs)", id="syntax"),
        pytest.param("process.exit(3);", "exit code 3", id="exits-with-a-code"),
    ],
)
def test_script_in_javascript_that_does_not_end_well(code: str, found: str) -> None:
    with pytest.raises(ScriptError) as caught:
        run_script(code, {}, name="script.mjs")
    assert caught.value.found == found


@pytest.mark.parametrize(
    ("code", "found", "repair"),
    [
        pytest.param("while True:\n    pass", "still running after 0.5 s", "bound its loops by steps", id="time"),
        pytest.param(
            "print('x' * 300_000)",
            "prints more than 256000 characters",
            "print what the page shows, not every step",
            id="output",
        ),
    ],
)
def test_script_that_goes_beyond_a_limit(code: str, found: str, repair: str) -> None:
    with pytest.raises(ScriptError) as caught:
        run_script(code, {}, seconds=0.5)
    assert (caught.value.found, caught.value.repair) == (found, repair)


def test_without_node_a_script_in_javascript_says_so(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(node, "executable", lambda: None)
    with pytest.raises(ScriptError, match="no Node on this machine"):
        run_script("", {}, name="script.mjs")


def test_a_script_that_takes_too_much_memory_is_told_how_much_it_may():
    with pytest.raises(
        ScriptError, match=r"MemoryError \(line 1 of script.py\); a script may take 2,048 MiB of memory"
    ):
        run_script("x = bytearray(3 * 2**30)\n", {})
