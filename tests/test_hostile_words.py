"""Words that would act: shown, or left out, and nothing else."""

from __future__ import annotations

import json
from html import unescape
from pathlib import Path
from typing import Any

import numpy as np
import pytest
import yaml
from clinic.pages.cases import CasePage
from clinic.pages.figures.film import HEIGHT, WIDTH
from clinic.pages.figures.pictures import webp
from clinic.pages.figures.plots import plots
from clinic.pages.home import home
from clinic.pages.text.prose import ProseError, markdown, opening
from clinic.pages.text.sanitize import sanitized
from clinic.proof.evidence import Evidence, collect
from clinic.record.case import load_case
from helpers import MODEL, RECORD, page_of, script_case, tiny_case, write_folder
from markup import acting, rendered
from project import SILENT, run, write_project

SCRIPTED = "<script>alert(1)</script>"
LINE = (
    "a [x](javascript:alert(1)) {{ 7 }} {% x %} { onclick=alert(1) } | & \" ' \\ `$\\frac{$ --> *b* </title>" + SCRIPTED
)
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
    "# heading { onclick=alert(1) style=position:fixed }",
    "{% raw %}{% for x in y %}",
    "[a]: javascript:alert(1)\n\n[a] [a][a] [x][a]",
    "[x](javascript:alert(1)) [x](JaVaScRiPt:alert(1)) [x](java&#115;cript:alert(1)) [x](data:text/html,alert(1))",
    "[x](<javascript:alert(1)>) [x]( vbscript:alert(1) ) [![x](y)](javascript:alert(1))",
    "![x](https://other.example/x.png) ![x](//other.example/x.png) ![x](data:image/svg+xml,alert(1))",
    r"$\text{<script>alert(1)</script>}$ $\href{javascript:alert(1)}{x}$ $\style{color:red}{x}$",
    r"$\text{<!--><img/src/onerror=alert(1)>-->}$ $\text{<![CDATA[<img/src/onerror=alert(1)>]]>}$",
    r"$\color{a>[x](/onmouseover=alert(1)//)}b$ $\color{a onmouseover=alert(1)}b$",
]


@pytest.fixture(scope="module")
def proof(tmp_path_factory: pytest.TempPathFactory) -> Evidence:
    """The evidence of the tiny case."""
    return collect(tiny_case(tmp_path_factory.mktemp("root")))


def wild_record(text: str = "\n\n".join(ACTS)) -> dict[str, Any]:
    """The tiny case's record, with this prose and with LINE wherever a line is written."""
    record = yaml.safe_load(RECORD)
    record |= dict.fromkeys(("symptom", "diagnosis", "cause", "fix", "lesson"), text)
    record |= {"title": LINE[:80], "phrases": [LINE], "exempt": {"steady": text}}
    record["refuted"][0]["why"] = text
    record["fixes"][0]["title"] = record["refuted"][0]["title"] = LINE
    record["signals"]["height"] |= {"label": LINE, "unit": LINE}
    return record


@pytest.mark.parametrize("text", ACTS)
def test_prose_does_not_act(proof: Evidence, text: str) -> None:
    try:
        made = markdown(text, proof)
    except ProseError:
        return
    assert acting(rendered(f"{made}\n\n<details markdown>\n\n{made}\n\n</details>\n")) == []


def test_lines_are_shown_on_every_page(proof: Evidence, tmp_path: Path) -> None:
    record = wild_record("Words.")
    case = load_case(write_folder(tmp_path, "falling-box", {"case.yaml": json.dumps(record), "model.xml": MODEL}))
    files = dict.fromkeys(("film.mp4", "broken.webp", "fixed.webp"), b"")
    files["strip.webp"] = webp(np.zeros((2 * HEIGHT, 4 * WIDTH, 3), dtype=np.uint8))
    said = {key: variant.model_copy(update={"messages": [SCRIPTED, "```"]}) for key, variant in proof.variants.items()}
    evidence = proof.model_copy(update={"variants": said})
    shown = [CasePage(case, "", opening(case, evidence), files)]
    for page in (page_of(case, evidence, files, case), home(shown)):
        assert acting(rendered(page)) == []
    assert unescape(rendered(page_of(case, evidence, files, case))).count(LINE[:30]) >= 5
    for drawing in plots(case, evidence).values():
        assert b"<script" not in drawing


def test_a_built_site_holds_nothing_that_acts(tmp_path: Path, kept: Path) -> None:
    folder = write_project(tmp_path, SILENT, kept=kept)
    (folder / "cases" / "falling-box" / "case.yaml").write_text(json.dumps(wild_record()), encoding="utf-8")
    (folder / "cases" / "refused").mkdir()
    (folder / "cases" / "refused" / "case.yaml").write_text(f"number: 3\ntitle: {LINE!r}\n", encoding="utf-8")
    done = run(folder, "-m", "mkdocs", "build")
    assert done.returncode == 0, done.stderr
    pages = {path: path.read_text(encoding="utf-8") for path in (folder / "site").rglob("*.html")}
    assert len(pages) >= 7
    assert [(path.name, said) for path, page in pages.items() for said in acting(page) if "alert" in said] == []


def test_what_a_script_prints_is_shown(tmp_path: Path) -> None:
    printed = [SCRIPTED, "```", "    ```", "`</code><script>x", "| a | <b>", "[x](javascript:y)", "error = 0.5"]
    case = script_case(tmp_path, script="\n".join(f"print({text!r})" for text in printed))
    html = rendered(page_of(case, collect(case), {}))
    assert acting(html) == []
    assert unescape(html).count("[x](javascript:y)") >= 3  # the script, and what it and the repaired one print


def test_the_description_of_a_page_stays_in_its_attribute(proof: Evidence, tmp_path: Path) -> None:
    case = tiny_case(tmp_path, ("It falls to {{ broken.height.final }}.", "'A \"><b>'"))
    assert 'description: "A &quot;&gt;&lt;b&gt;"' in page_of(case, proof)


def test_what_pages_need_is_kept() -> None:
    html = (
        '<p id="a" class="b" hidden="" data-c="d">x</p><a href="../b/index.md#c" title="d">e</a>'
        '<math display="block"><mfrac linethickness="0"><mi mathvariant="bold">x</mi><mn>2</mn></mfrac></math>'
        '<table><tbody><tr><td style="text-align:right">3</td></tr></tbody></table>'
    )
    assert sanitized(html) == html
