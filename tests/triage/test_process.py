"""Triage in a process of its own: the report comes out whatever the process does."""

from __future__ import annotations

import sys
from pathlib import Path

import pytest
from clinic.record.problem import CaseError
from clinic.triage.process import MARK, reports
from clinic.triage.steps import STEPS
from helpers import BALL

READ = f"print({MARK!r} + '{{\"reports\": []}}', flush=True)\n"
SAID = f'print({MARK!r} + \'{{"reports": ["1. warnings"]}}\', flush=True)\n'


def child(code: str) -> tuple[str, ...]:
    return (sys.executable, "-c", code)


@pytest.fixture
def model(tmp_path: Path) -> Path:
    path = tmp_path / "ball.xml"
    path.write_text(BALL, encoding="utf-8")
    return path


def test_a_model_is_reported_step_by_step(model: Path) -> None:
    made = list(reports(model))
    assert [text[:2] for text in made] == [f"{n}." for n in range(1, len(STEPS) + 1)]


def test_problems_come_through(tmp_path: Path) -> None:
    with pytest.raises(CaseError, match="no such file"):
        list(reports(tmp_path / "none.xml"))


def test_a_process_that_crashes_is_told_with_the_step(model: Path) -> None:
    crash = child(f"print('noise')\n{READ}{SAID}import os; os.abort()")
    made = reports(model, child=crash)
    assert next(made) == "1. warnings"
    with pytest.raises(CaseError, match=r"MuJoCo ended the process \(exit code -6\), at: the model as compiled"):
        next(made)


def test_a_process_that_hangs_is_stopped(model: Path) -> None:
    hang = child(f"import time\n{READ}time.sleep(600)")
    with pytest.raises(CaseError, match=r"no answer within 0\.5 s, at: MuJoCo's warnings"):
        list(reports(model, limit=0.5, child=hang))


def test_a_mistake_in_the_examination_is_named_as_one(model: Path) -> None:
    code = "import sys\nfrom pathlib import Path\nfrom clinic.triage import process\n"
    code += "process.subject_of = lambda path: 1 / 0\n"
    with pytest.raises(CaseError, match="ZeroDivisionError: division by zero"):
        list(reports(model, child=child(f"{code}process.main(Path(sys.argv[1]))")))


def test_a_process_that_cannot_read_the_model(model: Path) -> None:
    with pytest.raises(CaseError, match="at: reading the model"):
        list(reports(model, child=child("raise SystemExit(3)")))
