"""A mesh, texture or height field whose file or points MuJoCo cannot use.

An STL file is binary and has at most 200,000 faces; COLLADA, glTF and PLY are not read at all. A mesh collides as its
convex hull, which a flat one has not; of a very small one MuJoCo makes no mass.

Bad:

    <mujoco>
      <asset>
        <mesh name="sheet" vertex="0 0 0 1 0 0 0 1 0 1 1 0"/>
      </asset>
      <worldbody>
        <geom name="table" type="mesh" mesh="sheet"/>
      </worldbody>
    </mujoco>

Good:

    <mujoco>
      <worldbody>
        <geom name="table" type="box" size="0.5 0.5 0.001"/>
      </worldbody>
    </mujoco>

The number: none; the model compiles with the edit, which puts a box of 10 mm in the place of a flat mesh, or takes a
`<visual>` of URDF out. Of a file that must be converted or fetched this is a hint that says what the file is.

When it is wrong: the box stands for the mesh's place alone, and its size is a stopgap.
"""

from __future__ import annotations

import posixpath
import re
from collections.abc import Iterator

from clinic.diagnosis.edit import Edit, delete, remove_attribute, replace, set_attribute
from clinic.diagnosis.engine import CompileError
from clinic.diagnosis.reader_model import ReaderModel
from clinic.diagnosis.rules.errors._message import folder_of, meant, mends, sentence
from clinic.diagnosis.rules.errors._remedy import advised
from clinic.diagnosis.rules.errors._scale import scaled_back
from clinic.diagnosis.source import Element, asset_name, stem
from clinic.diagnosis.suspect import Suspect

TITLE = "A mesh or picture that MuJoCo cannot use"
FAMILIES = ("will-not-compile",)
LEVEL = "cause"
UNPLANTED = "the fault is in a file beside the model"

FORMATS = {
    "dae": "COLLADA is not read: save the mesh as OBJ or binary STL, in MeshLab for example.",
    "glb": "glTF is not read: save the mesh as OBJ or binary STL, in Blender for example.",
    "ply": "PLY is not read: save the mesh as OBJ or binary STL.",
    "fbx": "FBX is not read: save the mesh as OBJ or binary STL.",
    "jpg": "Pictures are read as PNG: save it as PNG.",
    "": "The file has no ending, by which MuJoCo knows .stl, .obj and .msh.",
}
FORMATS |= {"gltf": FORMATS["glb"], "jpeg": FORMATS["jpg"], "bmp": FORMATS["jpg"], "tga": FORMATS["jpg"]}
FACES, HEAD = 200_000, 84  # faces, bytes before them
FLAT = "coplanar|volume is too small|at least 4 vertices|surface area is too small|eigenvalue of mesh inertia"
BOX, HALVES = "0.01 0.01 0.01", "0.005 0.005 0.005"  # of 10 mm in URDF, and in MJCF
ANEW = "save it anew, or open it in another program."


def suspects(model: ReaderModel) -> Iterator[Suspect]:
    """What the file is, or something in the place of a mesh without volume."""
    said = sentence(model)
    if model.source is None:
        return
    if "stl_decoder" in said:
        file = next(iter(re.findall(r"'([^']+)'", said)), "")
        yield _of_file(model, file, f"{posixpath.basename(file)}: {_stl(file)}")
    elif re.search(r"no decoder found|unsupported content type|could not find decoder", said):
        yield from _unread(model, said)
    elif (
        found := re.search(r"(?:could not|error|rror) .*?'([^']+)'(.*)", said)
        if re.search(r"_decoder|could not read|hfield missing|MSH|SKN|PNG", said)
        else None
    ):
        says = f"{posixpath.basename(found[1])} is damaged or not what its ending says: {_bytes(found[1])}"
        yield _of_file(model, found[1], says)
    elif re.search(FLAT, said):
        yield from _without_volume(model, said)
    elif "vertex data must be" in said or "vertex index" in said:
        yield from _points(model, said)


def _of_file(model: ReaderModel, file: str, says: str) -> Suspect:
    """A hint at the element that names a file."""
    assert model.source is not None
    base = posixpath.basename(file)
    named = (
        each
        for each in model.source.root.walk()
        if posixpath.basename(each.get("file") or each.get("filename")) == base
    )
    element = next(named, next(iter(meant(model)), None))
    return advised(element, says, "filename" if element and "filename" in element.attributes else "file")


def _read(file: str) -> tuple[bytes, int] | None:
    """A file's first bytes and its length; None where it cannot be read."""
    try:
        with open(file, "rb") as opened:
            head = opened.read(400)
            return head, opened.seek(0, 2)
    except OSError:
        return None


def _bytes(file: str) -> str:
    """What a file is by its first bytes, where that is something else than a mesh or a picture."""
    found = _read(file)
    if found is None:
        return ANEW
    head, size = found
    start = head.lstrip()[:60].lower()
    if not size:
        return "it is empty."
    if start.startswith(b"version https://git-lfs"):
        return "it is the pointer that git leaves where large files were not fetched; `git lfs pull` fetches them."
    if start.startswith((b"<!doctype html", b"<html")):
        return "it is a page of the web; download the raw file in its place."
    return ANEW


