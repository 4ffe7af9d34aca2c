"""The inertia of a body is not that of its geoms.

A placeholder (`diaginertia="0.001 0.001 0.001"` on a finger of 10 g, or on a base of 60 kg), a tensor in g mm2, one
that belongs to another mass. The joint then turns far too easily, and explodes under a servo that the real one bears;
or it is far too sluggish.

Bad:

    <mujoco>
      <worldbody>
        <body name="base" pos="0 0 1">
          <freejoint/>
          <inertial pos="0 0 0" mass="60" diaginertia="0.001 0.001 0.001"/>
          <geom type="box" size="0.2 0.2 0.1"/>
        </body>
      </worldbody>
    </mujoco>

Good:

    -       <inertial pos="0 0 0" mass="60" diaginertia="0.001 0.001 0.001"/>
    +       <inertial pos="0 0 0" mass="60" diaginertia="1 1 1.6"/>

The number: the radius of gyration over that of the geoms, filled evenly: 0.53 to 1.7 for 90 % of 1475 bodies in healthy
models. Suspected are bodies beyond 0.4 or 2.5 whose inertia is the same about all axes, and others beyond 0.25 or 4,
unless more than half of the inertias are suspected. Those that change nothing, massless frames and tips, are told by
the inertia at the joint that turns the body: it must differ 2.5 times; 1.5 times where several bodies have the same,
and 5 times where it is not equal about all axes; and 1.1 times for one that is equal about all axes and whose radius
differs more than 6 times.

What a body has beyond its geoms is not seen where it is less than 25 ms times the damping of that joint: it was added
to steady a finger. Of those that are the same about all axes two are always told: a radius below a thirtieth, which is
as good as a point, and none of the 289 healthy models has; and one beyond 6 of three bodies with the same inertia and
more than 1 % of the model's mass each.

When it is wrong: a body whose geoms are a small part of it, such as the feet of an unseen leg.
"""

from __future__ import annotations

from collections.abc import Iterator

from clinic.diagnosis.probes.inertia import set_inertial
from clinic.diagnosis.probes.matter import ABSURD, explicit, gyration, joint_inertia
from clinic.diagnosis.reader_model import ReaderModel
from clinic.diagnosis.suspect import Suspect

TITLE = "The inertia is not that of the geoms"
FAMILIES = ("explodes", "oscillates", "stuck", "drifts", "wrong-mass", "wrong-numbers")
AFLOAT = True
CASE = "heavy-base-spins"
LEVEL = "hint"

USUAL = (0.4, 2.5)  # radius of gyration over that of the geoms
FAR = (0.25, 4.0)  # the same, for an inertia that is not equal about all axes, which nobody types in
LIMIT, ALIKE = 2.5, 1.5  # times the inertia at the joint; where several bodies have the same inertia
LITTLE, FELT = 1.1, 1.3  # at the joint, of a placeholder with an absurd radius
MANY, LIGHT = 3, 0.01  # bodies with the same absurd inertia; of the model's mass
POINT = 1 / 30  # of the radius of the geoms: no body of a healthy model is so near to a point
FEW = 0.5  # of the inertias: where more are so, the geoms show little of them


def suspects(model: ReaderModel) -> Iterator[Suspect]:
    """Bodies with a radius of gyration beyond their geoms', those with equal inertia together."""
    groups: dict[tuple[float, ...], list[int]] = {}
    found = dict(explicit(model))
    for body, each in sorted(found.items(), key=lambda one: -one[1].mass):
        if not USUAL[0] < each.radius < USUAL[1]:
            groups.setdefault(model.simulation.row("body_inertia", body, 3), []).append(body)
    unusual, distinct = len(groups), len({model.simulation.row("body_inertia", body, 3) for body in found})
    for inertia, bodies in groups.items():
        placeholder = max(inertia) < 1.03 * min(inertia)
        worst = max((found[body] for body in bodies), key=lambda each: max(each.radius, 1 / each.radius))
        if not placeholder and (FAR[0] < worst.radius < FAR[1] or unusual > max(1, FEW * distinct)):
            continue
        probe, limit = joint_inertia(*bodies), 2 * LIMIT
        if placeholder:
            limit = ALIKE if len(bodies) > 1 else LIMIT
            if max(worst.radius, 1 / worst.radius) > ABSURD:
                limit = FELT
            many = len(bodies) >= MANY and found[bodies[0]].mass > LIGHT * sum(each.mass for each in found.values())
            plain = many or all(found[body].radius < POINT for body in bodies)
            if found[bodies[0]].absurd and (plain or LITTLE < model.measured(probe) <= limit):
                probe, limit = gyration(*bodies), ABSURD
        edits = tuple(
            edit
            for body in bodies
            for edit in set_inertial(model, body, found[body].mass, found[body].centre, found[body].solid)
        )
        yield Suspect(
            tuple(model.simulation.name("body", body) for body in bodies),
            "inertial",
            "diaginertia " + " ".join(f"{x:.3g}" for x in inertia),
            "that of the geoms",
            edits,
            probe,
            limit,
            f"The radius of gyration is {worst.radius:.3g} times that of its geoms, filled with {worst.mass:.3g} kg.",
            "0.4 to 2.5 times: 90 % of 1475 bodies in healthy models lie between 0.53 and 1.7",
            excess=max(worst.radius, 1 / worst.radius),
            level="cause" if model.measured(probe) > (limit if placeholder else LIMIT) else "hint",
        )
