"""Models as no one would write them: each is drawn with a seed, and is to be diagnosed or refused."""

from __future__ import annotations

import random
import re
from collections.abc import Callable

from clinic.diagnosis.rules import rules

ATTRIBUTE = re.compile(r'\b([\w]+)="([^"]*)"')
NUMBER = re.compile(r'(?<=[" ])-?\d+(?:\.\d+)?(?=[" ])')
HUGE = ("1e308", "-1e308", "1e999", "nan", "-inf", "9" * 400, "1e-320", "0x10", "2147483648", "-2147483649", "")
BOMB = '<!DOCTYPE mujoco [<!ENTITY a "aaaaaaaaaa"><!ENTITY b "&a;&a;&a;&a;&a;&a;&a;&a;">]>\n'

EXAMPLES = ("visual-mass", "masks", "weak-servo", "key-outside-range", "touch-site-too-small", "twin-joint-differs")

Draw = random.Random


def truncated(text: str, draw: Draw) -> bytes:
    return text.encode()[: draw.randrange(len(text.encode()))]


def flipped(text: str, draw: Draw) -> bytes:
    made = bytearray(text.encode())
    for _ in range(draw.randint(1, 8)):
        made[draw.randrange(len(made))] ^= 1 << draw.randrange(8)
    return bytes(made)


def unquoted(text: str, draw: Draw) -> bytes:
    places = [found.start() for found in re.finditer('"', text)]
    dropped = set(draw.sample(places, min(len(places), draw.randint(1, 3))))
    return "".join(each for at, each in enumerate(text) if at not in dropped).encode()


def repeated(text: str, draw: Draw) -> bytes:
    lines = text.split("\n")
    at = draw.randrange(1, len(lines))
    return "\n".join([*lines[:at], *([lines[at]] * draw.choice((2, 3, 200))), *lines[at + 1 :]]).encode()


def nested(text: str, draw: Draw) -> bytes:
    depth = draw.choice((50, 300, 2000, 20000))
    joint = draw.choice(("", "<joint/>"))
    inside = f'<body>{joint}<geom size="0.1"/>' * depth + "</body>" * depth
    return text.replace("<worldbody>", f"<worldbody>{inside}", 1).encode()


def huge(text: str, draw: Draw) -> bytes:
    found = draw.choice([*NUMBER.finditer(text)])
    return (text[: found.start()] + draw.choice(HUGE) + text[found.end() :]).encode()


def reworded(text: str, draw: Draw) -> bytes:
    found = draw.choice([*ATTRIBUTE.finditer(text)])
    word = draw.choice(("", "x" * 100_000, "&#0;", "&lt;", "%s%n", "../../..", "a\u202eb", "\U0001f916", "a\nb", "--"))
    return (text[: found.start(2)] + word + text[found.end(2) :]).encode()


def missing(text: str, draw: Draw) -> bytes:
    file = draw.choice(("no.obj", "/no/such.stl", "..", ".", "a\u00e9.png", "x" * 5000, "model.xml", "a&#10;b.obj"))
    inside = draw.choice(
        (
            f'<asset><mesh name="m" file="{file}"/></asset><worldbody><geom type="mesh" mesh="m"/></worldbody>',
            f'<include file="{file}"/>',
            f'<asset><texture type="2d" file="{file}"/><hfield file="{file}" size="1 1 1 1"/></asset>',
            f'<asset><model name="m" file="{file}"/></asset><worldbody><attach model="m" prefix="a"/></worldbody>',
        )
    )
    return text.replace("<mujoco>", f"<mujoco>{inside}", 1).encode()


def binary(text: str, draw: Draw) -> bytes:
    noise = draw.randbytes(draw.choice((0, 1, 300, 100_000)))
    return draw.choice((noise, text.encode() + noise, b"<" + noise, text.encode().replace(b'"', b'"\0', 1)))


def encoded(text: str, draw: Draw) -> bytes:
    name = draw.choice(("utf-16", "latin-1", "no-such", "utf-32", "ascii"))
    head = f'<?xml version="1.0" encoding="{name}"?>\n'
    return draw.choice((head + text, BOMB + text.replace('="', '="&b;', 1), "\ufeff" + text, head)).encode()


def commented(text: str, draw: Draw) -> bytes:
    said = draw.choice(("ignore[", "ignore[]", "ignore[masks] why", "ignore[masks", "ignore[,,] x", "\U0001f916 ["))
    places = [found.start() for found in re.finditer("<", text)]
    at = draw.choice([*places, len(text)])
    return f"{text[:at]}<!-- clinic: {said} -->{text[at:]}".encode()


KINDS: tuple[Callable[[str, Draw], bytes], ...] = (
    *(truncated, flipped, unquoted, repeated, nested, huge, reworded, missing, binary, encoded, commented),
)


def mutilated(seed: int) -> tuple[str, bytes]:
    """A file and what was done to it; every kind in turn."""
    draw = random.Random(seed)
    texts = [rules()[name].example("Bad") for name in EXAMPLES]
    kind = KINDS[seed % len(KINDS)]
    return kind.__name__, kind(draw.choice(texts), draw)
