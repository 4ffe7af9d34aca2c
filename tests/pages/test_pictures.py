"""Still images of a case."""

from __future__ import annotations

import io
from pathlib import Path

from clinic.pages.figures.pictures import pictures
from clinic.record.case import load_case
from helpers import MODEL, tiny_case, write_script_case
from PIL import Image


def webp_size(data: bytes, kind: str = "WEBP") -> tuple[int, int]:
    with Image.open(io.BytesIO(data)) as image:
        assert image.format == kind
        return image.size


def test_pictures_show_the_broken_model_and_the_first_fix(tmp_path: Path) -> None:
    made = pictures(tiny_case(tmp_path, ("camera: side", "camera: side, time: 0.2")))

    assert webp_size(made.pop("card.jpg"), "JPEG") == (1200, 630)
    assert {name: webp_size(data) for name, data in made.items()} == {
        "broken.webp": (480, 360),
        "fixed.webp": (480, 360),
        "thumb.webp": (192, 144),
    }
    assert made["broken.webp"] != made["fixed.webp"]


def test_picture_of_a_script_is_its_scene_from_keyframe_0(tmp_path: Path) -> None:
    def picture(name: str, scene: str) -> bytes:
        folder = write_script_case(
            tmp_path / name,
            ("script: script.py", "script: script.py\nfiles: [scene.xml]"),
            ("camera: side", "camera: side, scene: scene.xml"),
        )
        (folder / "scene.xml").write_text(scene, encoding="utf-8")
        return pictures(load_case(folder))["broken.webp"]

    raised = MODEL.replace("</mujoco>", '<keyframe><key qpos="0 0 0.3 1 0 0 0"/></keyframe></mujoco>')
    assert webp_size(picture("one", MODEL)) == (480, 360)
    assert picture("two", raised) == picture("three", MODEL.replace('pos="0 0 0.06"', 'pos="0 0 0.3"'))
