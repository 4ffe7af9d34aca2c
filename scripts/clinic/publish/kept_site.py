"""The site that the last build made, used again where nothing that it was made from has changed.

It is found without importing what makes it: MuJoCo, NumPy and pydantic.
"""

from __future__ import annotations

import json
import os
import shutil
import sys
from hashlib import sha256
from pathlib import Path

from clinic.pages.text.addresses import VARIABLES
from clinic.publish.site_files import Site
from clinic.work.cache import Cache, key_of

INPUTS = (
    "cases",
    "docs",
    "scripts/bundle.mjs",
    "releases.lock.json",
    "messages.lock.json",
    "bench.lock.json",
    "node_modules/.package-lock.json",
)
ABOUT = "site.json"


def cached_or_new_site(root: Path, cache: Cache) -> Site:
    """The site of the last build if it was made from the same inputs, or else a new one.

    A new one is kept unless something is wrong with it or is missing, or an input was changed meanwhile.
    """
    inputs, key = inputs_digest(root), key_of("site", str(root.resolve()), of="record")
    files = cache.get(key) or {ABOUT: b"{}"}
    about = json.loads(files.pop(ABOUT))
    if about.get("inputs") == inputs:
        return Site(files, about["navigation"])
    from clinic.publish.site import make_site

    made = make_site(root, cache)
    if not made.problems and not cache.incomplete and inputs_digest(root) == inputs:
        about = {"inputs": inputs, "navigation": made.navigation}
        cache.put(key, {**made.files, ABOUT: json.dumps(about).encode()})
    return made


def inputs_digest(root: Path) -> str:
    """A digest of all that a site is made from: the checkout, the package, what is installed, Node, the addresses."""
    paths = sorted(path for name in INPUTS for path in (root / name, *(root / name).rglob("*")))
    content = {str(path): sha256(path.read_bytes()).hexdigest() for path in paths if path.is_file()}
    packages = sorted({path.name for place in sys.path for path in Path(place).glob("*.dist-info")})
    program = shutil.which("node")
    made = Path(program).stat().st_mtime_ns if program else 0
    said = [os.environ.get(name, "") for name in VARIABLES]
    return key_of(content, [str(path) for path in paths], packages, program, made, said, of="publish")
