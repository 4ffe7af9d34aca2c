"""Hostile input: each refused with one message, or shown and nothing else."""

from __future__ import annotations

import io
import json
import os
import shutil
import subprocess
import sys
from collections import Counter
from dataclasses import asdict
from html import unescape
from pathlib import Path
from typing import Any

import pytest
import yaml
from clinic import confine, node
from clinic.case import load_case
from clinic.evidence import Evidence, collect
from clinic.examine import examine
from clinic.folder import LARGE
from clinic.limits import Limits
from clinic.pages import card, home_page
from clinic.playground import playground
from clinic.plots import figures
from clinic.problem import CaseError, Problem
from clinic.script import ScriptError, run_node, run_python
from clinic.site import navigation
from clinic.ward import error_page, read_name
from helpers import MODEL, RECORD, SCRIPT_RECORD, changed, page_of, script_case, tiny_case, write_case, write_folder
from markup import ROOT, active, elements, extensions, rendered
from mkdocs.commands.build import build
from mkdocs.config import load_config

EDIT = "{find: ' contype=\"2\" conaffinity=\"2\"', replace: ''}"
SCRIPTED = "<script>alert(1)</script>"
LANDLOCK = confine.landlock_version() >= 1
kernel = pytest.mark.skipif(not LANDLOCK, reason="the kernel has no Landlock")


def problem(folder: Path) -> Problem:
    """The only problem of a case that is read, compiled and bound."""
    with pytest.raises(CaseError) as caught:
        examine(load_case(folder))
    (found,) = caught.value.problems
    return found


# YAML


BOMB = "a: &a [x, x]\nb: &b [*a, *a]\nc: &c [*b, *b]\n"


@pytest.mark.parametrize(
    ("text", "line", "found"),
    [
        pytest.param(BOMB, 2, "the alias *a", id="aliases"),
        pytest.param("number: 1\n<<: *base\n", 2, "the alias *base", id="merge-of-an-alias"),
        pytest.param("title: !!python/object/apply:os.system [ls]\n", 1, None, id="python-tag"),
        pytest.param("title: !!binary aGVsbG8=\n", 1, "the tag tag:yaml.org,2002:binary", id="binary-tag"),
        pytest.param("%TAG ! tag:yaml.org,2002:python/\n---\ntitle: !name:os.system x\n", 3, None, id="renamed-tag"),
        pytest.param("a: " + "[" * 10_000, 1, "a list in a list in ...", id="deep-lists"),
        pytest.param("a: " + "{b: " * 10_000, 1, "a list in a list in ...", id="deep-mappings"),
        pytest.param("title: a\ntitle: b\n", 2, "the key title twice", id="key-twice"),
        pytest.param("title: a\nrun: b\n---\ntitle: c\n", 3, None, id="two-documents"),
        pytest.param('title: "a\\0b"\n', 1, "the character U+0000", id="escaped-nul"),
        pytest.param('title: "a\\ud800b"\n', 1, "the character U+D800", id="half-a-character"),
        pytest.param('title: a\n"\\a": b\n', 2, "the character U+0007", id="bell-in-a-key"),
        pytest.param("number: 0x" + "f" * 5000 + "\n", 1, None, id="number-of-thousands-of-digits"),
        pytest.param("title: a\x00b\n", 1, "the character U+0000", id="nul"),
        pytest.param("title: a\u202eb\n", 1, "the character U+202E", id="text-turned-round"),
        pytest.param("a: 1\n" * 60_000, 1, "300000 bytes", id="enormous"),
    ],
)
def test_yaml(tmp_path: Path, text: str, line: int, found: str | None) -> None:
    told = problem(write_folder(tmp_path, "a-case", {"case.yaml": text}))
    assert (told.file, told.line) == ("cases/a-case/case.yaml", line)
    assert found is None or told.found == found
    assert told.expected
    assert told.repair


def test_an_inline_merge_is_an_unknown_key(tmp_path: Path) -> None:
    told = problem(write_case(tmp_path, ("number: 1", "number: 1\n<<: {number: 2}")))
    assert (told.line, told.found) == (2, "the unknown key `<<`")


