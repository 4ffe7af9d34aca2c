"""The cache: finished work found again by its content."""

from __future__ import annotations

import errno
import shutil
from pathlib import Path

import pytest
from clinic.work.cache import ENGINES, PACKAGE, SETTINGS, Cache, engines, key_of, log_cache_unwritable, source_digest

FILES = {"evidence.json": b"{}\n", "plot.svg": bytes(range(256)), "sub/empty": b""}
KEY = "0123456789abcdef" * 2


@pytest.fixture
def cache(tmp_path: Path) -> Cache:
    return Cache(tmp_path / "not" / "there" / "yet")


@pytest.mark.parametrize("files", [FILES, {}])
def test_what_was_put_is_got_and_replaced(cache: Cache, files: dict[str, bytes]) -> None:
    assert cache.get(KEY) is None
    cache.put(KEY, {"a": b"before"})
    cache.put(KEY, files)
    assert cache.get(KEY) == files
    assert cache.get("other") is None
    assert list(cache.folder.iterdir()) == [cache.path(KEY)]


def test_remember_makes_once(cache: Cache) -> None:
    made: list[str] = []

    def make() -> dict[str, bytes]:
        made.append("again")
        return FILES

    assert [cache.remember("key", make) for _ in range(3)] == [FILES] * 3
    assert made == ["again"]


@pytest.mark.parametrize("length", [0, 9, 300])
def test_an_archive_that_was_cut_is_made_again(cache: Cache, length: int) -> None:
    cache.put("key", FILES)
    cache.path("key").write_bytes(cache.path("key").read_bytes()[:length])
    assert cache.get("key") is None
    assert cache.remember("key", lambda: {"a": b"new"}) == cache.get("key") == {"a": b"new"}


@pytest.fixture
def said(caplog: pytest.LogCaptureFixture) -> pytest.LogCaptureFixture:
    log_cache_unwritable.cache_clear()
    return caplog


def test_work_goes_on_beside_a_folder_that_takes_nothing(tmp_path: Path, said: pytest.LogCaptureFixture) -> None:
    (tmp_path / "file").write_text("", encoding="utf-8")
    cache = Cache(tmp_path / "file" / "cache")
    assert [cache.remember(key, lambda: FILES) for key in ("one", "two")] == [FILES] * 2
    assert len(said.messages) == 1
    assert "takes no files" in said.messages[0]


def test_work_goes_on_beside_a_full_disk(
    cache: Cache, said: pytest.LogCaptureFixture, monkeypatch: pytest.MonkeyPatch
) -> None:
    def full(old: str, new: Path) -> None:
        raise OSError(errno.ENOSPC, "No space left on device")

    monkeypatch.setattr("clinic.work.cache.os.replace", full)
    assert [cache.remember(key, lambda: FILES) for key in ("one", "two")] == [FILES] * 2
    assert len(said.messages) == 1
    assert list(cache.folder.iterdir()) == []


@pytest.mark.parametrize(
    ("one", "other"),
    [
        pytest.param(("a",), ("b",), id="text"),
        pytest.param(("a", "b"), ("ab",), id="parts-do-not-run-together"),
        pytest.param((1,), ("1",), id="number-and-text"),
        pytest.param(({"x": [1, 2]},), ({"x": [2, 1]},), id="order-of-a-list"),
        pytest.param((0.1,), (0.1 + 1e-17 + 2**-56,), id="last-bit"),
    ],
)
def test_keys_differ(one: tuple[object, ...], other: tuple[object, ...]) -> None:
    assert key_of(*one, of="proof") != key_of(*other, of="proof")


def test_key_does_not_depend_on_the_order_of_a_mapping() -> None:
    assert key_of({"a": 1, "b": 2}, of="proof") == key_of({"b": 2, "a": 1}, of="proof")


def test_keys_follow_the_folder_that_does_the_work_and_those_before_it(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    folders = ("engine", "proof", "pages/figures", "pages")
    before = {folder: key_of("a", of=folder) for folder in folders}
    assert len(set(before.values())) == 4
    shutil.copytree(PACKAGE, tmp_path / "clinic")
    monkeypatch.setattr("clinic.work.cache.PACKAGE", tmp_path / "clinic")
    source_digest.cache_clear()
    assert {folder: key_of("a", of=folder) for folder in folders} == before
    with open(tmp_path / "clinic/proof/laws.py", "a", encoding="utf-8") as file:
        file.write("# another\n")
    source_digest.cache_clear()
    after = {folder: key_of("a", of=folder) for folder in folders}
    source_digest.cache_clear()
    assert [folder for folder in folders if before[folder] == after[folder]] == ["engine"]


@pytest.mark.parametrize("name", [*ENGINES, *SETTINGS, "python", "machine"])
def test_keys_follow_what_runs_and_draws(name: str, monkeypatch: pytest.MonkeyPatch) -> None:
    before = key_of("a", of="proof")
    if name in SETTINGS:
        monkeypatch.setenv(name, "another")
    else:
        changed = {**engines(), name: "another"}
        monkeypatch.setattr("clinic.work.cache.engines", lambda: changed)
    assert key_of("a", of="proof") != before
