"""The families of symptoms, from `families.toml`."""

from __future__ import annotations

import tomllib
from functools import cache
from pathlib import Path
from typing import NamedTuple


class Family(NamedTuple):
    """A symptom: its title, and the words that people use for it."""

    title: str
    words: tuple[str, ...]


@cache
def families() -> dict[str, Family]:
    """All families by name, in the order of the file."""
    read = tomllib.loads((Path(__file__).parent / "families.toml").read_text(encoding="utf-8"))
    return {name: Family(each["title"], tuple(each["words"])) for name, each in read.items()}
