"""The pages of the rules."""

from __future__ import annotations

import tempfile
from pathlib import Path

import pytest
import yaml
from clinic.commands.cli import app
from clinic.diagnosis.bench.lock import Kept
from clinic.diagnosis.rules import rules
from clinic.pages.rules import rule_pages
from clinic.pages.text.template import render
from clinic.record.families import families
from clinic.work.cache import Cache
from typer.testing import CliRunner


@pytest.mark.parametrize("which", ["Bad", "Good"])
def test_what_the_command_is_said_to_print_is_what_it_prints(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, which: str
) -> None:
    rule = rules()["visual-mass"]
    monkeypatch.setattr("clinic.pages.rules.rules", lambda: {rule.id: rule})
    monkeypatch.chdir(tmp_path)
    Path("model.xml").write_text(rule.example(which), encoding="utf-8")
    printed = CliRunner().invoke(app, ["diagnose", "model.xml"]).stdout

    page = rule_pages({}, Cache(tmp_path / "cache"), Kept())["rules/visual-mass.md"].decode()

    said = page.partition(f"## {which}\n")[2]
    assert f"`clinic diagnose` prints:\n\n``` {{ .text .wrap }}\n{printed}```" in said
    assert printed.startswith("1  cause   visual-mass" if which == "Bad" else "Nothing found, by ")


def test_titles_and_descriptions_are_plain_text(tmp_path: Path) -> None:
    pages = rule_pages({}, Cache(tmp_path / "cache"), Kept())
    for name, rule in rules().items():
        front = yaml.safe_load(pages[f"rules/{name}.md"].decode().split("---\n")[1])
        assert set('<`*"').isdisjoint(front["description"]), name
        assert set('<`*"&').isdisjoint(rule.title), name


def test_files_that_lie_around_are_no_part_of_an_example(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    (tmp_path / "wood.png").write_bytes(b"")
    monkeypatch.setattr(tempfile, "tempdir", str(tmp_path))
    page = rule_pages({}, Cache(tmp_path / "cache"), Kept())["rules/missing-file.md"].decode()
    assert "wood.png is not there, and no file called wood.png" in page


@pytest.mark.parametrize(
    ("address", "install"),
    [("https://host/clinic", "`pip install git+https://host/clinic`"), ("", "`pip install .` in [a checkout](")],
)
def test_the_list_says_how_to_install_the_command(address: str, install: str, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("REPO_URL", address)
    listed = render("rules", by_family={name: [] for name in families()}, families=families(), engine="")
    assert f"In a terminal, after {install}" in listed
