"""What MkDocs calls: events that keep compiled templates, and finished pages while the site is served, and put off what
takes long.
"""

from clinic.publish.later import on_serve
from clinic.publish.serving import on_page_content, on_page_context, on_page_markdown, on_post_page, on_startup
from clinic.publish.theme_templates import on_env, on_post_build

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