@pytest.mark.parametrize("name", ["case.yaml", "model.xml"])
@pytest.mark.parametrize(
    ("content", "found"),
    [
        pytest.param(b"a: \xff\xfe\n", "bytes that are not UTF-8", id="not-utf-8"),
        pytest.param(b"a: \n\n b\x00\n", "the character U+0000", id="nul"),
        pytest.param(b" " * (LARGE + 1), f"{LARGE + 1} bytes", id="enormous"),
    ],
)
def test_bytes_of_a_file(tmp_path: Path, name: str, content: bytes, found: str) -> None:
    folder = write_case(tmp_path)
    (folder / name).write_bytes(content)
    told = problem(folder)
    assert (told.file, told.found) == (f"cases/falling-box/{name}", found)
    assert told.line == (3 if "U+" in found else 1)


# The folder


def test_a_case_that_is_a_link(tmp_path: Path) -> None:
    folder = write_case(tmp_path)
    (tmp_path / "cases" / "other").symlink_to(folder)
    told = problem(tmp_path / "cases" / "other")
    assert (told.file, told.found) == ("cases/other", "a symbolic link")


@pytest.mark.parametrize("name", ["case.yaml", "model.xml", "more.xml"])
def test_a_file_that_is_a_link_out(tmp_path: Path, name: str) -> None:
    folder = write_case(tmp_path)
    outside = shutil.copy(folder / "model.xml", tmp_path / "outside.xml")
    (folder / name).unlink(missing_ok=True)
    (folder / name).symlink_to(outside)
    told = problem(folder)
    assert (told.file, told.found) == (f"cases/falling-box/{name}", "a symbolic link")


def test_a_pipe_is_not_read(tmp_path: Path) -> None:
    folder = write_case(tmp_path)
    os.mkfifo(folder / "more.txt")
    assert problem(folder).found == "no file"


# XML


ENTITIES = '<!DOCTYPE m [<!ENTITY a "lol"><!ENTITY b "&a;&a;">]>\n'
FILES = [
    pytest.param('<include file="/etc/hosts"/>', id="include-absolute"),
    pytest.param('<include file="../other/model.xml"/>', id="include-above"),
    pytest.param('<include file="model.xml"/>', id="include-itself"),
    pytest.param('<include file="&#47;etc/hosts"/>', id="include-behind-a-reference"),
    pytest.param('<asset><mesh name="m" file="/m.obj"/></asset>', id="mesh"),
    pytest.param('<asset><hfield name="h" file="../h.png" size="1 1 1 1"/></asset>', id="hfield"),
    pytest.param('<asset><texture type="2d" file="../t.png"/></asset>', id="texture"),
    pytest.param('<asset><texture type="cube" fileright="../t.png"/></asset>', id="texture-of-a-side"),
    pytest.param('<asset><model name="m" file="/m.xml"/></asset>', id="model"),
    pytest.param('<deformable><skin name="s" file="../s.skn"/></deformable>', id="skin"),
    pytest.param('<worldbody><flexcomp name="f" type="gmsh" file="../f.msh"/></worldbody>', id="flexcomp"),
    pytest.param('<compiler meshdir="/"/>', id="meshdir"),
    pytest.param('<compiler texturedir=".."/>', id="texturedir"),
    pytest.param('<compiler assetdir="../.."/>', id="assetdir"),
]


@pytest.mark.parametrize("element", FILES)
def test_a_model_that_names_a_file(tmp_path: Path, element: str) -> None:
    folder = write_case(tmp_path, model=changed(MODEL, ("  <option", f"  {element}\n  <option")))
    told = problem(folder)
    assert (told.file, told.line) == ("cases/falling-box/model.xml", 2)
    assert told.expected == "a model in one file"


