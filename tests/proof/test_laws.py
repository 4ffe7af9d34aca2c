"""The laws, each broken on purpose by a small change of a case that obeys them all."""

from __future__ import annotations

from pathlib import Path

import pytest
from clinic.proof.evidence import Evidence, collect
from clinic.proof.laws import LAWS, breaches
from clinic.proof.robustness import robustness
from clinic.proof.sweep import grid, measure_points, summarise
from clinic.record.case import Case
from clinic.record.problem import Problem
from helpers import MODEL, RECORD, SWEEP, changed, script_case, tiny_case

EDIT = "{find: ' contype=\"2\" conaffinity=\"2\"', replace: ''}"
SPACE = "\u00a0"
WRONG = "correct the bound, the edits, or the model"
RESTING = f"between 0.045 and 0.051 m; {WRONG}"
LAX_FIX = "checks.broken: share-a-bit: passes every check; expected a check that the repair fails; tighten one"
LAX_REFUTED = (
    "refuted[0]: passes every check of `fixed`; expected a refuted remedy that fails one; move it to `fixes`, or "
    "tighten a check"
)
EXPLOSIVE = (
    '<body><joint type="slide" stiffness="1e9" springref="1"/><geom size="0.1" mass="0.001" pos="9 0 9"/></body>'
)


def told(case: Case, law: str) -> list[str]:
    return list(map(said, breaches(case, collect(case), law)))


def said(problem: Problem) -> str:
    return f"{problem.where}: {problem.found}; expected {problem.expected}; {problem.repair}"


@pytest.mark.parametrize("law", LAWS)
def test_a_case_that_is_well_made_obeys(tmp_path: Path, law: str) -> None:
    assert told(tiny_case(tmp_path / "model"), law) == []
    assert told(script_case(tmp_path / "script"), law) == []


def test_a_breach_tells_file_and_line(tmp_path: Path) -> None:
    case = tiny_case(tmp_path, ("take: max, equals: 0", "take: max, above: 0"))
    first, _ = breaches(case, collect(case), "verdicts")
    assert first.file == "cases/falling-box/case.yaml"
    assert "contacts, take: max, above: 0" in RECORD.replace("equals: 0", "above: 0").splitlines()[first.line - 1]


# Law 1: verdicts


def test_an_edit_that_does_nothing(tmp_path: Path) -> None:
    case = tiny_case(tmp_path, ("replace: ''", 'replace: \' contype="2"  conaffinity="2"\''))
    height = f"share-a-bit: height (final) = {measured(case, 'share-a-bit')}"
    assert told(case, "verdicts") == [f"checks.fixed[0]: {height}; expected {RESTING}", LAX_FIX]


def test_a_bound_of_fixed_on_the_wrong_side(tmp_path: Path) -> None:
    case = tiny_case(tmp_path, ("between: [0.045, 0.051]", "below: 0.045"))
    height = f"share-a-bit: height (final) = {measured(case, 'share-a-bit')}"
    assert told(case, "verdicts") == [
        "checks.fixed: broken: passes every check; expected a check that the broken variant fails; tighten one",
        f"checks.fixed[0]: {height}; expected below 0.045 m; {WRONG}",
        LAX_REFUTED,
    ]


def test_a_bound_of_broken_on_the_wrong_side(tmp_path: Path) -> None:
    case = tiny_case(tmp_path, ("take: max, equals: 0", "take: max, above: 0"))
    assert told(case, "verdicts") == [
        f"checks.broken[0]: broken: contacts (max) = 0; expected above 0; {WRONG}",
        LAX_FIX,
    ]


def test_a_fix_swapped_with_a_refuted_remedy(tmp_path: Path) -> None:
    halve = "{find: 'timestep=\"0.002\"', replace: 'timestep=\"0.001\"'}"
    case = tiny_case(tmp_path, (EDIT, "@"), (halve, EDIT), ("@", halve))
    height = f"share-a-bit: height (final) = {measured(case, 'share-a-bit')}"
    assert told(case, "verdicts") == [f"checks.fixed[0]: {height}; expected {RESTING}", LAX_FIX, LAX_REFUTED]


def test_a_check_of_what_was_not_measured(tmp_path: Path) -> None:
    case = script_case(tmp_path, ("'0.5', replace: '0.0'", "other, replace: error"), script='print("other = 0.5")\n')
    assert told(case, "verdicts") == [
        f"checks.broken[0]: broken: error (final) = nothing; expected above 0.1 m; {WRONG}",
        f"checks.fixed[0]: no-error: error (final) = 0.500000{SPACE}m; expected 0 exactly m; {WRONG}",
        LAX_FIX.replace("share-a-bit", "no-error"),
    ]


