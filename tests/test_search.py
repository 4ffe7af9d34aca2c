"""The search of the built site, asked in its own box."""

from __future__ import annotations

import re
from collections.abc import Callable
from pathlib import Path
from typing import TypedDict

import pytest
from clinic.pages.messages import load_messages
from clinic.record.case import read_cases
from playwright.sync_api import Browser, Page, expect

pytestmark = pytest.mark.xdist_group("site")
FIRST = 3
MESSAGES = "messages.html"
ASK = """async (queries) => {
  const box = document.querySelector(".search input");
  const place = document.querySelector(".search-results");
  const answers = [];
  for (const query of queries) {
    box.value = query;
    box.dispatchEvent(new Event("input"));
    while (place.hidden) await new Promise((done) => setTimeout(done));
    const at = document.baseURI.lastIndexOf("/") + 1;
    const links = [...place.querySelectorAll("ol a")].map((link) => link.href.slice(at));
    answers.push({links, covered: !place.innerText.includes("Nothing here")});
  }
  return answers;
}"""
QUERIES = {
    "box-falls-through-floor": [
        "object falls through ground",
        "my robot falls through the floor",
        "contype conaffinity not colliding",
        "contacts are not detected",
    ],
    "arm-explodes": [
        "simulation explodes",
        "why does my simulation blow up after a few steps",
        "Nan, Inf or huge value in QACC at DOF 0. The simulation is unstable.",
        "while data.time < T loop never ends",
    ],
    "elbow-will-not-bend": [
        "joint does not move although motor applies torque",
        "joint limit in degrees or radians",
        "elbow joint stuck at small angle",
    ],
    "grasp-slips": ["gripper drops the object", "can't pick up object with gripper", "friction coefficient ignored"],
    "gravity-ignores-forearm": ["arm does not fall under gravity", "pendulum does not swing", "hinge axis wrong"],
    "small-stack-is-slow": [
        "mj_step slow many contacts",
        "visual geoms collide too",
        "too many contacts simulation slower than real time",
    ],
    "film-in-slow-motion": [
        "video plays in slow motion",
        "rendered video too slow fps timestep",
        "rendering every step takes long",
    ],
    "camera-upside-down": ["camera upside down", "rendered image is flipped", "how to orient camera xyaxes"],
    "ball-passes-through-shelf": [
        "ball goes through thin wall",
        "bullet passes through table",
        "contact too soft penetration solref",
    ],
    "servo-sags": ["position actuator does not reach target", "robot arm sags under its weight", "kp too low"],
    "box-on-its-side": ["quaternion order xyzw or wxyz", "object has wrong orientation", "scipy rotation quaternion"],
    "servo-oscillates": ["position servo oscillates around target", "overshoot kp kv", "pd controller vibration"],
    "stale-first-observation": [
        "site_xpos wrong after reset",
        "xpos is not updated after setting qpos",
        "first observation of episode is wrong gym",
    ],
    "satellite-turns-about-wrong-axis": [
        "angular velocity of free joint in world or body frame",
        "when I add some angular velocity the box rotates with its own coordinate system",
        "qvel of floating body frame",
    ],
    "marker-trails-hand": [
        "mj_forward modifies jacobian when called after mj_step",
        "xpos does not match qpos",
        "site position lags behind by one step",
    ],
    "same-action-ends-elsewhere": [
        "same action from same state can result in different next states",
        "save and restore simulation state",
        "are environments deterministic set_state",
    ],
    "misaligned-log": [
        "replay of recorded actions gives different trajectory",
        "simulation is not reproducible",
        "behavior cloning dataset actions shifted by one",
    ],
    "hard-coded-index": [
        "wrong joint after adding an object to the scene",
        "qpos index of a joint by name",
        "get joint by name",
    ],
    "log-repeats-one-row": ["only two unique values in the array", "qpos in my list are all the same"],
    "mug-falls-through-table": [
        "randomizing the size of box geoms makes them partially penetrable",
        "geom_rbound not updated",
    ],
    "arm-turns-too-fast": ["body_mass changed at runtime", "call mj_setConst after changing body masses"],
    "empty-pixels-have-depth": ["depth image background value", "mean depth is wrong", "depth of the sky"],
    "javascript-view-goes-dead": ["javascript qpos array stops updating", "wasm memory growth typed array detached"],
    "rotation-error-reads-zero": ["arccos of quaternion product is zero", "orientation error is exactly zero"],
    "balances-only-in-the-viewer": [
        "controller works in viewer but not headless",
        "falls when run faster than real time",
    ],
    "joint-snaps-at-start": ["joint jumps when simulation starts", "unexpected contact between parent and child body"],
    "drone-will-not-hover": ["robot is too heavy", "visual mesh adds mass"],
    "linkage-jumps-at-start": ["connect equality constraints not satisfied", "closed loop mechanism joint disengages"],
    "mug-missing-in-image": ["object not visible in rendered image", "geom has contacts but cannot be seen"],
    "first-image-is-black": ["got a totally black image from render", "black pixels from renderer"],
    "heavy-base-spins": ["base spins at infinite speed with the slightest force", "unrealistic diaginertia of base"],
    "box-sinks-into-floor": ["object sinks into the floor", "high friction penetration"],
    "arm-stops-short": ["robot arm cannot lift", "raising kp does nothing", "forcerange clamps actuator force"],
    "force-sensor-reads-zero": ["why is the force sensor value 9.81", "net contact force does not match the weight"],
    "touch-sensor-reads-zero": ["only getting 0 from touch sensor", "touch sensor does not capture contact force"],
    "crate-slides-off-table": ["friction does nothing", "object slides like on ice", "frictionless contact condim"],
}
TEXTS = [
    "WARNING: Pre-allocated contact buffer is full. Increase nconmax above 100. Time = 0.0000.",
    "Inertia matrix is too close to singular at DOF 3. Check model.",
    "mass and inertia of moving bodies must be larger than mjMINVAL",
    "inertia must satisfy A + B >= C; use 'balanceinertia' to fix",
    "free joint can only be used on top level",
    "more than 6 dofs in body",
    "XML Error: Schema violation: unrecognized attribute",
    "XML parse error 7 XML_ERROR_PARSING_ATTRIBUTE",
    "repeated name 'floor' in geom",
    "Error opening file stl",
    "resource not found via provider or OS filesystem",
    "mesh volume is too small",
    "keyframe invalid qpos size",
    "unknown transmission target",
    "could not initialize GLFW",
    "Image width 1920 > framebuffer width 640",
    "mj_stackAlloc: out of memory, stack overflow",
    "could not broadcast input array from shape",
]

