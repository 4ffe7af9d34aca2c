"""The adapter for mkdocs-gen-files."""

from __future__ import annotations

import logging
import os

import mkdocs_gen_files
from mkdocs.exceptions import PluginError

from clinic.publish.later import LATER
from clinic.record.checkout import cache_folder, project_root
from clinic.record.problem import CaseError
from clinic.work import cache

log = logging.getLogger("mkdocs.clinic")


def write() -> None:
    """Writes every page into the running MkDocs build.

    Raises:
        PluginError: In a strict build, with all problems of all cases; in any build, if the cluster cannot be used.
            MkDocs prints it without a traceback.
    """
    os.environ.setdefault("SOURCE_DATE_EPOCH", "0")  # MkDocs dates pages by the day of the build
    root = project_root()
    try:
        made = LATER.site(root, cache.Cache(cache_folder(root)))
    except ConnectionError as error:  # to a cluster
        raise PluginError(str(error)) from None
    if made.problems:
        said = str(CaseError(made.problems))
        if mkdocs_gen_files.config.strict:
            raise PluginError(said)
        log.error("%s", said)
    mkdocs_gen_files.config["nav"] = made.navigation
    if made.sectioned:  # else each of a thousand pages would hold a thousand links
        theme = mkdocs_gen_files.config["theme"]
        theme["features"] = [*theme["features"], "navigation.prune"]
    for name, content in made.files.items():
        with mkdocs_gen_files.open(name, "wb") as file:
            file.write(content)
