"""What MkDocs is told beside the pages: what templates ask for, and that a page's Markdown is to lie beside it."""

from __future__ import annotations

import sys
from pathlib import Path
from typing import Any

from clinic.publish.page_head import about, report_address, structured_data
from clinic.publish.plain_markdown import plain_markdown, with_listing
from clinic.publish.policy import policy


def on_config(config: Any, **_: object) -> Any:
    """Gives templates the versions, and *Cases by topic* the order of the cases."""
    config["extra"]["about"] = about()
    if tags := config["plugins"].get("material/tags"):
        tags.config.listings_sort_by = _number
    return config


def _number(listed: Any) -> tuple[int, str]:
    """The number that a case's title begins with, and the title."""
    title = str(listed.item.title)
    number = title.partition(".")[0]
    return int(number) if number.isdecimal() else sys.maxsize, title


def on_env(env: Any, *, config: Any, **_: object) -> Any:
    """Gives templates `policy`, `report` and `structured`."""

    def structured(page: Any) -> str:
        title = page.meta.get("title") or page.title
        whole = (config["site_url"], config["site_name"], title, page.canonical_url, page.meta, page.is_homepage)
        return structured_data(*whole)

    def report(page: Any) -> str:
        return report_address(config["repo_url"], page.url if page else "")

    env.globals |= {"policy": policy(), "structured": structured, "report": report}
    return env


def on_post_page(output: str, *, page: Any, config: Any, **_: object) -> str:
    """Writes the page's Markdown beside it."""
    path = Path(config["site_dir"], page.file.src_uri)
    path.parent.mkdir(parents=True, exist_ok=True)
    path.write_text(plain_markdown(with_listing(page.markdown, page.content)), encoding="utf-8")
    return output
