"""The pages of the rules."""

from __future__ import annotations

import tempfile
from pathlib import Path

import pytest
from clinic.diagnosis.bench.lock import Kept
from clinic.pages.rules import rule_pages
from clinic.pages.text.template import render
from clinic.record.families import families
from clinic.work.cache import Cache


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
