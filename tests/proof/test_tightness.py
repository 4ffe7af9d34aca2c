"""Tightness: which numbers matter, and which of them no check notices."""

from __future__ import annotations

from pathlib import Path

import pytest
from clinic.proof.evidence import collect
from clinic.proof.laws import breaches
from clinic.proof.tightness import loose_numbers, numbers, value_of, words_of
from clinic.record.case import Case
from helpers import MODEL, changed, script_case, tiny_case

OTHER_BIT = ("replace: ''", 'replace: \' contype="1" conaffinity="4"\'')
SWEEP = """\
sweep:
  weight:
    title: The weight
    text: It falls with any.
    vary: [{name: m, find: 'mass="1"', replace: 'mass="{}"', values: [1, 2]}]
    outcome: {signal: height}
    prediction: {label: none, expr: m, within: 1}
"""


def mattering(case: Case) -> list[tuple[str, str, str]]:
    return [(number.variant, words_of(case, number), value_of(case, number)) for number in numbers(case)]


def loose(case: Case) -> list[tuple[str, str, str]]:
    return [(n.variant, words_of(case, n), n.change) for n in loose_numbers(case, numbers(case))]


def told(case: Case) -> list[str]:
    evidence = collect(case).model_copy(update={"loose": loose_numbers(case, numbers(case))})
    return [f"{problem.where}: {problem.found}" for problem in breaches(case, evidence, "tightness")]


def test_numbers_that_a_fix_takes_away_and_writes(tmp_path: Path) -> None:
    assert mattering(tiny_case(tmp_path / "taken")) == [
        ("broken", 'contype="2"', "2"),
        ("broken", 'conaffinity="2"', "2"),
    ]
    assert mattering(tiny_case(tmp_path / "written", OTHER_BIT))[2:] == [
        ("share-a-bit", 'contype="1"', "1"),
        ("share-a-bit", 'conaffinity="4"', "4"),
    ]


def test_numbers_that_prose_quotes(tmp_path: Path) -> None:
    quoting = ("lesson: Look at the masks.", 'lesson: Look at `pos="0 0 0.06"`, not at size="1 1 0.1" or `type="2"`.')
    assert mattering(tiny_case(tmp_path, quoting))[2:] == [("broken", 'pos="0 0 0.06"', "0.06")]


def test_numbers_that_a_sweep_varies(tmp_path: Path) -> None:
    case = tiny_case(tmp_path, ("no_sweep: The masks are not a number.\n", SWEEP))
    assert ("broken", 'mass="1"', "1") in mattering(case)


def test_a_sweep_that_does_not_fit_is_left_to_its_own_run(tmp_path: Path) -> None:
    misfit = changed(SWEEP, ("find: 'mass=\"1\"'", "find: 'mass=\"7\"'"))
    case = tiny_case(tmp_path, ("no_sweep: The masks are not a number.\n", misfit))
    assert [words for _, words, _ in mattering(case)] == ['contype="2"', 'conaffinity="2"']


def test_a_number_of_a_script_is_told_by_its_line(tmp_path: Path) -> None:
    assert mattering(script_case(tmp_path)) == [("broken", 'print("error = 0.5")', "0.5")]


def test_what_the_broken_variant_s_checks_notice_is_not_loose(tmp_path: Path) -> None:
    assert loose(tiny_case(tmp_path)) == [  # halved, the masks share a bit
        ("broken", 'contype="2"', "doubled"),
        ("broken", 'conaffinity="2"', "doubled"),
    ]


def test_what_a_fix_s_checks_notice_is_not_loose(tmp_path: Path) -> None:
    quoting = ("lesson: Look at the masks.", 'lesson: Look at `conaffinity="2"`.')
    bit = (
        "find: ' contype=\"2\" conaffinity=\"2\"', replace: ''",
        'find: \'mass="1"\', replace: \'mass="1" contype="2"\'',
    )
    assert ("broken", 'conaffinity="2"', "doubled") not in loose(tiny_case(tmp_path, quoting, bit))


def test_a_warning_that_comes_or_goes_is_noticed(tmp_path: Path) -> None:
    spring = (
        '<body><joint type="slide" stiffness="1500" springref="1"/><geom size="0.1" mass="0.001" pos="9 0 9"/></body>'
    )
    quoting = ("lesson: Look at the masks.", 'lesson: Look at `stiffness="1500"`.\nwarnings: [BADQACC]')
    case = tiny_case(tmp_path, quoting, model=changed(MODEL, ("<worldbody>", f"<worldbody>{spring}")))
    assert "1500" in [value_of(case, number) for number in numbers(case)]
    assert ("broken", 'stiffness="1500"', "halved") not in loose(case)


def test_a_text_that_does_not_run_is_noticed(tmp_path: Path) -> None:
    repeated = ("{find: '0.5', replace: '0.0'}", "{find: 'range(1)', replace: 'range(3)'}")
    case = script_case(tmp_path, repeated, script='for k in range(1):\n    print("error = 0.5")\n')
    assert loose(case) == [("broken", "for k in range(1):", "doubled")]


def test_what_a_trial_s_checks_notice_is_not_loose(tmp_path: Path) -> None:
    floor, box = """find: ' contype="2" conaffinity="2"', replace: ''""", '<body name="box"'
    ledge = (floor, f'find: \'{box}\', replace: \'<geom type="box" pos="0 0 -0.001" size="0.4 1 0.001"/> {box}\'')
    trial = ("film: {}", 'film: {}\ntrials: [{id: aside, title: Aside, start: {"joint(free).qpos[0]": 0.3}}]')
    half = ("share-a-bit", 'size="0.4 1 0.001"', "halved")
    assert half in loose(tiny_case(tmp_path / "without", ledge))
    case = tiny_case(tmp_path / "with", ledge, trial)
    wide = next(n for n in numbers(case) if value_of(case, n) == "0.4")
    assert "halved" not in [found.change for found in loose_numbers(case, [wide])]


def test_a_trial_that_changes_the_very_number_is_not_asked(tmp_path: Path) -> None:
    trial = 'trials: [{id: more, title: More, edits: [{find: "error = 0.5", replace: "error = 1.5"}]}]'
    case = script_case(tmp_path, ("picture:", f"{trial}\npicture:"))
    assert [change for _, _, change in loose(case)] == ["halved", "doubled"]


@pytest.mark.parametrize(
    ("reasons", "expected"),
    [
        pytest.param(
            "{}",
            [f'loose: {mask}="2" of broken: no check notices when 2 is doubled' for mask in ("contype", "conaffinity")],
            id="none",
        ),
        pytest.param("""{'contype="2" conaffinity="2"': any bit but the first}""", [], id="for-both"),
        pytest.param(
            """{'contype="2" conaffinity="2"': any other bit, 'size="1 1 0.1"': any size}""",
            ['loose.size="1 1 0.1": size="1 1 0.1"'],
            id="one-too-many",
        ),
    ],
)
def test_reasons(tmp_path: Path, reasons: str, expected: list[str]) -> None:
    assert told(tiny_case(tmp_path, ("film: {}", f"loose: {reasons}\nfilm: {{}}"))) == expected


def test_a_record_without_the_field_is_not_asked(tmp_path: Path) -> None:
    case = tiny_case(tmp_path)
    assert breaches(case, collect(case), "tightness") == []
    assert "loose" in case.record.lacking
