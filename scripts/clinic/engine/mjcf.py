"""Checks of a case's model as text, before MuJoCo reads it: it is XML, and names no file that is not in its folder.

So a case's key in the build cache covers all that its model is made of, and the browser can compile it.
"""

from __future__ import annotations

from xml.parsers import expat


class ModelError(ValueError):
    """A model's text that is refused; `line` counts from 1."""

    def __init__(self, line: int, found: str, expected: str, repair: str) -> None:
        self.line, self.found, self.expected, self.repair = line, found, expected, repair
        super().__init__(line, found, expected, repair)

    def __str__(self) -> str:
        return f"line {self.line}: {self.found}"


def check_text(xml: str) -> None:
    """Refuses a text that is not well-formed XML, of which MuJoCo's own parser accepts some, or that names a file.

    Raises:
        ModelError: For the first mistake.
    """
    around: list[str] = []  # the elements that are open

    def check_element(element: str, attributes: dict[str, str]) -> None:
        around.append(f", in the <{element}> of line {parser.CurrentLineNumber}")
        for name, value in attributes.items():
            if name.startswith("file"):
                repair = "write out what it names: elements, `vertex` of a mesh, `builtin` of a texture"
                found = f'<{element} {name}="{value}">'
                raise ModelError(parser.CurrentLineNumber, found, "a model in one file", repair)

    parser = expat.ParserCreate("utf-8")
    parser.StartElementHandler = check_element
    parser.EndElementHandler = lambda _: around.pop()
    try:
        parser.Parse(xml.encode(), True)
    except expat.ExpatError as error:
        found = expat.errors.messages[error.code] + (around[-1] if around else "")
        raise ModelError(error.lineno, found, "well-formed XML", "correct the model") from None
