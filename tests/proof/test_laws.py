"""The laws, each broken on purpose by a small change of a case that obeys them all."""

from __future__ import annotations

import re
from pathlib import Path

import pytest
from clinic.proof.evidence import collect
from clinic.proof.laws import LAWS, breaches
from clinic.proof.robustness import robustness
from clinic.proof.sweep import measure_sweep
from clinic.record.case import Case
from clinic.record.problem import Problem
from helpers import MODEL, RECORD, SWEEP, changed, script_case, tiny_case

EDIT = "{find: ' contype=\"2\" conaffinity=\"2\"', replace: ''}"
HALVE = "{find: 'timestep=\"0.002\"', replace: 'timestep=\"0.001\"'}"
TWO = EDIT + "\n      - {find: 'mass=\"1\"', replace: 'mass=\"2\"'}"
THREE = (
    "{find: 'contype=\"2\"', replace: 'contype=\"4\"'}\n"
    "      - {find: 'conaffinity=\"2\"', replace: 'conaffinity=\"4\"'}\n"
    '      - {find: \'mass="1"\', replace: \'mass="1" contype="4"\'}'
)
"""Each mask by an edit of its own, and both are needed; the third spares the first."""
CHAIN = (
    "{find: ' contype=\"2\"', replace: ' contype=\"4\"'}\n"
    "      - {find: ' contype=\"4\" conaffinity=\"2\"', replace: ''}"
)
REASON = ("title: Remove", "redundant: It looks better.\n    title: Remove")
SWEPT = ("no_sweep: The masks are not a number.\n", SWEEP)
STRICT = ("within: 0.005", "within: 0.001")
LINE = [
    SWEPT,
    ("outcome: {signal: height}", "outcome: {signal: height}\n    holds: {above: -0.2583}"),
    ("0.06 - g * 0.4 * 0.398 / 2, within: 1.0e-9, relative: false", "'4', within: 0.01"),
    ("0.06 - g * 0.4 ** 2 / 2, within: 0.005, relative: false", "'1.5', within: 0.01"),
]
"""The box falls beyond a height from 4 m/s² on."""
NEAR = ("[1, 2, 4, 8]", "[1, 2, 3.94, 4.06, 8]")
FAR = ("[1, 2, 4, 8]", "[1, 2, 3.9, 4.1, 8]")
APART = ("title: Gravity and the fall", "title: Gravity and the fall\n    apart: It is slow.")
JUDGED_NEAR = "expected points judged near the line on both sides, by their end"
SPACE = "\u00a0"
EXPLOSIVE = (
    '<body><joint type="slide" stiffness="1e9" springref="1"/><geom size="0.1" mass="0.001" pos="9 0 9"/></body>'
)
HEIGHT = f"checks.fixed[0]: share-a-bit: height (final) = N{SPACE}m; expected"
WRONG = "correct the bound, the edits, or the model"
PASSES = "passes every check; expected a check that it fails"
LAX_FIX = f"checks.broken: share-a-bit: {PASSES}; tighten one"
LAX_REFUTED = f"checks.fixed: small-step: {PASSES}; move it to `fixes`, or tighten one"
SPARE = "alone repairs it; expected edits of which none can be spared; drop the other edits, or say why in `redundant`"
SMALL = "changed lines; expected 1 to 5; change the lines that matter, and no others"


def told(case: Case, law: str) -> list[str]:
    """What is said of the breaches, `N` in place of a measured number."""
    sweeps = {name: measure_sweep(case, name) for name in case.record.sweep}
    robust = robustness(case) if case.record.run and law in ("lasting", "steady") else {}
    evidence = collect(case).model_copy(update={"sweep": sweeps, "robustness": robust})
    return [re.sub(r"= [\u2212.\d]+\u00a0", f"= N{SPACE}", said(each)) for each in breaches(case, evidence, law)]


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


