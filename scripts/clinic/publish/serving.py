"""What MkDocs keeps from one build to the next while it serves; `scripts/hooks.py` hands these events to it.

A page whose Markdown is the same, among the same files, is not converted and not indexed again. A page that the
browser loads anew stands where it stood. A single build has none of this.
"""

from __future__ import annotations

from copy import deepcopy
from dataclasses import dataclass
from hashlib import sha256
from pathlib import Path
from typing import Any

from mkdocs.config.defaults import MkDocsConfig
from mkdocs.plugins import CombinedEvent, event_priority
from mkdocs.structure.files import Files
from mkdocs.structure.nav import Navigation
from mkdocs.structure.pages import Page
from mkdocs.structure.toc import TableOfContents
from mkdocs.utils.templates import TemplateContext

MOST = 5000
Key = tuple[object, ...]


@dataclass(frozen=True)
class Converted:
    """What converting a page gave: `links` are the anchors that it links to, by file."""

    html: str
    toc: TableOfContents
    anchors: set[str]
    links: dict[str, dict[str, str]]


SCRIPT = Path(__file__).with_name("served.js")
_scripts: list[str] = []
_digest: dict[str, object] = {}
_converted: dict[Key, Converted] = {}
_asked: dict[str, tuple[Key, str]] = {}
_indexed: dict[Key, list[dict[str, Any]]] = {}
_indexing: dict[str, tuple[Key, Any, int]] = {}


def on_startup(command: str, dirty: bool) -> None:
    """From now on, every page carries SCRIPT, if the site is served."""
    if command == "serve":
        _scripts.append(f"<script>{SCRIPT.read_text(encoding='utf-8')}</script>")


def on_post_page(output: str, page: Page, config: MkDocsConfig) -> str:
    """Adds SCRIPT at the end of a page."""
    return output.replace("</body>", f"{''.join(_scripts)}</body>")


@event_priority(-100)  # when the Markdown is final
def on_page_markdown(markdown: str, page: Page, config: MkDocsConfig, files: Files) -> str:
    """Gives the converter nothing to do where the result is known."""
    key = (page.file.src_uri, markdown, _surroundings(config, files))
    _asked[page.file.src_uri] = key, markdown
    return "" if key in _converted else markdown


@event_priority(100)  # before anything is added to the page
def on_page_content(html: str, page: Page, config: MkDocsConfig, files: Files) -> str:
    """Takes the known result, or keeps the new one."""
    key, markdown = _asked.pop(page.file.src_uri)
    if key not in _converted:
        if len(_converted) >= MOST:
            _converted.clear()
        links = {file.src_uri: anchors for file, anchors in (page.links_to_anchors or {}).items()}
        _converted[key] = Converted(html, deepcopy(page.toc), set(page.present_anchor_ids or ()), links)
        return html
    kept = _converted[key]
    page.markdown = markdown
    page.toc = deepcopy(kept.toc)  # plugins add to it
    page.present_anchor_ids = kept.anchors
    found = {files.get_file_from_path(path): anchors for path, anchors in kept.links.items()}
    page.links_to_anchors = {file: anchors for file, anchors in found.items() if file is not None}
    return kept.html


@event_priority(100)  # before the search reads the page
def _spare_search(context: TemplateContext, page: Page, config: MkDocsConfig, nav: Navigation) -> TemplateContext:
    key = (page.url, page.content, str(page.toc), repr(page.meta))
    _indexing[page.file.src_uri] = key, page.meta.get("search"), len(_entries(config))
    if key in _indexed:
        page.meta["search"] = {"exclude": True}
    return context


@event_priority(-100)
def _keep_entries(context: TemplateContext, page: Page, config: MkDocsConfig, nav: Navigation) -> TemplateContext:
    key, search, before = _indexing.pop(page.file.src_uri)
    entries = _entries(config)
    if key in _indexed:
        page.meta["search"] = search
        if search is None:
            del page.meta["search"]
        entries += deepcopy(_indexed[key])
    else:
        if len(_indexed) >= MOST:
            _indexed.clear()
        _indexed[key] = deepcopy(entries[before:])
    return context


on_page_context = CombinedEvent(_spare_search, _keep_entries)
"""Adds what the search found on a page before, where the page is the same."""


def _surroundings(config: MkDocsConfig, files: Files) -> str:
    """A digest of what a page's HTML hangs on besides its Markdown: which files there are, and how it is converted.

    Made once a build, which gives all its pages the same collection of files.
    """
    if _digest.get("files") is not files:
        paths = sorted(file.src_uri for file in files)
        said = repr((paths, config.markdown_extensions, config.mdx_configs))
        _digest.update(files=files, made=sha256(said.encode()).hexdigest())
    return str(_digest["made"])


def _entries(config: MkDocsConfig) -> list[dict[str, Any]]:
    """The entries of Material's search, made one page after the other."""
    plugin: Any = next(plugin for name, plugin in config.plugins.items() if name.endswith("search"))
    entries: list[dict[str, Any]] = plugin.search_index.entries
    return entries
