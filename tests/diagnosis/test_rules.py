"""The laws that every rule obeys; no rule is listed by hand."""

from __future__ import annotations

from dataclasses import replace

import pytest
from clinic.diagnosis.rules import rules
from clinic.engine.variant import variants
from clinic.record.case import Case, load_case
from clinic.record.checkout import project_root
from clinic.record.families import families
from diagnosed import diagnosed, findings

pytestmark = pytest.mark.usefixtures("folder")

CASES = [load_case(folder) for folder in sorted((project_root() / "cases").iterdir())]
MODELS = [case for case in CASES if case.record.run is not None]


@pytest.mark.parametrize("rule", rules().values(), ids=rules().keys())
def test_its_bad_example_shows_it_first_and_its_good_one_nothing(rule):
    bad = diagnosed(rule.example("Bad"))
    assert [each.rule for each in (*bad.causes, *bad.hints)][:1] == [rule.id], bad.text()
    assert findings(rule.example("Bad"), rule.id)
    good = diagnosed(rule.example("Good"))
    assert (good.error, good.causes, good.hints) == ("", (), ()), good.text()


@pytest.mark.parametrize("taken", ['<joint name="elbow"/>', "<worldbody>", ""], ids=["none", "two", "nothing"])
def test_a_diff_that_does_not_fit_its_bad_example_is_told(taken):
    bad = "<mujoco>\n<worldbody>\n</worldbody>\n<worldbody>\n</worldbody>\n</mujoco>"
    indented = bad.replace("\n", "\n    ")
    text = f"A fault.\n\nBad:\n\n    {indented}\n\nGood:\n\n    - {taken}\n    + <option/>\n\nThe number: 1."
    with pytest.raises(ValueError, match="in the bad example, expected once"):
        replace(rules()["no-armature"], text=text).example("Good")


@pytest.mark.parametrize("case", MODELS, ids=lambda case: case.slug)
def test_no_repaired_model_of_a_case_has_a_cause(case: Case):
    for variant in variants(case):
        if variant.kind == "fix":
            found = diagnosed(variant.text)
            assert not found.causes, f"{variant.id}:\n{found.text()}"


@pytest.mark.parametrize("rule", [rule for rule in rules().values() if rule.case], ids=lambda rule: rule.id)
def test_it_names_the_cause_in_the_broken_model_of_its_case(rule):
    (case,) = (case for case in CASES if case.slug == rule.case)
    found = diagnosed(case.text)
    named = found.hints if rule.level == "hint" else found.causes
    assert rule.id in {each.rule for each in named[:3]}, found.text()


@pytest.mark.parametrize("rule", rules().values(), ids=rules().keys())
def test_its_families_are_known(rule):
    assert rule.families
    assert set(rule.families) <= families().keys()
