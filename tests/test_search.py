"""The built search, asked through the very engine the page uses: its worker, its index and its settings."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

import pytest
from clinic.pages.messages import load_messages
from clinic.record.case import read_cases
from playwright.sync_api import Browser

pytestmark = pytest.mark.xdist_group("site")
FIRST = 3
MESSAGES = "messages.html"
ASK = """async (queries) => {
  const config = JSON.parse(document.getElementById("__config").textContent);
  const index = await (await fetch("search/search_index.json")).json();
  const worker = new Worker(config.search);
  const [SETUP, READY, QUERY, RESULT] = [0, 1, 2, 3];
  const tell = (type, data, wanted) => new Promise((done) => {
    worker.onmessage = (event) => event.data.type === wanted && done(event.data.data);
    worker.postMessage({type, data});
  });
  await tell(SETUP, {...index, options: {suggest: false}}, READY);
  const answers = [];
  for (const query of queries) {
    const result = await tell(QUERY, query, RESULT);
    answers.push(result.items.map((sections) => sections[0].location.split("#")[0]));
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
    "empty-pixels-have-depth": ["depth image background value", "mean depth is wrong", "depth of the sky"],
    "javascript-view-goes-dead": ["javascript qpos array stops updating", "wasm memory growth typed array detached"],
    "rotation-error-reads-zero": ["arccos of quaternion product is zero", "orientation error is exactly zero"],
    "balances-only-in-the-viewer": [
        "controller works in viewer but not headless",
        "falls when run faster than real time",
    ],
    "joint-snaps-at-start": ["joint jumps when simulation starts", "unexpected contact between parent and child body"],
    "drone-will-not-hover": ["robot is too heavy", "visual mesh adds mass"],
    "box-sinks-into-floor": ["object sinks into the floor", "high friction penetration"],
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

Ask = Callable[[list[str]], list[list[str]]]


@pytest.fixture(scope="module")
def ask(browser: Browser, served: str) -> Ask:
    """The pages that each query finds, best first."""
    page = browser.new_page()
    page.goto(served + "index.html")
    return lambda queries: page.evaluate(ASK, queries)


def check(ask: Ask, wanted: list[tuple[str, str]], repair: str) -> None:
    """Asserts that each query finds its page among the first results."""
    answers = ask([query for query, _ in wanted])
    missed = [
        f"{query!r} finds {found[:FIRST]}, not {page}"
        for (query, page), found in zip(wanted, answers, strict=True)
        if page not in found[:FIRST]
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