FOREIGN = [
    "how to install ros2 control with docker",
    "reward shaping for quadruped locomotion ppo",
    "blender export animation to video",
    "best gpu for reinforcement learning",
    "price of a commercial seat",
    "pip install fails on windows arm",
    "fluid drag coefficient for a fish",
    "muscle activation dynamics time constant",
    "export a trajectory to csv",
    "lidar point cloud",
]


class Answer(TypedDict):
    """The addresses that a query finds, best first, and whether the page says that it is about something here."""

    links: list[str]
    covered: bool


Ask = Callable[[list[str]], list[Answer]]


@pytest.fixture(scope="module")
def ask(browser: Browser, served: str) -> Ask:
    """What each query finds."""
    page = browser.new_page()
    page.goto(served + "index.html")
    return lambda queries: page.evaluate(ASK, queries)


def check(ask: Ask, wanted: list[tuple[str, str]], repair: str) -> None:
    """Asserts that each query finds its page among the first results, and that none is told to be foreign."""
    answers = ask([query for query, _ in wanted])
    missed = [
        f"{query!r} finds {answer['links'][:FIRST]}, not {page}; told to be covered: {answer['covered']}"
        for (query, page), answer in zip(wanted, answers, strict=True)
        if page not in [link.partition("#")[0] for link in answer["links"][:FIRST]] or not answer["covered"]
    ]
    assert not missed, "\n".join([repair, *missed])


def test_queries_find_their_case(ask: Ask, root: Path) -> None:
    there = {path.name for path in (root / "cases").iterdir()}
    wanted = [(query, f"cases/{slug}/index.html") for slug in QUERIES if slug in there for query in QUERIES[slug]]
    check(ask, wanted, "add to the case's `phrases` what people type")


def test_every_phrase_of_a_record_finds_its_case(ask: Ask, root: Path) -> None:
    wanted = [
        (phrase, f"cases/{case.slug}/index.html")
        for case in read_cases(root / "cases")[0]
        for phrase in case.record.phrases
    ]
    check(ask, wanted, "make the phrase say more of what is particular to the case")


def test_pasted_messages_find_their_meaning(ask: Ask) -> None:
    titles = [(message.title.replace("`", ""), MESSAGES) for message in load_messages()]
    check(ask, [(text, MESSAGES) for text in TEXTS] + titles, "put the text into `title`, or under `older`")


