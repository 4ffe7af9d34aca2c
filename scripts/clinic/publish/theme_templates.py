"""The theme's templates as Python has compiled them, kept from one build to the next; `scripts/hooks.py` calls this."""

from __future__ import annotations

import sys
from functools import lru_cache
from importlib.metadata import version

from jinja2 import BytecodeCache, Environment
from jinja2.bccache import Bucket
from mkdocs.config.defaults import MkDocsConfig
from mkdocs.structure.files import Files

from clinic.record.checkout import cache_folder, project_root
from clinic.work.cache import Cache, key_of


class Templates(BytecodeCache):
    """Compiled templates, in memory and in a cache. A template whose text has changed is compiled anew.

    Args:
        cache: Where those of earlier builds lie.
    """

    def __init__(self, cache: Cache) -> None:
        self.cache = cache
        self.key = key_of("templates", sys.version, version("jinja2"), of="record")
        self.kept = cache.get(self.key) or {}
        self.made: dict[str, bytes] = {}

    def load_bytecode(self, bucket: Bucket) -> None:
        """Fills the bucket with what was kept for it; Jinja leaves it empty when that was made of another text."""
        code = self.made.get(bucket.key) or self.kept.get(bucket.key)
        if code is not None:
            bucket.bytecode_from_string(code)

    def dump_bytecode(self, bucket: Bucket) -> None:
        """Takes what the bucket holds."""
        self.made[bucket.key] = bucket.bytecode_to_string()

    def keep(self) -> None:
        """Stores what was compiled since this was made."""
        if self.made:
            self.kept, self.made = self.kept | self.made, {}
            self.cache.put(self.key, self.kept)


@lru_cache
def _templates() -> Templates:
    return Templates(Cache(cache_folder(project_root())))


def on_env(env: Environment, config: MkDocsConfig, files: Files) -> Environment:
    """Lets a template be compiled once."""
    env.bytecode_cache = _templates()
    return env


def on_post_build(config: MkDocsConfig) -> None:
    """Stores what this build compiled."""
    _templates().keep()
