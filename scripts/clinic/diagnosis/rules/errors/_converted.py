"""Attributes that MuJoCo says in another way: a sensor's site in the place of its body, a mesh asset for a file."""

from __future__ import annotations

import math
from collections.abc import Iterator

from clinic.diagnosis.edit import Edit, insert, remove_attribute, replace, set_attribute
from clinic.diagnosis.probes.vector import cross, numbers, unit, written
from clinic.diagnosis.reader_model import ReaderModel
from clinic.diagnosis.source import ORIENTATIONS, Element, asset_name, stem

AT_SITE = ("touch", "accelerometer", "velocimeter", "gyro", "force", "torque", "magnetometer", "rangefinder")
FRAMES = {f"frame{each}" for each in ["pos", "quat", "xaxis", "yaxis", "zaxis", "linvel", "angvel", "linacc", "angacc"]}
BETWEEN = {"weld": "body", "connect": "body", "exclude": "body", "pair": "geom"}
Made = tuple[tuple[Edit, ...], str, str]  # edits, the value that is told, a sentence


def converted(model: ReaderModel, element: Element, attribute: str) -> Iterator[Made]:
    """What an attribute that is not known there may become."""
    tag, now = element.tag, element.get(attribute)
    taken = remove_attribute(element, attribute)
    if tag in AT_SITE and attribute in ("body", "geom", "joint", "objname"):
        yield from _at_site(model, element, attribute)
    elif tag in FRAMES and attribute in ("body", "xbody", "geom", "site", "camera"):
        edits = (taken, set_attribute(element, "objtype", attribute), set_attribute(element, "objname", now))
        yield edits, f"objtype={attribute!r} objname={now!r}", f"<{tag}> is of any frame: objtype says of which kind."
    elif tag == "subtreecom" or (tag in BETWEEN and attribute[:-1] in ("geom", "body")):
        kind, number = BETWEEN.get(tag, "body"), attribute[-1] if attribute[-1] in "12" else ""
        for name in _other(model, attribute.rstrip("12"), now, kind):
            value = f"{kind}{number}={name!r}"
            yield (taken, set_attribute(element, f"{kind}{number}", name)), value, f"<{tag}> is about a {kind}."
    elif tag in ("joint", "tendon") and element.parent is not None and element.parent.tag == "equality":
        yield (
            (taken, set_attribute(element, f"{tag}1", now)),
            f"{tag}1={now!r}",
            f"An equation's first {tag} is {tag}1.",
        )
    elif tag == "geom" and attribute in ("file", "filename"):
        yield from _mesh(model, element, attribute)
    elif tag == "geom" and attribute == "scale":
        for mesh in [each for each in _all(model, "mesh") if asset_name(each) == element.get("mesh")]:
            yield (
                (taken, set_attribute(mesh, "scale", now)),
                f"scale={now!r} at the mesh",
                "A scale belongs to the mesh asset.",
            )
    elif tag == "camera" and attribute in ("lookat", "target_pos"):
        yield from _seen(element, attribute)
    elif tag == "geom" and attribute in ("radius", "length"):
        radius, length = numbers(element.get("radius")), numbers(element.get("length"))
        if len(radius) == len(length) == 1:
            size = written([radius[0], length[0] / 2])
            gone = remove_attribute(element, "radius"), remove_attribute(element, "length")
            says = "size has the radius and half of the length."
            yield (*gone, set_attribute(element, "size", size)), f"size={size!r}", says
    elif attribute == "rpy" and not any(element.get(each) for each in ORIENTATIONS):
        yield from _turned(element)
    elif tag == "freejoint":
        text = model.text_of(element)
        whole = text.replace("<freejoint", '<joint type="free"', 1).replace("</freejoint", "</joint")
        yield (replace(element, whole),), '<joint type="free">', "A <freejoint> takes a name, a group and align alone."
    elif tag == "light" and attribute in ("color", "rgba", "rgb"):
        value = " ".join(now.split()[:3])
        yield (
            (taken, set_attribute(element, "diffuse", value)),
            f"diffuse={value!r}",
            "The colour of a light is diffuse.",
        )


def _all(model: ReaderModel, *tags: str) -> list[Element]:
    return list(model.source.elements(*tags)) if model.source else []


