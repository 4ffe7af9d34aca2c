"""A joint's limit gives way, or begins to push long before it is reached.

`solreflimit` is how fast a limit pushes back: 0.02 s unless a model says otherwise. With a second, or with a weak
`solimplimit`, the joint goes far past its range. With a `margin` the limit begins to push before it is reached.

Bad:

    <mujoco>
      <worldbody>
        <body pos="0 0 1">
          <joint name="hinge" axis="0 1 0" range="-30 30" solreflimit="1 1"/>
          <geom type="capsule" fromto="0 0 0 0 0 -0.3" size="0.02" mass="0.3"/>
        </body>
      </worldbody>
    </mujoco>

Good:

    <mujoco>
      <worldbody>
        <body pos="0 0 1">
          <joint name="hinge" axis="0 1 0" range="-30 30"/>
          <geom type="capsule" fromto="0 0 0 0 0 -0.3" size="0.02" mass="0.3"/>
        </body>
      </worldbody>
    </mujoco>

The number: how far a joint that moves outwards at 3 rad/s goes past its upper limit (a slide at 0.3 m/s, tenfold),
without gravity, contacts and actuators: more than 0.15 rad, and half of it gone with MuJoCo's own limit. Of a margin,
its share of the range, more than 0.15.

When it is wrong: a joint that ends at something soft.
"""

from __future__ import annotations

from collections.abc import Iterator

from clinic.diagnosis.edit import Edit
from clinic.diagnosis.engine import HINGE, SLIDE
from clinic.diagnosis.probes.servo import alone
from clinic.diagnosis.reader_model import ReaderModel
from clinic.diagnosis.simulation import Simulation
from clinic.diagnosis.suspect import Probe, Suspect

TITLE = "A limit that gives way"
FAMILIES = ("passes-limit", "stuck", "sags")
SINCE = "0.1"
LEVEL = "hint"
UNPLANTED = "how soft a stop is, its maker knows"

USUAL = {"solreflimit": "0.02 1", "solimplimit": "0.9 0.95 0.001"}
SPEED = {HINGE: 3.0, SLIDE: 0.3}  # rad/s, m/s
FAR, HALF, SHARE = 0.15, 0.5, 0.15  # rad; of it; of the range
SECONDS, MOST = 0.5, 60  # s; joints


def suspects(model: ReaderModel) -> Iterator[Suspect]:
    """Joints whose limit is softer than MuJoCo's own, and such as are pushed within their range."""
    of = model.simulation
    limited = [j for j in range(of.count("joint")) if of.joint_type(j) in SPEED and of.model("jnt_limited")[j]]
    soft = [j for j in limited[:MOST] if any(model.value("joint", j, name) for name in USUAL)]
    soft = [j for j in soft if _past(of, j) > FAR]
    edits: tuple[Edit, ...] = tuple(
        edit
        for name, value in USUAL.items()
        if (own := [j for j in soft if model.value("joint", j, name)])
        for edit in model.set("joint", own, name, value)
    )
    probe = Probe("past the limit at 3 rad/s (0.3 m/s, tenfold)", "rad", _farthest, tuple(soft))
    if soft and edits and model.measured(probe, edits) <= HALF * model.measured(probe):
        worst = max(soft, key=lambda joint: _past(of, joint))
        name = next(name for name in USUAL if model.value("joint", worst, name))
        now = model.value("joint", worst, name) or ""
        says = f"{of.name('joint', worst)} goes {_past(of, worst):.2g} rad past its limit before it comes back."
        told = tuple(of.name("joint", joint) for joint in soft)
        yield Suspect(told, name, now, USUAL[name], edits, probe, FAR, says, "next to nothing", share=HALF)
    inside = [joint for joint in limited if _margin(of, joint) > SHARE]
    if inside:
        margin, told = of.model("jnt_margin")[inside[0]], tuple(of.name("joint", joint) for joint in inside)
        probe = Probe("margin of a limit", "of the range", _widest, tuple(inside), dynamic=False)
        says = f"The limit begins to push {margin:.3g} before the end of the range."
        edits = model.set("joint", inside, "margin", "0")
        yield Suspect(told, "margin", f"{margin:g}", "0", edits, probe, SHARE, says, "0, MuJoCo's own")


def _margin(of: Simulation, joint: int) -> float:
    low, high = of.row("jnt_range", joint, 2)
    return of.model("jnt_margin")[joint] / max(high - low, 1e-9)


def _widest(of: Simulation, *joints: int) -> float:
    return max(_margin(of, joint) for joint in joints)


def _farthest(of: Simulation, *joints: int) -> float:
    return max((_past(of, joint) for joint in joints), default=0.0)


def _past(of: Simulation, joint: int) -> float:
    """How far a joint goes past its upper limit in rad, or tenths of a metre."""
    if ("past", joint) not in of.kept:
        with alone(of, limp=True):
            of.kept["past", joint] = _thrown(of, joint)
    return of.kept["past", joint]  # type: ignore[return-value]


def _thrown(of: Simulation, joint: int) -> float:
    kind, high = of.joint_type(joint), of.row("jnt_range", joint, 2)[1]
    of.begin()
    of.engine.write("qpos", [high], int(of.model("jnt_qposadr")[joint]))
    of.engine.write("qvel", [SPEED[kind]], of.dof(joint))
    farthest = 0.0
    for _ in of.run(SECONDS, samples=100):
        if of.unstable():
            return 0.0
        farthest = max(farthest, of.position(joint) - high)
    return farthest * (1 if kind == HINGE else 10)
