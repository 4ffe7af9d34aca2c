"""Meshes that were scaled although their numbers are metres."""

from __future__ import annotations

from clinic.diagnosis.edit import Edit, set_attribute
from clinic.diagnosis.reader_model import ReaderModel

SMALL, BACK = 0.01, 1000.0


def scaled_back(model: ReaderModel) -> tuple[tuple[Edit, ...], str, str]:
    """The edits that make all meshes with a scale below 0.01 a thousand times as large, that scale, and the new one."""
    edits, now, value = [], "", ""
    for mesh in model.source.elements("mesh") if model.source else ():
        written = model.source.value(mesh, "scale") if model.source else None
        numbers = [float(each) for each in (written or "1").split()]
        if written and 0 < max(numbers) < SMALL:
            now, value = written, " ".join(f"{BACK * each:g}" for each in numbers)
            edits.append(set_attribute(mesh, "scale", value))
    return tuple(edits), now, value
