"""The built site, read as files: independent of the builder."""

from __future__ import annotations

import subprocess
from collections.abc import Iterator
from pathlib import Path
from urllib.parse import unquote, urlparse

import lxml.html
import pytest
from clinic.engine import node
from clinic.publish.site import make_site
from clinic.record.checkout import cache_folder
from clinic.work.cache import Cache
from kinds import KINDS
from project import run

pytestmark = pytest.mark.xdist_group("site")
FOLDS = ["Just tell me", "Diagnosis", "Cause", "Fix", "Lesson", "How we know", "Read on"]


@pytest.fixture(scope="module")
def pages(site: Path) -> dict[Path, lxml.html.HtmlElement]:
    return {path: lxml.html.parse(path).getroot() for path in sorted(site.rglob("*.html"))}


def references(page: lxml.html.HtmlElement) -> Iterator[tuple[str, str]]:
    """Every address the page names, with the tag that names it."""
    for element in page.iter("a", "link", "script", "img", "video", "source", "iframe"):
        for name in ("href", "src", "poster"):
            if element.get(name):
                yield str(element.tag), str(element.get(name))


def has_anchor(page: lxml.html.HtmlElement, name: str) -> bool:
    return bool(page.xpath("//*[@id=$name or @name=$name]", name=name))


def test_a_page_for_every_folder_with_its_folds_and_evidence(site: Path, root: Path, pages) -> None:
    slugs = {path.name for path in (root / "cases").iterdir()}
    assert {path.name for path in (site / "cases").iterdir()} == slugs
    for slug in slugs:
        page = pages[site / "cases" / slug / "index.html"]
        folds = [str(summary.text).strip() for summary in page.xpath("//details/summary")]
        assert [fold for fold in folds if fold != "What does not help"] == FOLDS
        assert not page.xpath("//details[@open]")
        assert (site / "cases" / slug / "evidence.json").is_file()


def test_every_link_and_asset_resolves(site: Path, pages) -> None:
    missing = []
    for path, page in pages.items():
        for tag, address in references(page):
            parts = urlparse(address)
            if parts.scheme or parts.netloc:
                continue
            start = site if path.name == "404.html" else path.parent
            target = (start / unquote(parts.path).lstrip("/")).resolve() if parts.path else path
            if target.is_dir():
                target /= "index.html"
            if not target.is_file():
                missing.append(f"{path.relative_to(site)}: <{tag}> {address}")
            elif parts.fragment and target in pages and not has_anchor(pages[target], unquote(parts.fragment)):
                missing.append(f"{path.relative_to(site)}: no anchor {address}")
    assert not missing, "\n".join(missing)


def test_nothing_is_fetched_from_another_host(site: Path, pages) -> None:
    foreign = [
        f"{path.relative_to(site)}: <{tag}> {address}"
        for path, page in pages.items()
        for tag, address in references(page)
        if tag != "a" and (urlparse(address).netloc or urlparse(address).scheme not in ("", "data"))
    ]
    assert not foreign, "\n".join(foreign)
    for style in site.glob("stylesheets/*.css"):
        assert "//" not in style.read_text(encoding="utf-8").replace("/*", "").replace("*/", "")


def test_no_source_links_and_no_unresolved_templates(site: Path, pages) -> None:
    for path, page in pages.items():
        assert not [a for tag, a in references(page) if tag == "a" and urlparse(a).path.endswith(".md")], path
        for code in page.xpath("//code | //pre | //script | //style"):
            code.drop_tree()
        text = page.text_content()
        for mark in ("{{", "}}", "{%", "!!!", "???", "$$"):
            assert mark not in text, f"{path.relative_to(site)}: {mark}"


def test_images_say_what_they_show_and_how_large_they_are(site: Path, pages) -> None:
    for path, page in pages.items():
        for image in page.iter("img"):
            what = f"{path.relative_to(site)}: {image.get('src')}"
            assert image.get("alt") is not None, what
            assert image.get("width"), what
            assert image.get("height"), what
            assert image.get("loading") == "lazy" or not image.xpath("ancestor::details"), f"{what} in a fold"


def test_the_html_is_valid(site: Path, root: Path) -> None:
    program = [str(node.launcher()), str(root / "node_modules/html-validate/bin/html-validate.mjs")]
    settings = ["--config", str(root / ".htmlvalidate.json"), "--formatter", "text"]
    done = subprocess.run([*program, *settings, *KINDS.values()], cwd=site, capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stdout + done.stderr


def test_home_has_a_card_for_every_case(site: Path, root: Path, pages) -> None:
    cards = pages[site / "index.html"].xpath("//div[@class='case']")
    assert len(cards) == len(list((root / "cases").iterdir()))
    for card in cards:
        assert card.xpath(".//img")
        assert len(card.text_content().split()) > 8


def test_formulas_are_mathml(site: Path, pages) -> None:
    page = pages[site / "cases" / "box-falls-through-floor" / "index.html"]
    assert page.xpath("//*[local-name()='math']//*[local-name()='mo']")


def test_clinic_build_writes_the_bytes_that_mkdocs_is_given(site: Path, root: Path, tmp_path: Path) -> None:
    out = tmp_path / "pages"
    done = run(root, "-m", "clinic", "build", "--out", str(out), CLINIC_CACHE=str(cache_folder(root)))
    assert done.returncode == 0, done.stderr
    made = make_site(root, Cache(cache_folder(root))).files
    assert {str(p.relative_to(out)): p.read_bytes() for p in out.rglob("*") if str(p.relative_to(out)) in made} == made
    for name, content in made.items():
        if not name.endswith(".md"):
            assert (site / name).read_bytes() == content, name


def test_properdocs_builds_the_same_configuration(site: Path, root: Path, tmp_path: Path) -> None:
    command = ["properdocs", "build", "--strict", "-f", "mkdocs.yml", "--site-dir", str(tmp_path / "site")]
    done = run(root, "-m", *command, CLINIC_CACHE=str(cache_folder(root)))
    assert done.returncode == 0, done.stderr
    assert {p.relative_to(tmp_path / "site") for p in (tmp_path / "site").rglob("*.html")} == {
        p.relative_to(site) for p in site.rglob("*.html")
    }
