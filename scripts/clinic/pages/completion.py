"""What the playground's editor offers while one types: MuJoCo's own schema, each name with its sentence of the manual.

`mjcf.json` holds elements by `parent/element`: their attributes, each with its type and sentence, and their children.
"""

from __future__ import annotations

import json
import re
from functools import cache
from pathlib import Path
from typing import Any

import mujoco

FILE = "mjcf.json"
INDENT = 3  # spaces that an element of the printed schema is further in than the one around it
ELEMENT = re.compile(r"^(?P<indent> *)(?P<name>[\w()]+) \((?P<often>.)\) *(?P<attributes>.*)$")
LABEL = re.compile(r"^\.\. _([a-z][\w-]*):\s*$")
ATTRIBUTE = re.compile(r"^:at:`")
KIND = re.compile(r":at-val:`([^`]*)`")
HEADING = re.compile(r"^([=\-~^\"'`#*+.])\1{2,}$")
BESIDE = re.compile(r"^ *(?:\.\. \w+::| +:\w+:)")  # a figure or a film, and its settings
ROLE = re.compile(r":[\w-]+:`([^`<]*?)\s*(?:<[^>]*>)?`|``([^`]*)``|\*\*([^*]+)\*\*|`([^`<]+?)\s*<[^>]*>`_+|\\(?=.)")
SENTENCE = re.compile(r"^.+?(?<!e\.g)(?<!i\.e)(?<!etc)[.:](?=\s|$)", re.DOTALL)
ELSEWHERE = re.compile(
    r"attributes (?:are|is) available here|^See .{0,40} for a description"
)  # sentences that say nothing
SECTIONS = (
    "contact",
    "equality",
    "tendon",
    "sensor",
    "custom",
    "keyframe",
    "visual",
    "option",
    "deformable",
    "flexcomp",
)
LIKE = {  # where the manual tells an attribute once for many elements
    "actuator": ["actuator-general"],
    "default": ["actuator-general"],
    "sensor": ["sensor-touch", "sensor-user", "sensor-framepos", "sensor-distance"],
    "equality": ["equality-connect", "equality-weld"],
    "tendon": ["tendon-spatial"],
    "contact": ["flex-contact", "contact-pair", "body-geom"],
    "elasticity": ["flex-elasticity"],
    "pair": ["contact-pair"],
}
AROUND = ("frame", "replicate")  # stand around what a body may hold; the printed schema leaves them out
LONGEST = 300  # characters of a sentence


def completion() -> bytes:
    """The file for the installed MuJoCo; without sentences where its manual is not installed."""
    elements = _schema()
    for name in AROUND:
        said = {label.split("-")[1] for label in _manual() if re.fullmatch(rf"{name}-\w+", label)}
        elements[f"body/{name}"] = {"children": [], "attributes": sorted(said)}
        elements["mujoco/body"]["children"].append(name)
    made = {
        path: {
            "says": _told(path)[1],
            "children": sorted(set(one["children"])),
            "attributes": {name: _told(path, name) for name in one["attributes"]},
        }
        for path, one in elements.items()
    }
    return (json.dumps({"engine": mujoco.__version__, "elements": made}, ensure_ascii=False) + "\n").encode()


def _schema() -> dict[str, Any]:
    """Elements by `parent/element` with their children and attributes; `body` stands for the world's body as well."""
    found: dict[str, Any] = {}
    around: list[str] = []
    for line in mujoco.mj_printSchema(False, False).splitlines():
        if match := ELEMENT.match(line):
            name = match["name"].replace("(world)", "")
            around = [*around[: len(match["indent"]) // INDENT], name]
            path = "/".join(around[-2:])
            if len(around) > 1:
                found["/".join(around[-3:-1])]["children"].append(name)
            found.setdefault(path, {"children": [], "attributes": []})
            if match["often"] == "R":
                found[path]["children"].append(name)
        found[path]["attributes"] += (match["attributes"] if match else line).split()
    return found


def _told(path: str, attribute: str = "") -> tuple[str, str]:
    """The type of an attribute, as the manual writes it, and the first sentence about it, or about the element."""
    manual, (parent, _, element) = _manual(), path.rpartition("/")
    places = [f"{parent}-{element}", element, f"body-{element}", f"asset-{element}", f"actuator-{element}"]
    if attribute:
        places += [*LIKE.get(parent, ()), *LIKE.get(element, ())]
    else:
        places += [f"{section}-{element}" for section in SECTIONS]
    found = [manual[label] for place in places if (label := f"{place}-{attribute}".rstrip("-")) in manual]
    return next((one for one in found if one[1]), found[0] if found else ("", ""))


@cache
def _manual() -> dict[str, tuple[str, str]]:
    """The type and the first sentence of what stands at each label of the manual's XML reference."""
    source = Path(mujoco.__file__).parent / "doc" / "XMLreference.rst"
    found: dict[str, tuple[str, str]] = {}
    labels: list[str] = []
    lines = source.read_text(encoding="utf-8").splitlines() if source.is_file() else []
    for k, line in enumerate(lines):
        if match := LABEL.match(line):
            labels.append(match[1])
        elif line.strip() and labels and not BESIDE.match(line):
            kind = KIND.search(line)
            begin = k + 1 if ATTRIBUTE.match(line) else k + 2 if HEADING.match(lines[k + 1]) else k
            found |= dict.fromkeys(labels, (kind[1] if kind else "", _sentence(lines, begin)))
            labels = []
    return found


def _sentence(lines: list[str], begin: int) -> str:
    """The first sentence of the paragraph that begins at a line or after empty ones, as plain text."""
    while begin < len(lines) and (not lines[begin].strip() or BESIDE.match(lines[begin])):
        begin += 1
    paragraph = []
    for line in lines[begin:]:
        if not line.strip() or line.lstrip().startswith(("..", ":at:", "|", "+-")):
            break
        paragraph.append(line.strip())
    words = ROLE.sub(lambda match: next((part for part in match.groups() if part), ""), " ".join(paragraph))
    words = re.sub(r"\s*\|[^|\s]*\|\s*", " ", words).strip()
    sentence = SENTENCE.match(words)
    told = (sentence[0] if sentence else words).strip()
    if ELSEWHERE.search(told):
        return ""
    return told if len(told) <= LONGEST else told[: told.rfind(" ", 0, LONGEST)] + " …"
