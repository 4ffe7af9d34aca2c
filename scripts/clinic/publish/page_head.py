"""What a page says of itself to search engines and to whoever finds it wrong."""

from __future__ import annotations

import json
from collections.abc import Mapping
from html import unescape
from importlib.metadata import version
from typing import Any
from urllib.parse import urlencode

FORM = "wrong-claim.yml"  # of .github/ISSUE_TEMPLATE
LICENSE = "https://www.apache.org/licenses/LICENSE-2.0"


def about() -> dict[str, str]:
    """The version of the clinic and of the engine that it was built with."""
    return {"version": version("mujoco-clinic"), "engine": version("mujoco")}


def report_address(repository: str, path: str) -> str:
    """The issue form, filled in with the page, the engine and the release.

    Args:
        repository: The repository's address.
        path: The page's path in the site: `cases/servo-sags/index.html`.
    """
    said = about()
    where = path.removeprefix("cases/").removesuffix("/index.html")
    fields = {"case": where, "engine": said["engine"], "release": said["version"], "title": f"Wrong claim: {where}"}
    return f"{repository.rstrip('/')}/issues/new?{urlencode({'template': FORM, **fields})}"


def structured_data(site: str, name: str, title: str, address: str, meta: Mapping[str, Any], home: bool) -> str:
    """The page as schema.org has it, in JSON that may stand in a script element.

    Args:
        site: The site's address.
        name: The site's name.
        title: The page's title.
        address: The page's address.
        meta: Its front matter.
        home: Whether it is the first page.
    """
    whole = {"@type": "WebSite", "name": name, "url": site}
    data: dict[str, Any] = {"@context": "https://schema.org"}
    if home:
        data |= whole
    else:
        data |= {
            "@type": "TechArticle",
            "headline": unescape(title),
            "url": address,
            "isPartOf": whole,
            "about": {"@type": "SoftwareApplication", "name": "MuJoCo", "softwareVersion": about()["engine"]},
            "license": LICENSE,
        }
    if description := meta.get("description"):
        data["description"] = unescape(description)
    if image := meta.get("image"):
        data["image"] = f"{site}{image}"
    if tags := meta.get("tags"):
        data["keywords"] = ", ".join(tags)
    return json.dumps(data, ensure_ascii=False).replace("<", "\\u003c")
