"""What MkDocs calls while it builds and serves the site."""

from __future__ import annotations

from clinic.publish.hooks import on_config, on_env, on_post_page
from clinic.publish.live_reload import on_serve
from clinic.publish.policy import on_startup

__all__ = ["on_config", "on_env", "on_post_page", "on_serve", "on_startup"]
