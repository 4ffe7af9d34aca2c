"""A mesh is in another unit than the model around it.

CAD programs write STL files in millimetres, and MuJoCo takes their numbers as metres: a finger of 50 mm is 50 m long.
The robot is inside of it, or it is so large that nothing is seen at all. Scaled twice, it is a speck.

Bad:

    <mujoco>
      <asset>
        <mesh name="finger" vertex="-9 -9 0  9 -9 0  9 9 0  -9 9 0  -9 -9 50  9 -9 50  9 9 50  -9 9 50"/>
      </asset>
      <worldbody>
        <body name="hand" pos="0 0 0.5">
          <freejoint/>
          <geom type="box" size="0.04 0.03 0.02"/>
          <body name="finger" pos="0.04 0 0.02">
            <joint axis="0 1 0"/>
            <geom type="mesh" mesh="finger"/>
          </body>
        </body>
      </worldbody>
    </mujoco>

Good:

    +     <mesh name="finger" scale="0.001 0.001 0.001"
    -     <mesh name="finger" vertex="-9 -9 0  9 -9 0  9 9 0  -9 9 0  -9 -9 50  9 -9 50  9 9 50  -9 9 50"/>
    +       vertex="-9 -9 0  9 -9 0  9 9 0  -9 9 0  -9 -9 50  9 -9 50  9 9 50  -9 9 50"/>

The number: half of the mesh's length over the usual size of the rest: the median of the distances between bodies and
their parents, and of half the lengths of shapes other than meshes. In 215 healthy models with meshes it is 43 at most,
and that of the mesh in the middle 0.07 at least. More than 100 times is told. So is less than a hundredth: of all
meshes where they are under 2 mm, of a single one where it is under 0.6 mm. Where there is nothing else, a mesh of 20 m
is told.

When it is wrong: a planet beside a satellite.
"""

from __future__ import annotations

import re
from collections.abc import Iterator

from clinic.diagnosis.edit import Edit, set_attribute
from clinic.diagnosis.engine import HFIELD, MESH, PLANE
from clinic.diagnosis.probes.vector import norm, written
from clinic.diagnosis.reader_model import ReaderModel
from clinic.diagnosis.simulation import Simulation
from clinic.diagnosis.suspect import Probe, Suspect

TITLE = "A mesh in another unit"
FAMILIES = ("jumps-at-start", "explodes", "wrong-mass", "camera", "stuck")

STAND_IN = re.compile(r"fake|dummy|virtual", re.IGNORECASE)  # a frame of a URDF that must have a shape
TIMES, USUAL = 100.0, 10.0  # the usual size
TINY, SPECK, METRES = 0.001, 0.0003, 10.0  # m, half of a mesh's length


def suspects(model: ReaderModel) -> Iterator[Suspect]:
    """The meshes that are a hundred times as large, or as small, as all else, with the scale of the other unit."""
    of = model.simulation
    sizes, usual = mesh_sizes(of), _usual(of)
    large = [mesh for mesh, size in sizes.items() if size > (TIMES * usual if usual else METRES)]
    small = [mesh for mesh, size in sizes.items() if size < min(usual / TIMES, TINY)]
    if len(small) < len(sizes):  # a screw among links
        small = [mesh for mesh in small if sizes[mesh] < SPECK and 1000 * sizes[mesh] > usual / USUAL]
        small = [mesh for mesh in small if not STAND_IN.search(of.names("mesh")[mesh])]
    for meshes, factor in ((large, 0.001), (small, 1000.0)):
        if not meshes:
            continue
        edits = tuple(edit for mesh in meshes for edit in scaled(model, mesh, factor))
        worst = max(sizes[mesh] for mesh in meshes)
        beside = f"where the rest is of {usual:.3g} m" if usual else "and nothing else is there"
        yield Suspect(
            tuple(of.name("mesh", mesh) for mesh in meshes),
            "scale",
            "",
            edits[0].value if edits else f"{factor:g} times as much",
            edits,
            Probe("size of a mesh, unlike that of the rest by", "times", _times, tuple(meshes), dynamic=False),
            USUAL,
            f"Half its length is {worst:.3g} m, {beside}.",
            "0.07 to 43 times in 215 healthy models",
        )


def mesh_sizes(of: Simulation) -> dict[int, float]:
    """Half the length of every mesh on a body that is not the world, in m."""
    kinds, bodies, meshes = of.model("geom_type"), of.model("geom_bodyid"), of.model("geom_dataid")
    made: dict[int, float] = {}
    for geom, kind in enumerate(kinds):
        if int(kind) == MESH and bodies[geom]:
            made[int(meshes[geom])] = max(of.row("geom_aabb", geom, 6)[3:])
    return made


def _usual(of: Simulation) -> float:
    """The median of the lengths of all that is no mesh, in m; 0 where there is nothing."""
    kinds, bodies = of.model("geom_type"), of.model("geom_bodyid")
    lengths = [norm(of.row("body_pos", body, 3)) for body in range(1, of.count("body")) if of.parent(body)]
    for geom, kind in enumerate(kinds):
        if int(kind) not in (PLANE, HFIELD, MESH) and bodies[geom]:
            lengths.append(of.model("geom_rbound")[geom])
    lengths = sorted(each for each in lengths if each > 0)
    return lengths[len(lengths) // 2] if lengths else 0.0


def _times(of: Simulation, *meshes: int) -> float:
    every, usual = mesh_sizes(of), _usual(of)
    sizes = [every[mesh] for mesh in meshes if mesh in every]  # two of one file and one scale become one
    if not usual:
        return max((USUAL / METRES * size for size in sizes), default=0.0)
    return max((max(size / usual, usual / size) for size in sizes), default=0.0)


def scaled(model: ReaderModel, mesh: int, factor: float) -> Iterator[Edit]:
    """The edits that make a mesh `factor` times as large, wherever it is written: as an asset, or in a URDF by file.

    In a URDF one file may be there at several scales, of which MuJoCo makes as many meshes: `finger`, `finger1`.
    """
    name, source = model.simulation.engine.name("mesh", mesh), model.source
    compiled = model.simulation.row("mesh_scale", mesh, 3)
    for element in source.elements("mesh") if source else ():
        assert source is not None
        scale = tuple(float(each) for each in (source.value(element, "scale") or "1 1 1").split())
        if file := element.get("filename"):
            meant = scale == compiled and _stem(file) in (name, name.rstrip("0123456789"))
        else:
            meant = name == (element.get("name") or _stem(element.get("file")))
        if meant:
            yield set_attribute(element, "scale", written([factor * each for each in scale]))


def _stem(path: str) -> str:
    return path.replace("\\", "/").rpartition("/")[2].rpartition(".")[0]
