"""A visit to a page in a real browser: started offline, and asked what it loaded and complained of."""

from __future__ import annotations

import json
import os
import shutil
from pathlib import Path
from typing import Any

import axe_core_python
from selenium.webdriver import Chrome, ChromeOptions
from selenium.webdriver.chrome.service import Service
from selenium.webdriver.remote.webdriver import WebDriver
from selenium.webdriver.support.ui import WebDriverWait

CHROMIUM, CHROMEDRIVER = "/usr/bin/chromium", "/usr/bin/chromedriver"
MISSING = "There is no {}: apt-get install chromium chromium-driver, as root, puts it there."
# Nothing of the browser's own may reach for the network, so that what does was asked for by the page.
_QUIET = (
    *("--headless=new", "--disable-gpu", "--disable-quic", "--no-first-run", "--disable-background-networking"),
    *("--disable-component-update", "--disable-sync", "--disable-default-apps", "--disable-dev-shm-usage"),
    *("--hide-scrollbars", "--force-color-profile=srgb", "--proxy-server=127.0.0.1:9"),
)
# Addresses that are in the page or beside it.
_OWN = ("file:", "data:", "blob:", "about:")


def missing_program() -> str | None:
    """Return the path of what is not installed, if anything."""
    return next((program for program in (CHROMIUM, CHROMEDRIVER) if shutil.which(program) is None), None)


def start(profile: Path) -> WebDriver:
    """Start Chromium with an empty profile, logging its console and what it loads."""
    options = ChromeOptions()
    options.binary_location = CHROMIUM
    for argument in (*_QUIET, f"--user-data-dir={profile}"):
        options.add_argument(argument)
    if os.geteuid() == 0:
        options.add_argument("--no-sandbox")
    options.set_capability("goog:loggingPrefs", {"browser": "ALL", "performance": "ALL"})
    browser = Chrome(options=options, service=Service(CHROMEDRIVER))
    browser.set_script_timeout(120)  # on a machine that does much else too
    return browser


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


def open_explorer(browser: WebDriver, path: Path, choice: str = "", fresh: bool = False) -> None:
    """Have the page on the screen, drawn; ``choice`` is what follows the # of its address.

    It is loaded where another page is open, or where it has to be ``fresh``: loading takes longer than all the rest.
    """
    address = path.resolve().as_uri()
    drawn = browser.execute_script("return document.body !== null && 'shown' in document.body.dataset")
    if drawn and not fresh and browser.current_url.partition("#")[0] == address:
        show(browser, choice)
        return
    browser.get("about:blank")
    browser.get(address + (f"#{choice}" if choice else ""))
    settled(browser)


def settled(browser: WebDriver) -> str:
    """Wait until the page shows what its address says; return that."""
    script = "return document.body.dataset.shown === window.location.hash && window.location.hash"
    return str(WebDriverWait(browser, 20, poll_frequency=0.05).until(lambda _: browser.execute_script(script)))


def choose(browser: WebDriver, name: str, value: str) -> None:
    """Click the radio button of a name and a value."""
    browser.execute_script(
        "document.querySelector(`input[name=${arguments[0]}][value='${arguments[1]}']`).parentElement.click()",
        name,
        value,
    )
    settled(browser)


def place(browser: WebDriver, plot: str, x: float, y: float) -> tuple[float, float]:
    """Return where a point of a plot is on the screen, from its data."""
    script = """
    const plot = document.getElementById(arguments[0]);
    plot.scrollIntoView({ block: "center" });
    const box = plot.getBoundingClientRect(), { xaxis, yaxis } = plot._fullLayout;
    return [box.left + xaxis._offset + xaxis.d2p(arguments[1]), box.top + yaxis._offset + yaxis.d2p(arguments[2])];
    """
    left, top = browser.execute_script(script, plot, x, y)
    return left, top


def point_at(browser: WebDriver, spot: tuple[float, float]) -> None:
    """Move the mouse to a spot of the screen."""
    browser.execute_cdp_cmd("Input.dispatchMouseEvent", {"type": "mouseMoved", "x": spot[0], "y": spot[1]})


def hover_words(browser: WebDriver, plot: str, spot: tuple[float, float]) -> str:
    """Return what a plot tells about a spot that the mouse points at."""
    script = """
    return [...document.querySelectorAll(`#${arguments[0]} .hovertext .nums`)].map((one) => one.textContent).join(" ");
    """
    wait = WebDriverWait(browser, 5, poll_frequency=0.05)
    browser.execute_cdp_cmd("Input.dispatchMouseEvent", {"type": "mouseMoved", "x": 1, "y": 1})
    wait.until(lambda _: not browser.execute_script(script, plot))
    point_at(browser, spot)
    return str(wait.until(lambda _: browser.execute_script(script, plot)))


def click_at(browser: WebDriver, plot: str, spot: tuple[float, float]) -> None:
    """Click on a spot of a plot that tells something, and wait until the page shows what was chosen."""
    hover_words(browser, plot, spot)
    before = settled(browser)
    for kind in ("mousePressed", "mouseReleased"):
        event = {"type": kind, "x": spot[0], "y": spot[1], "button": "left", "clickCount": 1}
        browser.execute_cdp_cmd("Input.dispatchMouseEvent", event)
    WebDriverWait(browser, 5, poll_frequency=0.05).until(lambda _: settled(browser) != before)


def show(browser: WebDriver, choice: str) -> None:
    """Change what follows the # of the page's address, as a visitor may."""
    browser.execute_script("window.location.hash = arguments[0]", choice)
    settled(browser)


def words(browser: WebDriver, id_: str) -> str:
    """Return the text of an element, its narrow spaces made plain."""
    return " ".join(str(browser.execute_script("return document.getElementById(arguments[0]).innerText", id_)).split())


def traces(browser: WebDriver, plot: str) -> list[dict[str, Any]]:
    """Return what a plot draws."""
    script = """
    const told = ["name", "type", "mode", "yaxis", "x", "y", "z", "line"];
    return JSON.parse(JSON.stringify(document.getElementById(arguments[0]).data.map(
      (trace) => Object.fromEntries(told.filter((key) => key in trace).map((key) => [key, trace[key]])))));
    """
    found: list[dict[str, Any]] = browser.execute_script(script, plot)
    return found


def violations(browser: WebDriver) -> list[str]:
    """Return what axe-core finds against WCAG and good practice, contrast included: rule, count and first place."""
    browser.execute_script(Path(axe_core_python.__file__).with_name("axe.min.js").read_text(encoding="utf-8"))
    script = """
    const done = arguments[arguments.length - 1];
    const words = ({ html, failureSummary }) => `${html.slice(0, 120)} ${failureSummary.slice(0, 300)}`;
    axe.run({ resultTypes: ["violations"] }).then((found) => done(found.violations.map(
      ({ id, nodes }) => `${id} at ${nodes.length}: ${words(nodes[0])}`))).catch((error) => done([String(error)]));
    """
    return list(browser.execute_async_script(script))


def colours(browser: WebDriver, dark: bool = False, still: bool = False, media: str = "") -> None:
    """Have a visitor who prefers dark colours, or as little motion as can be; on paper where ``media`` is print."""
    preferred = {
        "prefers-color-scheme": "dark" if dark else "light",
        "prefers-reduced-motion": "reduce" if still else "",
    }
    features = [{"name": name, "value": value} for name, value in preferred.items()]
    browser.execute_cdp_cmd("Emulation.setEmulatedMedia", {"media": media, "features": features})
