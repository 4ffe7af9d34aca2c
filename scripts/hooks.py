"""What MkDocs calls: events that keep compiled templates, and finished pages while the site is served, and put off what
takes long.
"""

from clinic.compiled import on_env, on_post_build
from clinic.later import on_serve
from clinic.serving import on_page_content, on_page_context, on_page_markdown, on_post_page, on_startup

__all__ = [
    "on_env",
    "on_page_content",
    "on_page_context",
    "on_page_markdown",
    "on_post_build",
    "on_post_page",
    "on_serve",
    "on_startup",
]
