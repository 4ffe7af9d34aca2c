"""Words that would act: refused, or shown and nothing else."""

from __future__ import annotations

import io
import json
from collections import Counter
from html import unescape
from pathlib import Path
from typing import Any

import pytest
import yaml
from clinic.pages.case_page import card, home_page
from clinic.pages.error_page import error_page, read_name
from clinic.pages.figures.plots import plots
from clinic.pages.playground import playground
from clinic.proof.evidence import Evidence, collect
from clinic.proof.examine import examine
from clinic.publish.site import navigation
from clinic.record.case import load_case
from clinic.record.problem import CaseError
from helpers import MODEL, RECORD, only_problem, page_of, script_case, tiny_case, write_case, write_folder
from markup import ROOT, active, elements, extensions, rendered
from mkdocs.commands.build import build
from mkdocs.config import load_config

SCRIPTED = "<script>alert(1)</script>"


ACTS = [
    SCRIPTED,
    "<svg onload=alert(1)>",
    "<iframe src=//evil.example></iframe>",
    "<img src=x onerror=alert(1)>",
    "<a href='javascript:alert(1)'>x</a>",
    "<javascript:alert(1)>",
    "`\n\n<script>alert(1)</script>\n\n`",
    "\\`<script>alert(1)</script>\\`",
    "```a`b\n<script>alert(1)</script>",
    "   ~~~\n<script>alert(1)</script>\n   ~~~",
    "```{.x onclick=alert(1)}\ncode\n```",
    "> ```\n> <script>alert(1)</script>\n> ```",
    "<!-- x --> <?php x ?> <![CDATA[x]]>",
    "<div markdown onclick=alert(1)>x</div>",
    "text{ onclick=alert(1) }",
    "# heading { onclick=alert(1) }",
    "{% raw %}{% for x in y %}",
    "[a]: javascript:alert(1)\n\n[a] [a][a] [x][a]",
]


@pytest.mark.parametrize("field", ["symptom", "diagnosis", "cause", "fix", "lesson", "why"])
@pytest.mark.parametrize("text", ACTS)
def test_prose_that_would_act_is_shown(hostile: Evidence, tmp_path: Path, field: str, text: str) -> None:
    record = {**plain_record(), field: text} if field != "why" else plain_record()
    if field == "why":
        record["refuted"][0]["why"] = text
    case = load_case(write_folder(tmp_path, "falling-box", {"case.yaml": json.dumps(record), "model.xml": MODEL}))
    files = {"film.mp4": b"", "broken.webp": b"", "strip.webp": b"", "fixed.webp": b""}
    assert elements(rendered(body(page_of(case, hostile, files)))) is None
    assert elements(rendered(body(home_page([card(case, hostile, files)], "4.0.0")))) is None


@pytest.mark.parametrize(
    "link",
    [
        "[x](javascript:alert(1))",
        "[x](JaVaScRiPt:alert)",
        "[x](java&#115;cript:alert)",
        "[x](data:text/html,x)",
        "[x](vbscript:x)",
        "[x](<javascript:alert(1)>)",
        "[x]( javascript:x )",
        '[x](a.md "title")',
        "![x](https://other.example/x.png)",
        "![x](//other.example/x.png)",
        "[x](file:///etc/hosts)",
        "[x](//other.example)",
        "[![x](y)](javascript:x)",
    ],
)
def test_a_link_to_a_strange_address(tmp_path: Path, link: str) -> None:
    told = only_problem(write_case(tmp_path, ("lesson: Look at the masks.", f"lesson: |\n  Look\n  at {link} now.")))
    assert (told.line, told.where) == (10, "lesson")
    assert told.found in link
    assert told.repair == "correct the address; write code between backticks"


@pytest.mark.parametrize(
    "link",
    [
        "[x](https://mujoco.org/a?b=c#d)",
        "[x](../arm-explodes/index.md#fix)",
        "`[x](javascript:x)`",
        "![x](broken.webp)",
    ],
)
def test_a_plain_link_is_left(tmp_path: Path, link: str) -> None:
    assert tiny_case(tmp_path, ("Look at the masks.", f"'Look at {link} now.'")).record.lesson == f"Look at {link} now."


