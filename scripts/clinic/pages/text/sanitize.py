"""Every page's HTML cleaned by an allow-list, as an extension of Python-Markdown that mkdocs.yml names.

The one place where what an author writes is kept from acting: no script, no handler, no style, no address but of the
web, no picture from another host. And a table's empty corner is made a cell: a header without a text heads nothing.
"""

from __future__ import annotations

import re

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
DRAWN = "d fill font-family font-size font-weight height role rx stroke stroke-opacity viewBox width x y"
TAGS = nh3.ALLOWED_TAGS | {*MATHML.split(), "button", "section", "source", "video", "svg", "path", "rect", "text"}
ATTRIBUTES = {
    "*": {"class", "hidden", "id", "title"},
    "a": {"href", "name", "tabindex"},
    "button": {"type"},
    "img": {"alt", "height", "loading", "src", "width"},
    "ol": {"start"},
    "source": {"src", "type"},
    "td": {"style"},
    "th": {"style"},
    "video": {"height", "loop", "muted", "playsinline", "poster", "preload", "width"},
    **{key: set(MATHML_ATTRIBUTES.split()) for key in MATHML.split()},
    **{key: set(DRAWN.split()) for key in ("svg", "path", "rect", "text")},
}

EMPTY_HEADER = re.compile(r"<th( [^>]*)?>\s*</th>")


def sanitized(html: str) -> str:
    """The HTML with nothing but the elements, attributes and addresses above."""
    cleaned = nh3.clean(
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
    return EMPTY_HEADER.sub(r"<td\1></td>", cleaned)


def _from_here(tag: str, attribute: str, value: str) -> str | None:
    return None if attribute in ("src", "poster") and "//" in value else value


class _Last(Postprocessor):  # type: ignore[misc]
    def run(self, text: str) -> str:
        return sanitized(text)


class Sanitize(Extension):  # type: ignore[misc]
    """The extension: after all others, it cleans what they made."""

    def extendMarkdown(self, md: Markdown) -> None:  # noqa: D102, N802
        md.postprocessors.register(_Last(md), "sanitize", -100)
