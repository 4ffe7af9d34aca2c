"""Law 5: units, titles, denials, functions, comparisons and equations are held to the files and the runs."""

from __future__ import annotations

from dataclasses import replace

import pytest
from clinic.proof.evidence import collect
from clinic.proof.prose.absences import bold, commented, denied, functional, kinds, named
from clinic.proof.prose.comparisons import compared, ordered
from clinic.proof.prose.formulas import formulas, mutants
from clinic.proof.prose.labels import computed
from clinic.proof.prose.opposites import indexed, opposed, valued
from clinic.proof.prose.titles import performed
from clinic.proof.prose.units import in_units, written
from clinic.record.case import load_case
from clinic.record.checkout import project_root
from helpers import MODEL, script_case, tiny_case


@pytest.mark.parametrize(
    ("signal", "wrong"),
    [
        ('{path: "body(box).xpos[2]", unit: m}', False),
        ('{path: "body(box).xpos[2]", unit: N}', True),
        ('{path: "contact(*).force[0]", unit: kg}', True),
        ('{path: "contact(*).force[3]", unit: N m}', False),
        ('{path: "warning(BADQACC)", unit: s}', True),
        ('{path: "body(box).xpos[2]", unit: m, label: force of the box}', True),
        ("{expr: 1000 * height, unit: mm}", False),
        ("{expr: 2 * height, unit: mm}", True),
        ("{expr: height * height, unit: m}", True),
        ("{expr: height + contacts, unit: m}", True),
    ],
)
def test_a_unit_is_that_of_what_is_read(tmp_path, signal: str, wrong: bool) -> None:
    case = tiny_case(tmp_path, ("  contacts:", f"  other: {signal}\n  contacts:"))
    assert bool(list(in_units(case, collect(case)))) == wrong


@pytest.mark.parametrize(
    ("title", "wrong"),
    [
        ("Halve the timestep", False),
        ("Make it heavier", True),
        ("Damp it", True),
        ("Call mj_forward first", True),
    ],
)
def test_a_title_says_what_its_edits_do(tmp_path, title: str, wrong: bool) -> None:
    case = tiny_case(tmp_path, ("title: Halve the timestep", f"title: {title}"))
    assert bool(list(performed(case, collect(case)))) == wrong


@pytest.mark.parametrize(("title", "wrong"), [("Switch gravity off", False), ("Switch gravity on", True)])
def test_a_title_says_which_value_its_edits_write(tmp_path, title: str, wrong: bool) -> None:
    edit = ("replace: 'timestep=\"0.001\"'", 'replace: \'gravity="0 0 0"><flag gravity="disable"/></option><option\'')
    case = tiny_case(tmp_path, ("title: Halve the timestep", f"title: {title}"), edit)
    assert bool(list(performed(case, collect(case)))) == wrong


@pytest.mark.parametrize(
    ("text", "wrong"),
    [("It has no `contype`.", True), ("It has no `priority`.", False), ("There is no motor.", False)],
)
def test_what_prose_denies_is_not_there(tmp_path, text: str, wrong: bool) -> None:
    case = tiny_case(tmp_path, ("cause: The masks", f"cause: {text} The masks"))
    assert bool(list(denied(case, collect(case)))) == wrong


@pytest.mark.parametrize(
    ("text", "law", "wrong"),
    [
        ("It follows the sine of the angle.", functional, True),
        ("It follows the masks.", functional, False),
        ("The field is `qfrc_bais`.", named, True),
        ("The field is `qfrc_bias`, see `mj_forward`.", named, True),
        ("The masks are `contype` and `conaffinity`.", named, False),
        ("It has a ball joint.", kinds, True),
        ("It has a free joint.", kinds, False),
        ("It has a velocity servo.", kinds, True),
        ("It has a touch sensor.", kinds, True),
        ("By default the cone is elliptic.", kinds, True),
        ("By default the cone is pyramidal.", kinds, False),
        ("Its density is 1 g/cm³.", written, True),
        ("It always falls.", bold, True),
        ("It never rises above {{ broken.height.max }}.", bold, False),
    ],
)
def test_functions_and_universal_words_are_shown(tmp_path, text: str, law, wrong: bool) -> None:
    case = tiny_case(tmp_path, ("lesson: Look at the masks.", f"lesson: {text}"))
    assert bool(list(law(case, collect(case)))) == wrong