@pytest.mark.parametrize("element", FILES)
@pytest.mark.parametrize("kind", ["fixes", "refuted"])
def test_an_edit_that_names_a_file(tmp_path: Path, element: str, kind: str) -> None:
    find = EDIT if kind == "fixes" else "{find: 'timestep=\"0.002\"', replace: 'timestep=\"0.001\"'}"
    edit = "{find: '<mujoco>', replace: '<mujoco>" + element + "'}"
    told = problem(write_case(tmp_path, (find, edit)))
    assert told.where == f"{kind}[0].edits"
    assert told.found.startswith("after these edits: <")
    assert told.expected == "a model in one file, that names no other"


@pytest.mark.parametrize(
    "text", [pytest.param(ENTITIES + "<mujoco/>", id="entities"), pytest.param("<!DOCTYPE m>\n<mujoco/>", id="doctype")]
)
def test_a_model_with_a_doctype(tmp_path: Path, text: str) -> None:
    told = problem(write_case(tmp_path, model=text))
    assert (told.file, told.line, told.found) == ("cases/falling-box/model.xml", 1, "a DOCTYPE")


def test_an_edit_that_adds_a_doctype(tmp_path: Path) -> None:
    told = problem(write_case(tmp_path, (EDIT, "{find: '<mujoco>', replace: '<!DOCTYPE m><mujoco>'}")))
    assert told.found == "after these edits: a DOCTYPE"


@pytest.mark.parametrize("name", ["/etc/hosts", "../pendulum.xml", "sub/a.xml", "absent.xml"])
def test_a_scene_of_a_script_that_leads_out(tmp_path: Path, name: str) -> None:
    files = {
        "case.yaml": SCRIPT_RECORD.replace("script: script.py", "script: script.py\nfiles: [a.xml, b.xml]"),
        "script.py": "print('error = 0.5')\n",
        "a.xml": '<mujoco>\n  <include file="b.xml"/>\n</mujoco>',
        "b.xml": f'<mujocoinclude>\n\n  <include file="{name}"/>\n</mujocoinclude>',
    }
    told = problem(write_folder(tmp_path, "odd-script", files))
    assert (told.file, told.line) == ("cases/odd-script/b.xml", 3)
    assert told.expected == "a file of the folder: a.xml, b.xml, script.py"


def test_xml_that_only_mujoco_reads_is_refused(tmp_path: Path) -> None:
    told = problem(write_case(tmp_path, model=changed(MODEL, ('name="floor"', 'name="a & b"'))))
    assert (told.line, told.expected) == (5, "well-formed XML")


@pytest.mark.parametrize(
    "element",
    [
        pytest.param('<size memory="90000G"/>', id="memory"),
        pytest.param('<size nuser_geom="2000000000"/>', id="numbers-of-a-user"),
        pytest.param('<asset><hfield name="h" size="1 1 1 1" nrow="20000" ncol="20000"/></asset>', id="height-field"),
        pytest.param(
            '<asset><texture name="h" type="2d" builtin="flat" width="90000" height="90000"/></asset>', id="texture"
        ),
        pytest.param("<worldbody>" + "<body>" * 5000 + "</body>" * 5000 + "</worldbody>", id="depth"),
        pytest.param('<worldbody><geom size="nan"/></worldbody>', id="not-a-number"),
        pytest.param('<worldbody><geom size="1e400"/></worldbody>', id="too-large-a-number"),
        pytest.param('<extension><plugin plugin="/tmp/plugin.so"/></extension>', id="plugin"),
    ],
)
def test_a_model_that_asks_for_too_much(tmp_path: Path, element: str) -> None:
    told = problem(write_case(tmp_path, model=changed(MODEL, ("<mujoco>", f"<mujoco>{element}"))))
    assert told.file == "cases/falling-box/model.xml"
    assert told.found


