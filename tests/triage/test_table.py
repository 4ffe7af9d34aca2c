"""Steps by cases: a step that caught a case no longer sees it after the repair."""

from __future__ import annotations

from pathlib import Path

from clinic.triage.findings import Finding
from clinic.triage.steps import STEPS, Observation
from clinic.triage.table import FILE, Screening, cell, screen, screening_tasks, table
from clinic.work.cache import Cache
from clinic.work.task import run_tasks
from helpers import script_case, tiny_case


def finding(rule: str, element: str = "joint a", text: str = "odd") -> Finding:
    return Finding(rule=rule, element=element, text=text)


def observations(*found: Finding) -> list[Observation]:
    return [Observation(step=step, said="", findings=list(found) if step == "model" else []) for step in STEPS]


def test_what_the_repair_removes_is_caught_and_what_stays_is_not() -> None:
    made = Screening(
        broken=observations(finding("ranges"), finding("gains")), fixed=observations(finding("gains", text="still"))
    )
    assert made.seen("model") == ([finding("ranges")], [finding("gains")])
    assert cell(made, "model") == "**joint a: odd**"
    assert cell(made, "reduce") == "nothing"


def test_what_both_show_is_said_to_stay() -> None:
    both = observations(finding("gains"), finding("gains", "joint b"))
    assert cell(Screening(broken=both, fixed=both), "model") == "joint a: odd (and 1 more) (after the repair too)"
    assert cell(None, "model") == "code"


def test_long_findings_are_cut_at_a_word_and_marks_are_inert() -> None:
    made = Screening(broken=observations(finding("ranges", text="[0] | " + "word " * 40)), fixed=observations())
    text = cell(made, "model")
    assert text.startswith("**joint a: \\[0\\] \\| word")
    assert text.endswith("word …**")
    assert len(text) < 110


def test_the_tiny_case_is_caught_by_two_steps(tmp_path: Path) -> None:
    case = tiny_case(tmp_path)
    made = Screening.model_validate_json(screen(case)[FILE])
    assert {step for step in STEPS if made.seen(step)[0]} == {"model", "overlays"}


def test_the_table_has_a_row_for_every_case_and_is_honest_about_code(tmp_path: Path) -> None:
    cases = [tiny_case(tmp_path), script_case(tmp_path)]
    text = table(cases, run_tasks(list(screening_tasks(cases)), Cache(tmp_path / "cache"))[0])
    rows = [line for line in text.splitlines() if line.startswith("| [")]
    assert len(rows) == 2
    assert all(row.count("](cases/") == 7 for row in rows)
    assert rows[1].count("[code]") == 6
    assert "Of 1 cases with a model, 1 are caught by at least one step" in text
    assert "The other 1 are bugs in code" in text
    assert "A hinge's range is narrower than 0.1 rad" in text


def test_prose_alone_screens_nothing_again(tmp_path: Path) -> None:
    one = next(screening_tasks([tiny_case(tmp_path / "one")]))
    other = next(screening_tasks([tiny_case(tmp_path / "other", ("title: Remove", "title: Take off"))]))
    assert one.key == other.key
