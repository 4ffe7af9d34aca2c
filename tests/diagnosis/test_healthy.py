"""Healthy models that look ill, a file each in `healthy/`: none of them has any finding."""

from __future__ import annotations

from pathlib import Path

import pytest
from diagnosed import diagnosed

MODELS = sorted((Path(__file__).parent / "healthy").glob("*.xml"))


@pytest.mark.parametrize("path", MODELS, ids=lambda path: path.stem)
def test_nothing_is_found(path):
    found = diagnosed(path.read_text())
    assert not (*found.causes, *found.hints), found.text()
    assert not found.error
