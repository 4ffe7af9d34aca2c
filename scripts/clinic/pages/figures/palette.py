"""The plots' colours on a light and on a dark page, and the dashes that tell lines apart without colours."""

from __future__ import annotations

from typing import Any

INK = "#333a42"
GRID = "#d9dde2"
BROKEN = "#c2410c"
FIXED = ("#0b66c3", "#0a7d54", "#7a3fb5", "#b0186f")
RIVAL = "#8a6d00"
DASHES = ("--", "-.", ":", (0, (6, 2, 1, 2, 1, 2)))
DARK = {
    INK: "#d5dae0",
    GRID: "#454b54",
    BROKEN: "#ff9a5c",
    **dict(zip(FIXED, ("#6db3ff", "#55d6a3", "#c79bff", "#ff8fc4"), strict=True)),
    RIVAL: "#e5c454",
}


def fix_style(k: int) -> dict[str, Any]:
    """Colour and dash of fix `k`, counted from 0."""
    return {"color": FIXED[k % 4], "linestyle": DASHES[k % 4]}


def with_dark_scheme(svg: str) -> str:
    """The figure, which changes its colours where it is shown as an image of CSS `color-scheme: dark`.

    A viewer that does not know the rules shows it in the colours for a light page.
    """
    rules = [
        f'[style*="{part}: {light}"] {{{part}: {dark} !important}}'
        for light, dark in DARK.items()
        for part in ("fill", "stroke")
    ]
    style = "<style>\n@media (prefers-color-scheme: dark) {\n" + "\n".join(rules) + "\n}\n</style>\n"
    return svg.replace("<defs>", style + "<defs>", 1)
