"""What MkDocs calls: events that keep finished pages while the site is served, and put off what takes long."""

from clinic.later import on_serve
from clinic.serving import on_env, on_page_content, on_page_context, on_page_markdown, on_post_page, on_startup

__all__ = [
    "on_env",
    "on_page_content",
    "on_page_context",
    "on_page_markdown",
    "on_post_page",
    "on_serve",
    "on_startup",
]
