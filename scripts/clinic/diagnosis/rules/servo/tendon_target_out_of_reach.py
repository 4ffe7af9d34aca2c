"""A servo on a tendon is told lengths that the tendon cannot have.

The control of a position servo on a tendon is a length in m, or for a fixed tendon the sum of the coefficients times
the joints. A control range of 0 to 255 from the gripper's protocol, an angle, or a way from the start in place of the
length, sends it to an end and leaves it there.

Bad:

    <mujoco>
      <option integrator="implicitfast"/>
      <worldbody>
        <body pos="0 0 1">
          <geom type="box" size="0.05 0.05 0.02"/>
          <body pos="0 0.02 0.05">
            <joint name="left" type="slide" axis="0 1 0" range="0 0.04" damping="5"/>
            <geom type="box" size="0.01 0.005 0.02"/>
          </body>
          <body pos="0 -0.02 0.05">
            <joint name="right" type="slide" axis="0 -1 0" range="0 0.04" damping="5"/>
            <geom type="box" size="0.01 0.005 0.02"/>
          </body>
        </body>
      </worldbody>
      <tendon>
        <fixed name="split">
          <joint joint="left" coef="0.5"/>
          <joint joint="right" coef="0.5"/>
        </fixed>
      </tendon>
      <actuator>
        <position tendon="split" kp="100" kv="5" ctrlrange="0 255"/>
      </actuator>
    </mujoco>

Good:

    <mujoco>
      <option integrator="implicitfast"/>
      <worldbody>
        <body pos="0 0 1">
          <geom type="box" size="0.05 0.05 0.02"/>
          <body pos="0 0.02 0.05">
            <joint name="left" type="slide" axis="0 1 0" range="0 0.04" damping="5"/>
            <geom type="box" size="0.01 0.005 0.02"/>
          </body>
          <body pos="0 -0.02 0.05">
            <joint name="right" type="slide" axis="0 -1 0" range="0 0.04" damping="5"/>
            <geom type="box" size="0.01 0.005 0.02"/>
          </body>
        </body>
      </worldbody>
      <tendon>
        <fixed name="split">
          <joint joint="left" coef="0.5"/>
          <joint joint="right" coef="0.5"/>
        </fixed>
      </tendon>
      <actuator>
        <position tendon="split" kp="100" kv="5" ctrlrange="0 0.04"/>
      </actuator>
    </mujoco>

The number: the share of the targets that the tendon cannot reach while its joints are within their ranges; more than
two thirds. Of a spatial tendon the reach is that of 64 poses, and a fifth more at each end.

When it is wrong: targets beyond the reach as a way to command a force.
"""

from __future__ import annotations

from collections.abc import Iterator

from clinic.diagnosis.engine import HINGE, SLIDE
from clinic.diagnosis.probes.servo import AFFINE, FIXED, INTEGRATOR, USER
from clinic.diagnosis.reader_model import ReaderModel
from clinic.diagnosis.simulation import Simulation
from clinic.diagnosis.suspect import Probe, Suspect

TITLE = "A servo whose tendon cannot be as long as it is told"
FAMILIES = ("stuck", "passes-limit", "jumps-at-start")
SINCE = "0.1"
LEVEL = "hint"
UNPLANTED = "few healthy models have servos on tendons"

TENDON, JOINT_WRAP = 3, 1  # mjtTrn; mjtWrap
MOST, POSES, SPARE = 2 / 3, 64, 0.2
GOLDEN = 0.6180339887


def suspects(model: ReaderModel) -> Iterator[Suspect]:
    """Servos on tendons that are mostly told what cannot be, each by itself."""
    of = model.simulation
    for each in range(of.count("actuator")):
        if _beyond(of, each) <= MOST:
            continue
        targets, reach = _targets(of, each), _reach(of, int(of.model("actuator_trnid")[2 * each]))
        assert targets is not None
        assert reach is not None
        (low, high), (least, most) = targets, reach
        ctrl = of.row("actuator_ctrlrange", each, 2)
        scale = (high - low) / (ctrl[1] - ctrl[0]) * (1 if _scale(of, each) > 0 else -1)
        ends = sorted(ctrl[0] + (x - (low if scale > 0 else high)) / scale for x in reach)
        value = " ".join(f"{x + 0.0:.4g}" for x in ends)
        tendon = of.name("tendon", int(of.model("actuator_trnid")[2 * each]))
        yield Suspect(
            (of.name("actuator", each), tendon),
            "ctrlrange",
            " ".join(f"{x:g}" for x in ctrl),
            value,
            model.set("actuator", [each], "ctrlrange", value),
            Probe("share of a servo's targets that its tendon cannot reach", "", _beyond, (each,), dynamic=False),
            MOST,
            f"Targets from {low:.3g} to {high:.3g} for {tendon}, whose length goes from {least:.3g} to {most:.3g}.",
            "lengths that the tendon can have",
        )


