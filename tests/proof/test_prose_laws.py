"""Law 5: what prose says is bound to what was run. tests/proof/plants.yaml has wrong facts that must not pass."""

from __future__ import annotations

import re
import shutil
from pathlib import Path

import pytest
import yaml
from clinic.pages.text.manual import manual_problems
from clinic.pages.text.prose import prose_problems
from clinic.proof.bounds import bounded, parting
from clinic.proof.claims import claimed
from clinic.proof.evidence import collect
from clinic.proof.filing import filing_problems
from clinic.proof.prose.absences import bold, commented, denied, functional, kinds, named
from clinic.proof.prose.angles import angles
from clinic.proof.prose.comparisons import compared, ordered
from clinic.proof.prose.formulas import formulas
from clinic.proof.prose.labels import computed, entitled, labelled
from clinic.proof.prose.numbers import titled, typed
from clinic.proof.prose.opposites import indexed, opposed, valued
from clinic.proof.prose.signals import called, counted, within_its_sweep
from clinic.proof.prose.titles import performed
from clinic.proof.prose.units import in_units, written
from clinic.proof.prose_laws import owned, quotations, quoted, stated, taken
from clinic.record.case import load_case, read_cases
from clinic.record.problem import CaseError
from helpers import SWEEP, script_case, tiny_case

LAWS = (quoted, typed, titled, entitled, labelled, taken, called, counted, within_its_sweep, stated, formulas, owned)
LAWS += (
    in_units,
    written,
    angles,
    computed,
    performed,
    denied,
    functional,
    named,
    kinds,
    bold,
    commented,
    compared,
    ordered,
    opposed,
    valued,
    indexed,
)
LAWS += (bounded, parting, prose_problems)
PLANTS = yaml.safe_load(Path(__file__).with_name("plants.yaml").read_text(encoding="utf-8"))


def case_with(tmp_path, lesson: str, *changes: tuple[str, str]):
    case = tiny_case(tmp_path, ("lesson: Look at the masks.", f"lesson: |\n  {lesson}"), *changes)
    return case, collect(case)


def test_wrong_facts_are_refused(slug: str, proven, root: Path, tmp_path: Path) -> None:
    case, evidence = proven(slug)
    assert [problem for law in LAWS for problem in law(case, evidence)] == []
    folder = tmp_path / "cases" / slug
    shutil.copytree(root / "cases" / slug, folder)
    text = (folder / "case.yaml").read_text(encoding="utf-8")
    accepted, known = [], {case.slug: case for case in read_cases(root / "cases")[0]}
    assert list(filing_problems(known)) == []
    for plant in (plant for plant in PLANTS if plant["case"] == slug):
        find = re.compile(r"\s+".join(map(re.escape, plant["find"].split())))
        assert len(find.findall(text)) == 1, plant["find"]
        (folder / "case.yaml").write_text(find.sub(lambda _, words=plant["replace"]: words, text), encoding="utf-8")
        try:
            wrong = load_case(folder)
        except CaseError:
            continue
        filed = (manual_problems, lambda one: filing_problems({**known, slug: one}))
        laws = (claimed,) if plant.get("law") == "claimed" else LAWS
        if not any(list(law(wrong, evidence)) for law in laws) and not any(list(law(wrong)) for law in filed):
            accepted.append(plant["replace"])
    assert accepted == []


@pytest.mark.parametrize(
    "text",
    [
        "The floor has {{ broken.geom(floor).contype }}.",
        "The floor has {{ broken.geom(floor).contype conaffinity }}.",
        "The model has {{ broken.option.timestep }}.",
        "The attribute `contype` of a geom, {{ default.geom.contype }} by default.",
    ],
)
def test_a_quotation_that_names_its_element(tmp_path, text: str) -> None:
    case, evidence = case_with(tmp_path, text)
    assert [problem for law in LAWS for problem in law(case, evidence)] == []


@pytest.mark.parametrize(
    ("text", "found", "repair"),
    [
        (
            'The floor has `contype="2"`.',
            'contype="2"',
            "write a field such as {{ broken.geom(floor).contype }}",
        ),
        (
            "The box has {{ broken.geom(floor).contype }}.",
            "{{ broken.geom(floor).contype }}, after the box",
            "name it before the quotation, or correct the field",
        ),
        (
            "It has {{ broken.geom(floor).contype }}.",
            "{{ broken.geom(floor).contype }}, after no element's name",
            "name it before the quotation, or correct the field",
        ),
        ("It stands in `qpos[4]`.", "qpos[4]", "quote it as it stands there, or say it in words"),
        ("It is `4`.", "4", "write a field such as {{ broken.signal.final }}, {{ default.geom.solref }}"),
        ("It raises `mjWARN_BADQACC`.", "mjWARN_BADQACC", "correct the name"),
    ],
)
def test_a_quotation_that_does_not(tmp_path, text: str, found: str, repair: str) -> None:
    (problem,) = quoted(*case_with(tmp_path, text))
    assert (problem.where, problem.found, problem.repair) == ("lesson", found, repair)


