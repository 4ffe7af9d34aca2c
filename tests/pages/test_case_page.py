"""Pages: what stands on a case's page and on its card."""

from __future__ import annotations

import re
from dataclasses import replace
from pathlib import Path

import pytest
import yaml
from clinic.pages.case_page import interim_page
from clinic.pages.measured import measure, table
from clinic.proof.evidence import Evidence, collect
from clinic.record.case import Case, read_cases
from clinic.record.claims import Claims
from helpers import page_of, script_case, tiny_case, write_case
from lxml.html import fragment_fromstring
from markup import rendered

SPACE = "\u00a0"
FOLDS = ["Diagnosis", "Cause", "Fix", "What does not help", "Lesson", "How we know", "Read on"]


@pytest.fixture(scope="module")
def made(tmp_path_factory: pytest.TempPathFactory) -> tuple[Case, Evidence]:
    case = tiny_case(tmp_path_factory.mktemp("pages"))
    return case, collect(case)


@pytest.fixture
def page(made: tuple[Case, Evidence]) -> str:
    return page_of(*made)


def test_heading_and_folds_in_order(page: str) -> None:
    assert "\n# 1. A box falls through the floor\n" in page
    assert re.findall(r"^<summary>([\w ]*)", page, re.MULTILINE) == ["Just tell me ", *FOLDS]


def test_an_interim_page_shows_the_numbers_that_are_there(made: tuple[Case, Evidence]) -> None:
    page = interim_page(*made)
    assert "\n# 1. A box falls through the floor\n" in page
    assert "Being measured" in page
    assert "<th>repaired: share-a-bit</th>" in page


def test_no_field_is_left_open(page: str) -> None:
    assert "{{" not in page
    assert "{%" not in page


def test_symptom_stands_before_the_first_fold_with_its_number(made: tuple[Case, Evidence], page: str) -> None:
    final = made[1].variants["broken"].values["height"]["final"]
    assert f"It falls to \u2212{abs(final or 0):.3f}{SPACE}m." in page.split("<details", 1)[0]


def test_diff_of_every_remedy(page: str) -> None:
    told, fix, refuted = re.findall(r"```diff\n(.*?)```", page, re.DOTALL)
    assert told.splitlines() == [
        '-<geom name="floor" type="plane" size="1 1 0.1" contype="2" conaffinity="2"/>',
        '+<geom name="floor" type="plane" size="1 1 0.1"/>',
    ]
    assert '-    <geom name="floor" type="plane" size="1 1 0.1" contype="2" conaffinity="2"/>' in fix
    assert '+    <geom name="floor" type="plane" size="1 1 0.1"/>' in fix
    assert '+  <option timestep="0.001"/>' in refuted


def test_table_has_a_row_for_every_outcome_and_says_what_was_the_same(page: str) -> None:
    table = rendered(page)
    rows = [[cell.text_content() for cell in row] for row in fragment_fromstring(table, "div").xpath("//table//tr")]
    assert rows[0] == ["", "contacts, highest", "height of the box, at the end"]
    assert rows[1] == ["counts as broken", "0", ""]
    assert rows[2] == ["counts as repaired", "", f"between 0.045 and 0.051{SPACE}m"]
    assert rows[3][:2] == ["broken", "0"]
    assert re.fullmatch(rf"\u22120.7\d+{SPACE}m{SPACE}\u2717", rows[3][2])
    assert rows[4][:2] == ["repaired: share-a-bit", "4"]
    assert rows[4][2].endswith("\u2713")
    assert rows[5][0] == "does not help: small-step"


def test_variants_that_measure_the_same_share_a_row(made: tuple[Case, Evidence]) -> None:
    case, evidence = made
    twin = evidence.variants["broken"].model_copy(update={"kind": "refuted"})
    twice = evidence.model_copy(update={"variants": {**evidence.variants, "twin": twin}})
    assert [label for label, _ in table(case, twice).rows[2:]] == [
        "broken, also after twin",
        "repaired: share-a-bit",
        "does not help: small-step",
    ]


