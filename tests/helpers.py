"""A tiny case, and small models with known answers, for the tests of single modules."""

from __future__ import annotations

import io
import math
from collections.abc import Iterable
from pathlib import Path
from typing import Any

import av
import mujoco
import numpy as np
import pytest
from clinic.engine.checks import TAKES, Trace, take
from clinic.pages.case_page import case_page
from clinic.proof.evidence import Evidence, Samples, VariantEvidence
from clinic.proof.model_problems import check_against_model
from clinic.record.case import Case, load_case
from clinic.record.problem import CaseError, Problem

GRAVITY = 9.81
SLUG = "falling-box"

MODEL = """\
<mujoco>
  <option timestep="0.002"/>
  <worldbody>
    <camera name="side" pos="0 -2 0.2" xyaxes="1 0 0 0 0 1"/>
    <geom name="floor" type="plane" size="1 1 0.1" contype="2" conaffinity="2"/>
    <body name="box" pos="0 0 0.06">
      <freejoint name="free"/>
      <geom name="box" type="box" size="0.05 0.05 0.05" mass="1"/>
    </body>
  </worldbody>
</mujoco>
"""

RECORD = """\
number: 1
title: A box falls through the floor
model: model.xml
symptom: It falls to {{ broken.height.final }}.
diagnosis: There are {{ broken.contacts.max }} contacts.
cause: The masks share no bit.
fix: Share a bit.
lesson: Look at the masks.
tags: [contact]
phrases: [box falls through floor]
run: {duration: 0.4}
signals:
  height: {path: "body(box).xpos[2]", unit: m, label: height of the box}
  contacts: {path: ncon}
checks:
  broken:
    - {signal: contacts, take: max, equals: 0}
  fixed:
    - {signal: height, between: [0.045, 0.051]}
fixes:
  - id: share-a-bit
    title: Remove the masks of the floor
    edits:
      - {find: ' contype="2" conaffinity="2"', replace: ''}
refuted:
  - id: small-step
    title: Halve the timestep
    edits:
      - {find: 'timestep="0.002"', replace: 'timestep="0.001"'}
    why: It still falls to {{ small-step.height.final }}.
no_sweep: The masks are not a number.
film: {}
picture: {camera: side}
"""

SWEEP = """\
sweep:
  fall:
    title: Gravity and the fall
    text: At {{ sweep.fall.points }} points.
    vary:
      - {name: g, find: '<option timestep="0.002"/>', replace: '<option timestep="0.002" gravity="0 0 -{}"/>',
         values: [1, 2, 4, 8], unit: m/s²}
    outcome: {signal: height}
    prediction:
      {label: "semi-implicit, a step behind", expr: 0.06 - g * 0.4 * 0.398 / 2, within: 1.0e-9, relative: false}
    rivals:
      - {id: textbook, label: half g t squared, expr: 0.06 - g * 0.4 ** 2 / 2, within: 0.005, relative: false}
"""
"""How far the box falls in 0.4 s."""

SCRIPT = """\
print("first error = 0.25")
print("error = 0.5")
"""

SCRIPT_RECORD = """\
number: 2
title: A script prints an error
script: script.py
symptom: It prints {{ broken.error.final }}.
diagnosis: Read it.
cause: It says so.
fix: Write another number.
lesson: Read the output.
tags: [code]
phrases: [script prints wrong value]
signals:
  error: {path: printed(error), unit: m}
checks:
  broken:
    - {signal: error, above: 0.1}
  fixed:
    - {signal: error, equals: 0}
fixes:
  - id: no-error
    title: Print no error
    edits:
      - {find: '0.5', replace: '0.0'}
no_sweep: There is nothing to vary.
picture: {camera: side}
"""

BALL = """\
<mujoco>
  <option timestep="0.001"/>
  <worldbody>
    <body name="ball" pos="0 0 1">
      <freejoint name="free"/>
      <geom name="ball" size="0.1" mass="2"/>
    </body>
  </worldbody>
</mujoco>
"""
"""A ball in free fall."""

PENDULUM = """\
<mujoco>
  <option timestep="0.001"/>
  <worldbody>
    <camera name="front" pos="0 -3 0" xyaxes="1 0 0 0 0 1"/>
    <body name="rod">
      <joint name="hinge" type="hinge" axis="0 1 0" range="-90 45"/>
      <geom name="bob" pos="0.5 0 0" size="0.1" mass="2" friction="0.7"/>
      <site name="tip" pos="0.5 0 0"/>
    </body>
  </worldbody>
  <actuator>
    <motor name="motor" joint="hinge" gear="3"/>
  </actuator>
  <sensor>
    <jointpos name="angle" joint="hinge"/>
    <framepos name="where" objtype="site" objname="tip"/>
  </sensor>
  <keyframe>
    <key name="hanging" qpos="1.5707963267948966" ctrl="2"/>
  </keyframe>
</mujoco>
"""
"""A bob of 2 kg at 0.5 m from a hinge, held horizontal at qpos0: gravity's torque is -m g l about the hinge's axis."""