@pytest.mark.parametrize(
    ("text", "expected"),
    [
        pytest.param("It rises to {{ broken.height.final }.", "a field that is closed: {{ ... }}", id="one-brace"),
        pytest.param("{{" * 2400, "a field that is closed: {{ ... }}", id="braces-without-end"),
        pytest.param("``````````<b>`````````", "fewer", id="ten-backticks"),
        pytest.param("\n  ".join("~" * k for k in range(10, 90)), "fewer", id="more-and-more-tildes"),
        pytest.param("```\n  <script>alert(1)</script>", "a block of code that is closed", id="fence-without-end"),
        pytest.param("~~~~x\n  " * 500, "a block of code that is closed", id="fences-without-end"),
        pytest.param("*" * 1000 + "a" + "*_" * 1500, "text", id="emphasis-in-emphasis"),
        pytest.param("1. " * 1000, "text", id="list-in-a-list"),
        pytest.param("[" * 4000, "text", id="brackets"),
        pytest.param("[a " * 1500, "200 at most", id="brackets-apart"),
        pytest.param("a" * 5001, "5000 at most", id="long"),
        pytest.param(f"See ${'a+' * 600}a$.", "a LaTeX formula", id="long-formula"),
        pytest.param(" ".join("`" * k for k in range(1, 90)), "fewer", id="more-and-more-backticks"),
    ],
)
def test_what_would_be_searched_for_an_end_again_and_again(tmp_path: Path, text: str, expected: str) -> None:
    told = only_problem(write_case(tmp_path, ("lesson: Look at the masks.", f"lesson: |\n  {text}")))
    assert (told.where, told.expected) == ("lesson", expected)


@pytest.mark.parametrize(
    "formula",
    [
        r"\text{<script>alert(1)</script>}",
        r"\href{javascript:alert(1)}{x}",
        r"\style{color:red}{x}",
        r"\frac{",
        r"\text{<!--><img/src/onerror=alert(1)>-->}",
        r"\text{<![CDATA[<img/src/onerror=alert(1)>]]>}",
        r"\text{<?x?>}",
        r"\color{a>[x](/onmouseover=alert(1)//)}b",
        r"\color{a onmouseover=alert(1)}b",
        r"\sqrt{" * 160,
    ],
)
def test_a_formula_that_is_more(tmp_path: Path, formula: str) -> None:
    told = only_problem(write_case(tmp_path, ("lesson: Look at the masks.", f"lesson: 'See ${formula}$.'")))
    assert (told.where, told.expected) == ("lesson", "a LaTeX formula")


@pytest.mark.parametrize(
    ("old", "new", "where"),
    [
        pytest.param("A box falls through the floor", SCRIPTED, "title", id="title"),
        pytest.param("Remove the masks of the floor", SCRIPTED, "fixes[0].title", id="title-of-a-fix"),
        pytest.param("Halve the timestep", SCRIPTED, "refuted[0].title", id="title-of-a-remedy"),
        pytest.param("[box falls through floor]", f"[{SCRIPTED}]", "phrases[0]", id="phrase"),
        pytest.param("height of the box", SCRIPTED, "signals.height.label", id="label"),
        pytest.param("unit: m,", f"unit: {SCRIPTED},", "signals.height.unit", id="unit"),
        pytest.param("A box falls through the floor", '"one\\ntwo"', "title", id="line-break"),
        pytest.param("tags: [contact]", f"tags: ['{SCRIPTED}']", "tags[0]", id="tag"),
        pytest.param("id: share-a-bit", f"id: {SCRIPTED}", "fixes[0].id", id="id"),
        pytest.param("contacts: {path: ncon}", f"{SCRIPTED}: {{path: ncon}}", "signals", id="name-of-a-signal"),
        pytest.param("model: model.xml", "model: ../model.xml", "model", id="file"),
        pytest.param("picture: {camera: side}", f"picture: {{camera: {SCRIPTED}}}", "picture.camera", id="camera"),
    ],
)
def test_a_name_or_a_line_that_holds_html(tmp_path: Path, old: str, new: str, where: str) -> None:
    with pytest.raises(CaseError) as caught:
        examine(load_case(write_case(tmp_path, (old, new))))
    told = caught.value.problems[0]
    assert told.file == "cases/falling-box/case.yaml"
    assert told.where.startswith(where)


LINE = "a [x](javascript:alert) {{ 7 }} {% x %} { onclick=x } | & \" ' \\ `[y](javascript:z)` $\\frac{$ --> *b*"


@pytest.fixture(scope="module")
def hostile(tmp_path_factory: pytest.TempPathFactory) -> Evidence:
    """The evidence of the tiny case."""
    return collect(tiny_case(tmp_path_factory.mktemp("root")))


def plain_record() -> dict[str, object]:
    """The tiny case's record, without fields in its prose."""
    record = yaml.safe_load(RECORD)
    record |= {"symptom": "It falls.", "diagnosis": "No contacts."}
    record["refuted"][0]["why"] = "It falls."
    return record


def body(page: str) -> str:
    """A page without its front matter."""
    return page.split("\n---\n", 1)[1]


