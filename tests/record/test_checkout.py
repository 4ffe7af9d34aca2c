"""The checkout, found from within, and the cases that its folders hold."""

from __future__ import annotations

from pathlib import Path

import pytest
from clinic.record import checkout as places
from clinic.record.checkout import cache_folder, cases_root, folders, nearest, project_root, slugs
from clinic.record.problem import CaseError


@pytest.fixture
def checkout(tmp_path: Path) -> Path:
    for slug in ("box-sinks", "arm-explodes", "arm-sags"):
        (tmp_path / "cases" / slug).mkdir(parents=True)
    (tmp_path / "pyproject.toml").touch()
    return tmp_path


@pytest.mark.parametrize("below", [".", "cases", "cases/arm-sags"])
def test_root_is_found_from_any_folder(checkout: Path, below: str, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(checkout / below)
    assert project_root() == checkout


def test_outside_there_is_no_root(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)
    with pytest.raises(FileNotFoundError, match="no folder with cases/"):
        project_root()


def test_outside_the_cases_are_those_of_the_installed_package(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(places, "PACKAGE", tmp_path / "clinic")
    monkeypatch.delenv("CLINIC_CACHE", raising=False)
    monkeypatch.chdir(tmp_path)
    with pytest.raises(FileNotFoundError, match="needs a checkout"):
        cases_root()
    (tmp_path / "clinic" / "cases").mkdir(parents=True)
    assert cases_root() == tmp_path / "clinic"
    assert cache_folder(cases_root()) == Path.home() / ".cache" / "clinic"


def test_slugs_are_the_folders(checkout: Path) -> None:
    (checkout / "cases" / "note.txt").touch()
    assert slugs(checkout) == ["arm-explodes", "arm-sags", "box-sinks"]


def test_folders_named_once_each_as_a_shell_completes_them(checkout: Path) -> None:
    assert folders(checkout, ["cases/box-sinks/", "box-sinks"]) == [checkout / "cases" / "box-sinks"]
    assert len(folders(checkout, [])) == 3


def test_every_unknown_name_is_reported_with_those_nearest_to_it(checkout: Path) -> None:
    with pytest.raises(CaseError) as caught:
        folders(checkout, ["arm-sag", "box-sinks", "zzz"])
    assert [(problem.found, problem.repair) for problem in caught.value.problems] == [
        ("no case arm-sag", "write arm-sags"),
        ("no case zzz", "`clinic list` names them all"),
    ]


@pytest.mark.parametrize(
    ("word", "expected"),
    [("sink", ["box-sinks"]), ("arm", ["arm-explodes", "arm-sags"]), ("bx-sinks", ["box-sinks"]), ("", [])],
)
def test_nearest_holds_the_word_or_is_spelt_alike(checkout: Path, word: str, expected: list[str]) -> None:
    assert nearest(word, slugs(checkout)) == expected
