"""The page's diagnosis in a real browser: a model is given in each way, and what is found is shown, tried and kept."""

from __future__ import annotations

import json
import subprocess
import zipfile
from pathlib import Path

import pytest
from clinic.diagnosis.finding import FAILS, Diagnosis, remark
from clinic.diagnosis.rules import rules
from live import LIMIT, engines
from playwright.sync_api import Page, expect

pytestmark = pytest.mark.xdist_group("site")
SIZE = 7.2e6  # bytes, as the page says
ANSWER = ":is(.dg-report, .dg-error):not(.seen)"
STILL = '<mujoco><worldbody><geom name="slab" type="box" size="1 1 .1"/></worldbody></mujoco>'
DEEP = "<mujoco><worldbody>" + 400 * '<body><joint/><geom size="1"/>' + 400 * "</body>" + "</worldbody></mujoco>"
MESHED = """<mujoco><compiler meshdir="../meshes"/><asset><mesh name="wedge" file="wedge.obj"/></asset>
<worldbody><body><freejoint/><geom type="mesh" mesh="wedge"/></body></worldbody></mujoco>"""
WEDGE = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n"
DROP = """(place, files) => {
  const dataTransfer = new DataTransfer();
  for (const [name, bytes] of files) dataTransfer.items.add(new File([new Uint8Array(bytes)], name));
  place.dispatchEvent(new DragEvent("drop", { dataTransfer, bubbles: true, cancelable: true }));
}"""
TOP = "one => one.getBoundingClientRect().top"
BAD = rules()["spring-too-stiff"].example("Bad")
SWING = """
<mujoco>
  <worldbody>
    <body pos="0 0 1">
      <joint name="pivot" axis="0 1 0"/>
      <geom type="capsule" fromto="0 0 0 0.2 0 0" size="0.02" mass="0.2"/>
    </body>
  </worldbody>
</mujoco>
"""


def opened(page: Page, served: str) -> Page:
    page.goto(f"{served}index.html")
    return page


def give(page: Page, *files: Path) -> str:
    """Chooses files, or a folder, and gives what is said in the end."""
    page.locator(".dg-ask input").nth(int(files[0].is_dir())).set_input_files(files[0] if files[0].is_dir() else files)
    return answer(page)


def drop(page: Page, *files: Path) -> str:
    """Drops files."""
    page.locator(".dg-ask").evaluate(DROP, [[file.name, list(file.read_bytes())] for file in files])
    return answer(page)


def answer(page: Page) -> str:
    shown = page.locator(ANSWER)
    expect(shown).to_be_visible()
    said = shown.inner_text()
    shown.evaluate("(shown) => shown.className += ' seen'")
    return said


def written(path: Path, content: str | bytes) -> Path:
    path.parent.mkdir(parents=True, exist_ok=True)
    path.write_bytes(content.encode() if isinstance(content, str) else content)
    return path


def test_nothing_is_loaded_before_a_model_is_given_and_a_second_needs_no_network(
    fresh: Page, served: str, site: Path, tmp_path: Path
) -> None:
    asked: list[str] = []
    fresh.on("request", lambda request: asked.append(request.url.removeprefix(served)))
    opened(fresh, served)
    assert [url for url in asked if "playground" in url or "diagnosis" in url] == ["javascripts/playground/loader.js"]
    asked.clear()

    first = give(fresh, written(tmp_path / "shaking.xml", BAD))

    assert "spring-too-stiff" in first
    own = [url for url in asked if url.startswith("javascripts/")]
    assert sum((site / url).stat().st_size for url in own) == pytest.approx(SIZE, rel=0.05)
    ours = ("javascripts/", "assets/", "cases/", "blob:")  # the pictures of cards too, as they come in sight
    assert all(url.startswith(ours) for url in asked), asked

    fresh.context.set_offline(True)
    assert "spring-too-stiff" in give(fresh, written(tmp_path / "again.xml", BAD))


def test_what_was_measured_is_written_as_in_a_terminal(page: Page, served: str, tmp_path: Path) -> None:
    opened(page, served)
    said = give(page, written(tmp_path / "heavy.xml", rules()["denser-than-metal"].example("Bad")))
    assert "350 kg in 0.427 litres of geoms: 819,000 kg/m3." in said
    assert "Density: 819,000 kg/m3. With the edit: 819 kg/m3." in said


