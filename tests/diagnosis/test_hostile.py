"""Whatever a file holds, a diagnosis of it ends with what it found or with a sentence."""

from __future__ import annotations

from pathlib import Path

import pytest
from clinic.commands.cli import app
from clinic.diagnosis.edit import apply, set_attribute
from clinic.diagnosis.rules import rules
from clinic.diagnosis.source import Source
from diagnosed import causes, with_edits
from mutilated import KINDS, mutilated
from typer.testing import CliRunner


@pytest.mark.parametrize("seed", range(len(KINDS)), ids=lambda seed: KINDS[seed].__name__)
def test_a_mutilated_model_is_diagnosed_or_refused(seed: int, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)
    _, content = mutilated(seed)
    Path("model.xml").write_bytes(content)

    result = CliRunner().invoke(app, ["diagnose", "model.xml"])

    assert isinstance(result.exception, SystemExit | None)
    assert result.exit_code in (0, 1, 2)
    assert bool(result.stdout) or result.stderr.startswith("clinic: model.xml: ")
    assert "MuJoCo ended the process" not in result.stderr
    assert [path.name for path in tmp_path.iterdir()] == ["model.xml"]
    assert Path("model.xml").read_bytes() == content


@pytest.mark.parametrize("name", ["no-such", "utf-32", "latin-1"])
def test_a_text_is_read_as_utf_8_whatever_it_declares(name: str) -> None:
    text = rules()["visual-mass"].example("Bad").replace('"drill"', '"perçeuse"')
    (cause,) = causes(f'<?xml version="1.0" encoding="{name}"?>\n{text}', "visual-mass")
    assert (cause.elements, cause.line) == (('body "perçeuse"',), 6)


@pytest.mark.parametrize(
    ("before", "after"),
    [
        ("<worldbody>", "<!-- ---- the world ---- --><worldbody>"),
        ("<worldbody>", "<!--- the world ---><worldbody>"),
        ('name="drill" pos', 'name="drill"pos'),
        ("<worldbody>", '<worldbody><site name="up & down"/>'),
        ("<mujoco>", '\n<?xml version="1.0"?><mujoco>'),
        ("<worldbody>", '<worldbody><site name="a<b\x01"/>'),
    ],
    ids=["dashes", "dash at the end", "no blank", "ampersand", "declaration below", "bracket and control"],
)
def test_what_mujoco_reads_and_xml_does_not_allow_is_mended_at_its_place(before: str, after: str) -> None:
    text = rules()["visual-mass"].example("Bad")
    odd = text.replace(before, after)
    assert text.count(before) == 1

    (plain,), (told,) = (causes(each, "visual-mass") for each in (text, odd))

    assert told.elements == plain.elements
    assert with_edits(odd, told) == with_edits(text, plain).replace(before, after)


def test_an_attribute_without_a_blank_before_it_is_set_and_not_written_twice() -> None:
    texts = {"model.xml": """<mujoco><worldbody><geom name='b"margin="1" c'margin="2"/></worldbody></mujoco>"""}
    (geom,) = Source(texts).elements("geom")
    assert apply(texts, [set_attribute(geom, "margin", "0")])["model.xml"].count('margin="0"') == 1
    assert (
        """<geom name='b"margin="1" c' margin="0"/>"""
        in apply(texts, [set_attribute(geom, "margin", "0")])["model.xml"]
    )
