"""The picture of a package's folders and imports."""

from __future__ import annotations

from pathlib import Path
from xml.etree import ElementTree

import pytest
from clinic.pages.storeys import storeys
from clinic.work.cache import STOREYS

FILES = {
    "low/__init__.py": '"""What lies\nbelow.\n\nMore."""',
    "low/first.py": "",
    "low/room/__init__.py": "",
    "low/room/second.py": "from house.low import first",
    "high/__init__.py": '"""What stands on it."""',
    "high/third.py": "from house.low import first\nfrom house.low.room import second",
    "high/fourth.py": "from house.low import first",
}


def words(picture: str) -> list[str]:
    svg = picture[picture.index("<svg") : picture.index("</div>")]
    return [text.text or "" for text in ElementTree.fromstring(svg).iter("text")]


def test_folders_modules_and_imports_are_drawn(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    for name, text in {"__init__.py": "", **FILES}.items():
        path = tmp_path / "house" / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(text, encoding="utf-8")
    monkeypatch.syspath_prepend(tmp_path)
    made = storeys("house", ("low", "high"))
    assert words(made) == ["low", "first", "room: second", "high", "fourth, third", "3"]
    assert made.endswith("\n\n- `low`: What lies below.\n- `high`: What stands on it.")


def test_every_module_of_the_clinic_stands_in_the_picture(root: Path) -> None:
    drawn = " ".join(words(storeys("clinic", STOREYS))).replace(",", "").split()
    package = root / "scripts" / "clinic"
    paths = [*package.glob("*/*.py"), *package.glob("*/*/*.py")]  # what lies deeper stands there by its folder
    modules = [path.stem for path in paths if path.stem != "__init__"]
    assert set(modules) - {"script"} <= set(drawn)
