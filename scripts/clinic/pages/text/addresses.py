"""Where the site and the repository lie, as far as whoever builds says so: `SITE_URL` and `REPO_URL`."""

from __future__ import annotations

import os

SITE, REPOSITORY = "SITE_URL", "REPO_URL"
VARIABLES = (SITE, REPOSITORY)
MARK = "<address of the clinic's repository>"  # in a page written by hand, for the repository


def site() -> str:
    """The site's address, with a slash at its end; empty where nobody says it."""
    given = os.environ.get(SITE, "").strip()
    return f"{given.rstrip('/')}/" if given else ""


def repository() -> str:
    """The repository's address, without a slash at its end; empty where nobody says it."""
    return os.environ.get(REPOSITORY, "").strip().rstrip("/").removesuffix(".git")


def to_run(arguments: str) -> str:
    """How to run the command `clinic` from nothing, as Markdown: no index has the package."""
    if address := repository():
        return f"`uvx --from git+{address} clinic {arguments}`"
    return f"in a checkout, `pip install .`, then `clinic {arguments}`"
