"""The laws, each broken on purpose by a small change of a case that obeys them all."""

from __future__ import annotations

from pathlib import Path

import pytest
from clinic.case import Case
from clinic.evidence import Evidence, collect
from clinic.laws import LAWS
from helpers import MODEL, changed, script_case, tiny_case

EDIT = "{find: ' contype=\"2\" conaffinity=\"2\"', replace: ''}"
SPACE = "\u00a0"
WRONG = "correct the bound of checks.{}[0], the edits, or the model"
FALLEN = f"\u22120.721{SPACE}m"
EXPLOSIVE = (
    '<body><joint type="slide" stiffness="1e9" springref="1"/><geom size="0.1" mass="0.001" pos="9 0 9"/></body>'
)


def complaints(case: Case, law: str) -> list[str]:
    return list(LAWS[law](case, collect(case)))


@pytest.mark.parametrize("law", LAWS)
def test_a_case_that_is_well_made_gives_no_complaint(tmp_path: Path, law: str) -> None:
    assert complaints(tiny_case(tmp_path / "model"), law) == []
    assert complaints(script_case(tmp_path / "script"), law) == []


# Law 1: verdicts


def test_an_edit_that_does_nothing(tmp_path: Path) -> None:
    case = tiny_case(tmp_path, ("replace: ''", 'replace: \' contype="2"  conaffinity="2"\''))
    height = f"height (final) measured {measured(case, 'share-a-bit')}, expected between 0.045 and 0.051 m"
    assert complaints(case, "verdicts") == [
        f"share-a-bit: {height}; {WRONG.format('fixed')}",
        "share-a-bit: passes every check of `broken` too; tighten one until the repair fails it",
    ]


def test_a_bound_of_fixed_on_the_wrong_side(tmp_path: Path) -> None:
    case = tiny_case(tmp_path, ("between: [0.045, 0.051]", "below: 0.045"))
    height = f"height (final) measured {measured(case, 'share-a-bit')}, expected below 0.045 m"
    assert complaints(case, "verdicts") == [
        "broken: passes every check of `fixed`; tighten one until the broken variant fails it",
        f"share-a-bit: {height}; {WRONG.format('fixed')}",
        "small-step: refuted, yet passes every check of `fixed`; move it to `fixes` or tighten a check",
    ]


def test_a_bound_of_broken_on_the_wrong_side(tmp_path: Path) -> None:
    case = tiny_case(tmp_path, ("take: max, equals: 0", "take: max, above: 0"))
    assert complaints(case, "verdicts") == [
        f"broken: contacts (max) measured 0, expected above 0; {WRONG.format('broken')}",
        "share-a-bit: passes every check of `broken` too; tighten one until the repair fails it",
    ]


def test_a_fix_swapped_with_a_refuted_remedy(tmp_path: Path) -> None:
    halve = "{find: 'timestep=\"0.002\"', replace: 'timestep=\"0.001\"'}"
    case = tiny_case(tmp_path, (EDIT, "@"), (halve, EDIT), ("@", halve))
    height = f"height (final) measured {measured(case, 'share-a-bit')}, expected between 0.045 and 0.051 m"
    assert complaints(case, "verdicts") == [
        f"share-a-bit: {height}; {WRONG.format('fixed')}",
        "share-a-bit: passes every check of `broken` too; tighten one until the repair fails it",
        "small-step: refuted, yet passes every check of `fixed`; move it to `fixes` or tighten a check",
    ]


def test_a_check_of_what_was_not_measured(tmp_path: Path) -> None:
    case = script_case(tmp_path, ("'0.5', replace: '0.0'", "other, replace: error"), script='print("other = 0.5")\n')
    assert complaints(case, "verdicts") == [
        f"broken: error (final) measured nothing, expected above 0.1 m; {WRONG.format('broken')}",
        f"no-error: error (final) measured 0.500000{SPACE}m, expected 0 exactly m; {WRONG.format('fixed')}",
        "no-error: passes every check of `broken` too; tighten one until the repair fails it",
    ]


def test_an_onset_is_measured_in_seconds(tmp_path: Path) -> None:
    case = tiny_case(tmp_path, ("{signal: height, between: [0.045, 0.051]}", "{signal: height, take: onset, above: 1}"))
    assert complaints(case, "verdicts") == [
        f"share-a-bit: height (onset) measured 0.00200000{SPACE}s, expected above 1 s; {WRONG.format('fixed')}"
    ]


def measured(case: Case, variant: str) -> str:
    """The final height as a complaint says it."""
    value = collect(case).variants[variant].values["height"]["final"]
    assert value is not None
    return f"{value:.6g}{SPACE}m".replace("-", "\u2212")


# Law 2: ablation


