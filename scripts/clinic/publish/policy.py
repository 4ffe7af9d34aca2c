"""The Content Security Policy of every page: what it may load is the site's, and nothing that stands in a page runs.

A page that is opened as a file has no host of its own: `file:` allows there what `'self'` allows elsewhere. The engine
and Python run in workers, whose files no page's policy is about; so no page may compile anything.
"""

from __future__ import annotations

OWN = "'self' file:"
POLICY = "; ".join(
    (
        "default-src 'none'",
        f"script-src {OWN}",
        f"style-src {OWN} 'unsafe-inline'",  # the editor's, which it puts into the page, and the alignment of columns
        f"img-src {OWN} data: blob:",
        f"media-src {OWN}",
        f"connect-src {OWN}",
        "worker-src 'self'",
        f"form-action {OWN}",
        "base-uri 'none'",
    )
)
_commands: list[str] = []


def on_startup(command: str, **_: object) -> None:
    """Remembers whether the site is served: live reload puts a script into each page."""
    _commands[:] = [command]


def policy() -> str:
    """The policy of the pages of this build; empty while the site is served."""
    return "" if "serve" in _commands else POLICY
