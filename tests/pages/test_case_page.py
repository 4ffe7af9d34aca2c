"""Pages: what stands on a case's page and on its card."""

from __future__ import annotations

import re
from dataclasses import replace
from pathlib import Path

import pytest
import yaml
from clinic.pages.case_page import interim_page
from clinic.pages.cases import CasePage
from clinic.pages.text.prose import opening
from clinic.pages.text.template import render
from clinic.proof.evidence import Evidence, collect
from clinic.record.case import Case, read_cases
from clinic.record.families import families
from helpers import page_of, script_case, tiny_case, write_case

SPACE = "\u00a0"


@pytest.fixture(scope="module")
def made(tmp_path_factory: pytest.TempPathFactory) -> tuple[Case, Evidence]:
    case = tiny_case(tmp_path_factory.mktemp("pages"))
    return case, collect(case)


@pytest.fixture
def page(made: tuple[Case, Evidence]) -> str:
    return page_of(*made)


def test_heading_and_folds_in_order(page: str) -> None:
    assert "\n# 1. A box falls through the floor\n" in page
    assert re.findall(r'^\?\?\? \w+ "(.*)"$', page, re.MULTILINE) == ["Diagnosis", "Cause", "Fix", "Lesson"]


def test_an_interim_page_shows_the_numbers_that_are_there(made: tuple[Case, Evidence]) -> None:
    page = interim_page(*made)
    assert "\n# 1. A box falls through the floor\n" in page
    assert "Being measured" in page
    assert "| fix: `share-a-bit` | 4 | 0.0" in page


def test_no_field_is_left_open(page: str) -> None:
    assert "{{" not in page
    assert "{%" not in page


def test_symptom_stands_before_the_first_fold_with_its_number(made: tuple[Case, Evidence], page: str) -> None:
    final = made[1].variants["broken"].values["height"]["final"]
    assert f"It falls to \u2212{abs(final or 0):.3f}{SPACE}m." in page.split("???", 1)[0]


def test_diff_of_every_remedy(page: str) -> None:
    fix, refuted = re.findall(r"```diff\n(.*?)```", page, re.DOTALL)
    assert '-    <geom name="floor" type="plane" size="1 1 0.1" contype="2" conaffinity="2"/>' in fix
    assert '+    <geom name="floor" type="plane" size="1 1 0.1"/>' in fix
    assert '+  <option timestep="0.001"/>' in refuted


def test_table_has_a_row_for_every_variant_and_as_many_cells_as_heads(page: str) -> None:
    rows = [line.strip() for line in page.splitlines() if line.lstrip().startswith("| ")]
    assert len({row.count("|") for row in rows}) == 1
    assert rows[0] == "| | contacts, highest | height of the box, at the end |"
    assert rows[2] == "| *well means* |  | between 0.045 and 0.051 m |"
    assert rows[3].startswith("| **broken** | 0 | \u22120.7")
    assert rows[3].endswith("\u2717 |")
    assert rows[4].startswith("| fix: `share-a-bit` | 4 | 0.0")
    assert rows[4].endswith("\u2713 |")
    assert rows[5].startswith("| refuted: `small-step` | 0 | \u22120.7")


def test_pictures_are_shown_where_they_could_be_made(made: tuple[Case, Evidence], page: str) -> None:
    assert "broken.webp" not in page
    assert "broken.webp" in page_of(*made, {"broken.webp": b"", "fixed.webp": b""})


def test_alternative_text_states_the_numbers(made: tuple[Case, Evidence], page: str) -> None:
    (text,) = set(re.findall(r"!\[(.*?)\]\(plot.svg", page))
    assert text.startswith("Height of the box at the end: broken \u22120.7")
    assert "share-a-bit 0.0" in text


def test_files_and_command_at_the_foot(page: str) -> None:
    foot = page.split("## Files")[1]
    assert "`clinic check falling-box`" in foot
    assert set(re.findall(r"\]\((.*?)\)", foot)) >= {"model.xml", "case.yaml", "evidence.json"}