def test_words_in_the_same_order_come_before_the_same_words_apart(ask: Ask) -> None:
    first = {
        "robot falls through the floor": "cases/box-falls-through-floor/index.html#answer",
        "Nan, Inf or huge value in QACC at DOF 7": "messages.html#bad-qacc",
        "unrecognized attribute": "messages.html#unrecognized-attribute",
    }
    assert [answer["links"][0] for answer in ask([*first])] == [*first.values()]


def test_typos_and_beginnings_find_the_case_too(ask: Ask) -> None:
    wanted = {
        "griper drops the cub": "grasp-slips",
        "quaternoin order": "box-on-its-side",
        "overshoo": "servo-oscillates",
    }
    check(ask, [(query, f"cases/{slug}/index.html") for query, slug in wanted.items()], "mend docs/playground/search")


def test_what_is_not_covered_is_told_so(ask: Ask) -> None:
    told = [query for query, answer in zip(FOREIGN, ask(FOREIGN), strict=True) if answer["covered"]]
    assert not told, "raise COVERED in docs/playground/search/index.js, or is it covered now?"


def test_a_sentence_that_is_not_covered_is_asked_for_its_likeliest_symptom_first(page: Page, served: str) -> None:
    page.goto(served)
    page.locator(".search input").first.fill("my excavator's bucket chatters and slips on gravel")
    links = page.locator(".search-results p a")
    expect(links.first).to_have_attribute("href", re.compile("symptoms/oscillates.html"))
    expect(links.nth(1)).to_have_attribute("href", re.compile("symptoms/slips.html"))


def test_a_symptom_is_enough_whatever_robot_has_it(ask: Ask) -> None:
    told = {"quadruped explodes": "explodes", "go2 unstable": "explodes", "my hexapod's tibia wobbles": "oscillates"}
    for (query, family), answer in zip(told.items(), ask(list(told)), strict=True):
        assert answer["covered"], query
        assert any(f"symptoms/{family}.html" in link for link in answer["links"]), answer["links"]


def test_nothing_is_fetched_before_the_first_letter(page: Page, served: str) -> None:
    asked: list[str] = []
    page.on("request", lambda request: asked.append(request.url))
    page.goto(served + "messages.html")
    box = page.locator(".search-header input")
    box.focus()
    assert not [url for url in asked if "search" in url]
    box.press_sequentially("depth")
    expect(page.locator(".search-results li").first).to_contain_text("depth")
    box.press("ArrowDown")
    with page.expect_navigation():
        page.keyboard.press("Enter")
    assert "empty-pixels-have-depth" in page.url


def test_answers_are_searched_by_who_asks_for_them(page: Page, served: str) -> None:
    page.goto(served + "index.html")
    box = page.locator(".search-home input")
    box.fill("mju_subQuat")
    results = page.locator(".search-home .search-results")
    expect(results).to_contain_text("Nothing here is about")
    results.get_by_role("button", name="Search the answers too").click()
    expect(results.locator("a").first).to_have_attribute("href", re.compile("rotation-error-reads-zero"))


def test_on_a_phone_no_button_lies_over_the_open_box(page: Page, served: str) -> None:
    page.set_viewport_size({"width": 390, "height": 800})
    page.goto(served + "messages.html")
    box = page.locator(".search-header input")
    box.fill("nan")
    uncovered = """box => {
      const { left, right, top, bottom } = box.getBoundingClientRect();
      const met = document.elementFromPoint(right - (bottom - top) / 2, (top + bottom) / 2);
      return met === box && left > 0 && right < innerWidth;
    }"""
    assert box.evaluate(uncovered), "what clears the box is pressed instead of another button"


def test_it_runs_from_files(page: Page, site: Path) -> None:
    page.goto((site / "messages.html").as_uri())
    page.locator(".search-header input").fill("box falls through the floor")
    expect(page.locator(".search-results li").first).to_contain_text("falls", ignore_case=True)


def test_a_page_that_is_not_there_names_the_nearest(page: Page, served: str, site: Path) -> None:
    page.route("**/cases/box-falls-thru-flor/", lambda route: route.fulfill(path=site / "404.html", status=404))
    page.goto(served + "cases/box-falls-thru-flor/")
    expect(page.locator(".nearest a")).to_have_attribute("href", re.compile("cases/box-falls-through-floor/index.html"))
    expect(page.locator(".search-page input")).to_be_visible()