def test_quotations_are_given_as_they_are_written(tmp_path) -> None:
    case, _ = case_with(tmp_path, "The floor has {{ broken.geom(floor).contype conaffinity }}.")
    assert list(quotations(case)) == [(("lesson",), 'contype="2"'), (("lesson",), 'conaffinity="2"')]


def test_a_quoted_attribute_may_have_an_underscore(tmp_path) -> None:
    words = "With the small-step, {{ small-step.option.noslip_iterations }}."
    case, _ = case_with(tmp_path, words, ("replace: 'timestep=\"0.001\"'", "replace: 'noslip_iterations=\"3\"'"))
    assert list(quotations(case)) == [(("lesson",), 'noslip_iterations="3"')]


def test_a_problem_of_prose_stands_at_the_line_of_its_words(tmp_path) -> None:
    case, evidence = case_with(tmp_path, 'One line.\n  Another.\n  It falls 3 m, and `axis="0"` is wrong.')
    lines = {problem.line - case.lines.at(("lesson",)) for law in (typed, quoted) for problem in law(case, evidence)}
    assert lines == {3}


@pytest.mark.parametrize(
    "text",
    [
        "It falls 3 m.",
        "After 20ms it",
        "turned by 90°",
        "in 3 steps",
        "a seven-joint arm",
        "twice the load",
        "a tenth of it",
        "half a metre up",
        "MuJoCo 4.0 sees",
    ],
)
def test_a_number_typed_by_hand(tmp_path, text: str) -> None:
    (problem,) = typed(*case_with(tmp_path, text))
    assert problem.where == "lesson"
    assert problem.found.endswith(", typed by hand")
    assert problem.repair == "write a field such as {{ broken.signal.final }}, or say it without a number"


@pytest.mark.parametrize(
    "text",
    ["two boxes", "half of it", "`0.5 m`", "$3 m$", "{{ broken.height.final }}", "the third column", "once more"],
)
def test_what_no_run_could_have_given(tmp_path, text: str) -> None:
    assert list(typed(*case_with(tmp_path, text))) == []


@pytest.mark.parametrize(
    ("text", "wrong"),
    [
        ("The lowest height is {{ broken.height.max }}.", True),
        ("The lowest height is {{ broken.height.min }}.", False),
        ("It rests at {{ broken.height.span }}.", True),
        ("The flag `contype` is {{ default.geom.condim }}.", True),
    ],
)
def test_words_say_which_number(tmp_path, text: str, wrong: bool) -> None:
    assert bool(list(taken(*case_with(tmp_path, text)))) == wrong


@pytest.mark.parametrize(
    ("text", "wrong"),
    [
        (r"$\frac{m g}{2}$", True),
        ("$2 h$", True),
        ("$h_1 = h_2$", False),
        (r"$\tau$", False),
        ("${{ formula.fall.right }}$", False),
    ],
)
def test_a_formula_is_computed(tmp_path, text: str, wrong: bool) -> None:
    assert bool(list(stated(*case_with(tmp_path, text)))) == wrong


@pytest.mark.parametrize(
    ("says", "apart"),
    [
        ("z = z_0 - g * t ** 2 / 2", False),
        ("z = z_0 - g * t ** 2", True),
        ("z = z_1", True),
        ("z = (", True),
        ("z = sqrt(0 - t)", True),
    ],
)
def test_an_equation_is_held_against_a_run(tmp_path, says: str, apart: bool) -> None:
    where = "{z: height, z_0: height_first, g: '9.81', t: duration}"
    entry = f"formulas:\n  fall: {{says: {says}, where: {where}, within: 0.02}}\nno_sweep:"
    assert bool(list(formulas(*case_with(tmp_path, "It falls.", ("no_sweep:", entry))))) == apart


