"""Law 5, sentences: each is named in `claims.yaml`, and what is named there shows it."""

from __future__ import annotations

from pathlib import Path

import pytest
import yaml
from clinic.proof.claims import claimed, manual_text, missing, plain, unshown
from clinic.proof.evidence import collect
from clinic.record.case import Case, load_case, read_case
from clinic.record.claims import sentences
from helpers import SCRIPT_RECORD, changed, script_case, write_folder

SCRIPT = "first = 0.5\nscale = 1\nprint('error =', scale * first)\n"
CAUSE = "It is wrong by more than nothing."
RECORD = changed(SCRIPT_RECORD, ("cause: It says so.", f"cause: {CAUSE}"))
CODE = 'assert measured["broken.error.final"] > 0'
TITLES = ["Print no error", "There is nothing to vary."]
CLAIMS = {
    "claims": [{"says": CAUSE, "python": CODE}],
    "measured": ["It prints {{ broken.error.final }}."],
    "advice": ["Read it.", "Write another number.", "Read the output.", "A script prints an error", *TITLES],
}


def case_with(root: Path, claims: object = CLAIMS, record: str = RECORD) -> Case:
    files = {"case.yaml": record, "script.py": SCRIPT}
    text = claims if isinstance(claims, str) else yaml.safe_dump(claims)
    return load_case(write_folder(root, "odd-script", files | {"claims.yaml": text}))


def told(case: Case) -> list[str]:
    evidence = collect(case)
    evidence = evidence.model_copy(update={"claims": unshown(case, evidence)})
    return [f"{problem.file.rpartition('/')[2]}:{problem.line}: {problem.found}" for problem in claimed(case, evidence)]


def shown(python: str) -> dict[str, object]:
    return CLAIMS | {"claims": [{"says": CAUSE, "python": python}]}


def test_sentences_that_are_shown_are_no_problem(tmp_path):
    assert told(case_with(tmp_path)) == []


def test_a_sentence_that_is_changed_is_told_with_what_showed_it(tmp_path):
    case = case_with(tmp_path, record=changed(RECORD, ("more than nothing", "less than nothing")))
    evidence = collect(case)
    (changed_one,) = claimed(case, evidence)
    assert (changed_one.where, changed_one.line) == ("cause", 6)
    assert changed_one.found == "a sentence that nothing is named for: 'It is wrong by less than nothing.'"
    assert changed_one.expected == f"as in claims.yaml, where it is {CAUSE!r}, shown by code that holds"


@pytest.mark.parametrize(
    ("python", "said"),
    [
        ('assert measured["broken.error.final"] < 0', 'AssertionError: assert measured["broken.error.final"] < 0'),
        ("assert nothing", "NameError: name 'nothing' is not defined"),
        ("import sys\nsys.exit()\nassert True", "SystemExit: sys.exit()"),
        ('assert "error = 0.5" in output["broken"] and "first" in text["broken"]', ""),
        ('assert printed is None and "error = 0.0" in output["no-error"]', ""),
        ("data = load('<mujoco><worldbody><geom size=\"1\"/></worldbody></mujoco>')[1]; assert data.nefc == 0", ""),
    ],
)
def test_code_shows_or_says_why_not(tmp_path, python, said):
    found = [each.partition(": ")[2] for each in told(case_with(tmp_path, shown(python)))]
    assert found == ([f"{CAUSE!r} is not shown: {said}"] if said else [])


def test_a_sentence_that_the_record_does_not_say_is_told(tmp_path):
    (found,) = told(case_with(tmp_path, CLAIMS | {"measured": [*CLAIMS["measured"], "Quite another {{ field }}."]}))
    assert found.endswith("'Quite another {{ field }}.', which the record does not say")


def test_titles_and_labels_are_asked_too_and_code_reads_the_record(tmp_path):
    trial = "trials:\n  - {id: more, title: Twice as wrong, edits: [{find: scale = 1, replace: scale = 2}]}\npicture:"
    record = changed(RECORD, ("picture:", trial))
    assert told(case_with(tmp_path / "without", record=record)) == [
        "case.yaml:25: a sentence that nothing is named for: 'Twice as wrong'"
    ]
    code = 'assert record["trials"][0]["edits"][0]["replace"] == "scale = 2"'
    claims = CLAIMS | {"claims": [*CLAIMS["claims"], {"says": "Twice as wrong", "python": code}]}
    assert told(case_with(tmp_path / "with", claims, record)) == []


