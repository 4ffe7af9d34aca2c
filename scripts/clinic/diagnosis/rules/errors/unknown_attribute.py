"""An attribute that this release does not have: misspelt, or removed by an upgrade.

MuJoCo says `Schema violation: unrecognized attribute`. Many models on the web were written for older releases; what
was removed has a replacement, or goes.

Bad:

    <mujoco>
      <option mpr_iterations="50"/>
      <worldbody>
        <geom name="ball" size="0.1" colour="1 0 0 1"/>
      </worldbody>
    </mujoco>

Good:

    <mujoco>
      <option ccd_iterations="50"/>
      <worldbody>
        <geom name="ball" size="0.1" rgba="1 0 0 1"/>
      </worldbody>
    </mujoco>

The number: none; the text compiles with the edit. The new names of `mpr_iterations` and `mpr_tolerance` are from
MuJoCo's changelog; the other names are guessed.

When it is wrong: where no known attribute is like it, it is taken off, and what it was meant to do is lost.
"""

from __future__ import annotations

import re
from collections.abc import Iterator

from clinic.diagnosis.edit import Edit, remove_attribute, set_attribute
from clinic.diagnosis.engine import CompileError
from clinic.diagnosis.reader_model import ReaderModel
from clinic.diagnosis.rules.errors._converted import converted
from clinic.diagnosis.rules.errors._message import meant, mends, nearest, newer, sentence
from clinic.diagnosis.source import Element
from clinic.diagnosis.suspect import Suspect

TITLE = "An unknown or removed attribute"
FAMILIES = ("will-not-compile",)

MESSAGE = re.compile(r"(?:Schema violation: )?unrecognized attribute: '([\w:.-]+)'")
RENAMED = {  # the first two by the changelog
    "mpr_iterations": "ccd_iterations",
    "mpr_tolerance": "ccd_tolerance",
    "colour": "rgba",
    "color": "rgba",
    "stiff": "stiffness",
    "limit": "range",
    "orientation": "quat",
    "rpy": "euler",
    "xyz": "pos",
    "filename": "file",
    "radius": "size",
    "kd": "kv",
    "dof": "type",
}
KNOWN = """name class childclass mocap pos quat axisangle xyaxes zaxis euler gravcomp type group axis springdamper
limited actuatorfrclimited solreflimit solimplimit solreffriction solimpfriction stiffness range actuatorfrcrange margin
ref springref armature damping frictionloss contype conaffinity condim priority size material friction mass density
shellinertia solmix solref solimp gap fromto rgba hfield mesh fitscale fovy ipd resolution pixel focal principal mode
target directional castshadow active attenuation cutoff exponent ambient diffuse specular ctrllimited forcelimited
actlimited ctrlrange forcerange actrange lengthrange gear cranklength joint jointinparent tendon cranksite slidersite
site refsite body kp kv dampratio timeconst inheritrange gainprm biasprm dyntype gaintype biastype dynprm actdim time
qpos qvel act ctrl mpos mquat body1 body2 geom1 geom2 joint1 joint2 tendon1 tendon2 polycoef anchor relpose torquescale
timestep impratio gravity wind magnetic viscosity integrator cone jacobian solver iterations tolerance ls_iterations
noslip_iterations ccd_iterations autolimits boundmass boundinertia settotalmass balanceinertia strippath angle fitaabb
eulerseq meshdir texturedir assetdir discardvisual usethread fusestatic inertiafromgeom file scale builtin texture
texrepeat texuniform width height rgb1 rgb2 markrgb objtype objname reftype refname noise user diaginertia fullinertia
memory njmax nconmax offwidth offheight znear zfar coef width content_type refpos refquat vertex normal face inertia
"""


def suspects(model: ReaderModel) -> Iterator[Suspect]:
    """The attribute under its present name, the nearest known one, or gone."""
    found = MESSAGE.match(sentence(model))
    if not found:
        return
    attribute = found.group(1)
    for element in meant(model):
        if attribute not in element.attributes:
            continue
        if (hint := newer(model, element)) is not None:
            yield hint
            return
        now = element.get(attribute)
        for edits, value, why in converted(model, element, attribute):
            made = model.with_edits(edits)
            if not isinstance(made, CompileError) or made.args != (model.error,):
                says = f"This MuJoCo knows no {attribute!r} at <{element.tag}>. {why}"
                yield mends(element, edits, says, attribute=attribute, now=now, value=value)
                return
        names = [RENAMED[attribute]] if attribute in RENAMED else nearest(attribute, KNOWN.split())
        for name in names:
            edits = _renamed(element, attribute, name)
            if name not in element.attributes and _known(model, element, name) and not _refused(model, edits, name):
                says = f"This MuJoCo knows no {attribute!r} there, but it knows {name!r}."
                yield mends(element, edits, says, attribute=attribute, now=now, value=f"{name}={edits[1].value!r}")
                return
        says = f"This MuJoCo knows no {attribute!r} at <{element.tag}>."
        yield mends(
            element, (remove_attribute(element, attribute),), says, attribute=attribute, now=now, value="left out"
        )
        return


def _renamed(element: Element, attribute: str, name: str) -> tuple[Edit, ...]:
    value = element.get(attribute)
    value += " 1" * (name == "rgba" and len(value.split()) == 3)
    return (remove_attribute(element, attribute), set_attribute(element, name, value))


def _known(model: ReaderModel, element: Element, name: str) -> bool:
    """Whether MuJoCo knows an attribute of this element, which is tried alone."""
    edits = (*(remove_attribute(element, each) for each in element.attributes), set_attribute(element, name, "0"))
    made = model.with_edits(edits)
    return not isinstance(made, CompileError) or f"unrecognized attribute: '{name}'" not in str(made)


def _refused(model: ReaderModel, edits: tuple[Edit, ...], name: str) -> bool:
    """Whether MuJoCo says something against the attribute's new name."""
    made = model.with_edits(edits)
    return isinstance(made, CompileError) and f"'{name}'" in str(made)
