"""What a visitor does with the page beside looking: play, save, compare, in other units, with eyes or without."""

from __future__ import annotations

import re
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import pandas as pd
import pytest
from matplotlib.image import imread
from selenium.webdriver.common.keys import Keys
from selenium.webdriver.remote.webdriver import WebDriver
from selenium.webdriver.support.ui import WebDriverWait
from visit import choose, colours, console_errors, open_explorer, resize, settled, show, traces, violations, words

from rubfric.pages.explorer.data import payload
from rubfric.pages.explorer.page import page
from rubfric.pages.render import write_page

PLAYING = "return playing === null ? null : [playing.moves, playing.moving.length]"
PICTURE = "return document.querySelector('#passing canvas').toDataURL()"


def ended(browser: WebDriver) -> None:
    WebDriverWait(browser, 20, poll_frequency=0.05).until(lambda _: browser.execute_script(PLAYING) is None)
    settled(browser)


@pytest.fixture
def beside(whole: Any, tmp_path: Path) -> Path:
    """Return the page of the campaign without pictures, with another rubber that has 1.1 times the friction."""
    other = whole.totals.assign(
        **{name: 1.1 * whole.totals[name] for name in ("friction_total", "friction_total_error")}
    )
    path = tmp_path / "explorer.html"
    pair = {"softer on road": other}
    write_page(page(payload(whole.campaign, whole.totals, [], 0.75, "road", others=pair)), path)
    return path


def test_road_passes_under_the_block_from_speed_to_speed(browser: WebDriver, whole: Any) -> None:
    open_explorer(browser, whole.path, "scale=1&view=curves&pressure=0.5&speed=100", fresh=True)
    button = browser.find_element("id", "play")
    button.send_keys(Keys.ENTER)
    WebDriverWait(browser, 10, poll_frequency=0.05).until(lambda _: browser.execute_script(PLAYING) == [True, 1])
    assert button.text.endswith("Pause")
    pictures = set()
    WebDriverWait(browser, 10, poll_frequency=0.05).until(
        lambda _: pictures.add(browser.execute_script(PICTURE)) or len(pictures) > 2  # type: ignore[func-returns-value]
    )
    assert "The road passes under the block" in words(browser, "caption")
    button.send_keys(Keys.ESCAPE)
    ended(browser)
    assert settled(browser).endswith("speed=100")
    assert browser.execute_script("return document.getElementById('passing').hidden")
    browser.execute_script("PLAY.dwell = 150")
    for place in ("1", "whole", "total"):
        show(browser, f"scale={place}&speed=1")
        button.send_keys(Keys.SPACE)
        ended(browser)
        assert settled(browser).endswith("speed=10000")
    assert button.text.endswith("Play all speeds")
    # From the end it begins anew; who chooses a speed ends it.
    button.send_keys(Keys.ENTER)
    browser.find_element("id", "speed").send_keys(Keys.END)
    ended(browser)
    assert not console_errors(browser)


def test_who_wants_no_motion_sees_the_speeds_alone(browser: WebDriver, whole: Any) -> None:
    colours(browser, still=True)
    try:
        open_explorer(browser, whole.path, "scale=1&view=curves&pressure=0.5&speed=1", fresh=True)
        browser.execute_script("PLAY.still = 150; document.getElementById('play').click()")
        assert browser.execute_script(PLAYING)[0] is False
        assert browser.execute_script("return document.getElementById('passing').hidden")
        ended(browser)
        assert settled(browser).endswith("speed=10000")
    finally:
        colours(browser)


def test_speeds_have_their_ticks_and_three_units(browser: WebDriver, whole: Any) -> None:
    open_explorer(browser, whole.path, "scale=1&view=curves&pressure=0.5&speed=100")
    assert words(browser, "speed-ticks") == "1 100 1000 10 000"
    choose(browser, "unit", "km/h")
    assert settled(browser).endswith("&speed=100&unit=km/h")
    assert words(browser, "speed-ticks") == "0.0036 0.36 3.6 36"
    assert words(browser, "speed-value") == "0.36 km/h"
    assert words(browser, "speed-others") == "100 mm/s · 0.1 m/s"
    assert words(browser, "scene-title") == "Scale 1 at 0.36 km/h, 0.5 MPa"
    ticks = browser.execute_script("const { tickvals, ticktext } = chart.layout.xaxis; return [tickvals, ticktext]")
    assert {1.0, 100.0, 1000.0, 10000.0} <= set(ticks[0])
    named = {text: speed for speed, text in zip(*ticks, strict=True) if text}
    assert named["1"] == pytest.approx(1.0 / 3.6e-3)
    choose(browser, "unit", "mm/s")


def test_points_that_carry_a_warning_are_marked(browser: WebDriver, whole: Any) -> None:
    warned = {place for place, scene in whole.scenes.items() if scene.attrs["warnings"]}
    assert warned
    assert warned != set(whole.scenes)
    for scale in (1, 2):
        show_marks = {(speed, pressure) for number, speed, pressure in warned if number == scale}
        open_explorer(browser, whole.path, f"scale={scale}&view=curves&pressure=0.5&speed=1")
        marks = next(trace for trace in traces(browser, "chart") if trace.get("name") == "warnings")
        places = {(speed, whole.at("friction_coefficient", scale, speed, pressure)) for speed, pressure in show_marks}
        assert len(marks["x"]) == len(places)
        for speed, friction in zip(marks["x"], marks["y"], strict=True):
            assert any(speed == one and friction == pytest.approx(other, rel=1e-7) for one, other in places)


