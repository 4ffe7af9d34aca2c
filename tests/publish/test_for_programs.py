"""What the site has for programs: pages as Markdown, the list of them, the feed, what a page says of itself."""

from __future__ import annotations

import json
import re
from pathlib import Path
from urllib.parse import parse_qs, urlparse

import lxml.etree
import lxml.html
import pytest
import yaml
from clinic.pages.text.addresses import REPOSITORY, SITE, to_run
from clinic.publish.for_programs import feed, lines, llms_text
from clinic.publish.page_head import FORM, report_address, structured_data
from clinic.publish.plain_markdown import plain_markdown, with_listing
from helpers import tiny_case
from project import SILENT, run, write_project

HERE = {SITE: "https://example.org/clinic", REPOSITORY: "https://example.org/some/where.git"}
PAGES = {
    "index.md": b"---\ntitle: Home\ndescription: Begin.\n---\n\ntext",
    "cases/falling-box/index.md": b"---\ntitle: A box falls\ndescription: It falls to 1 &lt; 2.\n---\n\n# A box",
    "rules/masks.md": b"# Masks { #masks }\n",
    "plot.svg": b"<svg/>",
}
MARKED = """\
# 1. A box falls

It goes by <math alttext="\\frac&#123;1&#125;{2} &lt; g" display="inline"><mn>1</mn></math> &#91;m&#93;.

<div class="playground" data-case="playground.json">
<p>Here the model runs live.</p>
<button type="button" hidden>Run</button>
</div>

??? question "Diagnosis"

    Print `data.ncon`:

    ```python
    print("<b>", data.ncon)  # { .kept }
    ```

    ![Height.](plot.svg){ .plot width="480" }

## Files { #files }

<ul>
<li><a class="x" href="../../symptoms/sinks.html#more"><code>sinks</code></a></li>
</ul>
"""


@pytest.fixture
def nowhere(monkeypatch: pytest.MonkeyPatch) -> None:
    for name in (SITE, REPOSITORY):
        monkeypatch.delenv(name, raising=False)


@pytest.fixture
def somewhere(monkeypatch: pytest.MonkeyPatch) -> None:
    for name, address in HERE.items():
        monkeypatch.setenv(name, address)


def test_a_page_as_markdown_reads_without_a_browser() -> None:
    assert plain_markdown(MARKED) == (
        "# 1. A box falls\n\nIt goes by $\\frac{1}{2} < g$ [m].\n\n## Diagnosis\n\nPrint `data.ncon`:\n\n"
        '```python\nprint("<b>", data.ncon)  # { .kept }\n```\n\n![Height.](plot.svg)\n\n## Files\n\n'
        "- [`sinks`](../../symptoms/sinks.md#more)\n"
    )


def test_the_list_of_tags_stands_in_the_markdown_too() -> None:
    text = "# Topics\n\n[By symptom](symptoms.md)\n\n###### tags.md:9-31/name { #tags.md:9-31/slug }\n"
    html = (
        '<ul><li><a href="no.html">none</a></li></ul>\n'
        '<h2 id="tag:joint">\n<span class="md-tag">joint</span><a class="headerlink">¶</a></h2>\n'
        '<ul>\n<li>\n  <a href="cases/x/index.html">\n    2. A &amp; B\n  </a>\n</li></ul>'
    )
    assert plain_markdown(with_listing(text, html)) == (
        "# Topics\n\n[By symptom](symptoms.md)\n\n## joint\n\n- [2. A & B](cases/x/index.md)\n"
    )


@pytest.mark.usefixtures("nowhere")
def test_the_list_names_every_page_once_with_its_sentence() -> None:
    text = llms_text(lines(PAGES))
    assert text.startswith("# MuJoCo Debugging Clinic\n\n> ")
    assert "## Start here\n\n- [Home](index.md): Begin.\n" in text
    assert "## Cases\n\n- [A box falls](cases/falling-box/index.md): It falls to 1 < 2.\n" in text
    assert "## Rules of clinic diagnose\n\n- [Masks](rules/masks.md)\n" in text
    assert text.count("](") == 3
    assert "://" not in text


@pytest.mark.usefixtures("somewhere")
def test_where_the_site_is_known_addresses_are_whole_and_there_is_a_feed(tmp_path: Path) -> None:
    assert "(https://example.org/clinic/cases/falling-box/index.md)" in llms_text(lines(PAGES))
    case = tiny_case(tmp_path)
    news = feed(lines(PAGES), {case.slug: case})
    assert news is not None
    (item,) = lxml.etree.fromstring(news.encode()).iter("item")
    assert item.findtext("guid") == "https://example.org/clinic/cases/falling-box/index.html"
    assert item.findtext("description") == "It falls to 1 < 2."


@pytest.mark.usefixtures("nowhere")
def test_where_it_is_not_there_is_no_feed_and_a_checkout_is_installed(tmp_path: Path) -> None:
    case = tiny_case(tmp_path)
    assert feed(lines(PAGES), {case.slug: case}) is None
    assert to_run("list") == "in a checkout, `pip install .`, then `clinic list`"


