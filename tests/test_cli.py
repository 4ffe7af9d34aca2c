"""The command `clinic`."""

from __future__ import annotations

import os
import subprocess
import sys
from pathlib import Path

import pytest
from clinic import cli
from clinic.cli import app
from clinic.reference import reference
from helpers import RECORD, changed, write_script_case
from typer.testing import CliRunner, Result


@pytest.fixture
def project(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """A project with a script case, and the working directory inside of it."""
    (tmp_path / "pyproject.toml").touch()
    write_script_case(tmp_path)
    (tmp_path / "docs").mkdir()
    monkeypatch.chdir(tmp_path / "docs")
    monkeypatch.setenv("CLINIC_JOBS", "1")
    return tmp_path


def run(*arguments: str) -> Result:
    return CliRunner().invoke(app, list(arguments))


def main_with(monkeypatch: pytest.MonkeyPatch, *arguments: str) -> object:
    """What `main` passes to sys.exit."""
    monkeypatch.setattr(sys, "argv", ["clinic", *arguments])
    with pytest.raises(SystemExit) as caught:
        cli.main()
    return caught.value.code


@pytest.mark.usefixtures("project")
@pytest.mark.parametrize("arguments", [("check",), ("check", "odd-script")], ids=["all", "one"])
def test_check_of_a_sound_case(arguments: tuple[str, ...]) -> None:
    result = run(*arguments)
    assert result.exit_code == 0, result.output
    assert "2. A script prints an error" in result.stdout
    assert "no-error" in result.stdout
    assert result.stderr == ""


def test_check_of_a_case_that_breaks_a_law(project: Path) -> None:
    record = project / "cases" / "odd-script" / "case.yaml"
    record.write_text(changed(record.read_text(encoding="utf-8"), ("above: 0.1", "below: 0.1")), encoding="utf-8")

    result = run("check", "odd-script")

    assert result.exit_code == 1
    assert result.stderr.splitlines() == [
        "case 2 odd-script: broken: error (final) measured 0.500000\u00a0m, expected below 0.1 m; correct the bound of "
        "checks.broken, the edits, or the model",
        "case 2 odd-script: no-error: passes every check of `broken` too; tighten one until the repair fails it",
    ]


def test_check_keeps_its_work_in_the_project(project: Path) -> None:
    run("check")
    assert list((project / ".cache" / "clinic").iterdir())


def test_mistake_of_an_author_ends_with_its_message(project: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    record = project / "cases" / "odd-script" / "case.yaml"
    record.write_text(changed(record.read_text(encoding="utf-8"), ("number: 2", "number: two")), encoding="utf-8")

    message = main_with(monkeypatch, "check")

    assert isinstance(message, str)
    assert message.startswith('cases/odd-script/case.yaml:1: number\n  found:    "two"\n')


def test_case_that_does_not_exist_is_named_with_the_closest(project: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    assert main_with(monkeypatch, "check", "old-script") == (
        "cases/old-script:1:\n"
        "  found:    no folder old-script\n"
        "  expected: the folder of a case: odd-script\n"
        "  repair:   write odd-script"
    )


def test_outside_a_project(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)
    assert main_with(monkeypatch, "check") == f"clinic: no folder with cases/ and pyproject.toml at or above {tmp_path}"


def test_reference_is_printed() -> None:
    result = run("reference")
    assert result.exit_code == 0
    assert result.stdout == reference() + "\n"


def test_help_names_the_commands() -> None:
    result = run("--help")
    assert result.exit_code == 0
    assert [name for name in ("build", "check", "reference") if name not in result.stdout] == []


def test_build_writes_generated_pages_beside_those_written_by_hand(project: Path, tmp_path: Path) -> None:
    (project / "docs" / "triage.md").write_text("# Triage\n\n```python run\nprint(6 * 7)\n```\n", encoding="utf-8")
    (project / "docs" / "about.md").write_text("# About\n", encoding="utf-8")
    (project / "CONTRIBUTING.md").write_text("# Add a case\n", encoding="utf-8")
    out = tmp_path / "out"
    out.mkdir()
    (out / "stale.md").touch()

    result = run("build", "--out", str(out))

    assert result.exit_code == 0, result.output
    assert "\n42\n" in (out / "triage.md").read_text(encoding="utf-8")
    assert (out / "about.md").is_file()
    assert not (out / "stale.md").exists()
    assert "# 2. A script prints an error" in (out / "cases/odd-script/index.md").read_text(encoding="utf-8")
    assert (out / "cases/odd-script/script.py").read_bytes() == (project / "cases/odd-script/script.py").read_bytes()


def test_build_does_not_delete_what_it_needs(project: Path) -> None:
    (project / "docs" / "triage.md").touch()
    (project / "CONTRIBUTING.md").touch()
    for folder in (project, project / "docs", project / "cases"):
        assert run("build", "--out", str(folder)).exit_code != 0
    assert (project / "cases" / "odd-script" / "script.py").is_file()
    assert (project / "docs" / "triage.md").is_file()


def test_the_module_is_the_command(project: Path) -> None:
    (project / "cases" / "odd-script" / "case.yaml").write_text(changed(RECORD, ("number: 1", "number: 0")), "utf-8")
    done = subprocess.run(
        [sys.executable, "-m", "clinic", "check"],
        cwd=project,
        env=os.environ,
        check=False,
        capture_output=True,
        text=True,
    )
    assert done.returncode == 1
    assert done.stderr.startswith("cases/odd-script/case.yaml:1: number\n")
    assert "Traceback" not in done.stderr