def test_a_first_version_tells_what_is_not_known(tmp_path: Path, page: str) -> None:
    assert re.search(
        r"^Grade B: the record does not say whether a repair .*, nor whether a check .*, `telling`\)\.$", page, re.M
    )
    trial = 'trials: [{id: high, title: High, start: {"joint(free).qpos[2]": 0.2}}]'
    family = "family: falls-through\ntelling: {cause: masks, says: It falls.}"
    case = tiny_case(tmp_path, ("film: {}", f"film: {{}}\nloose: {{}}\n{trial}\n{family}"))
    assert "Grade" not in page_of(case, collect(case))


def test_related_cases_are_linked(tmp_path: Path) -> None:
    write_case(tmp_path, ("number: 1", "number: 1\nsee: [sliding-box]"))
    write_case(tmp_path, ("number: 1", "number: 2"), ("A box falls", "A box slides"), slug="sliding-box")
    case, other = read_cases(tmp_path / "cases")[0]
    assert "[2. A box slides through the floor](../sliding-box/index.md)" in page_of(case, collect(case), {}, other)


def test_script_with_its_output_before_and_after(tmp_path: Path) -> None:
    case = script_case(tmp_path)
    page = page_of(case, collect(case))
    assert '    print("error = 0.5")\n' in page
    assert re.findall(r"^    error = (.*)$", page, re.MULTILINE) == ["0.5"]
    assert "    | <code>error = 0.5</code> | <code>error = 0.0</code> |\n" in page


def test_snippet_with_its_output(tmp_path: Path) -> None:
    case = tiny_case(tmp_path, ("cause:", "snippet: |\n  for k in range(2):\n      print('line', k)\ncause:"))
    page = page_of(case, collect(case))
    assert "    ```python\n    for k in range(2):\n        print('line', k)\n    ```" in page
    assert "    ```text\n    line 0\n    line 1\n    ```" in page


def test_front_matter_is_yaml_whatever_the_title(tmp_path: Path) -> None:
    from yaml import safe_load

    title = 'A "box": falls # through'
    case = tiny_case(tmp_path, ("title: A box falls through the floor", f"title: '{title}'"))
    front = safe_load(page_of(case, collect(case)).split("---\n")[1])
    assert front["title"] == title
    assert front["tags"] == ["contact"]
    assert front["description"].startswith("It falls to \u2212")


def home(case: Case, evidence: Evidence, *files: str) -> str:
    page = CasePage(case, "", opening(case, evidence), dict.fromkeys(files, b""))
    return render("home", shown=[page], families=families(), engine="4.0.0")


def test_home_page_has_a_card_of_every_case(made: tuple[Case, Evidence]) -> None:
    drawn, plotted = home(*made, "broken.webp"), home(*made)
    assert "**[1. A box falls through the floor](cases/falling-box/index.md)**\n\nIt falls to \u2212" in drawn
    assert "MuJoCo 4.0.0" in drawn
    assert "](cases/falling-box/broken.webp)" in drawn
    assert "](cases/falling-box/plot.svg)" in plotted


def test_symptom_on_a_card_holds_no_html_of_its_own(tmp_path: Path) -> None:
    case = tiny_case(tmp_path, ("It falls to", "The <geom/> falls <b>to"))
    assert "<" not in home(case, collect(case)).split('class="cases"')[1].split("index.md)**")[1].split("</div>")[0]


def test_tags_are_words_whatever_yaml_makes_of_them(made: tuple[Case, Evidence]) -> None:
    case, evidence = made
    tags = ["joint", "null", "true", "on"]
    page = page_of(replace(case, record=case.record.model_copy(update={"tags": tags})), evidence)
    assert yaml.safe_load(page.split("---\n")[1])["tags"] == tags


def test_a_backtick_alone_in_a_title_is_no_code(made: tuple[Case, Evidence]) -> None:
    case, evidence = made
    fix = case.record.fixes[0].model_copy(update={"title": "Relax ` the mask"})
    page = page_of(replace(case, record=case.record.model_copy(update={"fixes": [fix]})), evidence)
    assert "**Relax &#96; the mask** (`share-a-bit`)" in page
