"""The playground's small, pure parts, run by Node: errors as sentences, axes, bounds of checks, places in a text."""

from __future__ import annotations

import json
import subprocess
from typing import Any

import pytest
from clinic.engine.node import executable as node
from clinic.pages.completion import completion
from clinic.pages.search_index import packed_weights
from clinic.record.families import families, family_shares, family_weights, sayings
from project import ROOT

pytestmark = pytest.mark.xdist_group("parity")
CALL = """
  import { readFileSync } from "node:fs";
  const [module, name, calls] = JSON.parse(readFileSync(0, "utf8"));
  const exported = await import("./docs/playground/" + module);
  const plain = (_, value) => typeof value !== "number" || Number.isFinite(value) ? value : String(value);
  console.log(JSON.stringify(calls.map((call) => exported[name](...call) ?? null), plain));
"""
REFUSED = {  # what MuJoCo 3.14's JavaScript binding throws, with what the page says
    "vector": "needs more memory",
    "std::bad_alloc": "needs more memory",
    "MuJoCo Error: Loading error: XML parse error 14:\nError=XML_ERROR_MISMATCHED_ELEMENT ErrorID=14 (0xe) "
    "Line number=3: XMLElement name=body\n\n": "<body> is not closed",
    "MuJoCo Error: Loading error: XML parse error 7:\nError=XML_ERROR_PARSING_ATTRIBUTE ErrorID=7 (0x7) "
    "Line number=2: XMLElement name=geom\n\n": "An attribute cannot be read",
    "MuJoCo Error: Loading error: XML parse error 13:\nError=XML_ERROR_EMPTY_DOCUMENT ErrorID=13 (0xd) "
    "Line number=0\n\n": "The text is empty",
    "MuJoCo Error: Loading error: XML Error: Schema violation: unrecognized attribute: 'siez'\n"
    "Element 'geom', line 2\n\n": '<geom> has no attribute "siez"',
    "MuJoCo Error: Loading error: Error: Error opening file 'a.stl'\n": "names a file",
    "memory access out of bounds": "nested too deeply",
    "MuJoCo Error: Loading error: XML Error: bad format in attribute 'size'\nElement 'geom', line 1\n\n": "bad format",
    "": "without saying why",
}


def call(module: str, name: str, *calls: list[Any]) -> list[Any]:
    asked = json.dumps([module, name, calls])
    command = [node() or "", "--input-type=module", "-e", CALL]
    done = subprocess.run(command, input=asked, cwd=ROOT, check=False, capture_output=True, text=True)
    assert done.returncode == 0, done.stderr
    found: list[Any] = json.loads(done.stdout)
    return found


def test_errors_of_the_engine_are_sentences() -> None:
    told = call("engine/errors.js", "sentence", *[[message] for message in REFUSED])
    for (message, words), said in zip(REFUSED.items(), told, strict=True):
        assert words in said, message
        assert "XML_E" not in said


def test_words_of_meaning_that_follow_one_another_are_pairs() -> None:
    told = call("search/words.js", "pairs", ["The robot falls through the floor"], ["floor, through"], ["floor"], [""])
    assert told == [["fall through", "through floor"], ["floor through"], [], []]


@pytest.mark.parametrize(
    "splits",
    [
        [0, 0.5, 1],
        [19.1231, 19.1232, 19.1233],
        [1e6, 1e6 + 1, 1e6 + 2],
        [-2e-9, 0, 2e-9],
        [0.0025, 0.005, 0.0075],
        [1e12, 2e12],
    ],
)
def test_the_marks_of_an_axis_differ(splits: list[float]) -> None:
    [told] = call("view/ticks.js", "ticks", [splits])
    assert len({*told}) == len(splits), told
    assert [float(text) for text in told] == pytest.approx(splits, rel=1e-6, abs=1e-12)


def test_noise_does_not_fill_an_axis() -> None:
    noisy, still, moving, nothing = call("view/ticks.js", "reach", [[0.05, 0.05 + 1e-12]], [[0, 1e-17]], [[0, 2]], [[]])
    assert noisy[1] - noisy[0] > 0.01
    assert still[1] - still[0] > 1e-3
    assert moving == pytest.approx([-0.16, 2.16])
    assert nothing == [0, 1]


def test_the_bounds_of_checks_stand_where_the_check_looks() -> None:
    checks = [
        {"signal": "a", "take": "final", "between": [1, 2]},
        {"signal": "a", "take": "max", "below": 3, "window": [0.5, 1]},
        {"signal": "a", "take": "min", "below": 0},
        {"signal": "a", "take": "mean", "equals": 1, "within": 0.5},
        {"signal": "a", "take": "span", "below": 3},
    ]
    [found] = call("view/bounds.js", "bounds", [checks, 2])
    assert found == [
        {"from": 1.92, "to": 2, "low": 1, "high": 2, "once": False},
        {"from": 0.5, "to": 1, "low": "-Infinity", "high": 3, "once": False},
        {"from": 0, "to": 2, "low": "-Infinity", "high": 0, "once": True},
        {"from": 0, "to": 2, "low": 0.5, "high": 1.5, "once": False},
    ]


def test_so_many_steps_are_made_a_second_that_none_is_seen_alone() -> None:
    arm, box = call("view/controls.js", "firstSpeed", [{"speed": 0.04}, 0.01], [{"speed": 0.2}, 0.002])
    assert arm / 0.01 >= 30
    assert box == 0.2


def test_what_stands_at_a_place_of_a_text_is_known() -> None:
    text = '<mujoco><!-- <geom --><worldbody><body name="a > b"><geom size="1" ty'
    places = [
        "<mujoco><wor",
        "<mujoco><!-- <geom",
        text,
        text[:-3] + ' type="ca',
        text + '="box"/><',
        "</mujoco></bo",
        "<a/> ",
    ]
    found = call("editor/place.js", "placeOf", *[[each, len(each)] for each in places])
    told = [one and (one["kind"], one["word"], one["parent"], one["element"], one["attribute"]) for one in found]
    assert told[:5] == [
        ("element", "wor", "mujoco", "wor", ""),
        None,
        ("attribute", "ty", "body", "geom", ""),
        ("value", "ca", "body", "geom", "type"),
        ("element", "", "body", "", ""),
    ]
    assert told[6] is None


def test_the_editor_knows_what_mujoco_s_schema_and_manual_say() -> None:
    elements = json.loads(completion())["elements"]
    kind, says = elements["body/geom"]["attributes"]["contype"]
    assert (kind, says[:40]) == ('int, "1"', "This attribute and the next specify 32-b")
    assert {"geom", "joint", "body", "frame"} <= {*elements["mujoco/body"]["children"]}
    assert elements["mujoco/option"]["attributes"]["integrator"][0].startswith("[Euler, RK4")
    attributes = [told for one in elements.values() for told in one["attributes"].values()]
    silent = sum(not says for _, says in attributes)
    assert len(attributes) > 1500
    assert silent < 0.05 * len(attributes), "the manual is read no longer: see clinic.pages.completion"
    markup = [says for _, says in attributes if ":ref:" in says or "``" in says or "|-|" in says]
    assert not markup


def test_a_query_speaks_of_the_same_families_as_in_python() -> None:
    asked = [text for texts in sayings().values() for text in texts]
    weights = {"families": [*families()], **packed_weights(family_weights())}
    told = call("search/families.js", "told", [weights, asked])[0]
    for text, shares in zip(asked, told, strict=True):
        assert shares == pytest.approx(family_shares(text)), text
