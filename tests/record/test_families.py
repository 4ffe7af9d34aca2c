"""The families of symptoms, and which of them a reader's words speak of."""

from __future__ import annotations

from pathlib import Path

import pytest
from clinic.record.families import families, family_shares, likely_families, sayings, weights_of
from clinic.record.problem import CaseError
from helpers import tiny_case

PARTS = 5  # of the sayings, each of which is asked when the others alone are known
SHARE = 0.75  # of the sayings that find their family first so


def test_what_people_write_finds_its_family_by_what_others_wrote() -> None:
    listed = [(name, each) for name, one in families().items() for each in (one.title, name, *one.words, *one.further)]
    asked = [(family, text) for family, texts in sayings().items() for text in texts]
    missed = []
    for part in range(PARTS):
        others = weights_of(listed + [each for at, each in enumerate(asked) if at % PARTS != part])
        for family, text in asked[part::PARTS]:
            if (found := [*family_shares(text, others)][:2])[:1] != [family]:
                missed.append(f"{text!r} finds {found}, not {family}")
    assert sayings().keys() == families().keys()
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
    assert likely_families("hello there, colleagues") == []


def test_a_title_names_its_family_too() -> None:
    assert [name for name, family in families().items() if name not in likely_families(family.title)] == []


def test_an_unknown_family_is_an_error_with_those_near_to_it(tmp_path: Path) -> None:
    with pytest.raises(CaseError) as caught:
        tiny_case(tmp_path, ("tags: [contact]", "tags: [contact]\nfamily: falls-thru"))
    (problem,) = caught.value.problems
    assert (problem.where, problem.found) == ("family", "falls-thru, which is no family")
    assert problem.repair.startswith("write falls-through")