def test_what_every_variant_measures_alike_is_said_once(tmp_path: Path) -> None:
    checks = ("  fixed:\n", "  fixed:\n    - {signal: height, take: first, above: 0}\n")
    case = tiny_case(tmp_path, checks, ('timestep="0.001"', 'timestep="0.002" gravity="0 0 -9.81"'))
    found = table(case, collect(case))
    assert found.same == [f"height of the box, after one step: 0.06000{SPACE}m"]
    assert len(found.heads) == 2


def test_what_rounding_left_of_zero_is_zero(made: tuple[Case, Evidence]) -> None:
    assert measure(1e-12, "height", made[1]) == f"0{SPACE}m"
    assert measure(1e-6, "height", made[1]) != f"0{SPACE}m"


def test_pictures_are_shown_where_they_could_be_made(made: tuple[Case, Evidence], page: str) -> None:
    assert "broken.webp" not in page
    assert "broken.webp" in page_of(*made, {"broken.webp": b"", "fixed.webp": b""})


def test_alternative_text_states_the_numbers(made: tuple[Case, Evidence], page: str) -> None:
    (text,) = set(re.findall(r"!\[(.*?)\]\(plot.svg", page))
    assert text.startswith("Height of the box at the end: broken \u22120.7")
    assert "share-a-bit 0.0" in text


def test_contrasts_are_told_apart_from_the_situations_in_which_repairs_hold(tmp_path: Path) -> None:
    sound = "{id: heavy, title: Twice the gravity, set: {'model.opt.gravity[2]': -19.62}}"
    checks = "checks: {broken: [{signal: contacts, take: max, equals: 0}], fixed: [{signal: height, below: 0.06}]}"
    other = f"{{id: high, title: From above, start: {{'joint(free).qpos[2]': 0.12}}, contrast: true, {checks}}}"
    case = tiny_case(tmp_path, ("no_sweep: The masks", f"trials: [{sound}, {other}]\nno_sweep: The masks"))
    known = page_of(case, collect(case)).split("<summary>How we know")[1]
    holds, _, contrasts = known.partition("A control, in which the broken model works, or the repaired one fails")
    assert "in other situations too:\n\n- Twice the gravity" in holds
    assert "- From above" not in holds
    assert "- From above" in contrasts


def test_files_to_download_and_the_command(page: str) -> None:
    assert "To download: [model.xml](model.xml)." in page
    known = page.split("<summary>How we know")[1]
    assert "`pip install .`, then `clinic show falling-box --answer`" in known
    assert set(re.findall(r"\]\((.*?)\)", known)) >= {"case.yaml", "evidence.json"}


def test_the_broken_source_stands_in_the_open(page: str, made: tuple[Case, Evidence]) -> None:
    source = f"```xml\n{made[0].text.rstrip()}\n```"
    assert page.index("</details>") < page.index(source) < page.index("<summary>Diagnosis")
    taken_over = page_of(*made, {"playground.json": b""}).split('<div class="playground"')[1].split("</div>")[0]
    assert source in taken_over


def test_a_model_is_not_told_that_its_script_does_not_run(made: tuple[Case, Evidence], tmp_path: Path) -> None:
    script = script_case(tmp_path)
    for case, evidence, told in ((*made, False), (script, collect(script), True)):
        assert ("does not run in this page" in page_of(case, evidence, {"playground.json": b"{}"})) == told


def test_who_asks_to_be_told_is_given_the_lines_to_copy(made: tuple[Case, Evidence]) -> None:
    page = fragment_fromstring(rendered(page_of(*made)), "div")
    (answer,) = page.xpath("//details[@class='answer']//*[@id='answer']")
    (block,) = answer.xpath(".//*[@data-copy]")
    assert block.get("data-copy") == '    <geom name="floor" type="plane" size="1 1 0.1"/>'
    assert block.xpath(".//pre//code")
    for link in answer.xpath(".//a[starts-with(@href, '#')]"):
        assert page.xpath("//details//*[@id=$name]", name=link.get("href")[1:]), link.get("href")


