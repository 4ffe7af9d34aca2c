"""The families of symptoms, and which of them a reader's words speak of."""

from __future__ import annotations

from pathlib import Path

import pytest
import yaml
from clinic.record.families import families, likely_families
from clinic.record.problem import CaseError
from helpers import tiny_case

SENTENCES = yaml.safe_load(Path(__file__).with_name("sentences.yaml").read_text(encoding="utf-8"))
SHARE = 0.9  # of the sentences that find their family first


def test_what_people_write_finds_its_family_first() -> None:
    asked = [(family, text, likely_families(text)[:2]) for family, texts in SENTENCES.items() for text in texts]
    missed = [f"{text!r} finds {found}, not {family}" for family, text, found in asked if found[:1] != [family]]
    assert SENTENCES.keys() == families().keys()
    assert len(missed) <= (1 - SHARE) * len(asked), "\n".join(["add to `words` in families.toml", *missed])


@pytest.mark.parametrize(
    ("text", "family"),
    [
        ("It's slipping out of the gripper", "slips"),
        ("the joints oscillate", "oscillates"),
        ("the elbow doesn\u2019t move", "stuck"),
        ("sags", "sags"),
    ],
)
def test_endings_and_ways_to_say_no_make_no_difference(text: str, family: str) -> None:
    assert likely_families(text)[0] == family


def test_words_of_no_family_find_none() -> None:
    assert likely_families("hello world of the") == []


def test_a_title_names_its_family_too() -> None:
    assert [name for name, family in families().items() if name not in likely_families(family.title)] == []


def test_an_unknown_family_is_an_error_with_those_near_to_it(tmp_path: Path) -> None:
    with pytest.raises(CaseError) as caught:
        tiny_case(tmp_path, ("tags: [contact]", "tags: [contact]\nfamily: falls-thru"))
    (problem,) = caught.value.problems
    assert (problem.where, problem.found) == ("family", "falls-thru, which is no family")
    assert problem.repair.startswith("write falls-through")