@pytest.mark.parametrize(("comment", "wrong"), [("one period", False), ("7 m of error", False), ("20 ms of it", True)])
def test_a_number_in_a_comment_stands_in_the_code(tmp_path, comment: str, wrong: bool) -> None:
    case = script_case(tmp_path, script=f'# {comment}\nerror = 0.5\nn = 7\nprint("error =", error)\n')
    assert [problem.line for problem in commented(case, collect(case))] == [1] * wrong


def test_a_comment_of_a_model_is_read_too(tmp_path) -> None:
    case = tiny_case(tmp_path, model=MODEL.replace("<worldbody>", "<!-- 7 boxes -->\n<worldbody>"))
    assert [(p.file.rpartition("/")[2], p.line) for p in commented(case, collect(case))] == [("model.xml", 3)]


def test_a_snippet_in_javascript_is_read_as_such(tmp_path) -> None:
    case = load_case(project_root() / "cases" / "javascript-view-goes-dead")
    snippet = "/* 7 views */ const broken = `it's`; // 8 more\n"
    shown = replace(case, record=case.record.model_copy(update={"snippet": snippet}))
    assert [p.found for p in commented(shown, collect(script_case(tmp_path)))] == [
        "'7' in a comment",
        "'8' in a comment",
    ]


LAST, FIRST = "{{ small-step.height.final }}", "{{ small-step.height.first }}"


@pytest.mark.parametrize(
    ("text", "wrong"),
    [
        (f"It is {LAST}, less than the {FIRST}.", False),
        (f"It is {LAST}, more than the {FIRST}.", True),
        (f"It is {LAST} instead of {FIRST}.", False),
        (f"It is {FIRST} instead of {FIRST}.", True),
        (f"It stays at {LAST}.", False),
        (f"It starts at {FIRST}, as before.", False),
        (f"It falls to {FIRST}.", True),
        (f"It is {LAST}, above the timestep.", False),
    ],
)
def test_a_comparison_holds(tmp_path, text: str, wrong: bool) -> None:
    case = tiny_case(tmp_path, ("why: It still falls to {{ small-step.height.final }}.", f"why: {text}"))
    assert bool(list(compared(case, collect(case)))) == wrong


def test_what_is_said_to_stay_has_stayed(tmp_path) -> None:
    faster = ("replace: 'timestep=\"0.001\"'", 'replace: \'timestep="0.002" gravity="0 0 -20"\'')
    case = tiny_case(tmp_path, ("why: It still falls to", "why: It stays at"), faster)
    (problem,) = compared(case, collect(case))
    assert (problem.where, "stays at" in problem.found) == ("refuted[0].why", True)


def test_every_number_and_symbol_of_an_equation_is_made_wrong() -> None:
    wrong = [
        "(1.5 * a) = 2 * b",
        "(a * a) = 2 * b",
        "a = 4.0 * b",
        "a = 1.0 * b",
        "a = 2 * (1.5 * b)",
        "a = 2 * (b * b)",
    ]
    assert list(mutants("a = 2 * b")) == wrong
    assert "a = cos(b)" in mutants("a = sin(b)")


def test_an_equation_that_a_wrong_one_equals_is_refused(tmp_path) -> None:
    where = "{z: height, z_0: height_first, g: '9.81', t: duration}"
    entry = f"formulas:\n  fall: {{says: z = z_0 - g * t ** 2 / 2, where: {where}, within: 0.1}}\nno_sweep:"
    case = tiny_case(tmp_path, ("no_sweep:", entry))
    (problem, *_) = formulas(case, collect(case))
    assert problem.where == "formulas.fall.within"


