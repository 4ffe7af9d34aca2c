"""The cache: finished work found again by its content."""

from __future__ import annotations

import errno
import hashlib
import os
import shutil
import subprocess
import sys
import time
from pathlib import Path

import pytest
from clinic.work.cache import (
    CHECKSUM,
    ENGINES,
    ORPHANED,
    PACKAGE,
    SETTINGS,
    Cache,
    engines,
    key_of,
    say_unkept,
    source_digest,
)

FILES = {"evidence.json": b"{}\n", "plot.svg": bytes(range(256)), "sub/empty": b""}


@pytest.fixture
def cache(tmp_path: Path) -> Cache:
    return Cache(tmp_path / "not" / "there" / "yet")


def test_what_was_put_is_got(cache: Cache) -> None:
    assert cache.get("key") is None
    cache.put("key", FILES)
    assert cache.get("key") == FILES
    assert cache.get("other") is None


def test_putting_again_replaces(cache: Cache) -> None:
    cache.put("key", FILES)
    cache.put("key", {"a": b"1"})
    assert cache.get("key") == {"a": b"1"}


def test_no_files_are_a_result_too(cache: Cache) -> None:
    cache.put("key", {})
    assert cache.get("key") == {}


def test_archives_of_equal_files_are_equal_bytes(cache: Cache) -> None:
    cache.put("key", FILES)
    first = cache.path("key").read_bytes()
    cache.put("key", dict(reversed(FILES.items())))
    assert cache.path("key").read_bytes() == first


def test_nothing_but_archives_is_left(cache: Cache) -> None:
    cache.put("key", FILES)
    cache.put("key", FILES)
    assert list(cache.folder.iterdir()) == [cache.path("key")]


def test_remember_makes_once(cache: Cache) -> None:
    made: list[str] = []

    def make() -> dict[str, bytes]:
        made.append("again")
        return FILES

    assert [cache.remember("key", make) for _ in range(3)] == [FILES] * 3
    assert made == ["again"]


def test_work_that_fails_is_not_remembered(cache: Cache) -> None:
    with pytest.raises(ZeroDivisionError):
        cache.remember("key", lambda: {"a": bytes(1 // 0)})
    assert cache.get("key") is None


def test_an_archive_cut_short_is_none(cache: Cache) -> None:
    cache.put("key", FILES)
    whole = cache.path("key").read_bytes()
    for end in range(len(whole)):
        cache.path("key").write_bytes(whole[:end])
        assert cache.get("key") is None, f"cut after {end} bytes"


def test_an_archive_with_a_bit_inverted_is_whole_or_none(cache: Cache) -> None:
    files = {"a": b"one"}
    cache.put("key", files)
    whole = cache.path("key").read_bytes()
    for bit in range(8 * len(whole)):
        damaged = bytearray(whole)
        damaged[bit // 8] ^= 1 << bit % 8
        cache.path("key").write_bytes(bytes(damaged))
        assert cache.get("key") in (None, files), f"bit {bit} inverted"


@pytest.mark.parametrize(
    "whole",
    [
        pytest.param(b"", id="empty"),
        pytest.param(bytes(1000), id="zeros"),
        pytest.param(b"no archive" * 50, id="text"),
        pytest.param(b"PK\x05\x06" + bytes(18), id="an-archive-of-nothing-without-checksum"),
    ],
)
def test_garbage_is_none(cache: Cache, whole: bytes) -> None:
    cache.put("key", FILES)
    cache.path("key").write_bytes(whole)
    assert cache.get("key") is None


def test_every_damage_behind_a_right_checksum_is_an_archive_or_none(cache: Cache) -> None:
    cache.put("key", {"a": b"one"})
    packed = cache.path("key").read_bytes()[CHECKSUM:]
    damaged = [packed[:end] for end in range(len(packed))]
    damaged += [packed[:k] + bytes([packed[k] ^ 0xFF]) + packed[k + 1 :] for k in range(len(packed))]
    for body in damaged:
        checksum = hashlib.sha256(b"key\0" + body).digest()
        cache.path("key").write_bytes(checksum + body)
        found = cache.get("key")
        assert found is None or all(isinstance(content, bytes) for content in found.values())


def test_the_archive_of_another_key_is_none(cache: Cache) -> None:
    cache.put("one", FILES)
    cache.path("other").write_bytes(cache.path("one").read_bytes())
    assert cache.get("other") is None


def test_a_folder_in_an_archives_place_is_none(cache: Cache) -> None:
    cache.path("key").mkdir(parents=True)
    assert cache.remember("key", lambda: FILES) == FILES


@pytest.fixture
def said(caplog: pytest.LogCaptureFixture) -> pytest.LogCaptureFixture:
    say_unkept.cache_clear()
    return caplog


def test_work_goes_on_beside_a_folder_that_takes_nothing(tmp_path: Path, said: pytest.LogCaptureFixture) -> None:
    (tmp_path / "file").write_text("", encoding="utf-8")
    cache = Cache(tmp_path / "file" / "cache")
    cache.tidy()
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


def test_orphans_are_removed_and_what_is_being_written_is_not(cache: Cache) -> None:
    cache.put("key", FILES)
    orphan, young = cache.folder / "old.part", cache.folder / "new.part"
    for part in (orphan, young):
        part.write_bytes(b"half")
    then = time.time() - ORPHANED - 60
    for path in (orphan, cache.path("key")):
        os.utime(path, (then, then))
    cache.tidy()
    assert set(cache.folder.iterdir()) == {young, cache.path("key")}


def test_many_processes_put_one_key(tmp_path: Path) -> None:
    code = (
        "import sys; from pathlib import Path; from clinic.cache import Cache\n"
        "cache = Cache(Path(sys.argv[1])); files = {'a': bytes(300_000)}\n"
        "for _ in range(100):\n cache.put('key', files); assert cache.get('key') == files"
    )
    running = [subprocess.Popen([sys.executable, "-c", code, str(tmp_path)]) for _ in range(3)]
    assert [process.wait() for process in running] == [0, 0, 0]
    assert list(tmp_path.iterdir()) == [Cache(tmp_path).path("key")]


def test_a_damaged_archive_is_made_again(cache: Cache) -> None:
    cache.put("key", FILES)
    cache.path("key").write_bytes(cache.path("key").read_bytes()[:9])
    assert cache.remember("key", lambda: {"a": b"new"}) == {"a": b"new"}
    assert cache.get("key") == {"a": b"new"}


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


def test_key_does_not_hang_on_the_order_of_a_mapping() -> None:
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


@pytest.mark.parametrize("name", [*ENGINES, "python", "machine"])
def test_keys_follow_what_runs_and_draws(name: str, monkeypatch: pytest.MonkeyPatch) -> None:
    before = key_of("a", of="proof")
    changed = {**engines(), name: "another"}
    monkeypatch.setattr("clinic.work.cache.engines", lambda: changed)
    assert key_of("a", of="proof") != before


@pytest.mark.parametrize("name", SETTINGS)
def test_keys_follow_the_renderer(name: str, monkeypatch: pytest.MonkeyPatch) -> None:
    before = key_of("a", of="proof")
    monkeypatch.setenv(name, "another")
    assert key_of("a", of="proof") != before
