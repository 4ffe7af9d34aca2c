"""A link has the mesh of another link.

A block was copied, and its mesh was not adapted: the link touches, or is seen, where another link's shape would be. All
other links have the mesh of their own name, so does the link itself in its other geoms, or the mesh of its name is
there and nothing uses it.

Bad:

    <mujoco>
      <asset>
        <mesh name="link1" vertex="-0.02 0 0  0.02 0 0  0 0.02 0  0 0 0.2"/>
        <mesh name="link2" vertex="-0.03 0 0  0.03 0 0  0 0.02 0  0 0 0.2"/>
        <mesh name="link3" vertex="-0.02 0 0  0.02 0 0  0 0.03 0  0 0 0.1"/>
        <mesh name="link4" vertex="-0.01 0 0  0.01 0 0  0 0.02 0  0 0 0.1"/>
      </asset>
      <worldbody>
        <body name="link1" pos="0 0 1">
          <joint axis="0 1 0"/>
          <geom type="mesh" mesh="link1"/>
          <body name="link2" pos="0 0 0.2">
            <joint axis="0 1 0"/>
            <geom type="mesh" mesh="link2"/>
            <body name="link3" pos="0 0 0.2">
              <joint axis="0 1 0"/>
              <geom type="mesh" mesh="link2"/>
              <body name="link4" pos="0 0 0.1">
                <joint axis="0 1 0"/>
                <geom type="mesh" mesh="link4"/>
              </body>
            </body>
          </body>
        </body>
      </worldbody>
    </mujoco>

Good:

    -           <geom type="mesh" mesh="link2"/>
    +           <geom type="mesh" mesh="link3"/>

The number: the links whose mesh is called after another link, that has it too, where three and more have one called
after themselves in the same way; one is told, two are a habit; of 260 healthy models none has one.

When it is wrong: two links of one shape, of which one was drawn twice.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterator
from typing import NamedTuple

from clinic.diagnosis.edit import set_attribute
from clinic.diagnosis.reader_model import ReaderModel
from clinic.diagnosis.source import Element, Source, asset_name, stem
from clinic.diagnosis.suspect import Suspect, counted

TITLE = "The mesh of another link"
FAMILIES = ("wrong-numbers", "jumps-at-start", "stuck")
UNPLANTED = "what a mesh is called after, only names tell"

MANY = 3


class Use(NamedTuple):
    """A mesh in a link: for what (`collision`, or a class), where it is named, and after which link it is called.

    `form` is the mesh's name without that of the link: `*_visual`.
    """

    link: str
    role: str
    element: Element
    mesh: str
    after: str
    form: str


def suspects(model: ReaderModel) -> Iterator[Suspect]:
    """The one link of a model whose mesh is called after another."""
    source = model.source
    uses = _uses(source) if source is not None else []
    own = {(use.link, use.role, use.form) for use in uses if use.after == use.link}
    many = Counter((role, form) for _, role, form in own)
    found = [
        use
        for use in uses
        if use.after != use.link
        and many[use.role, use.form] >= MANY
        and (use.after, use.role, use.form) in own
        and (use.link, use.role, use.form) not in own
    ]
    if len(found) != 1 or source is None:
        return
    (use,) = found
    right = use.form.replace("*", use.link)
    free = right in {asset_name(each) for each in source.elements("mesh")} - {each.mesh for each in uses}
    if not free and all(link != use.link for link, _, _ in own):
        return
    attribute = "filename" if source.urdf else "mesh"
    before, _, behind = use.element.get(attribute).rpartition(use.mesh)
    value = f"{before}{right}{behind}"
    says = f"It is called after {use.after}; {many[use.role, use.form]} other links have one called after themselves."
    names, edits = (f'body "{use.link}"',), (set_attribute(use.element, attribute, value),)
    probe = counted("links with the mesh of another", 1)
    yield Suspect(names, "mesh", use.mesh, right, edits, probe, 0, says, right, at=use.element)


def _uses(source: Source) -> list[Use]:
    """The meshes of all links that are called after one of them."""
    written = [(each.get("name"), *use) for each in source.elements("body", "link") for use in _meshes(source, each)]
    links = sorted({link for link, *_ in written if link}, key=len, reverse=True)
    made = []
    for link, role, element, mesh in written:
        if after := next((each for each in links if each in mesh), ""):
            made.append(Use(link, role, element, mesh, after, mesh.replace(after, "*", 1)))
    return made


def _meshes(source: Source, link: Element) -> Iterator[tuple[str, Element, str]]:
    """For what a link has a mesh, the element that names it, and its name."""
    if source.urdf:
        for shape in (each for each in link.children if each.tag in ("visual", "collision")):
            yield from ((shape.tag, each, stem(each.get("filename"))) for each in shape.walk() if each.tag == "mesh")
    for geom in (each for each in source.direct(link, "geom") if each.get("mesh")):
        yield geom.get("class"), geom, geom.get("mesh")
