"""The command `clinic`."""

from __future__ import annotations

import json
import os
import re
import subprocess
import sys
from pathlib import Path
from types import SimpleNamespace

import pytest
from clinic.commands import cli
from clinic.commands.cli import app
from clinic.pages.reference import reference
from clinic.pages.schema import FILE, schema_text
from clinic.record.families import families
from helpers import RECORD, changed, write_case, write_script_case
from typer.testing import CliRunner, Result

FOUND = ("tags: [code]", "tags: [code]\nfamily: wrong-numbers")


@pytest.fixture
def project(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """A project with a script case, and the working directory inside of it."""
    (tmp_path / "pyproject.toml").touch()
    write_script_case(tmp_path, FOUND)
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
def test_check_is_a_row_for_each_case_and_shows_every_check_of_one_that_is_named() -> None:
    every, named = run("check"), run("check", "odd-script")
    for result in (every, named):
        assert result.exit_code == 0, result.output
        assert re.search(r"2 │ odd-script │ 2 +│ 4 +│ sound", result.stdout)
        assert result.stderr == ""
    assert "error, last printed: above 0.1 m" not in every.stdout
    assert "error, last printed: above 0.1 m" in named.stdout


def test_check_of_a_case_that_breaks_a_law(project: Path) -> None:
    record = project / "cases" / "odd-script" / "case.yaml"
    record.write_text(changed(record.read_text(encoding="utf-8"), ("above: 0.1", "below: 0.1")), encoding="utf-8")

    result = run("check", "odd-script")

    assert result.exit_code == 1
    assert "2 broken laws" in result.stdout
    assert result.stderr.splitlines() == [
        "cases/odd-script/case.yaml:15: checks.broken",
        "  found:    no-error: passes every check",
        "  expected: a check that it fails",
        "  repair:   tighten one",
        "cases/odd-script/case.yaml:16: checks.broken[0]",
        "  found:    broken: error (final) = 0.500000\u00a0m",
        "  expected: below 0.1 m",
        "  repair:   correct the bound, the edits, or the model",
    ]


def test_check_reports_all_that_is_wrong_with_all_cases(project: Path) -> None:
    write_script_case(project, ("number: 2", "number: two"), ("title: A", "titel: A"), slug="misspelt")
    write_case(project, ("equals: 0}", "equals: 1}"), ("number: 1", "number: 3"))

    result = run("check", "--json")

    assert result.exit_code == 1
    found = {case["case"]: case for case in json.loads(result.stdout)}
    assert {slug: case["sound"] for slug, case in found.items()} == {
        "falling-box": False,
        "misspelt": False,
        "odd-script": True,
    }
    assert {problem["where"] for problem in found["misspelt"]["problems"]} == {"number", "titel", "title"}
    assert found["misspelt"]["variants"] == {}
    (check,) = found["falling-box"]["variants"]["broken"]["checks"]["broken"]
    assert (check["measured"], check["expected"], check["holds"]) == (0, {"equals": 1}, False)
    assert found["falling-box"]["breaches"][0]["where"] == "checks.broken[0]"


def test_mistake_of_an_author_ends_with_its_message(project: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    record = project / "cases" / "odd-script" / "case.yaml"
    record.write_text(changed(record.read_text(encoding="utf-8"), ("number: 2", "number: two")), encoding="utf-8")

    message = main_with(monkeypatch, "show", "odd-script")

    assert isinstance(message, str)
    assert message.startswith('cases/odd-script/case.yaml:1: number\n  found:    "two"\n')


@pytest.mark.usefixtures("project")
@pytest.mark.parametrize("command", ["check", "show", "view"])
def test_case_that_does_not_exist_is_named_with_the_closest(command: str, monkeypatch: pytest.MonkeyPatch) -> None:
    assert main_with(monkeypatch, command, "old-script") == (
        "cases/old-script:1:\n"
        "  found:    no case old-script\n"
        "  expected: the folder of a case: odd-script\n"
        "  repair:   write odd-script"
    )


@pytest.mark.usefixtures("project")
def test_list_has_a_row_a_case() -> None:
    assert re.search(r"2 │ odd-script │ A script prints an error │ code", run("list").stdout)
    assert json.loads(run("list", "--json").stdout) == [
        {"number": 2, "case": "odd-script", "title": "A script prints an error", "tags": ["code"]}
    ]


def test_list_names_the_others_beside_a_broken_one(project: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    write_script_case(project, ("number: 2", "number: two"), slug="misspelt")
    assert "cases/misspelt/case.yaml:1: number" in str(main_with(monkeypatch, "list"))
    assert "odd-script" in run("list").stdout


@pytest.mark.usefixtures("project")
def test_show_keeps_the_folds_closed() -> None:
    assert "It prints 0.500 m." in run("show", "odd-script").stdout.replace("\u00a0", " ")
    assert "Write another number." not in run("show", "odd-script").stdout
    assert "Write another number." in run("show", "odd-script", "--answer").stdout
    assert json.loads(run("show", "odd-script", "--json", "--answer").stdout)["fix"] == "Write another number."


def test_view_without_a_display_says_so(project: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    write_case(project)
    for name in ("DISPLAY", "WAYLAND_DISPLAY"):
        monkeypatch.delenv(name, raising=False)
    monkeypatch.setattr(sys, "platform", "linux")
    said = str(main_with(monkeypatch, "view", "falling-box", "--fix", "share-a-bit"))
    assert said.startswith("clinic: no display here")


def test_new_writes_a_case_with_the_next_number_and_the_schema(project: Path) -> None:
    result = run("new", "it-moves", "--title", "It moves", "--kind", "python")
    assert result.exit_code == 0, result.output
    assert {path.name for path in (project / "cases/it-moves").iterdir()} == {"case.yaml", "model.xml", "script.py"}
    assert "\nnumber: 1\n" in (project / "cases" / "it-moves" / "case.yaml").read_text(encoding="utf-8")
    assert (project / FILE).read_text(encoding="utf-8") == schema_text()


def test_new_asks_for_a_title_that_is_not_given(project: Path) -> None:
    result = CliRunner().invoke(app, ["new", "it-moves"], input="It moves\n")
    assert result.exit_code == 0, result.output
    assert (project / "cases" / "it-moves" / "model.xml").is_file()
    assert "\ntitle: It moves\n" in (project / "cases" / "it-moves" / "case.yaml").read_text(encoding="utf-8")


@pytest.mark.parametrize(
    ("options", "said"), [((), "The symptom"), (("--title", "x", "--kind", "rust"), "'javascript'")]
)
def test_new_without_what_it_needs_writes_nothing(project: Path, options: tuple[str, ...], said: str) -> None:
    result = run("new", "it-moves", *options)
    assert result.exit_code != 0
    assert said in result.output
    assert not (project / "cases" / "it-moves").exists()


def test_new_refuses_a_name_before_it_asks_for_anything(project: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    assert "found:    the slug Cup Slides\n" in str(main_with(monkeypatch, "new", "Cup Slides"))
    assert not (project / "cases" / "Cup Slides").exists()


@pytest.mark.usefixtures("project")
def test_new_asks_for_a_family_with_all_that_there_are(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("clinic.commands.cli.sys", SimpleNamespace(stdin=SimpleNamespace(isatty=lambda: True)))
    result = CliRunner().invoke(app, ["new", "it-moves", "--title", "hello"], input="sags\n")
    assert result.exit_code == 0, result.output
    assert all(f"  {name:18} {family.title}\n" in result.output for name, family in families().items())
    assert "cases/it-moves/, of the family sags, passes" in result.output


def test_new_names_the_families_where_the_title_tells_none(project: Path) -> None:
    result = run("new", "it-moves", "--title", "hello")
    assert result.exit_code != 0
    assert "name it with --family: explodes, " in " ".join(result.output.replace("\u2502", " ").split())
    assert not (project / "cases" / "it-moves").exists()


def test_new_refuses_a_slug_that_is_taken(project: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    message = main_with(monkeypatch, "new", "odd-script", "--title", "It moves")
    assert "found:    the slug odd-script, which is taken" in str(message)
    assert (project / "cases" / "odd-script" / "script.py").is_file()


def test_schema_is_printed() -> None:
    assert run("schema").stdout == schema_text()


@pytest.mark.usefixtures("project")
def test_slugs_complete_in_the_shell() -> None:
    words = {"_CLINIC_COMPLETE": "complete_bash", "COMP_WORDS": "clinic show od", "COMP_CWORD": "2"}
    done = subprocess.run(
        [Path(sys.executable).parent / "clinic"],
        env={**os.environ, **words},
        check=False,
        capture_output=True,
        text=True,
    )
    assert done.stdout.split() == ["odd-script"], done.stderr


def test_help_and_completion_import_nothing_that_is_slow() -> None:
    code = "import sys, clinic.commands.cli; print({'mujoco', 'numpy', 'pydantic', 'matplotlib'} & set(sys.modules))"
    done = subprocess.run([sys.executable, "-c", code], check=True, capture_output=True, text=True)
    assert done.stdout == "set()\n"


def test_outside_a_project(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)
    assert str(main_with(monkeypatch, "check")).startswith("clinic: this needs a checkout: no folder with cases/")


def test_reference_is_printed() -> None:
    assert run("reference").stdout == reference() + "\n"


def test_build_writes_generated_pages_beside_those_written_by_hand(project: Path, tmp_path: Path) -> None:
    (project / "docs" / "triage.md").write_text("# Triage\n\n```python run\nprint(6 * 7)\n```\n", encoding="utf-8")
    (project / "docs" / "about.md").write_text("# About\n", encoding="utf-8")
    out = tmp_path / "out"
    assert run("build", "--out", str(out)).exit_code == 0
    (out / "stale.md").touch()

    result = run("build", "--out", str(out))

    assert result.exit_code == 0, result.output
    assert "\n42\n" in (out / "triage.md").read_text(encoding="utf-8")
    assert (out / "about.md").is_file()
    assert not (out / "stale.md").exists()
    assert "# 2. A script prints an error" in (out / "cases/odd-script/index.md").read_text(encoding="utf-8")
    assert (out / "cases/odd-script/script.py").read_bytes() == (project / "cases/odd-script/script.py").read_bytes()


@pytest.mark.parametrize("out", [".", "docs", "docs/new", "cases", "mine", "mine/thesis.txt", "link"])
def test_build_deletes_nothing_that_no_build_wrote(project: Path, out: str) -> None:
    (project / FILE).touch()
    (project / "docs" / "triage.md").touch()
    (project / "mine").mkdir()
    (project / "mine" / "thesis.txt").touch()
    (project / "link").symlink_to(project / "mine")
    before = sorted(project.rglob("*"))
    result = run("build", "--out", str(project / out))
    assert result.exit_code == 2
    assert "Invalid value" in result.output
    assert sorted(project.rglob("*")) == before


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
    assert "cases/odd-script/case.yaml:1: number\n" in done.stderr
    assert "Traceback" not in done.stderr


@pytest.mark.usefixtures("project")
def test_judge_of_a_repair_of_none_and_of_what_cannot_be_run(tmp_path: Path) -> None:
    path = tmp_path / "mine.py"
    path.write_text('print("error = 0")\n', encoding="utf-8")
    repaired = run("judge", "odd-script", str(path))
    assert (repaired.exit_code, repaired.stdout) == (0, "Repaired.\n")

    path.write_text('print("error = 2")\n', encoding="utf-8")
    said = "error (final) is 2 m; expected exactly 0 m."
    plain, data = run("judge", "odd-script", str(path)), run("judge", "odd-script", str(path), "--json")
    assert (plain.exit_code, data.exit_code) == (1, 1)
    assert plain.stdout == f"{said}\nNot repaired.\n"
    assert json.loads(data.stdout) == {
        "case": "odd-script", "error": "", "failed": [said], "changes": [], "repaired": False,
    }  # fmt: skip

    assert [run("judge", slug, str(file)).exit_code for slug, file in (("odd-script", "no.py"), ("odd", path))] == [
        2,
        2,
    ]