@pytest.fixture
def needs_two(tmp_path: Path) -> Case:
    """The fix sets each mask by an edit of its own, and both are needed."""
    pair = (
        "{find: 'contype=\"2\"', replace: 'contype=\"4\"'}\n"
        "      - {find: 'conaffinity=\"2\"', replace: 'conaffinity=\"4\"'}\n"
        '      - {find: \'mass="1"\', replace: \'mass="1" contype="4"\'}'
    )
    return tiny_case(tmp_path, (EDIT, pair))


def test_an_unnecessary_edit(tmp_path: Path) -> None:
    case = tiny_case(tmp_path, (EDIT, EDIT + "\n      - {find: 'mass=\"1\"', replace: 'mass=\"2\"'}"))
    assert complaints(case, "ablation") == [
        'share-a-bit: the edit of \' contype="2" conaffinity="2"\' alone repairs it; drop the other edits, or say why '
        "in `redundant`"
    ]


def test_two_of_three_edits_that_suffice(needs_two: Case) -> None:
    assert complaints(needs_two, "ablation") == [
        "share-a-bit: the edit of 'conaffinity=\"2\"' and 'mass=\"1\"' alone repairs it; drop the other edits, or say "
        "why in `redundant`"
    ]


def test_a_reason_for_an_unnecessary_edit_is_accepted(tmp_path: Path) -> None:
    two = EDIT + "\n      - {find: 'mass=\"1\"', replace: 'mass=\"2\"'}"
    case = tiny_case(tmp_path, (EDIT, two), ("title: Remove", "redundant: It looks better.\n    title: Remove"))
    assert complaints(case, "ablation") == []


def test_a_reason_that_is_no_longer_needed(tmp_path: Path) -> None:
    case = tiny_case(tmp_path, ("title: Remove", "redundant: It looks better.\n    title: Remove"))
    assert complaints(case, "ablation") == [
        "share-a-bit: `redundant` is no longer needed: every edit is necessary; remove it"
    ]


def test_an_edit_that_needs_the_one_before_is_no_repair_alone(tmp_path: Path) -> None:
    chain = (
        "{find: ' contype=\"2\"', replace: ' contype=\"4\"'}\n"
        "      - {find: ' contype=\"4\" conaffinity=\"2\"', replace: ''}"
    )
    assert complaints(tiny_case(tmp_path, (EDIT, chain)), "ablation") == []


# Law 3: small edits


@pytest.mark.parametrize(
    ("edit", "count"),
    [
        pytest.param(r"""{find: ' contype="2"', replace: "\n\n\n\n\n"}""", 6, id="too-many-lines"),
        pytest.param("{find: \"</mujoco>\\n\", replace: '</mujoco>'}", 0, id="no-line"),
    ],
)
def test_number_of_changed_lines(tmp_path: Path, edit: str, count: int) -> None:
    case = tiny_case(tmp_path, ("{find: 'timestep=\"0.002\"', replace: 'timestep=\"0.001\"'}", edit))
    assert complaints(case, "small_edits") == [f"small-step: changes {count} lines; keep it to 1 to 5"]


# Law 4: repeatable, and silent


def test_a_script_that_prints_another_number_every_time(tmp_path: Path) -> None:
    clock = "import time\nprint('error =', time.perf_counter_ns())\nprint('error = 0.5')\n"
    assert complaints(script_case(tmp_path, script=clock), "repeatable") == [
        "broken: two runs differ; seed what is random, and bound loops by steps",
        "no-error: two runs differ; seed what is random, and bound loops by steps",
    ]


def test_a_fix_that_raises_a_warning(tmp_path: Path) -> None:
    case = tiny_case(
        tmp_path,
        ("replace: ''", f'replace: \'/>{EXPLOSIVE}<geom size="0.01" pos="5 5 5"\''),
        ("between: [0.045, 0.051]", "above: 0"),
    )
    assert complaints(case, "warned") == ["share-a-bit: a fix that raises BADQACC; repair the model until it is silent"]


def test_a_warning_that_the_record_does_not_name(tmp_path: Path) -> None:
    case = tiny_case(tmp_path, model=changed(MODEL, ("<worldbody>", f"<worldbody>{EXPLOSIVE}")))
    assert complaints(case, "warned")[0] == (
        "broken: raises ['BADQACC'], while `warnings` names []; write `warnings: ['BADQACC']`"
    )


def test_a_warning_that_is_named_but_not_raised(tmp_path: Path) -> None:
    case = tiny_case(tmp_path, ("number: 1", "number: 1\nwarnings: [BADQACC]"))
    assert complaints(case, "warned") == ["broken: raises [], while `warnings` names ['BADQACC']; write `warnings: []`"]


def test_every_law_takes_a_case_and_its_evidence(tmp_path: Path) -> None:
    case = tiny_case(tmp_path)
    evidence: Evidence = collect(case)
    assert {name for name, law in LAWS.items() if list(law(case, evidence))} == set()