RESTING = """\
<mujoco>
  <worldbody>
    <geom name="floor" type="plane" size="1 1 0.1" friction="0.3 0.02 0.0003"/>
    <body name="box" pos="0 0 0.0499">
      <freejoint/>
      <geom name="box" type="box" size="0.05 0.05 0.05" mass="3" friction="0.9 0.01 0.0001"/>
    </body>
    <body name="other" pos="0 0 1" gravcomp="1">
      <freejoint/>
      <geom name="other" size="0.05" mass="1"/>
    </body>
  </worldbody>
</mujoco>
"""
"""A box of 3 kg on a plane, on its four corners, and a weightless ball that touches nothing."""


def compiled(xml: str) -> tuple[mujoco.MjModel, mujoco.MjData]:
    """The model and its data, with everything derived from the start up to date."""
    model = mujoco.MjModel.from_xml_string(xml)
    data = mujoco.MjData(model)
    mujoco.mj_forward(model, data)
    return model, data


def changed(text: str, *changes: tuple[str, str]) -> str:
    """The text after replacements, each of which must match exactly once."""
    for old, new in changes:
        assert text.count(old) == 1, f"{old!r} occurs {text.count(old)} times"
        text = text.replace(old, new)
    return text


def write_case(
    root: Path, *changes: tuple[str, str], slug: str = SLUG, record: str = RECORD, model: str = MODEL
) -> Path:
    """Writes the tiny case with changes to its record below `root`/cases and gives its folder."""
    return write_folder(root, slug, {"case.yaml": changed(record, *changes), "model.xml": model})


def write_script_case(root: Path, *changes: tuple[str, str], slug: str = "odd-script", script: str = SCRIPT) -> Path:
    """Writes the tiny case whose bug is in a script."""
    return write_folder(root, slug, {"case.yaml": changed(SCRIPT_RECORD, *changes), "script.py": script})


def write_folder(root: Path, slug: str, files: dict[str, str]) -> Path:
    """Writes files into `root`/cases/`slug`."""
    folder = root / "cases" / slug
    folder.mkdir(parents=True)
    for name, text in files.items():
        (folder / name).write_text(text, encoding="utf-8")
    return folder


def tiny_case(root: Path, *changes: tuple[str, str], model: str = MODEL) -> Case:
    """The tiny case, read."""
    return load_case(write_case(root, *changes, model=model))


def script_case(root: Path, *changes: tuple[str, str], script: str = SCRIPT) -> Case:
    """The tiny script case, read."""
    return load_case(write_script_case(root, *changes, script=script))


def variant_evidence(kind: Any = "broken", **signals: list[float | None]) -> VariantEvidence:
    """What a variant showed whose signals had these samples, 1 s apart; `angle_rad` is the signal `angle` in rad."""
    traces, values = {}, {}
    for key, samples in signals.items():
        name, _, unit = key.partition("_")
        trace = Trace(np.arange(1.0, len(samples) + 1), np.array(samples, dtype=float))
        traces[name] = Samples(unit=unit, time=trace.time.tolist(), value=samples)
        taken = {which: take(trace, which) for which in TAKES}
        values[name] = {which: None if math.isnan(number) else number for which, number in taken.items()}
    common: dict[str, Any] = {"title": "", "edits": [], "timestep": 1.0, "steps": max(map(len, signals.values()))}
    return VariantEvidence(kind=kind, checks={"broken": [], "fixed": []}, values=values, traces=traces, **common)


def evidence_of_variants(**variants: VariantEvidence) -> Evidence:
    """Evidence of these variants; `_` in a name stands for `-`."""
    named = {name.replace("_", "-"): variant for name, variant in variants.items()}
    return Evidence(case=SLUG, number=1, engine="4.0.0", snippet=None, variants=named)


def page_of(case: Case, evidence: Evidence, files: dict[str, bytes] | None = None, *others: Case) -> str:
    """The Markdown of a case's page, with nothing told of its family."""
    return case_page(case, evidence, files or {}, {other.slug: other for other in others}, None)


def only_problem(folder: Path) -> Problem:
    """The only problem of a case that is read, compiled and bound."""
    with pytest.raises(CaseError) as caught:
        check_against_model(load_case(folder))
    (found,) = caught.value.problems
    return found


def told(problems: Iterable[Problem]) -> list[str]:
    """Every problem as `line: field | found | expected | repair`, that of another file with its name before it."""
    return [
        f"{p.file.removeprefix('cases/falling-box/case.yaml')}"
        f"{p.line}: {p.where} | {p.found} | {p.expected} | {p.repair}"
        for p in sorted(problems)
    ]


def refused(folder: Path) -> list[str]:
    """The problems of a case that is not read."""
    with pytest.raises(CaseError) as caught:
        load_case(folder)
    return told(caught.value.problems)


def decoded(content: bytes) -> list[np.ndarray]:
    """The images of a film, shape (height, width, 3) each."""
    with av.open(io.BytesIO(content)) as container:
        return [frame.to_ndarray(format="rgb24") for frame in container.decode(video=0)]