def test_the_findings_are_copied_and_the_mended_model_is_saved(page: Page, served: str, tmp_path: Path) -> None:
    page.context.grant_permissions(["clipboard-read", "clipboard-write"])
    opened(page, served)
    give(page, written(tmp_path / "shaking.xml", BAD))

    page.get_by_role("button", name="Copy as JSON").click()
    expect(page.get_by_role("button", name="Copied")).to_be_visible()
    copied = json.loads(page.evaluate("navigator.clipboard.readText()"))
    assert copied["file"] == "shaking.xml"
    (cause,) = copied["causes"]
    assert (cause["rule"], cause["attribute"]) == ("spring-too-stiff", "stiffness")

    page.get_by_role("button", name="Copy as text").click()
    page.wait_for_function("navigator.clipboard.readText().then((text) => text.startsWith('clinic diagnose'))")
    text = page.evaluate("navigator.clipboard.readText()")
    assert "rules (" in text, "what was ruled out is counted, not listed"
    assert "rolls-for-ever" not in text

    with page.expect_download() as download:
        page.get_by_role("button", name="Save the mended model").click()
    assert download.value.suggested_filename == "shaking.mended.xml"
    assert f'stiffness="{cause["value"]}"' in Path(download.value.path()).read_text(encoding="utf-8")


def test_an_edit_runs_beside_the_model_as_it_was(page: Page, served: str, tmp_path: Path) -> None:
    opened(page, served)
    give(page, written(tmp_path / "shaking.xml", BAD.replace("<mujoco>", "<mujoco>" + 300 * "\n")))

    page.get_by_role("button", name="Try this edit").click()

    expect(page.locator(".cm-deletedChunk")).to_be_in_viewport()
    measured = page.locator(".dg-found p", has_text="With the edit:").first.inner_text()
    expect(page.locator(".pg-beside")).to_contain_text(measured)
    expect(page.locator(".pg-status")).to_contain_text("This runs in MuJoCo")
    page.get_by_role("button", name="Run", exact=True).click()
    page.wait_for_function("document.querySelector('.pg-clock')?.dataset.steps > 0", timeout=LIMIT)
    expect(page.get_by_text("As it was: MuJoCo warns: Nan, Inf or huge value in QACC")).to_be_visible()
    page.locator(".pg-chart .u-over").hover(position={"x": 20, "y": 20})
    expect(page.locator(".pg-newest")).to_contain_text("with the edit 0, as it was 0")
    expect(page.locator(".pg-complaint")).to_be_empty()
    expect(page.locator(".pg-warnings")).to_be_empty()
    expect(page.get_by_role("button", name="Check my fix")).to_have_count(0)

    assert len(engines(page)) == 2


@pytest.mark.parametrize(
    ("rule", "told"),
    [
        ("armature-unlike-others", "armature: 100 → 0.1 Armature over that of the next: 1000. With the edit: 1."),
        ("rolls-for-ever", "condim: 3 → 6, friction 1 0.005 0.005 Try this edit"),
    ],
)
def test_a_hint_tells_its_edit_with_what_was_measured(
    page: Page, served: str, tmp_path: Path, rule: str, told: str
) -> None:
    opened(page, served)

    said = give(page, written(tmp_path / "hinted.xml", rules()[rule].example("Bad")))

    assert told in " ".join(said.split())
    page.locator("li", has_text=rule).get_by_role("button", name="Try this edit").click()
    expect(page.locator(".cm-deletedChunk").first).to_be_visible()