@pytest.mark.parametrize(
    ("change", "found"),
    [
        (("{path: printed(error), unit: m}", "{path: printed(error), unit: m, label: error}"), None),
        (("{path: printed(error), unit: m}", "{path: printed(error), unit: m, label: true error}"), "true error"),
        (("title: Print no error", "title: Print less"), "Print less"),
        (("title: Print no error", "title: Call mj_step"), None),  # that its edits do so is another law's
        (("no_sweep: There is nothing to vary.", "no_sweep: It is whole."), "It is whole."),
        (("picture:", 'older:\n  "<3.4": It was less.\npicture:'), "It was less."),
    ],
)
def test_labels_titles_and_reasons_are_asked_unless_their_path_tells_them(tmp_path, change, found):
    said = told(case_with(tmp_path, record=changed(RECORD, change)))
    assert [each.rpartition(": ")[2] for each in said if "nothing is named" in each] == ([repr(found)] if found else [])


def test_comments_docstrings_and_labels_are_asked(tmp_path):
    case = case_with(tmp_path)
    script = (
        '"""It prints."""\n'
        + SCRIPT
        + "# the scale\nnames = [\n    'of the box', 'box', '<a b>', 'its height = {}',\n]\n"
    )
    (tmp_path / "cases" / "odd-script" / "script.py").write_text(script, encoding="utf-8")
    said = told(load_case(tmp_path / "cases" / "odd-script"))
    assert [each.rpartition(": ")[2] for each in said] == ["'It prints.'", "'the scale'", "'of the box'"]
    assert told(case) == []


def test_a_quotation_stands_in_the_manual(tmp_path):
    page, words = "computation/index.html", "Semi-implicit with implicit joint damping (Euler)"
    true, false = ({"says": CAUSE, "manual": page, "quote": each} for each in (words, "explicit joint damping"))
    assert told(case_with(tmp_path / "true", CLAIMS | {"claims": [true]})) == []
    (found,) = told(case_with(tmp_path / "false", CLAIMS | {"claims": [false]}))
    assert found.endswith("explicit joint damping")
    (lost,) = told(case_with(tmp_path / "lost", CLAIMS | {"claims": [true | {"manual": "nowhere.html"}]}))
    assert lost.endswith("nowhere.html")


def test_without_the_file_nothing_is_asked_and_the_grade_is_lower(tmp_path):
    case = script_case(tmp_path)
    assert list(claimed(case, collect(case))) == []
    assert "claims.yaml" in case.lacking
    assert "claims.yaml" not in case_with(tmp_path / "other").lacking


@pytest.mark.parametrize(
    ("claims", "where", "found"),
    [
        ({"claims": [{"says": CAUSE}]}, "claims[0]", "no evidence, or two"),
        (
            {"claims": [{"says": CAUSE, "python": CODE, "manual": "x.html", "quote": "x"}]},
            "claims[0]",
            "no evidence, or two",
        ),
        ({"claims": [{"says": CAUSE, "manual": "x.html"}]}, "claims[0]", "no evidence, or two"),
        ({"claims": [{"says": CAUSE, "python": "print(1)"}]}, "claims[0]", "code that cannot fail"),
        ({"measured": ["Read it."]}, "", "'Read it.' in `measured`"),
        ({"advise": ["Read it."]}, "advise", ""),
        ("claims: [", "", ""),
    ],
)
def test_a_wrong_file_is_told_at_its_place(tmp_path, claims, where, found):
    text = claims if isinstance(claims, str) else yaml.safe_dump(claims)
    files = {"case.yaml": RECORD, "script.py": SCRIPT, "claims.yaml": text}
    problems = read_case(write_folder(tmp_path, "odd-script", files)).problems
    assert {problem.file for problem in problems} == {"cases/odd-script/claims.yaml"}
    assert problems[0].where == where
    assert found in problems[0].found


def test_the_missing_sentences_are_printed_for_the_file(tmp_path):
    case = case_with(tmp_path, {"advice": ["Read it."]})
    printed = yaml.safe_load(missing(case))
    lacking = [CAUSE, "Write another number.", "Read the output.", TITLES[1], "A script prints an error", TITLES[0]]
    assert [each["says"] for each in printed["claims"]] == lacking
    assert printed["measured"] == ["It prints {{ broken.error.final }}."]


def test_a_formula_on_its_own_lines_belongs_to_its_sentence():
    prose = "It is stable while\n\n$$h < 2$$\n\nand no longer. *Then* it is not: see `x`.\n"
    assert sentences(prose) == ["It is stable while $$h < 2$$ and no longer.", "*Then* it is not: see `x`."]


def test_the_manual_is_read_as_it_is_seen():
    assert plain("the :ref:`implicit<geIntegrators>` one,\n*not* ``Euler``") == "the implicit one, not Euler"
    assert "Four primitive types" in (manual_text("APIreference/APItypes.html") or "")
    assert manual_text("nowhere.html") is None
