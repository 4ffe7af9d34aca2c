from __future__ import annotations

import gzip
import shutil
from pathlib import Path

import pytest
from clinic.publish import bundle
from clinic.publish.bundle import has_playground, parts, strip_custom_sections

HEADER = b"\0asm\x01\0\0\0"
TYPE = b"\x01\x04\x01\x60\0\0"


def custom(name: bytes, content: bytes) -> bytes:
    size = 1 + len(name) + len(content)
    return b"\0" + bytes([size & 0x7F | 0x80, size >> 7]) + bytes([len(name)]) + name + content


def copied(root: Path, to: Path) -> Path:
    """The playground's sources, with the packages that are installed."""
    for name in ("docs/playground", "docs/stylesheets"):
        shutil.copytree(root / name, to / name)
    (to / "scripts").mkdir()
    shutil.copy(root / bundle.BUNDLER, to / bundle.BUNDLER)
    shutil.copy(root / "package-lock.json", to)
    (to / "node_modules").symlink_to(root / "node_modules")
    return to


def test_custom_sections_are_stripped_and_all_else_stays() -> None:
    named = HEADER + custom(b"name", b"x" * 300) + TYPE + custom(b"sourceMappingURL", b"a.map")

    assert strip_custom_sections(named) == HEADER + TYPE
    assert strip_custom_sections(HEADER) == HEADER


def test_what_is_no_module_is_refused() -> None:
    with pytest.raises(ValueError, match="not a WebAssembly module"):
        strip_custom_sections(b"<html>")


def test_the_same_sources_give_the_same_bytes(root: Path, tmp_path: Path) -> None:
    first = parts(copied(root, tmp_path / "one"))
    second = parts(copied(root, tmp_path / "two"))

    assert first == second
    assert has_playground(first)
    engine = gzip.decompress(first[f"{bundle.FOLDER}/mujoco.wasm.gz"])
    assert engine.startswith(HEADER)
    assert len(engine) < (root / bundle.ENGINE).stat().st_size / 2
    assert b"three" in first[f"{bundle.FOLDER}/licenses.txt"]


def test_a_second_bundle_is_taken_from_the_cache(root: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    sources = copied(root, tmp_path)
    made = parts(sources)
    monkeypatch.setenv("PATH", "")
    monkeypatch.setattr(bundle, "node", lambda: pytest.fail("bundled again"))

    assert parts(sources) == made


def test_without_its_packages_the_site_has_the_loader_alone(
    root: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch, caplog: pytest.LogCaptureFixture
) -> None:
    monkeypatch.setenv("CI", "true")
    sources = copied(root, tmp_path)
    (sources / "node_modules").unlink()

    made = parts(sources)

    assert list(made) == [f"{bundle.FOLDER}/loader.js"]
    assert not has_playground(made)
    assert caplog.messages == [f"no playground: {bundle.ENGINE} is not there; run `make setup`"]
    assert [record.levelname for record in caplog.records] == ["WARNING"]


def test_a_mistake_in_a_module_stops_the_build(root: Path, tmp_path: Path) -> None:
    sources = copied(root, tmp_path)
    (sources / "docs/playground/engine/checks.js").write_text("export const = 1;", encoding="utf-8")

    with pytest.raises(RuntimeError, match=r"checks\.js:1:13: ERROR"):
        parts(sources)