def test_another_rubber_is_laid_over_the_total(browser: WebDriver, whole: Any, beside: Path) -> None:
    open_explorer(browser, beside, "scale=total&view=curves&pressure=0.5&speed=100", fresh=True)
    assert settled(browser).endswith("&with=1")
    row = whole.totals.query("pressure_MPa == 0.5")
    other = next(trace for trace in traces(browser, "chart") if trace.get("name") == "softer on road")
    assert other["y"] == pytest.approx((1.1 * row["friction_total"]).tolist(), rel=1e-6)
    assert re.match(r"softer on road: μ = \d\.\d+ ± \d\.\d+ \(\+0\.\d+\)", words(browser, "beside"))
    choose(browser, "beside", "0")
    assert settled(browser).endswith("&with=")
    assert not [trace for trace in traces(browser, "chart") if trace.get("name") == "softer on road"]
    show(browser, "scale=1")
    assert browser.execute_script("return document.getElementById('comparison').hidden")
    assert not console_errors(browser)


def test_what_is_shown_is_saved(browser: WebDriver, whole: Any, tmp_path: Path) -> None:
    browser.execute_cdp_cmd("Browser.setDownloadBehavior", {"behavior": "allow", "downloadPath": str(tmp_path)})

    def saved(button: str, name: str) -> Path:
        browser.find_element("id", button).send_keys(Keys.ENTER)
        path = tmp_path / name
        WebDriverWait(browser, 20, poll_frequency=0.05).until(lambda _: path.is_file())
        return path

    colours(browser, dark=True)
    try:
        open_explorer(browser, whole.path, "scale=1&view=curves&pressure=5&speed=100", fresh=True)
        table = pd.read_csv(saved("chart-csv", "made-up_road_scale-1_curves.csv"))
        row = table.query("velocity_mm_per_s == 100 and pressure_MPa == 5").iloc[0]
        assert len(table) == 8
        assert row["friction"] == pytest.approx(whole.at("friction_coefficient", 1, 100.0, 5.0), rel=1e-7)
        assert row["warnings"] == len(whole.scenes[1, 100.0, 5.0].attrs["warnings"].splitlines())
        load = pd.read_csv(saved("scene-csv", "made-up_road_scale-1_5MPa_100mm_per_s.csv"))
        largest = load["contact_pressure_per_undeformed_area_MPa"].max()
        assert largest == pytest.approx(float(whole.scenes[1, 100.0, 5.0].contact_pressure.max()), rel=1e-4)
        picture = imread(saved("scene-png", "made-up_road_scale-1_5MPa_100mm_per_s.png"))
        assert picture.shape[1] == 2096
        assert np.array_equal(picture[5, 5], [1.0] * 4)  # light, whatever the page is
        assert len(np.unique(picture[::9, ::9].reshape(-1, 4), axis=0)) > 500
        show(browser, "scale=total&speed=1000")
        total = pd.read_csv(saved("scene-csv", "made-up_road_total_5MPa_1000mm_per_s.csv"))
        parts = total["friction_scale_1"] + total["friction_scale_2"]
        assert total["friction_sum"].to_numpy() == pytest.approx(parts.to_numpy(), rel=1e-6)
        assert imread(saved("chart-png", "made-up_road_total_curves.png")).shape[0] > 800
        assert not console_errors(browser)
    finally:
        colours(browser)


@pytest.mark.parametrize("dark", [False, True], ids=["light", "dark"])
def test_nothing_keeps_anyone_out(browser: WebDriver, whole: Any, measured: Any, beside: Path, dark: bool) -> None:
    wide = [(measured.path, "scale=whole&speed=1&road=1"), (beside, "scale=total&view=curves")]
    colours(browser, dark=dark)
    try:
        for path, choice in [*(() if dark else wide), (whole.path, "scale=total&view=curves&pressure=0.5&speed=10000")]:
            open_explorer(browser, path, choice)
            assert violations(browser) == []
        resize(browser, 390, 800, touch=True)
        show(browser, "scale=1&view=map" if dark else "scale=whole&speed=1000")
        assert violations(browser) == []
        caption = "document.getElementById('about').style"
        browser.execute_script(f"Object.assign({caption}, {{ color: '#808080', background: '#787878' }})")
        assert violations(browser)[0].startswith("color-contrast at ")
        browser.execute_script(f"Object.assign({caption}, {{ color: '', background: '' }})")
    finally:
        colours(browser)


def test_page_is_on_the_screen_before_it_can_draw(whole: Any, explorer: Callable[..., Any]) -> None:
    text = whole.path.read_text(encoding="utf-8")
    assert text.index("<h1>") < text.index("</header>") < text.index('<script id="payload"')
    assert len(re.findall(r"<script(?! id=\"\w+\" type=\"(?:application/json|text/plain)\")", text)) == 1
    assert text.index("<script>") > 0.9 * len(text)
    assert len(text) < 3_000_000
