"""Writes the site's pages into a MkDocs build, through mkdocs-gen-files."""

from __future__ import annotations

import logging
import os

import mkdocs_gen_files
from mkdocs.exceptions import PluginError

from clinic.publish.live_reload import LIVE
from clinic.publish.site_files import SECTION
from clinic.record.checkout import cache_folder, project_root, slugs
from clinic.record.problem import CaseError
from clinic.work.cache import Cache

log = logging.getLogger("mkdocs.clinic")


def write() -> None:
    """Writes every page into the running MkDocs build; what is wrong with cases is logged, which fails a strict one."""
    os.environ.setdefault("SOURCE_DATE_EPOCH", "0")  # MkDocs dates pages by the day of the build
    root, config = project_root(), mkdocs_gen_files.config
    try:
        made = LIVE.site(root, Cache(cache_folder(root)))
    except ConnectionError as error:  # to a cluster; MkDocs prints it without a traceback
        raise PluginError(str(error)) from None
    if made.problems:
        log.error("%s", CaseError(made.problems))
    config["nav"] = made.navigation
    if len(slugs(root)) > SECTION:  # else each of a thousand pages would hold a thousand links
        config["theme"]["features"] = [*config["theme"]["features"], "navigation.prune"]
    before = LIVE.shown.files if LIVE.shown.navigation == made.navigation else {}
    for name, content in made.files.items():
        with mkdocs_gen_files.open(name, "wb") as file:
            file.write(content)
        if before.get(name) == content:
            os.utime(file.name, (0, 0))  # `mkdocs serve --dirty` builds only what is newer than its page
    LIVE.shown = made