def test_a_model_that_never_compiles(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("clinic.mjcf.SECONDS", 1)
    endless = '<replicate count="2000000000"><geom size=".1"/></replicate>'
    told = problem(write_case(tmp_path, model=changed(MODEL, ("<worldbody>", f"<worldbody>{endless}"))))
    assert told.found == "a model that takes more than 1 s"


# Words


ACTS = [
    SCRIPTED,
    "<svg onload=alert(1)>",
    "<iframe src=//evil.example></iframe>",
    "<img src=x onerror=alert(1)>",
    "<a href='javascript:alert(1)'>x</a>",
    "<javascript:alert(1)>",
    "`\n\n<script>alert(1)</script>\n\n`",
    "\\`<script>alert(1)</script>\\`",
    "```\n<script>alert(1)</script>",
    "   ~~~\n<script>alert(1)</script>\n   ~~~",
    "```{.x onclick=alert(1)}\ncode\n```",
    "> ```\n> <script>alert(1)</script>\n> ```",
    "<!-- x --> <?php x ?> <![CDATA[x]]>",
    "<div markdown onclick=alert(1)>x</div>",
    "text{ onclick=alert(1) }",
    "# heading { onclick=alert(1) }",
    "{% raw %}{% for x in y %}",
    "[a]: javascript:alert(1)\n\n[a] [a][a] [x][a]",
]


@pytest.mark.parametrize("field", ["symptom", "diagnosis", "cause", "fix", "lesson", "why"])
@pytest.mark.parametrize("text", ACTS)
def test_prose_that_would_act_is_shown(hostile: Evidence, tmp_path: Path, field: str, text: str) -> None:
    record = {**plain_record(), field: text} if field != "why" else plain_record()
    if field == "why":
        record["refuted"][0]["why"] = text
    case = load_case(write_folder(tmp_path, "falling-box", {"case.yaml": json.dumps(record), "model.xml": MODEL}))
    files = {"film.mp4": b"", "broken.webp": b"", "strip.webp": b"", "fixed.webp": b""}
    assert elements(rendered(body(page_of(case, hostile, files)))) is None
    assert elements(rendered(body(home_page([card(case, hostile, files)], "4.0.0")))) is None


@pytest.mark.parametrize(
    "link",
    [
        "[x](javascript:alert(1))",
        "[x](JaVaScRiPt:alert)",
        "[x](java&#115;cript:alert)",
        "[x](data:text/html,x)",
        "[x](vbscript:x)",
        "[x](<javascript:alert(1)>)",
        "[x]( javascript:x )",
        '[x](a.md "title")',
        "![x](https://other.example/x.png)",
        "![x](//other.example/x.png)",
        "[x](file:///etc/hosts)",
        "[x](//other.example)",
        "[![x](y)](javascript:x)",
    ],
)
def test_a_link_to_a_strange_address(tmp_path: Path, link: str) -> None:
    told = problem(write_case(tmp_path, ("lesson: Look at the masks.", f"lesson: |\n  Look\n  at {link} now.")))
    assert (told.line, told.where) == (10, "lesson")
    assert told.found in link
    assert told.repair == "correct the address; write code between backticks"


@pytest.mark.parametrize(
    "link",
    [
        "[x](https://mujoco.org/a?b=c#d)",
        "[x](../arm-explodes/index.md#fix)",
        "`[x](javascript:x)`",
        "![x](broken.webp)",
    ],
)
def test_a_plain_link_is_left(tmp_path: Path, link: str) -> None:
    assert tiny_case(tmp_path, ("Look at the masks.", f"'Look at {link} now.'")).record.lesson == f"Look at {link} now."


@pytest.mark.parametrize(
    "formula",
    [
        r"\text{<script>alert(1)</script>}",
        r"\href{javascript:alert(1)}{x}",
        r"\style{color:red}{x}",
        r"\frac{",
        "{" * 3000,
    ],
)
def test_a_formula_that_is_more(tmp_path: Path, formula: str) -> None:
    told = problem(write_case(tmp_path, ("lesson: Look at the masks.", f"lesson: 'See ${formula}$.'")))
    assert (told.where, told.expected) == ("lesson", "a LaTeX formula")


@pytest.mark.parametrize(
    ("old", "new", "where"),
    [
        pytest.param("A box falls through the floor", SCRIPTED, "title", id="title"),
        pytest.param("Remove the masks of the floor", SCRIPTED, "fixes[0].title", id="title-of-a-fix"),
        pytest.param("Halve the timestep", SCRIPTED, "refuted[0].title", id="title-of-a-remedy"),
        pytest.param("[box falls through floor]", f"[{SCRIPTED}]", "phrases[0]", id="phrase"),
        pytest.param("height of the box", SCRIPTED, "signals.height.label", id="label"),
        pytest.param("unit: m,", f"unit: {SCRIPTED},", "signals.height.unit", id="unit"),
        pytest.param("A box falls through the floor", '"one\\ntwo"', "title", id="line-break"),
        pytest.param("tags: [contact]", f"tags: ['{SCRIPTED}']", "tags[0]", id="tag"),
        pytest.param("id: share-a-bit", f"id: {SCRIPTED}", "fixes[0].id", id="id"),
        pytest.param("contacts: {path: ncon}", f"{SCRIPTED}: {{path: ncon}}", "signals", id="name-of-a-signal"),
        pytest.param("model: model.xml", "model: ../model.xml", "model", id="file"),
        pytest.param("picture: {camera: side}", f"picture: {{camera: {SCRIPTED}}}", "picture.camera", id="camera"),
    ],
)
def test_a_name_or_a_line_that_holds_html(tmp_path: Path, old: str, new: str, where: str) -> None:
    with pytest.raises(CaseError) as caught:
        examine(load_case(write_case(tmp_path, (old, new))))
    told = caught.value.problems[0]
    assert told.file == "cases/falling-box/case.yaml"
    assert told.where.startswith(where)


LINE = "a [x](javascript:alert) {{ 7 }} {% x %} { onclick=x } | & \" ' \\ `[y](javascript:z)` $\\frac{$ --> *b*"


@pytest.fixture(scope="module")
def hostile(tmp_path_factory: pytest.TempPathFactory) -> Evidence:
    """The evidence of the tiny case."""
    return collect(tiny_case(tmp_path_factory.mktemp("root")))


def plain_record() -> dict[str, object]:
    """The tiny case's record, without fields in its prose."""
    record = yaml.safe_load(RECORD)
    record |= {"symptom": "It falls.", "diagnosis": "No contacts."}
    record["refuted"][0]["why"] = "It falls."
    return record


def body(page: str) -> str:
    """A page without its front matter."""
    return page.split("\n---\n", 1)[1]


def test_lines_that_would_act_are_shown_on_every_page(hostile: Evidence, tmp_path: Path) -> None:
    record = plain_record()
    record |= {"title": LINE[:80], "phrases": [LINE]}
    record["fixes"][0]["title"] = record["refuted"][0]["title"] = LINE
    record["signals"]["height"] |= {"label": LINE, "unit": LINE}
    case = load_case(write_folder(tmp_path, "falling-box", {"case.yaml": json.dumps(record), "model.xml": MODEL}))
    files = {"film.mp4": b"", "broken.webp": b"", "strip.webp": b"", "fixed.webp": b""}
    evidence = hostile.model_copy(update={"variants": dict(hostile.variants)})
    for key, variant in evidence.variants.items():
        traces = {name: trace.model_copy(update={"unit": LINE}) for name, trace in variant.traces.items()}
        evidence.variants[key] = variant.model_copy(update={"traces": traces, "messages": [SCRIPTED, "```", LINE]})
    page = page_of(case, evidence, files, case)
    html = rendered(body(page))
    assert elements(html) is None
    assert "<script>" not in page.split("---")[1]
    assert html.count("&lt;script&gt;") == 1
    assert elements(rendered(body(home_page([card(case, evidence, files)], "4.0.0")))) is None
    assert json.loads(playground(case, "4.0.0", [case]))["title"] == LINE[:80]
    for drawing in figures(case, evidence).values():
        assert b"<script" not in drawing
        assert b"onclick" not in drawing.split(b"-->")[-1]


def test_a_built_page_and_the_search_hold_nothing_that_acts(hostile: Evidence, tmp_path: Path) -> None:
    texts = {"tame": ("A plain title", "Plain words."), "wild": (LINE[:80], "\n\n".join(ACTS))}
    pages = {}
    for name, (title, symptom) in texts.items():
        record = {**plain_record(), "title": title, "phrases": [title], "symptom": symptom}
        folder = write_folder(tmp_path / name, "falling-box", {"case.yaml": json.dumps(record), "model.xml": MODEL})
        pages[name] = page_of(load_case(folder), hostile)
    tame, wild = built(tmp_path, pages, [{f"1. {title}": f"{name}.md"} for name, (title, _) in texts.items()])
    assert tame == wild


TITLES = [
    LINE,
    "</title>" + SCRIPTED,
    "<img src=x onerror=alert(1)>",
    "&lt;script>alert(1)&lt;/script>",
    '" onclick="x',
]


@pytest.mark.parametrize("title", TITLES)
def test_a_refused_title_is_text_on_every_page(tmp_path: Path, title: str) -> None:
    names = [
        read_name(write_folder(tmp_path / slug, slug, {"case.yaml": f"number: 1\ntitle: {said}\n"}))
        for slug, said in (("tame", "A plain title"), ("wild", title))
    ]
    pages = {name.slug: error_page(name.heading, []) for name in names}
    entries = next(entry["Cases"] for entry in navigation(names) if "Cases" in entry)
    nav = [{heading: Path(path).parent.name + ".md" for heading, path in entry.items()} for entry in entries]
    tame, wild = built(tmp_path, pages, nav)
    tame_alone, _ = built(tmp_path, {"tame": pages["tame"], "wild": pages["tame"]}, ["tame.md", "wild.md"])
    assert tame == wild == tame_alone


def built(folder: Path, pages: dict[str, str], nav: list[Any]) -> list[Counter[str]]:
    """What acts on each page of a site of these; its search holds nothing that does."""
    (folder / "docs").mkdir(exist_ok=True)
    for name, page in pages.items():
        (folder / "docs" / f"{name}.md").write_text(page, encoding="utf-8")
    names, options = extensions()
    config = load_config(
        config_file=io.BytesIO(b"site_name: x"),
        docs_dir=str(folder / "docs"),
        site_dir=str(folder / "site"),
        theme={
            "name": "material",
            "custom_dir": str(ROOT / "scripts" / "theme"),
            "font": False,
            "features": ["navigation.footer"],
        },
        plugins=["search", "tags"],
        markdown_extensions=[{name: options.get(name, {})} for name in names],
        nav=nav,
    )
    build(config)
    for entry in json.loads((folder / "site" / "search" / "search_index.json").read_text(encoding="utf-8"))["docs"]:
        assert elements(entry["title"]) is None
        assert elements(entry["text"]) is None
    return [active((folder / "site" / name / "index.html").read_text(encoding="utf-8")) for name in pages]


def test_what_a_script_prints_is_shown(tmp_path: Path) -> None:
    printed = [SCRIPTED, "```", "    ```", "`</code><script>x", "| a | <b>", "[x](javascript:y)", "error = 0.5"]
    case = script_case(tmp_path, script="\n".join(f"print({text!r})" for text in printed))
    html = rendered(body(page_of(case, collect(case), {})))
    assert elements(html) is None
    assert unescape(html).count("[x](javascript:y)") >= 4  # the script, what it prints, and both columns that compare


def test_the_description_of_a_page_stays_in_its_attribute(hostile: Evidence, tmp_path: Path) -> None:
    case = tiny_case(tmp_path, ("It falls to {{ broken.height.final }}.", "'A \"><b>'"))
    assert 'description: "A &quot;&gt;&lt;b&gt;"' in page_of(case, hostile)


# Scripts


@pytest.fixture
def outside(tmp_path: Path) -> Path:
    """A file that no script may touch."""
    made = tmp_path / "outside.txt"
    made.write_text("whole", encoding="utf-8")
    return made


def refusal(code: str, time_limit: float = 60.0) -> str:
    with pytest.raises(ScriptError) as caught:
        run_python(code, {}, time_limit=time_limit)
    return caught.value.found


@pytest.mark.parametrize(
    "code",
    [
        pytest.param("while True:\n    pass", id="loops"),
        pytest.param("import time\ntime.sleep(1000)", id="sleeps"),
        pytest.param("import os, time\nos.close(1)\nos.close(2)\ntime.sleep(1000)", id="closes-its-output"),
        pytest.param(
            "import signal, time\nsignal.signal(signal.SIGTERM, signal.SIG_IGN)\ntime.sleep(1000)", id="is-deaf"
        ),
    ],
)
def test_a_script_that_hangs(code: str) -> None:
    assert refusal(code, 0.5) == "still running after 0.5 s"


def test_the_time_limit_is_read_when_a_script_runs(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("clinic.script.TIME_LIMIT", 0.5)
    with pytest.raises(ScriptError, match=r"still running after 0\.5 s"):
        run_python("while True:\n    pass", {})


@pytest.mark.parametrize("stream", ["stdout", "stderr"])
def test_a_script_that_prints_without_end(stream: str) -> None:
    assert refusal(f"import sys\nwhile True:\n    sys.{stream}.write('x' * 10000)") == "prints more than 256000 bytes"


@pytest.mark.parametrize(
    ("code", "found"),
    [
        pytest.param("print('a')\nprint('b\\0')", "it prints the character U+0000 on line 2 of its output", id="nul"),
        pytest.param(
            "import os\nos.write(1, b'\\xff')", "it prints the character U+DCFF on line 1 of its output", id="bytes"
        ),
    ],
)
def test_a_script_that_prints_no_text(code: str, found: str) -> None:
    assert refusal(code) == found


def test_a_long_line_that_is_no_number_is_read_once() -> None:
    assert run_python("print('a' + ' ' * 200_000)", {}).traces() == {}


@pytest.mark.skipif(not confine.LINUX, reason="only Linux limits memory")
@pytest.mark.parametrize(
    ("code", "found"),
    [
        pytest.param("bytearray(3 * 2**30)", "MemoryError (line 1 of script.py)", id="at-once"),
        pytest.param("import numpy\nnumpy.ones(2**29)", None, id="numpy"),
    ],
)
def test_a_script_that_takes_gigabytes(code: str, found: str | None) -> None:
    said = refusal(code)
    assert said == found or (found is None and "Unable to allocate" in said)


@pytest.mark.skipif(not confine.LINUX, reason="only Linux counts shared memory")
def test_a_script_that_shares_gigabytes() -> None:
    code = "import mmap\na = mmap.mmap(-1, 4 * 2**30)\nwhile True:\n    a.write(b'x' * 2**26)\n"
    assert refusal(code) == "uses more than 2048 MiB of memory"


def test_a_file_that_grows_without_end() -> None:
    code = "f = open('big', 'wb')\nwhile True:\n    f.write(b'x' * 2**20)"
    assert refusal(code) == "OSError: [Errno 27] File too large (line 3 of script.py)"


@pytest.mark.skipif(not confine.LINUX, reason="only Linux refuses processes")
@pytest.mark.parametrize(
    "act",
    [
        "while True:\n    os.fork()",
        "os.fork() or (os.setsid(), os.fork(), os.environ.clear(), time.sleep(1000))",
        "subprocess.Popen([sys.executable, '-c', 'import time; time.sleep(1000)'], start_new_session=True)",
        "os.posix_spawn('/bin/true', ['true'], {})",
        "os.kill(os.getppid(), 9)",
    ],
)
def test_a_script_that_forks(act: str) -> None:
    assert "not permitted" in refusal(f"import os, subprocess, sys, time\n{act}")


@pytest.mark.skipif(not confine.LINUX, reason="only Linux tells of a process's descendants")
@pytest.mark.parametrize("detached", [True, False])
@pytest.mark.parametrize("ending", ["", "time.sleep(1000)"])
def test_children_end_with_their_script_where_no_filter_is_known(tmp_path: Path, detached: bool, ending: str) -> None:
    child = "import time; time.sleep(1000)"
    start = f"subprocess.Popen([sys.executable, '-c', {child!r}], start_new_session={detached}, env={{}})"
    order = {
        "command": [sys.executable, "-c", f"import subprocess, sys, time; {start}; {ending}"],
        "folder": str(tmp_path),
        "environment": {},
        "input": "",
        **asdict(Limits(seconds=1)),
    }
    code = f"from clinic import confine; confine.SYSTEMS = {{}}; print(confine.confine({order!r})['stopped'])"
    done = subprocess.run([sys.executable, "-c", code], check=True, capture_output=True, text=True)
    assert done.stdout.strip() == ("seconds" if ending else "")
    assert [cwd for cwd in Path("/proc").glob("[0-9]*/cwd") if _target(cwd) == str(tmp_path)] == []


def _target(link: Path) -> str:
    try:
        return str(link.readlink())
    except OSError:
        return ""


@kernel
@pytest.mark.parametrize(
    "act",
    [
        "open({path!r}, 'w')",
        "open({path!r}, 'a')",
        "open({path!r} + '.new', 'w')",
        "os.remove({path!r})",
        "os.rename({path!r}, 'mine')",
        "os.truncate({path!r}, 0)",
        "os.mkdir({path!r} + '.d')",
        "os.symlink('x', {path!r} + '.l')",
        "os.symlink({path!r}, 'l'); open('l', 'a')",
        "os.link({path!r}, 'l'); open('l', 'a')",
        "os.execvp('sh', ['sh', '-c', 'echo x > ' + {path!r}])",
    ],
)
def test_a_script_that_writes_elsewhere(outside: Path, act: str) -> None:
    said = refusal(f"import os, subprocess\n{act.format(path=str(outside))}")
    assert "Permission denied" in said or "cross-device" in said
    assert outside.read_text(encoding="utf-8") == "whole"
    assert list(outside.parent.iterdir()) == [outside]


@pytest.mark.skipif(not confine.LINUX, reason="only Linux refuses sockets")
@pytest.mark.parametrize(
    "act",
    [
        "socket.create_connection(('127.0.0.1', 9))",
        "socket.socket().bind(('127.0.0.1', 0))",
        "socket.socket(socket.AF_INET, socket.SOCK_DGRAM)",
        "socket.socket(socket.AF_UNIX)",
    ],
)
def test_a_script_that_opens_a_socket(act: str) -> None:
    assert "not permitted" in refusal(f"import socket\n{act}")


def test_a_script_sees_nothing_of_the_environment(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("A_SECRET_TOKEN", "x")
    seen = run_python("import os\nprint(*sorted(os.environ))\nprint(os.environ['HOME'] == os.getcwd())", {}).text
    assert "A_SECRET_TOKEN" not in seen
    assert seen.endswith("True\n")


def test_a_script_has_no_input() -> None:
    assert refusal("input()") == "EOFError: EOF when reading a line (line 1 of script.py)"


@kernel
@pytest.mark.skipif(node.program() is None, reason="no Node on this machine")
@pytest.mark.parametrize(
    ("code", "found"),
    [
        pytest.param("import fs from 'fs';\nfs.writeFileSync(PATH, 'x');", "permission denied", id="writes-elsewhere"),
        pytest.param("for (;;) {}", "still running after 3 s", id="loops"),
        pytest.param(
            "for (;;) { console.error('x'.repeat(1e5)); await new Promise(setImmediate); }",
            "prints more than 256000 bytes",
            id="prints",
        ),
        pytest.param("import net from 'net';\nnet.connect(9, '127.0.0.1');", "EPERM", id="opens-a-socket"),
    ],
)
def test_node_under_the_same_limits(outside: Path, code: str, found: str) -> None:
    with pytest.raises(ScriptError) as caught:
        run_node(code.replace("PATH", json.dumps(str(outside))), {}, time_limit=3 if code == "for (;;) {}" else 60)
    assert found in caught.value.found
    assert outside.read_text(encoding="utf-8") == "whole"