@pytest.mark.parametrize(
    ("law", "changes", "expected"),
    [
        pytest.param(
            "verdicts",
            [("replace: ''", 'replace: \' contype="2"  conaffinity="2"\'')],
            [f"{HEIGHT} between 0.045 and 0.051 m; {WRONG}", LAX_FIX],
            id="an-edit-that-does-nothing",
        ),
        pytest.param(
            "verdicts",
            [("between: [0.045, 0.051]", "below: 0.045")],
            [
                f"checks.fixed: broken: {PASSES}; tighten one",
                f"{HEIGHT} below 0.045 m; {WRONG}",
                LAX_REFUTED,
            ],
            id="a-bound-of-fixed-on-the-wrong-side",
        ),
        pytest.param(
            "verdicts",
            [("take: max, equals: 0", "take: max, above: 0")],
            [f"checks.broken[0]: broken: contacts (max) = 0; expected above 0; {WRONG}", LAX_FIX],
            id="a-bound-of-broken-on-the-wrong-side",
        ),
        pytest.param(
            "verdicts",
            [(EDIT, "@"), (HALVE, EDIT), ("@", HALVE)],
            [f"{HEIGHT} between 0.045 and 0.051 m; {WRONG}", LAX_FIX, LAX_REFUTED],
            id="a-fix-swapped-with-a-refuted-remedy",
        ),
        pytest.param(
            "verdicts",
            [("{signal: height, between: [0.045, 0.051]}", "{signal: height, take: onset, above: 1}")],
            [f"checks.fixed[0]: share-a-bit: height (onset) = N{SPACE}s; expected above 1 s; {WRONG}"],
            id="an-onset-in-seconds",
        ),
        pytest.param(
            "ablation",
            [(EDIT, TWO)],
            [f'fixes[0].edits: the edit of \' contype="2" conaffinity="2"\' {SPARE}'],
            id="an-edit-to-spare",
        ),
        pytest.param(
            "ablation",
            [(EDIT, THREE)],
            [f"fixes[0].edits: the edit of 'conaffinity=\"2\"' and 'mass=\"1\"' {SPARE}"],
            id="two-of-three-edits-suffice",
        ),
        pytest.param("ablation", [(EDIT, TWO), REASON], [], id="a-reason-for-an-edit-to-spare"),
        pytest.param(
            "ablation",
            [REASON],
            [
                "fixes[0].redundant: a reason, though every edit is necessary; expected a reason for an edit that can "
                "be spared; remove it"
            ],
            id="a-reason-no-longer-needed",
        ),
        pytest.param("ablation", [(EDIT, CHAIN)], [], id="an-edit-that-needs-the-one-before"),
        pytest.param(
            "small_edits",
            [(HALVE, r"""{find: ' contype="2"', replace: "\n\n\n\n\n"}""")],
            [f"refuted[0].edits: 6 {SMALL}"],
            id="too-many-lines",
        ),
        pytest.param(
            "small_edits",
            [(HALVE, "{find: \"</mujoco>\\n\", replace: '</mujoco>'}")],
            [f"refuted[0].edits: 0 {SMALL}"],
            id="no-line",
        ),
        pytest.param(
            "warned",
            [
                ("replace: ''", f'replace: \'/>{EXPLOSIVE}<geom size="0.01" pos="5 5 5"\''),
                ("between: [0.045, 0.051]", "above: 0"),
            ],
            [
                "fixes[0]: share-a-bit: raises BADQACC; expected a fix that raises no warning; repair the model until "
                "it is silent"
            ],
            id="a-fix-that-raises-a-warning",
        ),
        pytest.param(
            "warned",
            [("number: 1", "number: 1\nwarnings: [BADQACC]")],
            ["warnings: BADQACC; expected what the broken variant raises: none; remove `warnings`"],
            id="a-warning-named-but-not-raised",
        ),
        pytest.param(
            "swept",
            [("no_sweep:", f"{SWEEP}no_sweep:"), STRICT],
            ["sweep: both; expected `sweep`, or the reason why there is none in `no_sweep`; give one of them"],
            id="a-sweep-and-a-reason-for-none",
        ),
        pytest.param(
            "swept",
            [SWEPT, ("* 0.398 / 2", "* 0.4 / 2"), STRICT],
            [
                "sweep.fall.prediction: misses 4 of 4 points; most at g = 8: it says -0.58, and "
                "-0.5768 is measured; expected a prediction that misses none; correct its `expr`"
            ],
            id="a-prediction-that-misses",
        ),
        pytest.param(
            "swept",
            [SWEPT, ("within: 1.0e-9", "within: 1"), STRICT],
            [
                f"sweep.fall.prediction: agrees when multiplied by {factor} too; expected a prediction that then "
                "misses; choose points that can tell"
                for factor in (0.95, 1.05)
            ],
            id="a-prediction-that-no-point-can-judge",
        ),
        pytest.param(
            "swept",
            [SWEPT],
            [
                "sweep.fall.rivals: textbook: never misses; expected a rival that misses somewhere; remove it, or "
                "choose points that can tell"
            ],
            id="a-rival-that-never-misses",
        ),
        pytest.param("swept", [*LINE, NEAR], [], id="a-line-with-points-near-to-it"),
        pytest.param(
            "swept",
            [*LINE, ("[1, 2, 4, 8]", "[1, 2, 3.94, 4.1, 8]")],
            [
                "sweep.fall: no point above it within 0.02 of the line, relative, that is judged; "
                f"{JUDGED_NEAR}; add points there, or say in `apart` why not"
            ],
            id="a-line-with-points-near-to-it-on-one-side",
        ),
        pytest.param(
            "swept",
            [*LINE, ("[1, 2, 4, 8]", "[1, 2, 3.9, 4.06, 8]")],
            [
                "sweep.fall: no point below it within 0.02 of the line, relative, that is judged; "
                f"{JUDGED_NEAR}; add points there, or say in `apart` why not"
            ],
            id="a-line-with-points-near-to-it-on-the-other-side",
        ),
        pytest.param("swept", [*LINE, FAR, APART], [], id="a-reason-for-points-apart-from-the-line"),
        pytest.param(
            "swept",
            [*LINE, NEAR, ("{signal: height}\n    holds", "{signal: height, take: min}\n    holds")],
            [f"sweep.fall: the outcome is taken as min; {JUDGED_NEAR}; take `final`, or say in `apart` why not"],
            id="a-line-by-what-is-seen-on-the-way",
        ),
        pytest.param(
            "swept",
            [*LINE, NEAR, APART],
            ["sweep.fall.apart: a reason, though none is needed; expected nothing to excuse; remove it"],
            id="a-reason-for-points-that-are-there",
        ),
        pytest.param(
            "lasting",
            [
                ("  contacts: {path: ncon}", "  contacts: {path: ncon}\n  elapsed: {path: time, unit: s}"),
                ("0.051]}", "0.051]}\n    - {signal: elapsed, below: 1}"),
            ],
            [
                "fixes[0]: share-a-bit: no longer holds after ten times the duration; expected a fix that holds; "
                "repair what builds up, or say in `exempt: {lasting: ...}` why it must"
            ],
            id="a-fix-that-does-not-last",
        ),
        pytest.param(
            "lasting", [("between: [0.045, 0.051]", "below: 0.045")], [], id="a-fix-that-does-not-hold-at-all"
        ),
        pytest.param(
            "lasting",
            [("film: {}", "film: {}\nexempt: {lasting: It tips over in the end.}")],
            ["exempt.lasting: a law that it obeys; expected an exemption from a law that the case breaks; remove it"],
            id="an-exemption-that-is-not-needed",
        ),
    ],
)
def test_a_breach_is_told(tmp_path: Path, law: str, changes: list[tuple[str, str]], expected: list[str]) -> None:
    assert told(tiny_case(tmp_path, *changes), law) == expected


