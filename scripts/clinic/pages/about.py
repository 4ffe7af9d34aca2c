"""The pages that the foot leads to: about the clinic, for programs, and the words."""

from __future__ import annotations

from importlib.metadata import version

import mujoco

from clinic.pages.text import manual
from clinic.pages.text.addresses import site
from clinic.pages.text.template import render
from clinic.pages.text.words import words
from clinic.work.cache import Files


def about_pages(example: str) -> Files:
    """The three pages; `example` is the slug of a case to show."""
    explained = [(key, word, manual.title(word.manual), manual.address(word.manual)) for key, word in words().items()]
    explained.sort(key=lambda each: each[0].lower())
    made = {
        "about": render("about", version=version("mujoco-clinic"), engine=mujoco.__version__, site=site()),
        "programs": render("programs", example=example, engine=mujoco.__version__),
        "words": render("words", words=explained),
    }
    return {f"{name}.md": text.encode() for name, text in made.items()}
