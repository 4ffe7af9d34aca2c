"""The figures' colours, light and dark, and the dashes that tell lines apart without them."""

from __future__ import annotations

from typing import Literal

Theme = Literal["light", "dark"]
THEMES: tuple[Theme, ...] = ("light", "dark")
INK = {"light": "#333a42", "dark": "#d5dae0"}
GRID = {"light": "#d9dde2", "dark": "#454b54"}
BROKEN = {"light": "#c2410c", "dark": "#ff9a5c"}
FIXED = {"light": ("#0b66c3", "#0a7d54", "#7a3fb5"), "dark": ("#6db3ff", "#55d6a3", "#c79bff")}
DASHES = ("--", "-.", ":")
RIVAL = {"light": "#8a6d00", "dark": "#e5c454"}
