"""What MuJoCo says. The law: every text on the page is what the installed engine says today."""

from __future__ import annotations

import re
from pathlib import Path

import mujoco
import pytest
from clinic.engine.signals import WARNINGS
from clinic.pages.messages import (
    LOCK,
    Heard,
    Message,
    codes_of,
    listen,
    load_messages,
    messages_page,
    provoke_messages,
    read_heard,
)
from clinic.record.problem import CaseError
from clinic.work.cache import Cache
from helpers import tiny_case

MESSAGES = load_messages()
ENTRY = """\
While it runs:
  odd-text:
    title: odd text
    xml: <mujoco/
    meaning: It is odd.
    look_at: The text.
"""


@pytest.fixture(scope="module")
def said(tmp_path_factory: pytest.TempPathFactory) -> dict[str, str]:
    return provoke_messages(MESSAGES, Cache(tmp_path_factory.mktemp("cache")))


@pytest.mark.parametrize("message", [m for m in MESSAGES if m.code is not None], ids=lambda message: message.id)
def test_the_engine_still_says_it(message: Message, said: dict[str, str]) -> None:
    words = re.findall(r"\w{3,}", message.title)
    assert re.search(".*".join(words), said[message.id], re.DOTALL), (
        f"messages.yaml: {message.id}: the installed MuJoCo says something else now: {said[message.id]}\n"
        "Correct `title`, and `meaning` where it no longer holds; keep the former text under `older`."
    )


@pytest.mark.parametrize("warning", WARNINGS)
def test_every_warning_type_is_covered(warning: str) -> None:
    entries = [message for message in MESSAGES if message.warning == warning]
    assert len(entries) == 1, f"mjWARN_{warning}: add one entry with `warning: {warning}` to messages.yaml"


def test_the_page_names_the_joint_of_a_degree_of_freedom(capsys: pytest.CaptureFixture[str]) -> None:
    (code,) = re.findall(r"`(print\(.+?\))`", " ".join(MESSAGES[0].look_at.split()))
    joints = "".join(f'<body><joint name="joint {number}"/><geom size="0.1"/></body>' for number in range(9))
    exec(code, {"model": mujoco.MjModel.from_xml_string(f"<mujoco><worldbody>{joints}</worldbody></mujoco>")})
    assert MESSAGES[0].id == "bad-qacc"
    assert capsys.readouterr().out == "joint 7\n"


def test_forty_errors_are_provoked() -> None:
    assert len([message for message in MESSAGES if message.warning is None and message.code is not None]) >= 40


def test_every_case_named_exists(root: Path) -> None:
    slugs = {path.name for path in (root / "cases").iterdir()}
    assert {message.case for message in MESSAGES if message.case} <= slugs


def test_the_page_says_what_was_heard(tmp_path: Path, said: dict[str, str]) -> None:
    case = tiny_case(tmp_path, ("tags: [contact]", "tags: [contact]\nfamily: sinks"))
    named = MESSAGES[0].model_copy(update={"case": case.slug})
    page = messages_page(
        [named, *MESSAGES[1:]],
        {**said, named.id: "WARNING: said today"},
        {case.slug: case},
        Heard(said={named.id: {"3.9.0": "once", "3.10.0": "once", "3.11.0": ""}}),
    )
    assert "WARNING: said today" in page
    shown = f"[1. A box falls through the floor](cases/{case.slug}/index.md#answer)"
    assert f"{shown}, or [another cause of it](symptoms/sinks.md).\n" in page
    assert page.count("\n### ") == len(MESSAGES)
    assert "mjWARN_BADQACC" in page
    assert "Not provoked here." in page
    assert "- 3.9.0 to 3.10.0: `` once ``\n" in page
    assert "- 3.11.0: no message\n" in page


def test_what_releases_say_otherwise_is_kept() -> None:
    first, second, *_ = codes_of(MESSAGES)
    newest = dict.fromkeys(codes_of(MESSAGES), "line 3")
    heard = listen(MESSAGES, {"3.9.0": {**newest, first: "gone\nin two lines", second: "line 45"}, "4.0.0": newest})
    assert heard.said == {first: {"3.9.0": "gone"}}


def test_a_lock_of_other_codes_tells_nothing(tmp_path: Path) -> None:
    heard = listen(MESSAGES, {"4.0.0": dict.fromkeys(codes_of(MESSAGES), "")})
    assert read_heard(tmp_path, MESSAGES) == Heard()
    (tmp_path / LOCK).write_text(heard.model_dump_json(), encoding="utf-8")
    assert read_heard(tmp_path, MESSAGES) == heard
    changed = MESSAGES[0].model_copy(update={"python": "load('<mujoco>')"})
    assert read_heard(tmp_path, [changed, *MESSAGES[1:]]) == Heard()


def test_no_older_text_is_one_that_a_measured_release_says(root: Path, said: dict[str, str]) -> None:
    heard = read_heard(root, MESSAGES)
    assert heard.codes, f"{LOCK} is stale: run `make releases` and commit it"
    for message in MESSAGES:
        texts = [said.get(message.id, ""), *heard.said.get(message.id, {}).values()]
        provoked = [older for older in message.older if any(older in text for text in texts)]
        assert not provoked, f"messages.yaml: {message.id}: remove from `older` what is provoked: {provoked}"


@pytest.mark.parametrize(
    ("old", "new", "expected"),
    [
        ("    title: odd text\n", "", "odd-text.title"),
        ("xml: <mujoco/", "wxl: <mujoco/", "odd-text.wxl"),
        ("    meaning:", "    python: x\n    meaning:", "xml and python instead of exactly one of"),
        ("odd-text:", "Odd text:", "pattern"),
        ("    meaning: It", "    meaning: [It", "line 6"),
    ],
)
def test_a_wrong_entry_is_a_problem(tmp_path: Path, old: str, new: str, expected: str) -> None:
    file = tmp_path / "messages.yaml"
    file.write_text(ENTRY.replace(old, new), encoding="utf-8")
    with pytest.raises(CaseError) as caught:
        load_messages(file)
    assert expected in str(caught.value)
    assert str(caught.value).startswith("messages.yaml:")
