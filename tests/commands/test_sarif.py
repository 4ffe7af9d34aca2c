"""Findings as SARIF and as GitHub's workflow commands."""

from __future__ import annotations

import json
from collections.abc import Mapping
from pathlib import Path
from typing import Any

import pytest
from clinic.commands.cli import app
from clinic.commands.github import workflow_command
from clinic.diagnosis.rules import rules
from typer.testing import CliRunner, Result

TWO = """<mujoco>
  <worldbody>
    <body pos="0 0 1">
      <freejoint/>
      <geom size="0.05" contype="0" conaffinity="0"/>
      <geom size="0.05" mass="0.2"/>
    </body>
    <!-- clinic: ignore[visual-mass] a lamp -->
    <body pos="0 0 2">
      <freejoint/>
      <geom size="0.05" contype="0" conaffinity="0"/>
      <geom size="0.05" mass="0.2"/>
    </body>
  </worldbody>
</mujoco>
"""
ONE = TWO.replace("    <!-- clinic: ignore[visual-mass] a lamp -->\n", "")


def run(*arguments: object) -> Result:
    return CliRunner().invoke(app, ["diagnose", *map(str, arguments)])


@pytest.fixture
def folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    monkeypatch.chdir(tmp_path)
    (tmp_path / "my robot").mkdir()
    return tmp_path / "my robot"


def log(*arguments: object) -> dict[str, Any]:
    return valid(json.loads(run(*arguments, "--format", "sarif").stdout))


def valid(found: dict[str, Any]) -> dict[str, Any]:
    """A log whose required properties, and those that the schema bounds, are as SARIF 2.1.0 wants them."""
    assert found["version"] == "2.1.0"
    assert found["$schema"].endswith("sarif-2.1.0.json")
    (made,) = found["runs"]
    assert made["columnKind"] in ("utf16CodeUnits", "unicodeCodePoints")
    driver = made["tool"]["driver"]
    assert isinstance(driver["name"], str)
    ids = [rule["id"] for rule in driver["rules"]]
    assert len(ids) == len(set(ids))
    for rule in driver["rules"]:
        assert set(rule) <= {
            "id", "shortDescription", "fullDescription", "help", "helpUri", "properties", "defaultConfiguration"
        }  # fmt: skip
        assert all(rule[name]["text"] for name in ("shortDescription", "fullDescription", "help") if name in rule)
    for invocation in made["invocations"]:
        assert isinstance(invocation["executionSuccessful"], bool)
        for said in invocation.get("toolExecutionNotifications", []):
            assert said["message"]["text"]
    for result in made["results"]:
        assert ids[result["ruleIndex"]] == result["ruleId"]
        assert result["level"] in ("none", "note", "warning", "error")
        assert result["message"]["text"]
        assert all(isinstance(each, str) for each in result["partialFingerprints"].values())
        for place in result["locations"]:
            located(place["physicalLocation"]["artifactLocation"])
            assert place["physicalLocation"]["region"]["startLine"] >= 1
        for fix in result.get("fixes", []):
            assert fix["artifactChanges"]
            for change in fix["artifactChanges"]:
                located(change["artifactLocation"])
                assert change["replacements"]
                assert all("deletedRegion" in each for each in change["replacements"])
        for suppression in result.get("suppressions", []):
            assert suppression["kind"] in ("inSource", "external")
    return made


def located(place: Mapping[str, str]) -> None:
    assert not place["uri"].startswith(("/", ".."))
    assert " " not in place["uri"]
    assert "\\" not in place["uri"]


def replaced(text: str, replacements: list[dict[str, Any]]) -> str:
    """A text after the replacements of a fix, by lines and columns."""
    starts = [0]
    for line in text.split("\n"):
        starts.append(starts[-1] + len(line) + 1)
    for each in reversed(replacements):
        region = each["deletedRegion"]
        assert region["endLine"] < len(starts)
        assert region["startColumn"] >= 1
        start = starts[region["startLine"] - 1] + region["startColumn"] - 1
        end = starts[region["endLine"] - 1] + region["endColumn"] - 1
        text = text[:start] + each["insertedContent"]["text"] + text[end:]
    return text


