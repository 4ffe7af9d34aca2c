"""Code that makes MuJoCo speak, each piece in a process of its own."""

from __future__ import annotations

from clinic.engine.provoke import provoked, tidied


def test_exceptions_warnings_and_prints_are_heard() -> None:
    said = provoked(
        {
            "error": "load('<mujoco/')",
            "print": "print('hello')",
            "warning": "import sys; print('WARNING: oh', file=sys.stderr)",
            "silence": "",
        }
    )
    assert said["error"].startswith("ValueError: XML parse error")
    assert said["print"] == "hello"
    assert said["warning"] == "WARNING: oh"
    assert said["silence"] == ""


def test_a_crash_is_heard_and_ends_nothing_else() -> None:
    said = provoked({"crash": "print('before', flush=True); import os; os.abort()", "after": "print('here')"})
    assert said == {"crash": "before\nended by signal 6", "after": "here"}


def test_a_process_that_hangs_is_ended() -> None:
    said = provoked({"hang": "import signal; signal.alarm(1)\nwhile True: pass"})
    assert said == {"hang": "ended by signal 14"}


def test_pieces_do_not_share_a_folder_or_names() -> None:
    said = provoked(
        {"one": "x = 1; open('file', 'w').write('x')", "two": "import os; print(os.listdir(), 'x' in globals())"}
    )
    assert said["two"] == "['said.txt'] False"


def test_addresses_and_long_tails_are_left_out() -> None:
    assert tidied("<object at 0x7f3704c2e070>\n\n" + "line\n" * 20) == "<object at 0x…>" + "\nline" * 5
