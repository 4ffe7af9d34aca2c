"""Triage that runs: six steps on a model, cheapest first, each of which says what it saw.

The steps name no causes. A step looks at what is general to every model, by rules with stated thresholds, and an
observation lists what the rules found. Nothing found is an answer too.
"""

from __future__ import annotations

import re
import warnings
from collections.abc import Callable, Iterator
from dataclasses import replace
from pathlib import Path
from time import perf_counter

import mujoco
import numpy as np
from pydantic import BaseModel

from clinic.engine.releases import read_spec
from clinic.engine.simulate import RunError, captured_messages
from clinic.record.case import Case, load_case
from clinic.record.fields import RunSpec
from clinic.record.folder import RECORD
from clinic.record.problem import CaseError, Problem
from clinic.triage import model_rules, motion, scene_rules, switch_off
from clinic.triage.findings import Finding, StepResult
from clinic.triage.recording import Subject

SECONDS = 7.0
DURATION = 2.0
MAX_STEPS = 4000
SHOWN = 3
FIRST = "the first keyframe"
ENGINE_ERRORS = (ValueError, mujoco.FatalError, mujoco.UnexpectedError)
STEPS: dict[str, tuple[str, Callable[[Subject], StepResult]]] = {
    "warnings": ("MuJoCo's warnings", motion.warnings),
    "model": ("the model as compiled", model_rules.look),
    "overlays": ("the scene with overlays", scene_rules.look),
    "conservation": ("conservation", motion.conservation),
    "timestep": ("half the timestep", motion.halved),
    "reduce": ("a reduced scene", switch_off.look),
}


class Observation(BaseModel, frozen=True):
    """What one step saw; `said` is what it looked at and measured, whatever it found."""

    step: str
    said: str
    taken: bool = True
    findings: list[Finding] = []


def triage(subject: Subject, seconds: float = np.inf) -> Iterator[Observation]:
    """The six observations, each as soon as it is made. A step that cannot be taken within `seconds` says why."""
    subject = replace(subject, end=perf_counter() + seconds)
    for step, (_, look) in STEPS.items():
        if perf_counter() >= subject.end:
            yield Observation(step=step, taken=False, said="the time allowed was used up")
            continue
        try:
            with np.errstate(all="ignore"):
                said, findings = look(subject)
        except RunError as error:
            yield Observation(step=step, taken=False, said=error.found)
        except (*ENGINE_ERRORS, ArithmeticError) as error:
            yield Observation(step=step, taken=False, said=" ".join(str(error).split()) or type(error).__name__)
        else:
            yield Observation(step=step, said=said, findings=findings)


def subject_of_case(case: Case, text: str | None = None) -> Subject:
    """A model case's broken model, or another text of it, run as the record says."""
    assert case.record.run is not None
    return _compiled(lambda: mujoco.MjSpec.from_string(case.text if text is None else text), case.record.run)


def subject_of(path: Path) -> Subject:
    """What stands at `path`: a case's folder, or a model file.

    A model file is started from its first keyframe, where it has one, with that keyframe's controls.

    Raises:
        CaseError: If it is a case in code, or cannot be read or compiled.
    """
    if (path / RECORD).is_file() or path.name == RECORD:
        case = load_case(path if path.is_dir() else path.parent)
        if case.record.model is None:
            raise CaseError(
                [case.problem(("script",), "a bug in code", "a model", f"read {case.file}; triage looks at models")]
            )
        return subject_of_case(case)
    if not path.is_file():
        found = f"a folder without {RECORD}" if path.is_dir() else "no such file"
        expected = "an MJCF or URDF file, or a case's folder"
        raise CaseError([Problem(str(path), 1, "", found, expected, "correct the path")])
    try:
        return _compiled(lambda: read_spec(path))
    except ENGINE_ERRORS as error:
        said = " ".join(str(error).split())
        lines = re.findall(r"(?:Element\b.*\bline |Line number=)(\d+)", said)
        line, expected = max([1, *map(int, lines), _line_of_key(path, said)]), "XML that MuJoCo compiles"
        raise CaseError([Problem(str(path), line, "", said, expected, "see *What MuJoCo says*")]) from None


def _line_of_key(path: Path, said: str) -> int:
    """The line of the keyframe that MuJoCo's message names, as it does not say it; 1 where there is none."""
    found = re.match(r"Error: key(?:frame)? '?([^':]*)'?:", said)
    lines = path.read_text(encoding="utf-8", errors="replace").splitlines() if found else []
    keys = [number for number, line in enumerate(lines, 1) if re.search(r"<key[\s/>]", line)]
    named = [number for number in keys if found and f'name="{found[1]}"' in lines[number - 1]]
    if named or not found or not found[1].isdigit():
        return (named or [1])[0]
    return keys[int(found[1])] if int(found[1]) < len(keys) else 1


def report(observation: Observation) -> str:
    """An observation as text: a line that says what was looked at, then what was found, alike findings summed up."""
    result = "saw something" if observation.findings else "nothing unusual" if observation.taken else "not taken"
    number, title = list(STEPS).index(observation.step) + 1, STEPS[observation.step][0]
    lines = [f"{number}. {title}: {result} ({observation.said})"]
    by_rule: dict[str, dict[str, list[str]]] = {}
    for finding in observation.findings:
        by_rule.setdefault(finding.rule, {}).setdefault(finding.text, []).append(finding.element)
    for texts in by_rule.values():
        for text, elements in list(texts.items())[:SHOWN]:
            more = f" and {len(elements) - SHOWN} more" if len(elements) > SHOWN else ""
            lines.append(f"   - {', '.join(elements[:SHOWN])}{more}: {text}")
        if rest := sum(map(len, list(texts.values())[SHOWN:])):
            lines.append(f"   - ... and {rest} more of the same kind")
    return "\n".join(lines)


def _compiled(read: Callable[[], mujoco.MjSpec], run: RunSpec | None = None) -> Subject:
    """The model read and compiled. Without a run: DURATION from the first keyframe, with that keyframe's controls."""
    with captured_messages() as messages, warnings.catch_warnings(record=True) as raised:
        warnings.simplefilter("always")
        spec = read()
        if spec.keys and not spec.keys[0].name:
            spec.keys[0].name = FIRST
        given = {key.name: len(key.qpos) for key in spec.keys}
        model = spec.compile()
    if run is None:
        duration = min(DURATION, MAX_STEPS * model.opt.timestep) if model.opt.timestep > 0 else DURATION
        run = RunSpec(duration=duration, keyframe=next(iter(given), None))
    notes = tuple(dict.fromkeys([*(str(warning.message) for warning in raised), *messages]))
    return Subject(spec, model, run, notes, given)
