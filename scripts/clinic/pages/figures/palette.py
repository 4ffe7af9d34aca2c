"""The figures' colours, and the dashes that tell lines apart without them."""

from __future__ import annotations

import re

INK = "#333a42"
GRID = "#d9dde2"
BROKEN = "#c2410c"
FIXED = ("#0b66c3", "#0a7d54", "#7a3fb5")
RIVAL = "#8a6d00"
DASHES = ("--", "-.", ":")
DARK = {
    INK: "#d5dae0",
    GRID: "#454b54",
    BROKEN: "#ff9a5c",
    **dict(zip(FIXED, ("#6db3ff", "#55d6a3", "#c79bff"), strict=True)),
    RIVAL: "#e5c454",
}
COLOUR = re.compile("|".join(DARK))


def darkened(svg: str) -> str:
    """A figure in the colours for a dark page."""
    return COLOUR.sub(lambda colour: DARK[colour[0]], svg)