@pytest.mark.parametrize(
    ("field", "value", "wrong"),
    [
        ("fix: Share", "fix: It is {{ small-step.height.final }}. Share", True),
        ("fix: Share", "fix: It is {{ share-a-bit.height.final }}. Share", False),  # the only fix
        ("fix: Share", "fix: '{{ share-a-bit.title }}: it is {{ share-a-bit.height.final }}. Share", False),
        ("symptom: It", "symptom: At {{ share-a-bit.height.final }} it", True),
        ("why: It", "why: At {{ share-a-bit.height.final }} it", True),
        ("why: It", "why: At {{ small-step.option.timestep }} it", False),
        ("why: It", "why: The floor, {{ small-step.geom(floor).contype }}, it", True),
    ],
)
def test_a_number_stands_where_its_remedy_is_spoken_of(tmp_path, field: str, value: str, wrong: bool) -> None:
    changes = [(field, value)] + ([("Share a bit.", "Share a bit.'")] if "'" in value else [])
    case = tiny_case(tmp_path, *changes)
    assert bool(list(owned(case, collect(case)))) == wrong


@pytest.mark.parametrize(
    ("title", "wrong"),
    [
        ("Halve the timestep", False),
        ("Step at 1 ms", False),
        ("Divide the timestep by ten", True),
        ("Step at 2.5 ms", True),
    ],
)
def test_a_title_agrees_with_its_edits(tmp_path, title: str, wrong: bool) -> None:
    case = tiny_case(tmp_path, ("title: Halve the timestep", f"title: {title}"))
    assert bool(list(titled(case, collect(case)))) == wrong


@pytest.mark.parametrize("label", ["half of g t squared, 9.81", "g t / 2"])
def test_a_legend_is_words_alone(tmp_path, label: str) -> None:
    sweep = SWEEP.replace("semi-implicit, a step behind", label)
    case = tiny_case(tmp_path, ("no_sweep: The masks are not a number.\n", sweep))
    assert [problem.where for problem in typed(case, collect(case))] == ["sweep.fall.prediction"]


@pytest.mark.parametrize(
    ("text", "wrong"),
    [
        ("It falls to {{ broken.height.final }}.", False),
        ("At a height of {{ broken.height.final }} it goes on.", False),
        ("The number of contacts is {{ broken.height.final }}.", True),
        ("Its height is {{ broken.contacts.final }}.", True),
        ("With {{ broken.contacts.max }} contacts, its height is {{ broken.height.final }}.", False),
        ("With {{ broken.height.max }} contacts, its height is {{ broken.contacts.final }}.", True),
    ],
)
def test_a_number_stands_beside_the_words_of_its_signal(tmp_path, text: str, wrong: bool) -> None:
    assert bool(list(called(*case_with(tmp_path, text)))) == wrong


def test_an_author_says_by_which_words_prose_speaks_of_a_signal(tmp_path) -> None:
    text = "All touching corners make {{ broken.contacts.final }}, though the height is small."
    said = ("label: height of the box", "label: height of the box, said: [corners, touching]")
    assert list(called(*case_with(tmp_path / "without", text))) == []
    (problem,) = called(*case_with(tmp_path / "with", text, said))
    assert (problem.where, "said" in problem.repair) == ("lesson", True)


@pytest.mark.parametrize(
    ("text", "wrong"),
    [
        ("It falls to {{ broken.height.mean }}.", True),
        ("Its height is {{ broken.height.mean }} on average.", False),
        ("Its height is {{ broken.height.first }}.", True),
        ("Its height is {{ broken.height.first }} at the start.", False),
        ("Its height is {{ broken.height.max }}.", True),
        ("Its height is {{ broken.height.max }} at most.", False),
    ],
)
def test_another_sample_than_the_last_is_told(tmp_path, text: str, wrong: bool) -> None:
    assert bool(list(counted(*case_with(tmp_path, text)))) == wrong


@pytest.mark.parametrize(
    ("field", "value", "wrong"),
    [
        ("label: height of the box", "label: height of the floor", True),
        ("label: height of the box", "label: height above the ground", False),
        ("title: Remove the masks of the floor", "title: Remove the masks of the box", True),
        ("title: Remove the masks of the floor", "title: Remove the masks", False),
    ],
)
def test_labels_and_titles_name_what_is_read_and_changed(tmp_path, field: str, value: str, wrong: bool) -> None:
    case = tiny_case(tmp_path, (field, value))
    evidence = collect(case)
    assert bool([*labelled(case, evidence), *entitled(case, evidence)]) == wrong


@pytest.mark.parametrize(("unit", "wrong"), [("m", False), ("mm", True)])
def test_a_unit_is_the_one_that_a_script_prints(tmp_path, unit: str, wrong: bool) -> None:
    script = 'print("first error = 0.25 m")\nprint("error = 0.5 m")\n'
    case = script_case(tmp_path, ("unit: m}", f"unit: {unit}}}"), script=script)
    assert bool(list(labelled(case, collect(case)))) == wrong
