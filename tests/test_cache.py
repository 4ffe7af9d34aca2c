"""The cache: finished work found again by its content."""

from __future__ import annotations

from pathlib import Path

import pytest
from clinic.cache import Cache, digest, key_of, source_digest

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
    cache.put("one", FILES)
    cache.put("two", dict(reversed(FILES.items())))
    assert cache.path("one").read_bytes() == cache.path("two").read_bytes()


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
    assert key_of(*one) != key_of(*other)


def test_key_does_not_hang_on_the_order_of_a_mapping() -> None:
    assert key_of({"a": 1, "b": 2}) == key_of({"b": 2, "a": 1})


def test_digest_follows_names_and_contents(tmp_path: Path) -> None:
    def of(**files: str) -> str:
        for name, text in files.items():
            (tmp_path / name).write_text(text, encoding="utf-8")
        return digest([tmp_path / name for name in files])

    assert of(a="1", b="2") == of(a="1", b="2")
    assert len({of(a="1", b="2"), of(a="12", b=""), of(a="2", b="1"), of(c="1", b="2")}) == 4


def test_source_digest_is_stable() -> None:
    assert source_digest() == source_digest()
