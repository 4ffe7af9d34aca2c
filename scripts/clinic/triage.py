"""Triage that runs: six steps on a model, cheapest first, each of which says what it saw.

The steps name no causes. A step looks at what is general to every model, by rules with stated thresholds, and an
observation lists what the rules found. Nothing found is an answer too.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from pathlib import Path

import mujoco
from pydantic import BaseModel, ConfigDict

from clinic import triage_model, triage_motion, triage_reduce, triage_scene
from clinic.case import RECORD, Case, load_case
from clinic.problem import CaseError, Problem
from clinic.record import RunSpec
from clinic.simulate import RunError, captured_messages
from clinic.triage_run import Budget, Subject
from clinic.triage_watch import Trial

SECONDS = 8.0
DURATION = 2.0
MAX_STEPS = 4000
SHOWN = 4


class Finding(BaseModel):
    """Something unusual: the rule that saw it, the element it saw it at, and what it saw, in words."""

    model_config = ConfigDict(frozen=True, extra="forbid")

    rule: str
    element: str
    text: str


class Observation(BaseModel):
    """What one step saw; `said` is what it looked at and measured, whatever it found."""

    model_config = ConfigDict(frozen=True, extra="forbid")

    step: str
    said: str
    findings: list[Finding] = []

    @property
    def saw(self) -> bool:
        """Whether the step found anything."""
        return bool(self.findings)


Look = Callable[[Trial], tuple[str, list[tuple[str, str, str]]]]
STEPS: dict[str, tuple[str, Look]] = {
    "warnings": ("MuJoCo's warnings", triage_motion.warnings),
    "model": ("the model as compiled", triage_model.look),
    "overlays": ("the scene with overlays", triage_scene.look),
    "conservation": ("conservation", triage_motion.conservation),
    "timestep": ("half the timestep", triage_motion.halved),
    "reduce": ("a reduced scene", triage_reduce.look),
}


def triage(subject: Subject, budget: Budget | None = None) -> Iterator[Observation]:
    """The six observations, each as soon as it is made. A step that cannot be taken says why."""
    trial = Trial(subject, budget or Budget())
    for step, (_, look) in STEPS.items():
        if trial.budget.left <= 0:
            yield Observation(step=step, said="not taken: the time allowed was used up")
            continue
        try:
            said, found = look(trial)
        except RunError as error:
            yield Observation(step=step, said=f"not taken: {error.found}")
        except (ValueError, ArithmeticError, mujoco.FatalError, mujoco.UnexpectedError) as error:
            yield Observation(step=step, said=f"not taken: {_first_line(error)}")
        else:
            findings = [Finding(rule=rule, element=element, text=text) for rule, element, text in found]
            yield Observation(step=step, said=said, findings=findings)


def subject_of_case(case: Case, text: str | None = None) -> Subject:
    """A model case's broken model, or another text of it, run as the record says."""
    assert case.record.run is not None
    with captured_messages():
        spec = mujoco.MjSpec.from_string(case.text if text is None else text)
        return Subject(f"{case.record.number}. {case.record.title}", spec, spec.compile(), case.record.run)


def subject_of(path: Path) -> Subject:
    """What stands at `path`: a case's folder, or a model file.

    A model file is started from its first keyframe, where it has one, with that keyframe's controls.

    Raises:
        CaseError: If it is a case in code, or cannot be read or compiled.
    """
    if path.is_dir() or path.name == RECORD:
        case = load_case(path if path.is_dir() else path.parent)
        if case.record.model is None:
            raise CaseError(
                [case.problem(("script",), "a bug in code", "a model", f"read {case.file}; triage looks at models")]
            )
        return subject_of_case(case)
    if not path.is_file():
        raise _problem(path, 1, "no such file", "an MJCF or URDF file, or a case's folder", "correct the path")
    try:
        with captured_messages():
            spec = mujoco.MjSpec.from_file(str(path))
            model = spec.compile()
    except (ValueError, mujoco.FatalError, mujoco.UnexpectedError, UnicodeError) as error:
        said = " ".join(str(error).split())
        raise _problem(
            path, triage_model.line_of(said), said, "XML that MuJoCo compiles", "see *What MuJoCo says*"
        ) from None
    timestep = model.opt.timestep
    duration = min(DURATION, MAX_STEPS * timestep) if timestep > 0 else DURATION
    keyframe = None
    if model.nkey:
        keyframe = mujoco.mj_id2name(model, mujoco.mjtObj.mjOBJ_KEY, 0)
    return Subject(path.name, spec, model, RunSpec(duration=duration, keyframe=keyframe or None))


def report(observation: Observation) -> str:
    """An observation as text: a line that says what was looked at, then what was found."""
    number = list(STEPS).index(observation.step) + 1
    title = STEPS[observation.step][0]
    lines = [f"{number}. {title}: {'saw something' if observation.saw else 'nothing unusual'} ({observation.said})"]
    by_rule: dict[str, list[Finding]] = {}
    for finding in observation.findings:
        by_rule.setdefault(finding.rule, []).append(finding)
    for findings in by_rule.values():
        lines += [f"   - {finding.element}: {finding.text}" for finding in findings[:SHOWN]]
        if len(findings) > SHOWN:
            lines.append(f"   - ... and {len(findings) - SHOWN} more of the same kind")
    return "\n".join(lines)


def _problem(path: Path, line: int, found: str, expected: str, repair: str) -> CaseError:
    return CaseError([Problem(str(path), line, "", found, expected, repair)])


def _first_line(error: BaseException) -> str:
    return (str(error).strip().splitlines() or [type(error).__name__])[0]
