"""Pages and cases for the playground."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path
from typing import Any

import pytest
from clinic.record.case import Case, read_cases
from playwright.sync_api import Browser, Page, ViewportSize

SMALL: ViewportSize = {"width": 600, "height": 600}  # drawing without a graphics card takes a processor
QUIET: Any = {"reduced_motion": "reduce"}  # nothing moves before it is asked to


def opened(browser: Browser) -> Iterator[Page]:
    context = browser.new_context(**QUIET, viewport=SMALL, bypass_csp=True)
    yield context.new_page()
    context.close()


tab = pytest.fixture(scope="module")(opened)
fresh = pytest.fixture(opened)


@pytest.fixture(scope="session")
def cases(root: Path) -> list[Case]:
    """The cases of models."""
    return [case for case in read_cases(root / "cases")[0] if case.record.model is not None]


@pytest.fixture
def page(tab: Page, served: str) -> Page:
    """The page of the test before, which has forgotten everything: a new one takes Chromium as long as the engine."""
    tab.goto("about:blank")
    tab.set_viewport_size(SMALL)
    tab.emulate_media(**QUIET, color_scheme="null")
    session = tab.context.new_cdp_session(tab)
    session.send("Storage.clearDataForOrigin", {"origin": served.rstrip("/"), "storageTypes": "all"})
    session.detach()
    return tab