def test_an_edit_of_two_files_is_tried_and_what_is_silenced_is_told(page: Page, served: str, tmp_path: Path) -> None:
    skinned = """<mujoco><worldbody><body name="{0}" pos="{1} 0 2"><freejoint/>
    <geom size="0.05" contype="0" conaffinity="0"/><geom size="0.05" mass="0.2"/></body></worldbody></mujoco>"""
    parts = [written(tmp_path / f"{name}.xml", skinned.format(name, x)) for x, name in enumerate(("left", "right"))]
    silent = '<!-- clinic: ignore[nothing-lit] drawn elsewhere --><visual><headlight active="0"/></visual>'
    includes = "".join(f'<include file="{part.name}"/>' for part in parts)
    opened(page, served)

    said = drop(page, written(tmp_path / "scene.xml", f"<mujoco>{silent}{includes}</mujoco>"), *parts)

    assert "visual-mass" in said
    assert "Silenced by comments in the model: one finding" in said
    page.locator("li", has_text="visual-mass").get_by_role("button", name="Try this edit").click()
    expect(page.locator(".pg-file")).to_contain_text("scene.xml")
    expect(page.locator(".cm-deletedChunk").first).to_be_visible()
    expect(page.locator(".pg-status")).to_contain_text("This runs in MuJoCo")
    expect(page.locator(".pg-complaint")).to_be_empty()


def test_a_folder_and_a_zip_bring_their_meshes(page: Page, served: str, tmp_path: Path) -> None:
    robot = tmp_path / "robot"
    written(robot / "models" / "wedge.xml", MESHED)
    written(robot / "meshes" / "wedge.obj", WEDGE)
    with zipfile.ZipFile(tmp_path / "robot.zip", "w") as packed:
        for path in robot.rglob("*.*"):
            packed.write(path, path.relative_to(tmp_path))
        packed.writestr("__MACOSX/robot/models/._wedge.xml", b"\0\1\2")
    opened(page, served)

    assert drop(page, tmp_path / "robot.zip").startswith("wedge.xml was run by MuJoCo")
    assert give(page, robot).startswith("wedge.xml was run by MuJoCo")
    alone = give(page, robot / "models" / "wedge.xml")
    assert "wedge.obj is not there" in alone
    assert "Drop the model's folder" in alone
    lacking = give(page, robot / "models")
    assert "wedge.obj is not there" in lacking
    assert "Drop the model's folder" not in lacking


def test_of_several_models_one_is_chosen(page: Page, served: str, tmp_path: Path) -> None:
    part = written(tmp_path / "part.xml", "<mujoco><worldbody><geom size='1'/></worldbody></mujoco>")
    scene = written(tmp_path / "scene.xml", '<mujoco><include file="part.xml"/></mujoco>')
    opened(page, served)

    assert drop(page, part, scene, written(tmp_path / "shaking.xml", BAD)).startswith("scene.xml was run")
    chooser = page.get_by_label("Model")
    assert chooser.locator("option").all_text_contents() == ["scene.xml", "shaking.xml"]
    chooser.select_option("shaking.xml")

    assert answer(page).startswith("shaking.xml was run")


@pytest.mark.parametrize(
    ("name", "content", "said"),
    [
        ("deep.xml", DEEP, "deep.xml: MuJoCo ended (RuntimeError"),
        ("binary.xml", bytes(range(256)), "binary.xml: this is not a text in UTF-8"),
        ("huge.xml", b" " * 25_000_000, "huge.xml: the text has 25 MB; this page reads up to 20 MB"),
        ("notes.txt", "no model", "There is no MJCF or URDF file among these"),
        ("torn.zip", "no zip", "torn.zip cannot be unpacked"),
        ("bomb.zip", "", "bomb.zip: more than 300 MB"),
        ("empty.xml", "", "empty.xml does not compile"),
    ],
    ids=["deep", "binary", "huge", "notes", "torn", "bomb", "empty"],
)
def test_what_cannot_be_diagnosed_is_said_in_a_sentence(
    page: Page, served: str, tmp_path: Path, name: str, content: str | bytes, said: str
) -> None:
    given = written(tmp_path / name, content)
    if name == "bomb.zip":
        with zipfile.ZipFile(given, "w", zipfile.ZIP_DEFLATED) as packed:
            packed.writestr("model.xml", b" " * 301_000_000)
    opened(page, served)

    assert said in give(page, given)

    assert give(page, written(tmp_path / "still.xml", STILL)).startswith("still.xml was run")


