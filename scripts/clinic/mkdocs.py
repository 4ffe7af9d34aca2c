"""The adapter for mkdocs-gen-files."""

from __future__ import annotations

import mkdocs_gen_files
from mkdocs.exceptions import PluginError

from clinic.problem import CaseError
from clinic.site import build, navigation, project_root


def write() -> None:
    """Writes every page into the running MkDocs build.

    Raises:
        PluginError: With all problems of all cases; MkDocs prints it without a traceback.
    """
    try:
        root = project_root()
        made = build(root)
        mkdocs_gen_files.config["nav"] = navigation(root)
    except CaseError as error:
        raise PluginError(str(error)) from None
    for name, content in made.items():
        with mkdocs_gen_files.open(name, "wb") as file:
            file.write(content)
