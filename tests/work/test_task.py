"""Tasks: what is not kept is done, and many of them are told of."""

from __future__ import annotations

import logging
from collections.abc import Callable
from pathlib import Path

import pytest
from clinic.work.cache import Cache, Files
from clinic.work.task import MANY, Task, run_tasks


@pytest.fixture(autouse=True)
def alone(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("CLINIC_JOBS", "1")


def tasks(count: int, make: Callable[[], Files] = dict) -> list[Task]:
    return [Task(f"case-{k}", "kind", f"key-{k}", make) for k in range(count)]


def test_many_parts_are_counted_while_they_are_made(tmp_path: Path, caplog: pytest.LogCaptureFixture) -> None:
    caplog.set_level(logging.INFO, "mkdocs.clinic")
    run_tasks(tasks(2 * MANY), Cache(tmp_path))
    assert caplog.messages[0].startswith(f"kind of {2 * MANY} cases: ")
    assert caplog.messages[1:] == [f"{MANY} of {2 * MANY} parts are made", f"{2 * MANY} of {2 * MANY} parts are made"]


def test_few_parts_are_made_in_silence(tmp_path: Path, caplog: pytest.LogCaptureFixture) -> None:
    caplog.set_level(logging.INFO, "mkdocs.clinic")
    run_tasks(tasks(MANY - 1), Cache(tmp_path))
    run_tasks(tasks(MANY - 1), Cache(tmp_path))
    assert caplog.messages == []


def test_what_is_kept_is_not_made(tmp_path: Path) -> None:
    made = run_tasks(tasks(2, lambda: {"a": b"made"}), Cache(tmp_path))

    def make() -> Files:
        raise AssertionError("made again")

    assert (
        run_tasks(tasks(2, make), Cache(tmp_path)) == made == ({"case-0": {"a": b"made"}, "case-1": {"a": b"made"}}, [])
    )
