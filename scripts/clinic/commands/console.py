"""The terminal to which the commands print."""

from __future__ import annotations

import sys

from rich.console import Console

WIDTH = 120


def console(stderr: bool = False) -> Console:
    """The terminal, or WIDTH columns where there is none."""
    stream = sys.stderr if stderr else sys.stdout
    return Console(file=stream, width=None if stream.isatty() else WIDTH, highlight=False)