def test_an_onset_is_measured_in_seconds(tmp_path: Path) -> None:
    case = tiny_case(tmp_path, ("{signal: height, between: [0.045, 0.051]}", "{signal: height, take: onset, above: 1}"))
    height = f"share-a-bit: height (onset) = 0.00200000{SPACE}s"
    assert told(case, "verdicts") == [f"checks.fixed[0]: {height}; expected above 1 s; {WRONG}"]


def measured(case: Case, variant: str) -> str:
    """The final height as it is told."""
    value = collect(case).variants[variant].values["height"]["final"]
    assert value is not None
    return f"{value:.6g}{SPACE}m".replace("-", "\u2212")


# Law 2: ablation

SPARE = "expected edits of which none can be spared; drop the other edits, or say why in `redundant`"


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
    assert told(case, "ablation") == [
        f'fixes[0].edits: the edit of \' contype="2" conaffinity="2"\' alone repairs it; {SPARE}'
    ]


def test_two_of_three_edits_that_suffice(needs_two: Case) -> None:
    assert told(needs_two, "ablation") == [
        f"fixes[0].edits: the edit of 'conaffinity=\"2\"' and 'mass=\"1\"' alone repairs it; {SPARE}"
    ]


def test_a_reason_for_an_unnecessary_edit_is_accepted(tmp_path: Path) -> None:
    two = EDIT + "\n      - {find: 'mass=\"1\"', replace: 'mass=\"2\"'}"
    case = tiny_case(tmp_path, (EDIT, two), ("title: Remove", "redundant: It looks better.\n    title: Remove"))
    assert told(case, "ablation") == []


def test_a_reason_that_is_no_longer_needed(tmp_path: Path) -> None:
    case = tiny_case(tmp_path, ("title: Remove", "redundant: It looks better.\n    title: Remove"))
    assert told(case, "ablation") == [
        "fixes[0].redundant: a reason, though every edit is necessary; expected a reason for an edit that can be "
        "spared; remove it"
    ]


def test_an_edit_that_needs_the_one_before_is_no_repair_alone(tmp_path: Path) -> None:
    chain = (
        "{find: ' contype=\"2\"', replace: ' contype=\"4\"'}\n"
        "      - {find: ' contype=\"4\" conaffinity=\"2\"', replace: ''}"
    )
    assert told(tiny_case(tmp_path, (EDIT, chain)), "ablation") == []


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
    assert told(case, "small_edits") == [
        f"refuted[0].edits: {count} changed lines; expected 1 to 5; change the lines that matter, and no others"
    ]


# Law 4: repeatable, and silent

SEED = "expected the same numbers from every run; seed what is random, and bound loops by steps"


def test_a_script_that_prints_another_number_every_time(tmp_path: Path) -> None:
    clock = "import time\nprint('error =', time.perf_counter_ns())\nprint('error = 0.5')\n"
    assert told(script_case(tmp_path, script=clock), "repeatable") == [
        f"checks: broken: two runs that differ; {SEED}",
        f"fixes[0]: no-error: two runs that differ; {SEED}",
    ]


def test_a_fix_that_raises_a_warning(tmp_path: Path) -> None:
    case = tiny_case(
        tmp_path,
        ("replace: ''", f'replace: \'/>{EXPLOSIVE}<geom size="0.01" pos="5 5 5"\''),
        ("between: [0.045, 0.051]", "above: 0"),
    )
    assert told(case, "warned") == [
        "fixes[0]: share-a-bit: raises BADQACC; expected a fix that raises no warning; repair the model until it is "
        "silent"
    ]


def test_a_warning_that_the_record_does_not_name(tmp_path: Path) -> None:
    case = tiny_case(tmp_path, model=changed(MODEL, ("<worldbody>", f"<worldbody>{EXPLOSIVE}")))
    assert told(case, "warned")[0] == (
        "warnings: none; expected what the broken variant raises: BADQACC; write `warnings: [BADQACC]`"
    )


def test_a_warning_that_is_named_but_not_raised(tmp_path: Path) -> None:
    case = tiny_case(tmp_path, ("number: 1", "number: 1\nwarnings: [BADQACC]"))
    assert told(case, "warned") == [
        "warnings: BADQACC; expected what the broken variant raises: none; remove `warnings`"
    ]


# Law 6: lasting, and steady


