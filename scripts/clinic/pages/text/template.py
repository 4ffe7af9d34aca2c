"""The templates of pages."""

from __future__ import annotations

import jinja2

from clinic.pages.text.addresses import repository, to_run
from clinic.pages.text.markup import code, fence, line

TEMPLATES = jinja2.Environment(
    loader=jinja2.PackageLoader("clinic.pages"), undefined=jinja2.StrictUndefined, trim_blocks=True, lstrip_blocks=True
)
TEMPLATES.filters |= {"code": code, "fence": fence, "line": line}
TEMPLATES.globals |= {"to_run": to_run, "repository": repository}


def render(name: str, **values: object) -> str:
    """The Markdown of a template, by its name: `case`, `home`, ..."""
    return TEMPLATES.get_template(f"{name}.md.j2").render(values)
