"""A browser, and pages of small campaigns."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path

import pytest
from selenium.webdriver.remote.webdriver import WebDriver
from visit import console_errors, requested_addresses, resize, start


@pytest.fixture(scope="session")
def chromium(tmp_path_factory: pytest.TempPathFactory) -> Iterator[WebDriver]:
    """Return Chromium, started once."""
    browser = start(tmp_path_factory.mktemp("profile"))
    yield browser
    browser.quit()


@pytest.fixture
def browser(chromium: WebDriver) -> Iterator[WebDriver]:
    """Return Chromium on an empty page of 1400 by 900 pixels, its logs empty."""
    resize(chromium, 1400, 900)
    chromium.get("about:blank")
    console_errors(chromium)
    requested_addresses(chromium)
    yield chromium
    chromium.get("about:blank")