def test_a_fix_that_does_not_last(tmp_path: Path) -> None:
    bound = "- {signal: height, between: [0.045, 0.051]}"
    case = tiny_case(
        tmp_path,
        ("  contacts: {path: ncon}", "  contacts: {path: ncon}\n  elapsed: {path: time, unit: s}"),
        (bound, f"{bound}\n    - {{signal: elapsed, below: 1}}"),
    )
    assert robust(case, "lasting") == [
        "fixes[0]: share-a-bit: no longer holds after ten times the duration; expected a fix that holds; "
        "repair what builds up, or say in `exempt: {lasting: ...}` why it must"
    ]


def test_a_fix_that_does_not_hold_at_all_is_not_blamed_for_not_lasting(tmp_path: Path) -> None:
    assert robust(tiny_case(tmp_path, ("between: [0.045, 0.051]", "below: 0.045")), "lasting") == []


def test_a_verdict_that_hangs_on_the_start(tmp_path: Path) -> None:
    case = tiny_case(tmp_path, ("between: [0.045, 0.051]", "take: first, equals: 0.06, within: 0.0002"))
    _, fixed, *_ = robust(case, "steady")
    assert fixed == (
        "fixes[0]: share-a-bit: keeps its verdict in 4 of 16 slightly changed runs; expected the same verdict in all "
        "of them; widen a bound, or say in `exempt: {steady: ...}` why it must"
    )


def test_an_exemption_that_is_not_needed(tmp_path: Path) -> None:
    case = tiny_case(tmp_path, ("film: {}", "film: {}\nexempt: {lasting: It tips over in the end.}"))
    assert robust(case, "lasting") == [
        "exempt.lasting: a law that it obeys; expected an exemption from a law that the case breaks; remove it"
    ]


def robust(case: Case, law: str) -> list[str]:
    evidence = collect(case).model_copy(update={"robustness": robustness(case)})
    return list(map(said, breaches(case, evidence, law)))


# The cause is a law: sweeps


def swept(folder: Path, *changes: tuple[str, str]) -> list[str]:
    case = tiny_case(folder, ("no_sweep: The masks are not a number.\n", changed(SWEEP, *changes)))
    sweep = case.record.sweep["fall"]
    found = summarise(case, sweep, measure_points(case, sweep, grid(sweep)))
    return list(map(said, breaches(case, collect(case).model_copy(update={"sweep": {"fall": found}}), "swept")))


def test_a_prediction_that_misses(tmp_path: Path) -> None:
    assert swept(tmp_path, ("* 0.398 / 2", "* 0.4 / 2"), ("within: 0.005", "within: 0.001")) == [
        f"sweep.fall.prediction: misses 4 of 4 points; most at g = 8, by 0.00320{SPACE}m: it says -0.58, and "
        "-0.5768 is measured; expected a prediction that misses none; correct its `expr`"
    ]


def test_a_prediction_that_no_point_can_judge(tmp_path: Path) -> None:
    assert swept(tmp_path, ("within: 1.0e-9", "within: 1"), ("within: 0.005", "within: 0.001")) == [
        f"sweep.fall.prediction: agrees when multiplied by {factor} too; expected a prediction that then misses; "
        "choose points that can tell"
        for factor in (0.95, 1.05)
    ]


def test_a_rival_that_never_misses(tmp_path: Path) -> None:
    assert swept(tmp_path) == [
        "sweep.fall.rivals[0]: textbook: never misses; expected a rival that misses somewhere; remove it, or choose "
        "points that can tell"
    ]


def test_a_prediction_that_no_point_is_held_against(tmp_path: Path) -> None:
    beyond = ("relative: false}\n    rivals", "relative: false, over: [90, 99]}\n    rivals")
    assert swept(tmp_path, beyond, ("within: 0.005", "within: 0.001"))[0] == (
        "sweep.fall.prediction: held against no point; expected points that it can miss; widen its `over`, or "
        "correct its `expr`"
    )


def test_a_case_with_neither_a_sweep_nor_a_reason(tmp_path: Path) -> None:
    assert told(tiny_case(tmp_path, ("no_sweep: The masks are not a number.\n", "")), "swept") == [
        "sweep: neither; expected `sweep`, or the reason why there is none in `no_sweep`; give one of them"
    ]


# Films


def test_a_model_without_a_film_and_a_script_with_one(tmp_path: Path) -> None:
    assert told(tiny_case(tmp_path, ("film: {}\n", "")), "filmed") == [
        "film: nothing; expected a film of the model; add `film`"
    ]
    assert told(script_case(tmp_path, ("picture:", "film: {}\npicture:")), "filmed") == [
        "film: a film of a script; expected none: there is nothing to see; remove `film`"
    ]


def test_every_law_takes_a_case_and_its_evidence(tmp_path: Path) -> None:
    case = tiny_case(tmp_path)
    evidence: Evidence = collect(case)
    assert {name for name in LAWS if breaches(case, evidence, name)} == set()
