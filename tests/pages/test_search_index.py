"""The search's index, packed."""

from __future__ import annotations

from typing import Any

from clinic.pages.search_index import Document, packed


def unpacked(kinds: dict[str, Any]) -> list[Document]:
    return [
        {
            "kind": kind,
            "at": made["around"][0] + rest + made["around"][1],
            **dict(zip(made["fields"], values, strict=True)),
        }
        for kind, made in kinds.items()
        for rest, *values in made["rows"]
    ]


def test_what_is_packed_is_all_there() -> None:
    case, other = ({"kind": "case", "at": f"cases/{slug}/index.html#answer", "text": slug} for slug in ("a", "bc"))
    page = {"kind": "page", "at": "aba", "title": "One"}  # its own beginning and end
    assert unpacked(packed([case, page, other])) == [case, other, page]


def test_a_field_that_one_lacks_is_empty() -> None:
    documents = [{"kind": "message", "at": "a", "case": "b"}, {"kind": "message", "at": "c"}]
    assert [each["case"] for each in unpacked(packed(documents))] == ["b", ""]
