"""Variants: the broken text after named edits."""

from __future__ import annotations

from pathlib import Path

import pytest
from clinic.engine.variant import EditError, apply_edits, changed_lines, diff, place_of, variants
from clinic.record.parts import Edit
from clinic.record.problem import CaseError
from helpers import MODEL, tiny_case


def edits(*pairs: tuple[str, str]) -> list[Edit]:
    return [Edit(find=find, replace=replace) for find, replace in pairs]


@pytest.mark.parametrize(
    ("changes", "after"),
    [
        pytest.param([], "a=1 b=2", id="none"),
        pytest.param([("a=1", "a=9")], "a=9 b=2", id="one"),
        pytest.param([(" b=2", "")], "a=1", id="deleted"),
        pytest.param([("a=1", "b=2x"), ("b=2x", "c")], "c b=2", id="second-sees-the-first"),
        pytest.param([("1", r"\1 \g<0>")], r"a=\1 \g<0> b=2", id="text-is-taken-literally"),
    ],
)
def test_edits_are_applied_in_order(changes: list[tuple[str, str]], after: str) -> None:
    assert apply_edits("a=1 b=2", edits(*changes)) == after


@pytest.mark.parametrize(
    ("text", "changes", "index", "count"),
    [
        pytest.param("abc", [("x", "y")], 0, 0, id="nowhere"),
        pytest.param("abab", [("ab", "y")], 0, 2, id="twice"),
        pytest.param("aaa", [("aa", "y")], 0, 2, id="twice-overlapping"),
        pytest.param("abc", [("a", "z"), ("a", "y")], 1, 0, id="removed-by-the-edit-before"),
        pytest.param("abc", [("a", "b"), ("b", "y")], 1, 2, id="doubled-by-the-edit-before"),
    ],
)
def test_edit_must_match_once(text: str, changes: list[tuple[str, str]], index: int, count: int) -> None:
    with pytest.raises(EditError) as caught:
        apply_edits(text, edits(*changes))
    assert (caught.value.index, caught.value.count) == (index, count)


def test_variants_are_the_broken_one_then_fixes_then_refuted(tmp_path: Path) -> None:
    case = tiny_case(tmp_path)
    broken, fix, refuted = variants(case)

    assert [(v.kind, v.id) for v in (broken, fix, refuted)] == [
        ("broken", "broken"),
        ("fix", "share-a-bit"),
        ("refuted", "small-step"),
    ]
    assert [place_of(case, v.id) for v in (broken, fix, refuted)] == [(), ("fixes", 0), ("refuted", 0)]
    assert broken.text == MODEL
    assert fix.text == MODEL.replace(' contype="2" conaffinity="2"', "")
    assert refuted.text == MODEL.replace("0.002", "0.001")
    assert refuted.title == "Halve the timestep"


def test_edits_that_do_not_match_are_reported_for_all_remedies(tmp_path: Path) -> None:
    case = tiny_case(
        tmp_path, ('find: \' contype="2"', 'find: \' contype="4"'), ("find: 'timestep=\"0.002\"'", "find: '\"0.07'")
    )
    with pytest.raises(CaseError) as caught:
        variants(case)
    assert [problem.where for problem in caught.value.problems] == [
        "fixes[0].edits[0].find",
        "refuted[0].edits[0].find",
    ]


BEFORE = "one\ntwo\nthree\nfour\n"


@pytest.mark.parametrize(
    ("after", "shown", "count"),
    [
        pytest.param(BEFORE, "", 0, id="same"),
        pytest.param("one\n2\nthree\nfour\n", "@@ -1,3 +1,3 @@\n one\n-two\n+2\n three", 1, id="changed"),
        pytest.param("one\nthree\nfour\n", "@@ -1,3 +1,2 @@\n one\n-two\n three", 1, id="removed"),
        pytest.param("one\n2\n2.5\nthree\nfour\n", "@@ -1,3 +1,4 @@\n one\n-two\n+2\n+2.5\n three", 2, id="grown"),
        pytest.param(
            "-- 1\ntwo\nthree\n++ 4\n",
            "@@ -1,4 +1,4 @@\n-one\n+-- 1\n two\n three\n-four\n+++ 4",
            2,
            id="text-that-looks-like-a-header",
        ),
    ],
)
def test_diff_and_changed_lines(after: str, shown: str, count: int) -> None:
    assert diff(BEFORE, after, "model.xml") == shown
    assert changed_lines(BEFORE, after) == count
