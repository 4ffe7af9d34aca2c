"""Every page's HTML cleaned by an allow-list, as an extension of Python-Markdown that mkdocs.yml names.

The one place where what an author writes is kept from acting: no script, no handler, no style, no address but of the
web, no picture from another host.
"""

from __future__ import annotations

from typing import Any

import nh3
from markdown import Markdown
from markdown.extensions import Extension
from markdown.postprocessors import Postprocessor

MATHML = (
    "math menclose mfrac mi mn mo mover mpadded mphantom mroot mrow mspace msqrt mstyle "
    "msub msubsup msup mtable mtd mtext mtr munder munderover none"
)
MATHML_ATTRIBUTES = (
    "accent columnalign columnlines columnspacing depth display displaystyle fence form height linebreak linethickness "
    "lspace mathbackground mathcolor mathsize mathvariant maxsize minsize movablelimits notation rowlines rowspacing "
    "rspace scriptlevel separator stretchy voffset width"
)
TAGS = nh3.ALLOWED_TAGS | {*MATHML.split(), "button", "section", "source", "video"}
ATTRIBUTES = {
    "*": {"class", "hidden", "id", "title"},
    "a": {"href", "name", "tabindex"},
    "button": {"type"},
    "img": {"alt", "height", "loading", "src", "width"},
    "ol": {"start"},
    "source": {"src", "type"},
    "td": {"style"},
    "th": {"style"},
    "video": {"controls", "height", "muted", "playsinline", "poster", "preload", "width"},
    **{key: set(MATHML_ATTRIBUTES.split()) for key in MATHML.split()},
}


def sanitized(html: str) -> str:
    """The HTML with nothing but the elements, attributes and addresses above."""
    return nh3.clean(
        html,
        tags=TAGS,
        attributes=ATTRIBUTES,
        attribute_filter=_from_here,
        generic_attribute_prefixes={"aria-", "data-"},
        url_schemes={"http", "https"},
        filter_style_properties={"text-align"},
        strip_comments=False,  # Material marks with one where the list of tags goes
        link_rel=None,
    )


def _from_here(tag: str, attribute: str, value: str) -> str | None:
    return None if attribute in ("src", "poster") and "//" in value else value


class _Last(Postprocessor):  # type: ignore[misc]
    def run(self, text: str) -> str:
        return sanitized(text)


class _Sanitize(Extension):  # type: ignore[misc]
    def extendMarkdown(self, md: Markdown) -> None:  # noqa: N802
        md.postprocessors.register(_Last(md), "sanitize", -100)


def makeExtension(**options: Any) -> Extension:  # noqa: N802
    """What Python-Markdown calls."""
    return _Sanitize(**options)
