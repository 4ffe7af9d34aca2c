"""A wheel cannot go on turning: a position servo drives it, it has no joint, or dry friction holds it.

`<position>` stands where `<velocity>` or `<motor>` was meant, and turns the wheel to an angle, where it stops, by its
joint or by the tendon of a differential; or two of four wheels have no joint, and drag; or `frictionloss` is above all
that the ground can turn a wheel with.

Bad:

    <mujoco>
      <compiler angle="radian"/>
      <worldbody>
        <geom type="plane" size="2 2 0.1"/>
        <body name="car" pos="0 0 0.1">
          <freejoint/>
          <geom type="box" size="0.2 0.1 0.03"/>
          <body name="left_wheel" pos="0 0.15 0">
            <joint name="left_wheel" axis="0 1 0"/>
            <geom type="cylinder" size="0.1 0.02" euler="1.5708 0 0"/>
          </body>
          <body name="right_wheel" pos="0 -0.15 0">
            <joint name="right_wheel" axis="0 1 0"/>
            <geom type="cylinder" size="0.1 0.02" euler="1.5708 0 0"/>
          </body>
        </body>
      </worldbody>
      <actuator>
        <position joint="left_wheel" kp="20" kv="2" ctrlrange="-10 10"/>
        <position joint="right_wheel" kp="20" kv="2" ctrlrange="-10 10"/>
      </actuator>
    </mujoco>

Good:

    -     <position joint="left_wheel" kp="20" kv="2" ctrlrange="-10 10"/>
    +     <velocity joint="left_wheel" kv="2" ctrlrange="-10 10"/>
    -     <position joint="right_wheel" kp="20" kv="2" ctrlrange="-10 10"/>
    +     <velocity joint="right_wheel" kv="2" ctrlrange="-10 10"/>

The number: how many wheels of a free base cannot go on turning. A wheel is a body that is called so, or whose hinge is,
with a cylinder, sphere, ellipsoid or mesh that collides; a hinge across the vertical turns it. The ground turns a
wheel with the weight of the whole robot times its radius at the most, at a friction of 1.

When it is wrong: wheels that are blocked on purpose, or turned to an angle that the controller moves on.
"""

from __future__ import annotations

from collections.abc import Iterator

from clinic.diagnosis.engine import CYLINDER, ELLIPSOID, HINGE, MESH, SPHERE
from clinic.diagnosis.probes import tendons
from clinic.diagnosis.probes.servo import servos
from clinic.diagnosis.probes.shape import root_of, solid
from clinic.diagnosis.probes.wheels import is_wheel
from clinic.diagnosis.reader_model import ReaderModel
from clinic.diagnosis.simulation import Simulation
from clinic.diagnosis.suspect import Suspect, how_many

TITLE = "A wheel that cannot go on turning"
FAMILIES = ("stuck", "slow")
AFLOAT = True
UNPLANTED = "only names say what is a wheel"

ROUND, ACROSS = (SPHERE, ELLIPSOID, CYLINDER, MESH), 0.7

BARE, SERVO = "it has no joint, and others have", "a position servo turns it to an angle, where it stops"
FRICTION = "its frictionloss is more than the ground can turn it with: the robot's weight times its radius"
WANTED = {BARE: ("joint", "a hinge"), SERVO: ("actuator", "velocity or motor"), FRICTION: ("frictionloss", "0")}


def suspects(model: ReaderModel) -> Iterator[Suspect]:
    """The wheels that are held, all of one reason together."""
    of = model.simulation
    found = _held(of)
    for reason in dict.fromkeys(found.values()):
        bodies = [body for body, each in found.items() if each == reason]
        joints = [joint for body in bodies for joint in _hinges(of, body)]
        attribute, value = WANTED[reason]
        probe = how_many("wheels that cannot go on turning", _held)
        names = tuple(of.name("joint", joint) for joint in joints) or tuple(of.name("body", body) for body in bodies)
        says = f"{of.name('body', bodies[0])} is a wheel, and {reason}."
        now = f"{_friction(of, bodies[0]):.3g}" if reason == FRICTION else ""
        edits = model.set("joint", joints, "frictionloss", "0") if reason == FRICTION else ()
        healthy = "wheels that turn without an end"
        yield Suspect(names, attribute, now, value, edits, probe, 0, says, healthy, level="hint")


def _held(of: Simulation) -> dict[int, str]:
    """The wheels that cannot go on turning, and why."""
    by_joint = {each.joint for each in servos(of)}
    lines = [line for each, line in tendons.pulled(of).items() if tendons.servo(of, each)]
    by_joint |= {joint for line in lines for joint, _ in tendons.joints_of(of, line)}
    wheels, owner = _wheels(of), root_of(of)
    turning = {owner[body] for body in wheels if _hinges(of, body)}
    made = {}
    for body in wheels:
        hinges = _hinges(of, body)
        if not hinges and owner[body] in turning:
            made[body] = BARE
        elif set(hinges) & by_joint:
            made[body] = SERVO
        elif _friction(of, body) > _traction(of, body):
            made[body] = FRICTION
    return made


def _friction(of: Simulation, body: int) -> float:
    return sum(of.model("dof_frictionloss")[of.dof(joint)] for joint in _hinges(of, body))


def _traction(of: Simulation, body: int) -> float:
    """The torque in N m with which the ground turns a wheel that bears its whole robot, at a friction of 1."""
    radius = max(of.model("geom_rbound")[geom] for geom in of.geoms_of(body))
    return radius * of.model("body_subtreemass")[root_of(of)[body]] * of.gravity


def _wheels(of: Simulation) -> list[int]:
    """The wheels of free bases."""
    owner, free, kinds, names = root_of(of), set(of.free_bodies), of.model("geom_type"), of.names("body")
    made = []
    for body in of.moving_bodies:
        called = [names[body], *(of.names("joint")[joint] for joint in _hinges(of, body))]
        is_round = any(int(kinds[geom]) in ROUND and solid(of, geom) for geom in of.geoms_of(body))
        if owner[body] in free and body not in free and is_round and is_wheel(*called) and not _carried(of, body):
            made.append(body)
    return made


def _carried(of: Simulation, body: int) -> bool:
    """Whether a body without a joint is fixed to one that a hinge without limits turns, as a tyre to its rim."""
    joints = of.joints_of(int(of.model("body_weldid")[body])) if not of.joints_of(body) else []
    return any(map(of.continuous, joints))


def _hinges(of: Simulation, body: int) -> list[int]:
    """The hinges of a body that lie across the vertical at the zero pose, or its other joints that turn it."""
    of.as_written()
    hinges = [joint for joint in of.joints_of(body) if of.joint_type(joint) == HINGE]
    across = [joint for joint in hinges if abs(of.axis(joint)[2]) < ACROSS]
    return across or of.joints_of(body)
