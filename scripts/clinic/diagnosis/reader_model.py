"""A reader's model: its source beside what was compiled of it, and every edited copy that was tried."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence

from clinic.diagnosis.edit import Edit, apply, insert, remove_attribute, set_attribute
from clinic.diagnosis.engine import CompileError, Engine
from clinic.diagnosis.probes.vector import written
from clinic.diagnosis.simulation import Simulation
from clinic.diagnosis.source import REPEATING, Element, Source
from clinic.diagnosis.start import Start
from clinic.diagnosis.suspect import Probe

OF_ROBOT = {"body": "link", "joint": "joint"}
TAGS = {  # how the elements of a kind are written
    "joint": ("joint", "freejoint"),
    "geom": ("geom",),
    "site": ("site",),
    "camera": ("camera",),
    "light": ("light",),
}
URDF = {
    "range": ("limit", "lower", "upper"),
    "damping": ("dynamics", "damping"),
    "frictionloss": ("dynamics", "friction"),
    "axis": ("axis", "xyz"),
    "origin": ("origin", "xyz"),
}
AFLOAT = (
    """<link name="world"/><joint name="afloat" type="floating"><parent link="world"/><child link="{root}"/></joint>"""
)
UNFUSED = {
    "fusestatic": "false",
    "boundmass": "1e-9",
    "boundinertia": "1e-15",
    "inertiagrouprange": "0 0",
}
SECTION = {"actuator": "actuator", "sensor": "sensor", "equality": "equality", "tendon": "tendon", "key": "keyframe"}


class ReaderModel:
    """The model under diagnosis.

    Attributes:
        source: Its text with places; None where it is not well-formed XML.
        error: What the engine says when it does not compile; empty when it does.
        simulation: The compiled model as it is; only where `error` is empty.
        symptom: The family of symptoms that the reader sees: what explains it is told from smaller numbers on.

    Raises:
        StartError: If the model does not have the start.
    """

    def __init__(
        self, engine: Engine, texts: dict[str, str], source: Source | None, start: Start, symptom: str = ""
    ) -> None:
        self.engine, self.texts, self.source, self.start, self.symptom = engine, texts, source, start, symptom
        self._compiled: dict[tuple[Edit, ...], Simulation | CompileError] = {}
        self._measured: dict[tuple[object, ...], float] = {}
        found = self.with_edits(())
        self.error = str(found) if isinstance(found, CompileError) else ""
        if isinstance(found, Simulation):
            self.start = found.begin_from(start)
        self._elements: dict[str, list[Element | None]] = {}

    @property
    def simulation(self) -> Simulation:
        """The compiled model as it is."""
        found = self.with_edits(())
        assert isinstance(found, Simulation)
        return found

    @property
    def urdf(self) -> bool:
        """Whether the text is URDF."""
        return self.source is not None and self.source.urdf

    def with_edits(self, edits: Sequence[Edit]) -> Simulation | CompileError:
        """The model after edits of its text, compiled anew, or what the engine says against it."""
        key = tuple(edits)
        if key not in self._compiled:
            texts = apply(self.texts, key)
            main, *others = texts
            try:
                compiled = self.engine.compile(texts[main], {name: texts[name] for name in others})
                self._compiled[key] = Simulation(compiled, self.start)
            except CompileError as error:
                self._compiled[key] = error
        return self._compiled[key]

    def measured(self, probe: Probe, edits: Sequence[Edit] = ()) -> float:
        """A probe's number on the model after edits; infinity where it does not compile."""
        key = (probe.measure, probe.of, tuple(edits))
        if key not in self._measured:
            found = self.with_edits(edits)
            self._measured[key] = float("inf") if isinstance(found, CompileError) else probe.run(found)
        return self._measured[key]

    def afloat(self) -> ReaderModel:
        """The model with its root free to move and every link a body, where it is URDF.

        MuJoCo makes the root link of a URDF the world, and fuses the links without a joint: what is written of their
        mass does not show in the compiled model. It does once the robot is put on a free joint.
        """
        if self.source is None or not self.urdf:
            return self
        children = {each.get("link") for each in self.source.elements("child")}
        roots = [name for each in self.source.root.children if each.tag == "link" and (name := each.get("name"))]
        roots = [name for name in roots if name not in children and not set(name) & set('"&<')]
        free = any(each.get("type") == "floating" for each in self.source.elements("joint"))
        edits = [insert(self.source.root, AFLOAT.format(root=root)) for root in roots[: not free]]
        for visual in ({"discardvisual": "false"}, {}):  # whose meshes may be of a kind that MuJoCo does not read
            texts = apply(self.texts, [*edits, *self._unfused(UNFUSED | visual)])
            floating = ReaderModel(self.engine, texts, self.source, Start(), self.symptom)
            if not floating.error:
                return floating
        return self

    def _unfused(self, settings: Mapping[str, str]) -> list[Edit]:
        """The edits that have MuJoCo keep every link of a URDF, with what little mass it has."""
        assert self.source is not None
        root = self.source.root
        given = next((each for each in root.children if each.tag == "mujoco"), None)
        compiler = next((each for each in given.children if each.tag == "compiler"), None) if given else None
        if compiler is not None:
            return [set_attribute(compiler, *each) for each in settings.items()]
        xml = f"<compiler {' '.join(f'{name}={value!r}' for name, value in settings.items())}/>"
        return [insert(given, xml) if given else insert(root, f"<mujoco>{xml}</mujoco>")]

    @property
    def angle_unit(self) -> float:
        """The unit in which the text has angles, in rad: 1, or pi/180 where MJCF does not say otherwise."""
        if self.source is None or self.urdf:
            return 1.0
        written = [each.get("angle") for each in self.source.elements("compiler") if each.get("angle")]
        return 1.0 if written and written[-1] == "radian" else math.pi / 180

    def element(self, kind: str, index: int) -> Element | None:
        """Where an element of the compiled model is written; None for one that a macro made."""
        if kind not in self._elements:
            self._elements[kind] = self._placed(kind)
        placed = self._elements[kind]
        return placed[index] if 0 <= index < len(placed) else None

    def _placed(self, kind: str) -> list[Element | None]:
        names = self.simulation.names(kind)
        if self.source is None:  # the engine reads XML that is not quite well-formed
            return [None] * len(names)
        if self.urdf and kind in OF_ROBOT:  # a transmission names its joints by <joint> too
            written = [each for each in self.source.root.children if each.tag == OF_ROBOT[kind]]
        elif kind == "body":
            written = list(self.source.bodies())
        elif kind in TAGS:
            written = self.source.of_bodies(*TAGS[kind])
        else:
            written = list(self.source.section(SECTION.get(kind, kind)))
        if kind in ("pair", "exclude"):
            written = [each for each in self.source.section("contact") if each.tag == kind]
        by_name = {element.get("name"): element for element in written if element.get("name")}
        whole = not self.urdf and not any(True for _ in self.source.elements(*REPEATING))
        if whole and len(written) == len(names):
            fits = all(element.get("name") in ("", name) for element, name in zip(written, names, strict=True))
            if fits or kind == "body":
                return list(written)
        return [by_name.get(name) if name else None for name in names]

    def named(self, said: str) -> Element | None:
        """Where an element stands that is told as `Simulation.name` does; None where it has no place."""
        kind = said.partition(" ")[0]
        if kind not in (*TAGS, *SECTION, "body"):
            return None
        found = (index for index in range(self.simulation.count(kind)) if self.simulation.name(kind, index) == said)
        return self.element(kind, next(found, -1))

    def text_of(self, element: Element) -> str:
        """An element as it is written, with all inside."""
        return self.texts[element.file].encode()[element.start : element.end].decode()

    def value(self, kind: str, index: int, attribute: str) -> str | None:
        """What is written for an attribute, on the element or in its default class; None where nothing is."""
        element = self.element(kind, index)
        return self.source.value(element, attribute) if element is not None and self.source else None

    def set(self, kind: str, indices: Sequence[int], attribute: str, value: str) -> tuple[Edit, ...]:
        """Edits that give an attribute of elements a value: in their default class where all of its users are meant.

        Empty where one of them has no place in the text.
        """
        found = [self.element(kind, index) for index in indices]
        if self.source is None or not found or any(each is None for each in found):
            return ()
        elements = [each for each in found if each is not None]
        if self.urdf:
            return self._set_urdf(elements, attribute, value)
        made: dict[Edit, None] = {}
        for element in elements:
            target = element
            holder = self.source.written(element, attribute)
            if (
                holder
                and holder[0] is not element
                and self._users(kind, holder[0], attribute) <= frozenset(map(id, elements))
            ):
                target = holder[0]
            made[set_attribute(target, attribute, value)] = None
        return tuple(made)

    def set_each(self, kind: str, attribute: str, values: Mapping[int, str]) -> tuple[Edit, ...]:
        """Edits that give an attribute of elements a value of its own each; none for what has no place in the text.

        Those of one value are meant together, so that their default class may have it.
        """
        alike: dict[str, list[int]] = {}
        for index, value in values.items():
            if self.element(kind, index) is not None:
                alike.setdefault(value, []).append(index)
        return tuple(edit for value, some in alike.items() for edit in self.set(kind, some, attribute, value))

    def giver(self, kind: str, indices: Sequence[int], attribute: str) -> Element | None:
        """The element of a default class that gives all of some elements an attribute; None where one has its own."""
        found = [self.element(kind, index) for index in indices]
        if self.source is None or not found or any(each is None for each in found):
            return None
        givers = [self.source.written(each, attribute) for each in found if each is not None]
        holders = {id(giver[0]) if giver else 0 for giver in givers}
        first = givers[0][0] if givers[0] else None
        return first if len(holders) == 1 and first not in found else None

    def _set_urdf(self, elements: Sequence[Element], attribute: str, value: str) -> tuple[Edit, ...]:
        """The same where the text is URDF, which has what is said of a joint in elements inside it."""
        tag, *names = URDF.get(attribute, ("",))
        inner = [each.first(tag) for each in elements]
        if not tag or any(each is None for each in inner):
            return ()
        values = value.split() if len(names) > 1 else [value]
        return tuple(set_attribute(each, *pair) for each in inner if each for pair in zip(names, values, strict=True))

    def turned_axis(self, joint: int) -> tuple[Edit, ...]:
        """Edits that let a joint turn, or slide, the other way."""
        return self.set("joint", [joint], "axis", written([-x for x in self.simulation.row("jnt_axis", joint, 3)]))

    def placed(self, body: int, place: Sequence[float]) -> tuple[Edit, ...]:
        """Edits that put a body elsewhere in its parent; in URDF its joint's `<origin>` does."""
        if not self.urdf:
            return self.set("body", [body], "pos", written(place))
        return self.set("joint", self.simulation.joints_of(body)[:1], "origin", written(place))

    def remove(self, kind: str, indices: Sequence[int], attribute: str) -> tuple[Edit, ...]:
        """Edits that take an attribute off elements that have it themselves."""
        found = [self.element(kind, index) for index in indices]
        return tuple(remove_attribute(each, attribute) for each in found if each and attribute in each.attributes)

    def option(self, attribute: str, value: str, tag: str = "option") -> tuple[Edit, ...]:
        """The edit that gives `<option>`, or another element below the root, an attribute."""
        if self.source is None or self.urdf:
            return ()
        there = [child for child in self.source.root.children if child.tag == tag]
        holder = next((child for child in there if attribute in child.attributes), there[-1] if there else None)
        if holder is not None:
            return (set_attribute(holder, attribute, value),)
        return (insert(self.source.root, f'<{tag} {attribute}="{value}"/>'),)

    def add(self, section: str, xml: str) -> tuple[Edit, ...]:
        """The edit that adds an element to a section such as `contact`."""
        if self.source is None or self.urdf:
            return ()
        there = self.source.root.first(section)
        return (insert(there, xml) if there else insert(self.source.root, f"<{section}>{xml}</{section}>"),)

    def _users(self, kind: str, holder: Element, attribute: str) -> frozenset[int]:
        assert self.source is not None
        written = [self.element(kind, index) for index in range(self.simulation.count(kind))]
        givers = ((each, self.source.written(each, attribute)) for each in written if each is not None)
        return frozenset(id(each) for each, giver in givers if giver and giver[0] is holder)
