"""Fixtures that several tests of diagnosis share."""

from __future__ import annotations

from pathlib import Path

import pytest


@pytest.fixture
def folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """The current folder; the one around it is searched too."""
    made = tmp_path / "around" / "model"
    made.mkdir(parents=True)
    monkeypatch.chdir(made)
    return made
