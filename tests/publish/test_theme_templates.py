"""Compiled templates: made once, made again when a text changes, and never taken from what is damaged."""

from __future__ import annotations

from pathlib import Path

import pytest
from clinic.publish.theme_templates import Templates
from clinic.work.cache import Cache
from jinja2 import DictLoader, Environment

TEXTS = {"page": "{% include 'name' %}!", "name": "Hello {{ who }}"}


def rendered(cache: Cache, **changed: str) -> tuple[str, set[str]]:
    """The page, and what had to be compiled for it."""
    templates = Templates(cache)
    compiled = set()

    class Watched(Environment):
        def compile(self, source, name=None, *rest, **named):
            compiled.add(name)
            return super().compile(source, name, *rest, **named)

    made = Watched(loader=DictLoader(TEXTS | changed), bytecode_cache=templates).get_template("page").render(who="you")
    templates.keep()
    return made, compiled


def test_a_template_is_compiled_once(tmp_path: Path) -> None:
    assert rendered(Cache(tmp_path)) == ("Hello you!", {"page", "name"})
    assert rendered(Cache(tmp_path)) == ("Hello you!", set())


def test_a_changed_template_is_compiled_anew_and_the_others_stay(tmp_path: Path) -> None:
    rendered(Cache(tmp_path))

    assert rendered(Cache(tmp_path), name="Bye {{ who }}") == ("Bye you!", {"name"})
    assert rendered(Cache(tmp_path), name="Bye {{ who }}") == ("Bye you!", set())


@pytest.mark.parametrize("damaged", [b"", b"no archive", None], ids=["emptied", "overwritten", "cut"])
def test_what_is_damaged_is_made_again(tmp_path: Path, damaged: bytes | None) -> None:
    rendered(Cache(tmp_path))
    [path] = tmp_path.iterdir()
    path.write_bytes(path.read_bytes()[:-9] if damaged is None else damaged)

    assert rendered(Cache(tmp_path)) == ("Hello you!", {"page", "name"})
    assert rendered(Cache(tmp_path)) == ("Hello you!", set())