def _beyond(of: Simulation, actuator: int) -> float:
    targets = _targets(of, actuator)
    reach = _reach(of, int(of.model("actuator_trnid")[2 * actuator])) if targets else None
    if targets is None or reach is None or targets[1] <= targets[0] or reach[1] <= reach[0]:
        return 0.0
    within = min(targets[1], reach[1]) - max(targets[0], reach[0])
    return 1.0 - max(0.0, within) / (targets[1] - targets[0])


def _scale(of: Simulation, actuator: int) -> float:
    """How far a unit of control moves the target."""
    gain, bias, gear = _numbers(of, actuator)
    return gain / (-bias[1] * gear)


def _numbers(of: Simulation, actuator: int) -> tuple[float, tuple[float, ...], float]:
    """Gain, bias and gear."""
    return of.gain(actuator)[0], of.bias(actuator), of.row("actuator_gear", actuator, 6)[0]


def _targets(of: Simulation, actuator: int) -> tuple[float, float] | None:
    """The lengths that a servo on a tendon is told over its control range; None for another actuator."""
    kinds = [int(of.model(f"actuator_{kind}type")[actuator]) for kind in ("trn", "gain", "bias", "dyn")]
    gain, bias, gear = _numbers(of, actuator)
    servo = kinds[:3] == [TENDON, FIXED, AFFINE] and kinds[3] not in (INTEGRATOR, USER)
    if not servo or not of.model("actuator_ctrllimited")[actuator] or bias[1] >= 0 or not gain * gear:
        return None
    ends = [(gain * ctrl + bias[0]) / (-bias[1] * gear) for ctrl in of.row("actuator_ctrlrange", actuator, 2)]
    return min(ends), max(ends)


def _reach(of: Simulation, tendon: int) -> tuple[float, float] | None:
    """The least and the most of a tendon's length over its joints' ranges; None where a joint has no range."""
    first, number = int(of.model("tendon_adr")[tendon]), int(of.model("tendon_num")[tendon])
    wraps = range(first, first + number)
    if int(of.model("wrap_type")[first]) != JOINT_WRAP:
        return _sampled(of, tendon)
    least = most = 0.0
    for each in wraps:
        joint, coefficient = int(of.model("wrap_objid")[each]), of.model("wrap_prm")[each]
        if not of.model("jnt_limited")[joint]:
            return None
        ends = [coefficient * x for x in of.row("jnt_range", joint, 2)]
        least, most = least + min(ends), most + max(ends)
    return least, most


def _sampled(of: Simulation, tendon: int) -> tuple[float, float] | None:
    """The same of a spatial tendon, in poses between the ends of all ranges; None where a hinge has none."""
    key = ("reach", tendon)
    if key not in of.kept:
        kinds = [of.joint_type(joint) for joint in range(of.count("joint"))]
        joints = [joint for joint, kind in enumerate(kinds) if kind in (HINGE, SLIDE)]
        limited = all(of.model("jnt_limited")[joint] for joint in joints)
        lengths = []
        for pose in range(POSES if limited and joints else 0):
            of.begin(forward=False)
            for place, joint in enumerate(joints):
                share = (0.5 + pose * (place + 1) * GOLDEN) % 1.0
                share = (pose >> place % 6) % 2 if pose % 3 == 0 else share
                low, high = of.row("jnt_range", joint, 2)
                of.engine.write("qpos", [low + share * (high - low)], int(of.model("jnt_qposadr")[joint]))
            of.engine.forward()
            lengths.append(of.data("ten_length")[tendon])
        spare = SPARE * (max(lengths) - min(lengths)) if lengths else 0.0
        of.kept[key] = (min(lengths) - spare, max(lengths) + spare) if lengths else None
    return of.kept[key]  # type: ignore[return-value]