@pytest.mark.parametrize(
    ("text", "wrong"),
    [
        ("It starts at {{ broken.height.first }} and then is at {{ broken.height.final }}.", False),
        ("It is at {{ broken.height.final }} and then at {{ broken.height.first }}.", True),
    ],
)
def test_what_comes_next_comes_later(tmp_path, text: str, wrong: bool) -> None:
    case = tiny_case(tmp_path, ("lesson: Look at the masks.", f"lesson: {text}"))
    assert bool(list(ordered(case, collect(case)))) == wrong


@pytest.mark.parametrize(
    ("words", "wrong"), [("instead of {{ broken.height.final }}", False), ("{{ broken.height.final }}", True)]
)
def test_the_broken_number_in_a_why_is_set_against_the_remedys(tmp_path, words: str, wrong: bool) -> None:
    faster = ("replace: 'timestep=\"0.001\"'", 'replace: \'timestep="0.002" gravity="0 0 -20"\'')
    said = ("why: It still falls to {{ small-step.height.final }}.", f"why: It is {words}.")
    case = tiny_case(tmp_path, said, faster)
    assert bool(list(compared(case, collect(case)))) == wrong


@pytest.mark.parametrize(
    ("change", "wrong"),
    [
        (("id: small-step", "id: more-steps"), True),
        (("id: small-step", "id: halved"), False),
        (("label: height of the box", "label: depth below the upper edge"), False),
        (("{path: ncon}", "{path: 'joint(free).qpos[2]', label: lower limit}"), False),
    ],
)
def test_a_title_or_label_does_not_deny_its_id(tmp_path, change: tuple[str, str], wrong: bool) -> None:
    changes = [change, ("{{ small-step.height.final }}", "{{ more-steps.height.final }}")] if wrong else [change]
    if change[1] == "id: halved":
        changes.append(("{{ small-step.height.final }}", "{{ halved.height.final }}"))
    case = tiny_case(tmp_path, *changes)
    assert bool(list(opposed(case, collect(case)))) == wrong


@pytest.mark.parametrize(("words", "wrong"), [("radians", False), ("degrees", True)])
def test_a_sentence_says_the_value_that_it_quotes(tmp_path, words: str, wrong: bool) -> None:
    model = MODEL.replace("<mujoco>", '<mujoco><compiler angle="radian"/>')
    text = f"The file has {{{{ broken.compiler.angle }}}}, so it is in {words}."
    case = tiny_case(tmp_path, ("lesson: Look at the masks.", f"lesson: {text}"), model=model)
    assert bool(list(valued(case, collect(case)))) == wrong


@pytest.mark.parametrize(
    ("label", "text", "where"),
    [
        ("height of the box", "The z component is {{ broken.height.final }}.", []),
        ("height of the box", "The x component is {{ broken.height.final }}.", ["lesson"]),
        ("height of the box", "The second number is {{ broken.height.final }}.", ["lesson"]),
        ("y component of the box", "Look.", ["signals.height.label"]),
    ],
)
def test_a_component_is_the_one_of_the_path(tmp_path, label: str, text: str, where: list[str]) -> None:
    changes = ("label: height of the box", f"label: {label}"), ("lesson: Look at the masks.", f"lesson: {text}")
    case = tiny_case(tmp_path, *changes)
    assert [problem.where for problem in indexed(case, collect(case))] == where


@pytest.mark.parametrize(
    ("label", "expr", "wrong"),
    [
        ("mean of both", "(height + contacts) / 2", False),
        ("mean of both", "height + contacts + 9", True),
        ("height minus contacts", "height - contacts", False),
        ("height minus contacts", "height + contacts", True),
    ],
)
def test_a_label_says_what_is_computed(tmp_path, label: str, expr: str, wrong: bool) -> None:
    case = tiny_case(tmp_path, ("  contacts:", f"  other: {{expr: {expr}, label: {label}}}\n  contacts:"))
    assert bool(list(computed(case, collect(case)))) == wrong