@pytest.mark.usefixtures("somewhere")
def test_from_nothing_the_command_comes_from_the_repository() -> None:
    assert to_run("list") == "`uvx --from git+https://example.org/some/where clinic list`"


def test_the_form_for_a_wrong_claim_is_filled_in_by_its_own_fields(root: Path) -> None:
    form = yaml.safe_load((root / ".github/ISSUE_TEMPLATE" / FORM).read_text(encoding="utf-8"))
    fields = {field["id"] for field in form["body"] if field["type"] in ("input", "textarea")}
    asked = parse_qs(urlparse(report_address("https://example.org/r/", "cases/servo-sags/index.html")).query)
    assert asked.pop("template") == [FORM]
    assert asked.pop("title") == ["Wrong claim: servo-sags"]
    assert asked.keys() <= fields
    assert {"case", "engine", "release"} <= asked.keys()
    assert asked["case"] == ["servo-sags"]


def test_what_a_page_says_of_itself_ends_no_script() -> None:
    meta = {"description": "</script> &lt; 1", "tags": ["contact"], "image": "cases/x/card.jpg"}
    said = structured_data("https://example.org/", "Clinic", "A &amp; B", "https://example.org/x.html", meta, False)
    assert "<" not in said
    data = json.loads(said)
    assert (data["@type"], data["headline"]) == ("TechArticle", "A & B")
    assert data["image"] == "https://example.org/cases/x/card.jpg"


def test_a_site_whose_addresses_are_known_says_them_and_another_says_none(tmp_path: Path, kept: Path) -> None:
    folder = write_project(tmp_path, SILENT, kept=kept)
    none, known = (folder / "none", folder / "known")
    for site, environment in ((none, {}), (known, HERE)):
        done = run(folder, "-m", "mkdocs", "build", "--strict", "--site-dir", str(site), **environment)
        assert done.returncode == 0, done.stderr
    page = "cases/falling-box/index.html"
    silent, told = ((site / page).read_text(encoding="utf-8") for site in (none, known))
    assert not re.findall(r"https?://example\.org", silent)
    html = lxml.html.fromstring(told)
    links = {link.text_content(): link.get("href") for link in html.xpath("//div[contains(@class, 'foot')]//a")}
    assert links["Repository"] == "https://example.org/some/where.git"
    assert "case=falling-box" in links["Report a wrong claim"]
    assert html.xpath("string(//link[@rel='canonical']/@href)") == f"https://example.org/clinic/{page}"
    image = html.xpath("string(//meta[@property='og:image']/@content)").removeprefix("https://example.org/clinic/")
    assert (known / image).read_bytes()[:2] == b"\xff\xd8"
    assert json.loads(html.xpath("string(//script[@type='application/ld+json'])"))["url"].endswith(page)
    assert (known / "feed.xml").is_file()
    assert not (none / "feed.xml").exists()
    assert "uvx --from git+https://example.org/some/where clinic show falling-box" in told
    assert not html.xpath("//*[@data-md-component='source']"), "this asks another host how many stars it has"
    for site in (none, known):
        assert "\n## contact\n\n- [1. A box" in (site / "tags.md").read_text(encoding="utf-8")
        assert (site / "cases/falling-box/index.md").read_text(encoding="utf-8").startswith("# 1. A box falls")


def test_every_page_of_the_site_lies_as_markdown_beside_it_and_is_listed(site: Path) -> None:
    listed = re.findall(r"\]\(([^)]*\.md)\)", (site / "llms.txt").read_text(encoding="utf-8"))
    pages = {path.relative_to(site).with_suffix(".md").as_posix() for path in site.rglob("*.html")} - {"404.md"}
    assert sorted(listed) == sorted(pages)
    for name in listed:
        text = (site / name).read_text(encoding="utf-8")
        prose = re.sub(r"^( *`{3,}).*?^\1$|`[^`\n]+`", "", text, flags=re.DOTALL | re.MULTILINE)
        assert not re.search(r"<(?:math|div|video|button|span|section)\b|\?\?\?|\{ ?[.#]", prose), name


def test_what_the_page_for_programs_documents_is_there(site: Path) -> None:
    text = (site / "programs.md").read_text(encoding="utf-8")
    evidence = json.loads((site / "cases/box-falls-through-floor/evidence.json").read_text(encoding="utf-8"))
    named = re.findall(r"^\| `([a-z]+)`", text.partition("## evidence.json")[2], re.MULTILINE)
    assert {"variants", "sweep"} <= set(named) <= evidence.keys()
    broken = evidence["variants"]["broken"]
    assert set(re.findall(r"`variants\.\*\.([a-z]+)`", text)) <= broken.keys()
    rule = json.loads((site / "rules.json").read_text(encoding="utf-8"))[0]
    assert rule.keys() <= set(re.findall(r"`([a-z]+)`", text.partition("## rules.json")[2]))
