"""Repairs, right and wrong, that the judge tells apart, and files that cannot be judged."""

from __future__ import annotations

import json
from collections.abc import Iterator
from pathlib import Path

import pytest
import yaml
from clinic.engine.variant import apply_edits
from clinic.proof.judge import judge_file, judge_text
from clinic.record.case import Case, load_case
from clinic.record.parts import Edit

REPAIRS = yaml.safe_load(Path(__file__).with_name("repairs.yaml").read_text(encoding="utf-8"))
MODELS, SCRIPTS = 3, 11  # every how many of the list are asked: a script is a process in each of its trials
ROOT = Path(__file__).parents[2]


def sampled() -> Iterator[object]:
    """Every MODELS-th repair of the model cases and every SCRIPTS-th of the code cases, right and wrong."""
    for slug, kinds in REPAIRS.items():
        step = MODELS if (ROOT / "cases" / slug / "model.xml").exists() else SCRIPTS
        listed = [(kind, name) for kind, repairs in kinds.items() for name in repairs]
        for kind, name in listed[len(slug) % step :: step]:
            yield pytest.param(slug, kind, name, id=f"{slug}: {name}")


def repaired(case: Case, edits: list[str]) -> str:
    pairs = zip(edits[::2], edits[1::2], strict=True)
    return apply_edits(case.text, [Edit(find=find, replace=replace) for find, replace in pairs])


@pytest.mark.parametrize(("of", "kind", "name"), list(sampled()))
def test_a_repair_is_judged_rightly(root: Path, of: str, kind: str, name: str) -> None:
    case = load_case(root / "cases" / of)

    judgement = judge_text(case, repaired(case, REPAIRS[of][kind][name]))

    assert judgement.repaired == (kind == "right"), judgement


def test_every_edit_of_the_list_finds_its_text(root: Path) -> None:
    for slug, kinds in REPAIRS.items():
        case = load_case(root / "cases" / slug)
        for repairs in kinds.values():
            for edits in repairs.values():
                repaired(case, edits)


@pytest.fixture
def sags(root: Path) -> Case:
    return load_case(root / "cases" / "servo-sags")


def test_what_fails_is_told_with_the_trial_and_the_number(sags: Case) -> None:
    judgement = judge_text(sags, sags.text.replace('damping="1"', 'damping="1" frictionloss="8"'))

    assert judgement.failed[-1].startswith(
        "In the trial 'Sent half a radian up': angle below the horizontal (final) is "
    )
    assert "rad; expected between -0.55 rad and -0.45 rad." in judgement.failed[-1]


def test_a_file_is_judged_by_another_process(root: Path, sags: Case, tmp_path: Path) -> None:
    path = tmp_path / "mine.xml"
    path.write_text(sags.text.replace('joint="shoulder"/>', 'joint="shoulder" kp="400" kv="20"/>'))

    assert judge_file(root / "cases" / "servo-sags", path).repaired


@pytest.mark.parametrize(
    ("text", "said"),
    [
        (b"", "no element found"),
        (b"<mujoco><worldbody/></mujoco>", ""),
        (b"\xff\xfe\x00", "mine.xml: "),
        (b'<mujoco><include file="/etc/passwd"/></mujoco>', '<include file="/etc/passwd">'),
        (b'<mujoco><option timestep="1e-9"/></mujoco>', ""),
    ],
)
def test_what_cannot_be_run_is_told_in_one_sentence(root: Path, tmp_path: Path, text: bytes, said: str) -> None:
    path = tmp_path / "mine.xml"
    path.write_bytes(text)

    judgement = judge_file(root / "cases" / "servo-sags", path)

    assert not judgement.repaired
    assert said in judgement.error
    assert json.dumps(judgement.error).count("\\n") == 0


def test_a_file_that_takes_too_long_is_told_so(root: Path) -> None:
    judgement = judge_file(root / "cases" / "servo-sags", Path("any.xml"), seconds=0)

    assert (judgement.repaired, judgement.error) == (False, "it takes more than 0 s")


def test_a_script_that_undoes_a_trial_is_told_so(root: Path) -> None:
    case = load_case(root / "cases" / "balances-only-in-the-viewer")

    judgement = judge_text(case, case.text.replace("(1, 20, 1000)", "(1, 1, 1)"))

    assert "changes 'for speed in (1, 20, 1000):': leave that in the script, once." in " ".join(judgement.failed)
