"""Edits of a text by place."""

from __future__ import annotations

import pytest
from clinic.diagnosis.edit import apply, insert, set_attribute
from clinic.diagnosis.source import read_source


@pytest.mark.parametrize("text", ['<mujoco>\n  <option gravity="0 0 0"/>\n</mujoco>', "<mujoco/>"])
def test_what_two_edits_insert_into_one_element_is_inside_of_it(text: str) -> None:
    root = read_source({"model": text}).root  # type: ignore[union-attr]
    edits = [insert(root, "<asset/>"), set_attribute(root, "model", "arm"), insert(root, "<worldbody/>")]
    after = read_source(apply({"model": text}, edits))
    assert after is not None
    assert after.root.get("model") == "arm"
    assert [each.tag for each in after.root.children][-2:] == ["asset", "worldbody"]