def test_rules_that_had_no_time_are_listed_and_of_a_failure_there_is_no_page(fresh: Page, root: Path) -> None:
    command = ["node_modules/.bin/esbuild", "docs/playground/diagnosis/report.js", "--bundle", "--global-name=made"]
    fresh.add_script_tag(content=subprocess.run(command, cwd=root, capture_output=True, text=True, check=True).stdout)
    hints = (remark(FAILS, "A rule failed", "masks failed.", "still.xml"),)
    made = Diagnosis("4.0.0", "still.xml", (), hints, (), (), untried=("tilted-ground", "visual-mass"))
    shown = {"data": made.data(), "text": "", "diff": "", "texts": {}, "mended": {}, "edited": [{}], "titles": {}}

    fresh.evaluate("(shown) => document.body.append(made.report(shown, {name: 'still.xml'}, 'rules/'))", shown)

    fresh.get_by_text("No time was left for 2 rules").click()
    expect(fresh.get_by_role("link", name="tilted-ground")).to_be_visible()
    expect(fresh.get_by_text(FAILS)).to_be_visible()
    expect(fresh.get_by_role("link", name=FAILS)).to_have_count(0)


def test_it_stops(page: Page, served: str, tmp_path: Path) -> None:
    opened(page, served)
    page.locator(".dg-ask input").first.set_input_files(written(tmp_path / "still.xml", STILL))
    page.get_by_role("button", name="Stop").click()

    assert answer(page) == "still.xml: Stopped."
    assert give(page, tmp_path / "still.xml").startswith("still.xml was run")


def test_the_symptom_and_everything_shown_have_names(page: Page, served: str, root: Path, tmp_path: Path) -> None:
    page.goto(f"{served}rules/index.html")
    page.get_by_label("What do you see?").select_option("explodes")
    give(page, written(tmp_path / "shaking.xml", BAD))
    page.get_by_role("button", name="Try this edit").click()
    expect(page.locator(".pg-status")).to_contain_text("This runs in MuJoCo")
    page.add_script_tag(path=root / "node_modules/axe-core/axe.min.js")

    found = page.evaluate(
        "axe.run('.diagnose').then(({ violations }) => violations.map(({ id, nodes }) => [id, nodes[0].html]))"
    )

    assert found == []


def test_what_the_reader_sees_can_be_said_afterwards(page: Page, served: str, tmp_path: Path) -> None:
    page.goto(f"{served}rules/index.html")
    text = give(page, written(tmp_path / "swing.xml", SWING))
    assert "Choose above what you see" in text
    assert "hint" not in text

    page.get_by_label("What do you see?").select_option("oscillates")

    text = answer(page)
    assert "no cause, one hint" in text
    assert "Choose above what you see" not in text


def test_what_is_found_is_read_on_the_first_page(page: Page, served: str, root: Path, tmp_path: Path) -> None:
    page.set_viewport_size({"width": 1280, "height": 900})
    opened(page, served)
    give(page, written(tmp_path / "shaking.xml", BAD))
    page.add_script_tag(path=root / "node_modules/axe-core/axe.min.js")

    for scheme in ("default", "slate"):
        page.evaluate("scheme => document.body.setAttribute('data-md-color-scheme', scheme)", scheme)
        found = page.evaluate(  # white on white is incomplete to axe, and no violation
            "axe.run('.drop', { runOnly: 'color-contrast' }).then(({ violations, incomplete }) =>"
            "[...violations, ...incomplete].flatMap(({ nodes }) => nodes.map(({ html }) => html)))"
        )
        assert found == []


def test_on_a_phone_all_stays_where_the_model_is_given(page: Page, served: str, tmp_path: Path) -> None:
    page.set_viewport_size({"width": 390, "height": 700})
    opened(page, served)
    place, tiles, stop = page.locator(".dg-ask"), page.locator(".tiles"), page.get_by_role("button", name="Stop")
    expect(page.get_by_label("What do you see?")).to_be_visible()
    place.evaluate("place => place.scrollIntoView({ block: 'end' })")

    page.locator(".dg-ask input").first.set_input_files(written(tmp_path / "still.xml", STILL))
    expect(stop).to_be_in_viewport(ratio=1)
    stop.click()

    assert answer(page) == "still.xml: Stopped."
    assert place.evaluate(TOP) < tiles.evaluate(TOP)


def test_opened_as_files_the_page_says_what_it_wants(page: Page, site: Path) -> None:
    page.goto(f"{site.as_uri()}/index.html")
    expect(page.get_by_text("In a page from a server, with JavaScript, your model can be given here.")).to_be_visible()
    expect(page.locator(".dg-ask")).to_be_hidden()
