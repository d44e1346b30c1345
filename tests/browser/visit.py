"""A visit to a page in a real browser: started offline, and asked what it loaded and complained of."""

from __future__ import annotations

import json
import os
import shutil
from pathlib import Path
from typing import Any

from selenium.webdriver import Chrome, ChromeOptions
from selenium.webdriver.chrome.service import Service
from selenium.webdriver.remote.webdriver import WebDriver
from selenium.webdriver.support.ui import WebDriverWait

CHROMIUM, CHROMEDRIVER = "/usr/bin/chromium", "/usr/bin/chromedriver"
MISSING = f"There is no {{}}: apt-get install chromium chromium-driver (as root) puts {CHROMIUM} and its driver there."
# Nothing of the browser's own may reach for the network, so that what does was asked for by the page.
_QUIET = (
    *("--headless=new", "--disable-gpu", "--disable-quic", "--no-first-run", "--disable-background-networking"),
    *("--disable-component-update", "--disable-sync", "--disable-default-apps", "--disable-dev-shm-usage"),
    *("--hide-scrollbars", "--force-color-profile=srgb", "--proxy-server=127.0.0.1:9"),
)
# Addresses that are in the page or beside it.
_OWN = ("file:", "data:", "blob:", "about:")


def start(profile: Path) -> WebDriver:
    """Start Chromium with an empty profile, logging its console and what it loads."""
    for program in (CHROMIUM, CHROMEDRIVER):
        if shutil.which(program) is None:
            raise FileNotFoundError(MISSING.format(program))
    options = ChromeOptions()
    options.binary_location = CHROMIUM
    for argument in (*_QUIET, f"--user-data-dir={profile}"):
        options.add_argument(argument)
    if os.geteuid() == 0:
        options.add_argument("--no-sandbox")
    options.set_capability("goog:loggingPrefs", {"browser": "ALL", "performance": "ALL"})
    return Chrome(options=options, service=Service(CHROMEDRIVER))


def resize(browser: WebDriver, width: int, height: int, touch: bool = False) -> None:
    """Give the page so many CSS pixels, as a phone with a finger where ``touch``."""
    screen = {"width": width, "height": height, "deviceScaleFactor": 1, "mobile": touch}
    browser.execute_cdp_cmd("Emulation.setDeviceMetricsOverride", screen)
    browser.execute_cdp_cmd("Emulation.setTouchEmulationEnabled", {"enabled": touch})


def console_errors(browser: WebDriver) -> list[str]:
    """Return what the console has said since the last call, warnings and errors."""
    return [entry["message"] for entry in browser.get_log("browser") if entry["level"] in ("WARNING", "SEVERE")]


def requested_addresses(browser: WebDriver) -> list[str]:
    """Return the addresses that were asked for since the last call, scripts, images and sockets included."""
    found = []
    for entry in browser.get_log("performance"):
        message: dict[str, Any] = json.loads(entry["message"])["message"]
        if message["method"] == "Network.requestWillBeSent":
            found.append(message["params"]["request"]["url"])
        elif message["method"] == "Network.webSocketCreated":
            found.append(message["params"]["url"])
    return found


def outside(addresses: list[str]) -> list[str]:
    """Return those addresses that need a network."""
    return [address for address in addresses if not address.startswith(_OWN)]


def open_explorer(browser: WebDriver, path: Path, choice: str = "") -> None:
    """Open the page and wait until it is drawn; ``choice`` is what follows the # of its address."""
    browser.get("about:blank")
    browser.get(path.resolve().as_uri() + (f"#{choice}" if choice else ""))
    settled(browser)


def settled(browser: WebDriver) -> str:
    """Wait until the page shows what its address says; return that."""
    script = "return document.body.dataset.shown === window.location.hash && window.location.hash"
    return str(WebDriverWait(browser, 20, poll_frequency=0.05).until(lambda _: browser.execute_script(script)))
