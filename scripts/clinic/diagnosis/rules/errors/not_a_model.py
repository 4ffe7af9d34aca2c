"""The file is no model: a package's description, a page of the web, a world of Gazebo, or xacro that is not expanded.

MuJoCo reads MJCF, whose first element is `<mujoco>`, and URDF, whose first element is `<robot>`.

Bad:

    <package>
      <name>arm</name>
    </package>

Good:

    <mujoco>
      <worldbody>
        <geom name="ball" size="0.1"/>
      </worldbody>
    </mujoco>

The number: none; a part of a model, such as a `<body>`, gets the elements that belong around it. Of all else this is a
hint that says what the file is.

When it is wrong: the name of the first element is all that is looked at.
"""

from __future__ import annotations

import re
from collections.abc import Iterator

from clinic.diagnosis.edit import replace
from clinic.diagnosis.reader_model import ReaderModel
from clinic.diagnosis.rules.errors._message import mends
from clinic.diagnosis.rules.errors._remedy import advised
from clinic.diagnosis.suspect import Suspect

TITLE = "The file is no model"
FAMILIES = ("will-not-compile",)
LEVEL = "cause"
UNPLANTED = "a healthy model is a model"

ROOTS = {
    "package": "This is a package.xml, which describes a ROS package; its models lie in its folders urdf or xml.",
    "sdf": "This is SDF, of Gazebo: MuJoCo reads MJCF and URDF; sdf2mjcf of gz-mujoco converts it.",
    "world": "This is a world of Gazebo, or MJCF that lacks its <mujoco> and <worldbody>.",
    "gazebo": "This is an extension for Gazebo; the model is the <robot> that includes it.",
    "launch": "This is a launch file of ROS, which names the model that it loads.",
    "html": "This is a page of the web: download the raw file in its place.",
    "svg": "This is a picture.",
    "COLLADA": "This is a mesh: MuJoCo reads meshes as STL, OBJ or MSH, and names them in the <asset> of a model.",
}
SAID = {
    "git-lfs": "This is the pointer that git leaves where large files were not fetched: `git lfs pull` fetches it.",
    "<html": "This is a page of the web: download the raw file in its place.",
    "<!doctype html": "This is a page of the web: download the raw file in its place.",
}
WHOLE = ("worldbody", "asset", "default", "option", "compiler", "actuator", "sensor", "tendon", "equality", "contact")
INSIDE = ("body", "geom", "site", "camera", "light", "frame", "composite", "flexcomp", "replicate")


def suspects(model: ReaderModel) -> Iterator[Suspect]:
    """What the file is; a part of a model, made a whole one."""
    text = next(iter(model.texts.values()))
    if model.source is None:
        if says := _of_text(text):
            yield advised(None, says)
        return
    root = model.source.root
    if model.urdf or root.tag == "mujoco":
        if "xacro" in root.attributes.get("xmlns:xacro", "") or _unexpanded(text):
            says = (
                "This is xacro that is not expanded: `xacro model.urdf.xacro > model.urdf` of ROS makes the URDF of it."
            )
            yield from [advised(root, says)] if _unexpanded(text) else []
        return
    if "model type" not in model.error and "unrecognized element" not in model.error:
        return
    xml = model.text_of(root)
    if root.tag.lower() in ("mujoco", "mjcf", "mujocoinclude", "mujocomodel", "model"):
        inner = re.sub(rf"^<{re.escape(root.tag)}\b", "<mujoco", re.sub(r"</[\w:]+\s*>$", "</mujoco>", xml))
        says = f"MJCF begins with <mujoco>, and not with <{root.tag}>."
        yield mends(root, (replace(root, inner),), says, value="<mujoco>")
    elif root.tag in WHOLE:
        yield mends(root, (replace(root, f"<mujoco>{xml}</mujoco>"),), "MJCF begins with <mujoco>.", value="<mujoco>")
    elif root.tag in INSIDE:
        whole = f"<mujoco><worldbody>{xml}</worldbody></mujoco>"
        says = f"A <{root.tag}> belongs into the <worldbody> of a <mujoco>."
        yield mends(root, (replace(root, whole),), says, value="<mujoco><worldbody>")
    else:
        says = f"MuJoCo reads MJCF (<mujoco>) and URDF (<robot>), and this is <{root.tag}>."
        yield advised(root, " ".join(filter(None, (says, ROOTS.get(root.tag, "")))))


def _of_text(text: str) -> str:
    """What a text that is no XML is; nothing where it looks like XML."""
    if not text.strip():
        return "The file is empty."
    head = text.lstrip("\ufeff \t\r\n")[:300].lower()
    known = next((says for word, says in SAID.items() if word in head), "")
    return known or ("" if head.startswith("<") else "This is not XML, which begins with <mujoco> or <robot>.")


def _unexpanded(text: str) -> bool:
    """Whether something of xacro is left."""
    return bool(re.search(r"<xacro:|=\s*[\"'][^\"']*\$\{", text))
