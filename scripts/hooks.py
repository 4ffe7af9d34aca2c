"""What MkDocs calls while it serves the site."""

from clinic.publish.live_reload import on_serve

__all__ = ["on_serve"]
