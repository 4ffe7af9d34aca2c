"""A page's Markdown for programs: formulas in LaTeX, folds as sections, without what only a browser needs."""

from __future__ import annotations

import re
from html import unescape
from textwrap import dedent

FENCE = re.compile(r"^(?P<bars> *`{3,}).*?^(?P=bars)$", re.DOTALL | re.MULTILINE)
FOLD = re.compile(r'^(?:\?\?\?\+?|!!!) \w+(?: "(?P<title>[^"\n]*)")?\n(?P<body>(?:(?: {4}.*)?\n)*)', re.MULTILINE)
PARTS = re.compile(
    r'<div class="(?:playground|diagnose)".*?</div>\n|<(?:button|video)\b.*?</(?:button|video)>', re.DOTALL
)
MATH = re.compile(r'<math[^>]*? alttext="(?P<tex>[^"]*)"(?P<rest>[^>]*)>.*?</math>', re.DOTALL)
LINK = re.compile(r'<a\b[^>]*?href="(?P<to>[^"]*)"[^>]*>(?P<text>.*?)</a>', re.DOTALL)
IMAGE = re.compile(r'<img\b[^>]*?src="(?P<at>[^"]*)"[^>]*?alt="(?P<alt>[^"]*)"[^>]*>')
HEADING = re.compile(r"<(?:h(?P<level>[1-6])|summary)\b[^>]*>(?P<text>.*?)</(?:h[1-6]|summary)>", re.DOTALL)
ITEM = re.compile(r"<li\b[^>]*>")
CODE = re.compile(r"</?code>")
TAG = re.compile(r"</?(?:div|section|span|figure|figcaption|details|p|b|small|ul|ol|li|article)\b[^>]*>")
ATTRIBUTES = re.compile(r"[ \n]?\{:? ?[#.][^{}\n]*\}|(?<=\))\{ ?[#.\w][^{}\n]*\}")
EMPTY = re.compile(r"\n(?:[ \t]*\n){2,}")
LISTING = re.compile(r"^#+ \S+/name \{ #\S+/slug \}$", re.MULTILINE)  # where the theme lists what bears each tag
LISTED = re.compile(
    r'<h\d id="tag:[^>]*>\s*<span[^>]*>(?P<tag>.*?)</span>|<li>\s*<a href="(?P<to>[^"]*)">\s*(?P<title>.*?)\s*</a>',
    re.DOTALL,
)


def plain_markdown(text: str) -> str:
    """The Markdown of a page, read as easily without a browser; code is left as it stands."""
    text = FOLD.sub(lambda fold: f"\n## {fold['title'] or ''}\n\n{dedent(fold['body'])}\n", text)
    made, at = [], 0
    for fence in FENCE.finditer(text):
        made += [_plain(text[at : fence.start()]), fence[0]]
        at = fence.end()
    return EMPTY.sub("\n\n", "".join([*made, _plain(text[at:])])).strip() + "\n"


def with_listing(text: str, html: str) -> str:
    """The Markdown of a page with the list of tags that the theme puts into its HTML alone, as the last thing there."""
    _, mark, rest = html.partition('<h2 id="tag:')
    rows = [
        f"\n## {each['tag']}\n" if each["tag"] else f"- [{each['title']}]({_beside(each['to'])})"
        for each in LISTED.finditer(mark + rest)
    ]
    return LISTING.sub(lambda _: "\n".join(rows), text)


def _plain(text: str) -> str:
    text = MATH.sub(_formula, PARTS.sub("", text))
    text = HEADING.sub(lambda each: f"\n{'#' * int(each['level'] or 2)} {each['text']}\n", text)
    text = IMAGE.sub(lambda each: f"![{each['alt']}]({each['at']})" if each["alt"] else "", text)
    text = TAG.sub("", CODE.sub("`", ITEM.sub("- ", text)))
    text = LINK.sub(lambda each: f"[{each['text']}]({_beside(each['to'])})", text)
    return unescape(ATTRIBUTES.sub("", text))


def _formula(match: re.Match[str]) -> str:
    bars = "$$" if 'display="block"' in match[0].partition(">")[0] else "$"
    return f"{bars}{match['tex']}{bars}"


def _beside(address: str) -> str:
    return re.sub(r"\.html(?=#|$)", ".md", address) if "//" not in address else address