def test_a_check_of_what_was_not_measured(tmp_path: Path) -> None:
    case = script_case(tmp_path, ("'0.5', replace: '0.0'", "other, replace: error"), script='print("other = 0.5")\n')
    assert told(case, "verdicts") == [
        f"checks.broken[0]: broken: error (final) = nothing; expected above 0.1 m; {WRONG}",
        f"checks.fixed[0]: no-error: error (final) = N{SPACE}m; expected exactly 0 m; {WRONG}",
        LAX_FIX.replace("share-a-bit", "no-error"),
    ]


def test_a_script_that_prints_another_number_every_time(tmp_path: Path) -> None:
    clock = "import time\nprint('error =', time.perf_counter_ns())\nprint('error = 0.5')\n"
    seed = "expected the same numbers from every run; seed what is random, and bound loops by steps"
    assert told(script_case(tmp_path, script=clock), "repeatable") == [
        f"checks: broken: two runs that differ; {seed}",
        f"fixes[0]: no-error: two runs that differ; {seed}",
    ]


def test_a_warning_that_the_record_does_not_name(tmp_path: Path) -> None:
    case = tiny_case(tmp_path, model=changed(MODEL, ("<worldbody>", f"<worldbody>{EXPLOSIVE}")))
    assert told(case, "warned")[0] == (
        "warnings: none; expected what the broken variant raises: BADQACC; write `warnings: [BADQACC]`"
    )


def test_a_film_of_a_script(tmp_path: Path) -> None:
    assert told(script_case(tmp_path, ("picture:", "film: {}\npicture:")), "filmed") == [
        "film: a film of a script; expected none: there is nothing to see; remove `film`"
    ]


def test_a_verdict_that_hangs_on_the_start(tmp_path: Path) -> None:
    case = tiny_case(tmp_path, ("between: [0.045, 0.051]", "take: first, equals: 0.06, within: 0.0002"))
    _, fixed, *_ = told(case, "steady")
    assert fixed == (
        "fixes[0]: share-a-bit: keeps its verdict in 4 of 16 slightly changed runs; expected the same verdict in all "
        "of them; widen a bound, or say in `exempt: {steady: ...}` why it must"
    )


def test_a_prediction_that_no_point_is_held_against(tmp_path: Path) -> None:
    beyond = ("relative: false}\n    rivals", "relative: false, over: [90, 99]}\n    rivals")
    assert told(tiny_case(tmp_path, SWEPT, beyond, STRICT), "swept")[0] == (
        "sweep.fall.prediction: held against no point; expected points that it can miss; widen its `over`, or "
        "correct its `expr`"
    )


def test_a_first_version_is_not_held_to_its_every_word(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    case = tiny_case(tmp_path, ("lesson: Look at the masks.", "lesson: Always look at `qfrc_bias` of a ball joint."))
    evidence = collect(case)
    assert breaches(case, evidence, "bold", "named", "kinds") == []
    monkeypatch.setattr(type(case), "lacking", {})
    found = {problem.found for problem in breaches(case, evidence, "bold", "named", "kinds")}
    assert found == {"Always", "qfrc_bias", "ball joint"}


def test_the_only_fix_s_numbers_need_no_words(tmp_path: Path) -> None:
    case = tiny_case(tmp_path, ("fix: Share a bit.", "fix: It stands at {{ share-a-bit.height.final }}."))
    assert breaches(case, collect(case), "owned") == []