@pytest.mark.parametrize("text", [ONE, ONE.rstrip("\n"), ONE.replace("\n", " ")], ids=["lines", "open end", "one line"])
def test_a_log_names_rule_place_and_fix(folder, text):
    (folder / "drill.xml").write_text(text)

    made = log("my robot/drill.xml")

    cause = next(each for each in made["results"] if each["ruleId"] == "visual-mass")
    assert cause["level"] == "error"
    place = cause["locations"][0]["physicalLocation"]
    assert place["artifactLocation"] == {"uri": "my%20robot/drill.xml", "uriBaseId": "%SRCROOT%"}
    assert place["region"] == {"startLine": text[: text.index("<geom")].count("\n") + 1}
    (change,) = cause["fixes"][0]["artifactChanges"]
    wanted = text.replace('conaffinity="0"/>', 'conaffinity="0" mass="0"/>')
    assert replaced(text, change["replacements"]) == wanted
    rule = made["tool"]["driver"]["rules"][cause["ruleIndex"]]
    assert rule["help"]["text"] == rules()["visual-mass"].text
    assert made["invocations"] == [{"executionSuccessful": True}]


def test_hints_are_notes_and_what_a_comment_silences_is_listed_with_its_reason(folder):
    (folder / "drill.xml").write_text(TWO.replace("[visual-mass]", "[visual-mass, masks]"))

    found = {each["ruleId"]: each for each in log(folder / "drill.xml")["results"]}

    assert found["ignore-comment"]["level"] == "note"
    assert "suppressions" not in found["visual-mass"]  # it is about both bodies
    (folder / "drill.xml").write_text(
        ONE.replace("<worldbody>", "<!-- clinic: ignore[visual-mass] lamps --><worldbody>")
    )
    found = {each["ruleId"]: each for each in log(folder / "drill.xml")["results"]}
    assert found["visual-mass"]["suppressions"] == [{"kind": "inSource", "justification": "lamps"}]
    assert run(folder / "drill.xml").exit_code == 0


def test_a_fix_of_an_included_file_names_that_file(folder):
    (folder / "part.xml").write_text(ONE)
    (folder / "scene.xml").write_text('<mujoco>\n  <include file="part.xml"/>\n</mujoco>\n')
    cause = next(each for each in log("my robot/scene.xml")["results"] if each["ruleId"] == "visual-mass")
    assert cause["locations"][0]["physicalLocation"]["artifactLocation"]["uri"] == "my%20robot/part.xml"
    assert [each["artifactLocation"]["uri"] for each in cause["fixes"][0]["artifactChanges"]] == ["my%20robot/part.xml"]


def test_what_cannot_be_run_is_told_in_the_log(folder):
    (folder / "wrong.xml").write_text("<mujoco>\n  <wordbody/>\n</mujoco>\n")
    result = run("nowhere.xml", "my robot/wrong.xml", "--select", "masks", "--format", "sarif")
    (invocation,) = valid(json.loads(result.stdout))["invocations"]
    assert result.exit_code == 2
    assert not invocation["executionSuccessful"]
    said = [each["message"]["text"] for each in invocation["toolExecutionNotifications"]]
    assert said[0] == "nowhere.xml: No such file or directory"
    assert said[1].startswith("wrong.xml: ")


def test_github_marks_the_line_that_the_edit_changes(folder):
    (folder / "drill.xml").write_text(ONE)
    result = run("my robot/drill.xml", "nowhere.xml", "--format", "github", "--select", "visual-mass")
    first, second = result.stdout.splitlines()
    assert first.startswith("::error file=my robot/drill.xml,line=5,title=visual-mass::Geoms that are only seen")
    assert second == "::error file=nowhere.xml,line=1,title=cannot be run::nowhere.xml: No such file or directory"
    assert result.exit_code == 1


def test_a_workflow_command_is_escaped_as_the_runner_reads_it():
    made = workflow_command("error", "a,b:c%.xml", 3, "x\n", "50 %: a, b\r\nc")
    assert made == "::error file=a%2Cb%3Ac%25.xml,line=3,title=x%0A::50 %25: a, b%0D%0Ac"