def _stl(file: str) -> str:
    """What is wrong with an STL file."""
    found = _read(file)
    if found is None:
        return "it is text, or has too many faces: save it as binary STL or OBJ of at most 200,000 faces."
    head, size = found
    if (other := _bytes(file)) != ANEW:
        return other
    if head.lstrip().startswith(b"solid") and b"facet" in head:
        return "it is STL as text (ASCII), and MuJoCo reads binary STL: save it as binary, or as OBJ."
    if size < HEAD:
        return (
            f"it has {size} bytes, and binary STL has {HEAD} before the first face: it is damaged, or something else."
        )
    faces = int.from_bytes(head[80:84], "little")
    if size == HEAD + 50 * faces and faces > FACES:
        return f"it has {faces:,} faces, and MuJoCo reads at most {FACES:,}: reduce them, or save it as OBJ."
    if size != HEAD + 50 * faces:
        needs = f"{faces:,} faces by its head, which are {HEAD + 50 * faces:,} bytes"
        return f"it has {needs}, and {size:,} bytes: it is cut off, or no binary STL."
    return "save it as binary STL or OBJ of at most 200,000 faces."


def _unread(model: ReaderModel, said: str) -> Iterator[Suspect]:
    """A file of a kind that MuJoCo does not read."""
    for element in meant(model)[:1]:
        file = element.get("file") or element.get("filename") or next(iter(re.findall(r"'([^']+)'", said)), "")
        ending = posixpath.splitext(file)[1].lstrip(".").lower()
        says = FORMATS.get(
            ending, f"MuJoCo does not read {ending} files here: meshes are OBJ, STL or MSH, pictures PNG."
        )
        yield _of_file(model, file, f"{posixpath.basename(file)}: {says}")


def _without_volume(model: ReaderModel, said: str) -> Iterator[Suspect]:
    """A mesh of which no hull or no mass can be made: scaled back, a shell, a box in its place, or left out."""
    assert model.source is not None
    if (back := scaled_back(model))[0] and "vert" not in said:
        for element in meant(model, "mesh")[:1]:
            says = f"{said}. Meshes that are in metres need no scale."
            yield mends(element, back[0], says, attribute="scale", now=back[1], value=back[2])
    if model.urdf:
        yield from _in_urdf(model, said)
        return
    for mesh in meant(model, "mesh")[:1]:
        if not (mesh.get("file") or mesh.get("vertex") or mesh.get("builtin")):
            yield advised(mesh, "A <mesh> names a file, or has vertex: this one has neither.", "file")
            continue
        file = posixpath.join(folder_of(model, mesh), mesh.get("file"))
        if mesh.get("file") and _bytes(file) != ANEW:
            yield advised(mesh, f"{posixpath.basename(file)}: {_bytes(file)}", "file")
            continue
        yield mends(
            mesh,
            (set_attribute(mesh, "inertia", "shell"),),
            f"{said}.",
            attribute="inertia",
            now=mesh.get("inertia", "legacy"),
            value="shell",
        )
        name = asset_name(mesh)
        users = [each for each in model.source.elements("geom", "site") if each.get("mesh") == name]
        instead = "A box of 10 mm stands in its place" if users else "Nothing uses it, and it is taken out"
        says = f"{said}. {instead}."
        edits = [delete(mesh), *(edit for each in users for edit in _box(each))]
        yield mends(mesh, edits, says, attribute="mesh", now=name, value="box" if users else "removed")


def _box(geom: Element) -> Iterator[Edit]:
    yield set_attribute(geom, "type", "box")
    yield set_attribute(geom, "size", HALVES)
    yield from (remove_attribute(geom, name) for name in ("mesh", "fitscale") if name in geom.attributes)


def _in_urdf(model: ReaderModel, said: str) -> Iterator[Suspect]:
    """The collision with this mesh made a small box, and its visual taken out; first each alone."""
    assert model.source is not None
    found = re.search(r"mesh '([^']+)'|too small: (\S+)|Element name '([^']+)'", f"{said} {model.error}")
    name = next(filter(None, found.groups())) if found else ""
    users = [each for each in model.source.elements("mesh") if stem(each.get("filename")) == name]
    shown = [each for each in users if any(outer.tag == "visual" for outer in each.around())]
    hit = [each for each in users if each not in shown]
    visuals = [delete(outer) for each in shown for outer in each.around() if outer.tag == "visual"]
    boxes = [replace(each, f'<box size="{BOX}"/>') for each in hit]
    tail = "A box of 10 mm stands in its place" if hit else "MuJoCo does without what is only seen"
    says = f"{said}. {tail}."
    for edits in dict.fromkeys((tuple(boxes), tuple(boxes + visuals))):
        made = model.with_edits(edits)
        if edits and (not isinstance(made, CompileError) or name not in str(made)):
            yield mends(
                (hit or shown)[0],
                edits,
                says,
                attribute="filename",
                now=users[0].get("filename"),
                value="box" if hit else "removed",
            )


def _points(model: ReaderModel, said: str) -> Iterator[Suspect]:
    """Points and faces that are written in the model: three numbers a point, and points counted from 0."""
    for mesh in meant(model, "mesh")[:1]:
        numbers, faces = mesh.get("vertex").split(), mesh.get("face").split()
        if "vertex data" in said:
            value = " ".join(numbers[: len(numbers) // 3 * 3])
            says = f"{said}: {len(numbers)} numbers are written, and each point has three."
            yield mends(
                mesh,
                (set_attribute(mesh, "vertex", value),),
                says,
                attribute="vertex",
                now=f"{len(numbers)} numbers",
                value=f"{len(value.split())} numbers",
            )
        elif faces and min(map(int, faces)) == 1:
            value = " ".join(str(int(each) - 1) for each in faces)
            says = f"{said}: points are counted from 0, and these from 1 as in OBJ."
            yield mends(
                mesh,
                (set_attribute(mesh, "face", value),),
                says,
                attribute="face",
                now=mesh.get("face")[:40],
                value=value[:40],
            )
        else:
            yield advised(mesh, f"{said}: the mesh has {len(numbers) // 3} points, counted from 0.", "face")
