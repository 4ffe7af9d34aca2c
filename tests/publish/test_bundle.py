from __future__ import annotations

import gzip
import shutil
from pathlib import Path

import pytest
from clinic.publish import bundle
from clinic.publish.bundle import START, playground_files, strip_custom_sections
from clinic.work.cache import Cache
from clinic.work.task import log_missing_once

HEADER = b"\0asm\x01\0\0\0"
TYPE = b"\x01\x04\x01\x60\0\0"


def custom(name: bytes, content: bytes) -> bytes:
    size = 1 + len(name) + len(content)
    return b"\0" + bytes([size & 0x7F | 0x80, size >> 7]) + bytes([len(name)]) + name + content


def copied(root: Path, to: Path) -> Path:
    """The playground's sources, with the packages that are installed."""
    for name in ("docs/playground", "docs/stylesheets"):
        shutil.copytree(root / name, to / name)
    for name in (bundle.BUNDLER, *bundle.TABLES):
        (to / name).parent.mkdir(parents=True, exist_ok=True)
        shutil.copy(root / name, to / name)
    (to / "node_modules").symlink_to(root / "node_modules")
    return to


def test_custom_sections_are_stripped_and_all_else_stays() -> None:
    named = HEADER + custom(b"name", b"x" * 300) + TYPE + custom(b"sourceMappingURL", b"a.map")

    assert strip_custom_sections(named) == HEADER + TYPE
    assert strip_custom_sections(HEADER) == HEADER


def test_the_same_sources_give_the_same_bytes(root: Path, tmp_path: Path) -> None:
    made = [
        playground_files(copied(root, tmp_path / name), Cache(tmp_path / name / "cache")) for name in ("one", "two")
    ]

    assert made[0] == made[1]
    assert START in made[0]
    engine = gzip.decompress(made[0][f"{bundle.FOLDER}/mujoco.wasm.gz"])
    assert engine.startswith(HEADER)
    assert len(engine) < (root / bundle.ENGINE).stat().st_size / 2
    assert b"three" in made[0][f"{bundle.FOLDER}/licenses.txt"]


def test_a_second_bundle_is_taken_from_the_cache(root: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    sources, cache = copied(root, tmp_path), Cache(tmp_path / "cache")
    made = playground_files(sources, cache)
    monkeypatch.setattr(bundle, "_bundle", lambda root: pytest.fail("bundled again"))

    assert playground_files(sources, cache) == made
    (sources / bundle.STYLE).write_text("", encoding="utf-8")
    with pytest.raises(pytest.fail.Exception, match="bundled again"):
        playground_files(sources, cache)


def test_without_its_packages_the_site_has_the_loader_alone(
    root: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch, caplog: pytest.LogCaptureFixture
) -> None:
    monkeypatch.setenv("CI", "true")
    log_missing_once.cache_clear()
    sources, cache = copied(root, tmp_path), Cache(tmp_path / "cache")
    (sources / "node_modules").unlink()

    made = playground_files(sources, cache)

    assert list(made) == [f"{bundle.FOLDER}/loader.js"]
    assert cache.incomplete
    assert [record.levelname for record in caplog.records] == ["WARNING"]


def test_a_mistake_in_a_module_stops_the_build(root: Path, tmp_path: Path) -> None:
    sources = copied(root, tmp_path)
    start = sources / "docs/playground/start.js"
    start.write_text(f"export const = 1;\n{start.read_text(encoding='utf-8')}", encoding="utf-8")

    with pytest.raises(RuntimeError, match=r"start\.js:1:13: ERROR"):
        playground_files(sources, Cache(tmp_path / "cache"))