def test_formulas_stay_in_their_line(tmp_path: Path) -> None:
    case = tiny_case(
        tmp_path, ("cause: The masks share no bit.", "cause: |\n  The bit\n  $a$ is\n  none.\n\n  $b$ too.")
    )
    page = fragment_fromstring(rendered(page_of(case, collect(case))), "div")
    assert [p.text_content() for p in page.xpath("//details[@class='bug']/p")] == ["The bit\na is\nnone.", "b too."]


def test_a_first_version_tells_what_is_not_known(tmp_path: Path, page: str) -> None:
    assert re.search(
        r"^Grade B: the record does not say whether a repair .*, nor whether a check .*, `claims.yaml`\)\.$", page, re.M
    )
    trial = 'trials: [{id: high, title: High, start: {"joint(free).qpos[2]": 0.2}}]'
    family = "family: falls-through\ntelling: {cause: masks, says: It falls.}"
    case = tiny_case(tmp_path, ("film: {}", f"film: {{}}\nloose: {{}}\n{trial}\n{family}"))
    assert "Grade" not in page_of(replace(case, claims=Claims()), collect(case))


def test_related_cases_are_linked(tmp_path: Path) -> None:
    write_case(tmp_path, ("number: 1", "number: 1\nsee: [sliding-box]"))
    write_case(tmp_path, ("number: 1", "number: 2"), ("A box falls", "A box slides"), slug="sliding-box")
    case, other = read_cases(tmp_path / "cases")[0]
    assert "[2. A box slides through the floor](../sliding-box/index.md)" in page_of(case, collect(case), {}, other)


def test_script_with_its_output_before_and_after(tmp_path: Path) -> None:
    case = script_case(tmp_path)
    page = page_of(case, collect(case))
    opened, fix = page.split("<summary>Fix")[0].split("<summary>Diagnosis")[0], page.split("<summary>Fix")[1]
    assert 'print("error = 0.5")\n' in opened
    assert re.findall(r"^error = (.*)$", opened, re.MULTILINE) == ["0.5"]
    assert re.findall(r"^error = (.*)$", fix, re.MULTILINE) == ["0.0"]


def test_snippet_with_its_output(tmp_path: Path) -> None:
    case = tiny_case(tmp_path, ("cause:", "snippet: |\n  for k in range(2):\n      print('line', k)\ncause:"))
    page = page_of(case, collect(case))
    assert "```python\nfor k in range(2):\n    print('line', k)\n```" in page
    assert "```text\nline 0\nline 1\n```" in page


def test_front_matter_is_yaml_whatever_the_title(tmp_path: Path) -> None:
    from yaml import safe_load

    title = 'A "box": falls # through'
    case = tiny_case(tmp_path, ("title: A box falls through the floor", f"title: '{title}'"))
    front = safe_load(page_of(case, collect(case)).split("---\n")[1])
    assert front["title"] == title
    assert front["tags"] == ["contact"]
    assert front["description"].startswith("It falls to \u2212")


def test_tags_are_words_whatever_yaml_makes_of_them(made: tuple[Case, Evidence]) -> None:
    case, evidence = made
    tags = ["joint", "null", "true", "on"]
    page = page_of(replace(case, record=case.record.model_copy(update={"tags": tags})), evidence)
    assert yaml.safe_load(page.split("---\n")[1])["tags"] == tags


def test_a_backtick_alone_in_a_title_is_no_code(made: tuple[Case, Evidence]) -> None:
    case, evidence = made
    fix = case.record.fixes[0].model_copy(update={"title": "Relax ` the mask"})
    page = page_of(replace(case, record=case.record.model_copy(update={"fixes": [fix]})), evidence)
    assert "**Relax &#96; the mask**{ #fix-share-a-bit } (`share-a-bit`)" in page