def test_lines_that_would_act_are_shown_on_every_page(hostile: Evidence, tmp_path: Path) -> None:
    record = plain_record()
    record |= {"title": LINE[:80], "phrases": [LINE]}
    record["fixes"][0]["title"] = record["refuted"][0]["title"] = LINE
    record["signals"]["height"] |= {"label": LINE, "unit": LINE}
    case = load_case(write_folder(tmp_path, "falling-box", {"case.yaml": json.dumps(record), "model.xml": MODEL}))
    files = {"film.mp4": b"", "broken.webp": b"", "strip.webp": b"", "fixed.webp": b""}
    evidence = hostile.model_copy(update={"variants": dict(hostile.variants)})
    for key, variant in evidence.variants.items():
        traces = {name: trace.model_copy(update={"unit": LINE}) for name, trace in variant.traces.items()}
        evidence.variants[key] = variant.model_copy(update={"traces": traces, "messages": [SCRIPTED, "```", LINE]})
    page = page_of(case, evidence, files, case)
    html = rendered(body(page))
    assert elements(html) is None
    assert "<script>" not in page.split("---")[1]
    assert html.count("&lt;script&gt;") == 1
    assert elements(rendered(body(home_page([card(case, evidence, files)], "4.0.0")))) is None
    assert json.loads(playground(case, "4.0.0", [case]))["title"] == LINE[:80]
    for drawing in plots(case, evidence).values():
        assert b"<script" not in drawing
        assert b"onclick" not in drawing.split(b"-->")[-1]


def test_a_built_page_and_the_search_hold_nothing_that_acts(hostile: Evidence, tmp_path: Path) -> None:
    texts = {"tame": ("A plain title", "Plain words."), "wild": (LINE[:80], "\n\n".join(ACTS))}
    pages = {}
    for name, (title, symptom) in texts.items():
        record = {**plain_record(), "title": title, "phrases": [title], "symptom": symptom}
        folder = write_folder(tmp_path / name, "falling-box", {"case.yaml": json.dumps(record), "model.xml": MODEL})
        pages[name] = page_of(load_case(folder), hostile)
    tame, wild = built(tmp_path, pages, [{f"1. {title}": f"{name}.md"} for name, (title, _) in texts.items()])
    assert tame == wild


TITLES = [
    LINE,
    "</title>" + SCRIPTED,
    "<img src=x onerror=alert(1)>",
    "&lt;script>alert(1)&lt;/script>",
    '" onclick="x',
]


@pytest.mark.parametrize("title", TITLES)
def test_a_refused_title_is_text_on_every_page(tmp_path: Path, title: str) -> None:
    names = [
        read_name(write_folder(tmp_path / slug, slug, {"case.yaml": f"number: 1\ntitle: {said}\n"}))
        for slug, said in (("tame", "A plain title"), ("wild", title))
    ]
    pages = {name.slug: error_page(name.heading, []) for name in names}
    entries = next(entry["Cases"] for entry in navigation(names) if "Cases" in entry)
    nav = [{heading: Path(path).parent.name + ".md" for heading, path in entry.items()} for entry in entries]
    tame, wild = built(tmp_path, pages, nav)
    tame_alone, _ = built(tmp_path, {"tame": pages["tame"], "wild": pages["tame"]}, ["tame.md", "wild.md"])
    assert tame == wild == tame_alone


def built(folder: Path, pages: dict[str, str], nav: list[Any]) -> list[Counter[str]]:
    """What acts on each page of a site of these; its search holds nothing that does."""
    (folder / "docs").mkdir(exist_ok=True)
    for name, page in pages.items():
        (folder / "docs" / f"{name}.md").write_text(page, encoding="utf-8")
    names, options = extensions()
    config = load_config(
        config_file=io.BytesIO(b"site_name: x"),
        docs_dir=str(folder / "docs"),
        site_dir=str(folder / "site"),
        theme={
            "name": "material",
            "custom_dir": str(ROOT / "scripts" / "theme"),
            "font": False,
            "features": ["navigation.footer"],
        },
        plugins=["search", "tags"],
        markdown_extensions=[{name: options.get(name, {})} for name in names],
        nav=nav,
    )
    build(config)
    for entry in json.loads((folder / "site" / "search" / "search_index.json").read_text(encoding="utf-8"))["docs"]:
        assert elements(entry["title"]) is None
        assert elements(entry["text"]) is None
    return [active((folder / "site" / name / "index.html").read_text(encoding="utf-8")) for name in pages]


def test_what_a_script_prints_is_shown(tmp_path: Path) -> None:
    printed = [SCRIPTED, "```", "    ```", "`</code><script>x", "| a | <b>", "[x](javascript:y)", "error = 0.5"]
    case = script_case(tmp_path, script="\n".join(f"print({text!r})" for text in printed))
    html = rendered(body(page_of(case, collect(case), {})))
    assert elements(html) is None
    assert unescape(html).count("[x](javascript:y)") >= 4  # the script, what it prints, and both columns that compare


def test_the_description_of_a_page_stays_in_its_attribute(hostile: Evidence, tmp_path: Path) -> None:
    case = tiny_case(tmp_path, ("It falls to {{ broken.height.final }}.", "'A \"><b>'"))
    assert 'description: "A &quot;&gt;&lt;b&gt;"' in page_of(case, hostile)