def _body_of(model: ReaderModel, kind: str, name: str) -> Element | None:
    """The body that has an element, or is it."""
    there = next((each for each in _all(model, kind) if each.get("name") == name), None)
    around = [there, *there.around()] if there is not None else []
    return next((each for each in around if each.tag == "body"), None)


def _at_site(model: ReaderModel, sensor: Element, attribute: str) -> Iterator[Made]:
    """A site of the body, or a new one at its origin."""
    kind = "body" if attribute == "objname" else attribute
    body = _body_of(model, kind, sensor.get(attribute))
    if body is None:
        return
    taken = remove_attribute(sensor, attribute)
    sites = [each.get("name") for each in body.children if each.tag == "site" and each.get("name")]
    says = f"<{sensor.tag}> is fixed to a site"
    for name in sites[:1]:
        yield (
            (taken, set_attribute(sensor, "site", name)),
            f"site={name!r}",
            f"{says}, as {name!r} of body {body.get('name')!r}.",
        )
    names = {each.get("name") for each in _all(model, "site")}
    name = next(
        each for each in (f"{body.get('name') or 'body'}_site{n or ''}" for n in range(1000)) if each not in names
    )
    edits = (set_attribute(sensor, "site", name), taken, insert(body, f'<site name="{name}"/>'))
    yield edits, f"site={name!r}", f"{says}: one is put into the origin of body {body.get('name')!r}."


def _other(model: ReaderModel, kind: str, name: str, wanted: str) -> Iterator[str]:
    """The body of a geom or site, or the geoms of a body."""
    body = _body_of(model, kind, name)
    if body is not None and wanted == "body":
        yield body.get("name")
    elif body is not None:
        yield from [each.get("name") for each in body.children if each.tag == wanted and each.get("name")][:1]


def _mesh(model: ReaderModel, geom: Element, attribute: str) -> Iterator[Made]:
    """The mesh of a file, with an asset for it where there is none."""
    file = geom.get(attribute)
    name = stem(file)
    edits = [remove_attribute(geom, attribute), set_attribute(geom, "mesh", name), set_attribute(geom, "type", "mesh")]
    root = model.source.root if model.source else geom
    assets = root.first("asset")
    if not any(asset_name(each) == name for each in _all(model, "mesh")):
        mesh = f'<mesh name="{name}" file="{file}"/>'
        edits.append(insert(assets, mesh) if assets else insert(root, f"<asset>{mesh}</asset>"))
    yield (
        tuple(edits),
        f"mesh={name!r}",
        "A file is named once, by a <mesh> of the <asset>, and a geom names that mesh.",
    )


def _turned(element: Element) -> Iterator[Made]:
    """The quaternion of roll, pitch and yaw in rad; of angles beyond a turn, which are in degrees, nothing."""
    angles = numbers(element.get("rpy"))
    if len(angles) == 3 and max(map(abs, angles)) < 2 * math.pi:
        (a, b, c), (x, y, z) = ([half(each / 2) for each in angles] for half in (math.cos, math.sin))
        turn = a * b * c + x * y * z, x * b * c - a * y * z, a * y * c + x * b * z, a * b * z - x * y * c
        edits = remove_attribute(element, "rpy"), set_attribute(element, "quat", written(turn))
        says = "rpy is of URDF, in rad about axes that do not turn with it: this quat is the same turn."
        yield edits, f"quat={written(turn)!r}", says


def _seen(camera: Element, attribute: str) -> Iterator[Made]:
    """The axes of a camera that looks at a point along its negative z axis, with its image's right level."""
    place, point = numbers(camera.get("pos", "0 0 0")), numbers(camera.get(attribute))
    back = [a - b for a, b in zip(place, point, strict=False)]
    if len(back) == 3 and any(back):
        right = (-back[1], back[0], 0.0) if any(back[:2]) else (1.0, 0.0, 0.0)
        value = written([*unit(right), *unit(cross(back, right))])
        edits = (remove_attribute(camera, attribute), set_attribute(camera, "xyaxes", value))
        yield (
            edits,
            f"xyaxes={value!r}",
            "xyaxes are the image's right and up; the camera looks along its negative z axis.",
        )
