"""Code that makes MuJoCo speak, each piece in a process of its own."""

from __future__ import annotations

import pytest
from clinic.engine.provoke import provoke, tidied


def test_exceptions_warnings_and_prints_are_heard() -> None:
    said = provoke(
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
    said = provoke({"crash": "print('before', flush=True); import os; os.abort()", "after": "print('here')"})
    assert said == {"crash": "before\nended by signal 6", "after": "here"}


def test_a_process_that_hangs_is_ended(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("clinic.engine.provoke.SECONDS", 0.5)
    assert provoke({"hang": "while True: pass"}) == {"hang": "ended by signal 14"}


def test_pieces_do_not_share_a_folder_or_names() -> None:
    said = provoke(
        {"one": "x = 1; open('f', 'w').close()", "two": "import os; print(os.path.exists('f'), 'x' in globals())"}
    )
    assert said["two"] == "False False"


def test_addresses_and_long_tails_are_left_out() -> None:
    many = "".join(f"line {i}\n" for i in range(20))
    assert tidied("<object at 0x7f3704c2e070>\n\n" + many).splitlines() == ["<object at 0x…>", *many.splitlines()[:5]]


def test_a_warning_that_is_said_twice_is_heard_once() -> None:
    assert tidied("WARNING: singular\n\nWARNING: singular\nmore\n") == "WARNING: singular\nmore"
