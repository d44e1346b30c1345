"""The page to explore a campaign, as a visitor meets it."""

from __future__ import annotations

import re
from collections.abc import Callable
from itertools import product
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from selenium.webdriver.common.action_chains import ActionChains
from selenium.webdriver.common.keys import Keys
from selenium.webdriver.remote.webdriver import WebDriver
from visit import (
    choose,
    click_at,
    console_errors,
    hover_words,
    open_explorer,
    outside,
    place,
    requested_addresses,
    resize,
    settled,
    show,
    traces,
    words,
)

SPEEDS, PRESSURES = (1.0, 100.0, 1000.0, 10000.0), (0.5, 5.0)
MEASURED = re.compile(r"(\d+\.\d+) ± (\d+\.\d+)")


def numbers_in(text: str) -> tuple[float, float, float]:
    """Return friction and error out of some words, and half of what their last digit counts."""
    found = MEASURED.search(text)
    assert found, text
    return float(found[1]), float(found[2]), 0.5 * 10.0 ** -len(found[1].partition(".")[2])


def assert_gives(text: str, friction: float, error: float) -> None:
    """Words must hold a friction coefficient to its last digit, and its error, rounded up."""
    said, slack, half = numbers_in(text)
    assert abs(said - friction) <= half * 1.001
    assert -1e-9 <= slack - error <= 2.0 * half * 1.001


def press(browser: WebDriver, *keys: str) -> None:
    ActionChains(browser).send_keys(*keys).perform()
    settled(browser)


def focused(browser: WebDriver) -> str:
    script = "const { id, name, type, className } = document.activeElement; return id || name || className || type"
    return str(browser.execute_script(script))


def curve(browser: WebDriver, pressure: float) -> dict[str, Any]:
    return next(trace for trace in traces(browser, "chart") if trace.get("name", "").startswith(f"{pressure:g}\u202f"))


def test_page_needs_no_network_and_complains_of_nothing(browser: WebDriver, whole: Any) -> None:
    open_explorer(browser, whole.path, fresh=True)
    for choice in ("scale=1", "scale=2&view=map&pressure=0.5&speed=1", "scale=total", "scale=whole"):
        show(browser, choice)
    addresses = requested_addresses(browser)
    assert whole.path.resolve().as_uri() in {address.partition("#")[0] for address in addresses}
    assert not outside(addresses)
    assert not console_errors(browser)


def test_complaints_and_requests_would_be_seen(browser: WebDriver, whole: Any) -> None:
    open_explorer(browser, whole.path)
    browser.execute_async_script("console.error('so'); fetch('http://192.0.2.1/').catch(arguments[0])")
    assert any("so" in words for words in console_errors(browser))
    assert outside(requested_addresses(browser)) == ["http://192.0.2.1/"]


def test_hovering_tells_the_numbers_of_the_dataset(browser: WebDriver, whole: Any) -> None:
    open_explorer(browser, whole.path)
    for scale, speed, pressure in ((1, 1.0, 5.0), (1, 100.0, 0.5), (2, 1000.0, 5.0), (2, 10000.0, 0.5)):
        show(browser, f"scale={scale}&view=curves&pressure={5.5 - pressure:g}&speed=100")
        friction = whole.at("friction_coefficient", scale, speed, pressure)
        said = hover_words(browser, "chart", place(browser, "chart", speed, friction))
        assert f"{speed:g}mm/s,{pressure:g}MPa" in re.sub(r"\s", "", said)
        assert_gives(said, friction, whole.at("friction_coefficient_error", scale, speed, pressure))
        contact = 100.0 * whole.at("contact_fraction", scale, speed, pressure)
        assert abs(float(re.search(r"contact ([\d.]+)", said)[1]) - contact) <= 0.5  # type: ignore[index]
        kind = "finite" if whole.at("finite_strain", scale, speed, pressure) else "small"
        assert f"{kind} strain" in said
    show(browser, "scale=1&view=map")
    friction, error = (whole.at(f"friction_coefficient{part}", 1, 1000.0, 0.5) for part in ("", "_error"))
    assert_gives(hover_words(browser, "chart", place(browser, "chart", 2, 0)), friction, error)


def test_choosing_a_scale_changes_the_curves(browser: WebDriver, whole: Any) -> None:
    open_explorer(browser, whole.path, "scale=1&view=curves")
    for scale in (1, 2):
        choose(browser, "place", str(scale))
        for pressure in PRESSURES:
            wanted = [whole.at("friction_coefficient", scale, speed, pressure) for speed in SPEEDS]
            assert curve(browser, pressure)["x"] == list(SPEEDS)
            assert curve(browser, pressure)["y"] == pytest.approx(wanted, rel=1e-7)
        assert words(browser, "chart-title") == f"Scale {scale}: friction against speed"


def test_map_has_a_cell_for_every_scene(browser: WebDriver, whole: Any) -> None:
    open_explorer(browser, whole.path, "scale=2")
    choose(browser, "view", "map")
    cells = next(trace for trace in traces(browser, "chart") if trace.get("type") == "heatmap")
    wanted = [[whole.at("friction_coefficient", 2, speed, pressure) for speed in SPEEDS] for pressure in PRESSURES]
    assert np.array(cells["z"]) == pytest.approx(np.array(wanted), rel=1e-7)


def assert_shows(browser: WebDriver, whole: Any, scale: int, speed: float, pressure: float) -> None:
    """The block and the numbers beside the chart must be those of the scene."""
    scene = whole.scenes[scale, speed, pressure]
    friction, error = float(scene.friction_coefficient), float(scene.friction_coefficient_error)
    assert_gives(words(browser, "headline"), friction, error)
    assert words(browser, "scene-title").startswith(f"Scale {scale} at ")
    drawn = traces(browser, "picture")
    profile = next(trace for trace in drawn if trace.get("yaxis") == "y2")
    assert max(profile["y"]) == pytest.approx(float(scene.contact_pressure.max()), rel=1e-6)
    faces = [trace for trace in drawn if trace["mode"] == "lines" and trace["line"]["color"] == "#1d2129"]
    assert len(faces) == 2
    top = scene.mesh_node_y.values == scene.mesh_node_y.values.max()
    if int(scene.finite_strain):
        height = (scene.mesh_node_y + scene.displacement_y).values[top]
        shown = np.array(faces[1]["y"])
        width = float(np.ptp(scene.mesh_node_x.values))
        # The picture has the nodes of the upper face, to the steps in which it is stored.
        assert [shown.min(), shown.max()] == pytest.approx([height.min(), height.max()], abs=1e-3 * width)
    image = browser.execute_script("return document.getElementById('picture').layout.images[0].source")
    assert image.startswith("data:image/png;base64,")
    assert len(image) > 5000
    numbers = words(browser, "numbers")
    assert scene.attrs["kinematics_reason"][1:] in numbers
    assert f"{int(scene.rows)} cells" in numbers
    assert bool(words(browser, "warnings")) == bool(scene.attrs["warnings"])
    for warning in filter(None, scene.attrs["warnings"].split("\n")):
        assert warning in words(browser, "warnings")


def test_clicking_shows_a_scene(browser: WebDriver, whole: Any) -> None:
    open_explorer(browser, whole.path, "scale=1&view=curves&pressure=0.5&speed=1")
    for speed, pressure in ((1000.0, 5.0), (100.0, 0.5)):
        friction = whole.at("friction_coefficient", 1, speed, pressure)
        click_at(browser, "chart", place(browser, "chart", speed, friction))
        assert browser.current_url.endswith(f"#scale=1&view=curves&pressure={pressure:g}&speed={speed:g}")
        assert_shows(browser, whole, 1, speed, pressure)
    show(browser, "scale=2&view=map&pressure=0.5&speed=1")
    click_at(browser, "chart", place(browser, "chart", 3, 1))
    assert_shows(browser, whole, 2, 10000.0, 5.0)
    show(browser, "scale=total&pressure=5&speed=1")
    click_at(browser, "picture", place(browser, "picture", 2, 0.05))
    assert words(browser, "scene-title") == "Total at 1000 mm/s, 5 MPa"


def test_everything_is_reached_and_chosen_by_keyboard(browser: WebDriver, whole: Any) -> None:
    open_explorer(browser, whole.path, "scale=total&view=curves&pressure=0.5&speed=1", fresh=True)
    reached = []
    for _ in range(14):
        ActionChains(browser).send_keys(Keys.TAB).perform()
        reached.append(focused(browser))
        outline = browser.execute_script(
            "const seen = document.activeElement.nextElementSibling ?? document.activeElement;"
            "return [document.activeElement, seen].some((one) => getComputedStyle(one).outlineStyle !== 'none')"
        )
        assert outline, reached[-1]
    assert reached[:9] == ["place", "view", "unit", "chart", "pressure", "play", "speed", "chart-png", "chart-csv"]
    assert reached[9:] == ["small wide", "small", "small", "scene-png", "scene-csv"]
    browser.execute_script("document.getElementById('speed').focus()")
    press(browser, Keys.HOME)
    press(browser, Keys.ARROW_RIGHT)
    assert "speed=100" in settled(browser)
    ActionChains(browser).key_down(Keys.SHIFT).send_keys(Keys.TAB, Keys.TAB).key_up(Keys.SHIFT).perform()
    press(browser, Keys.ARROW_RIGHT)
    assert "pressure=5" in settled(browser)
    browser.execute_script("document.querySelector('input[name=place]:checked').focus()")
    press(browser, Keys.ARROW_RIGHT)
    assert words(browser, "scene-title").startswith("Whole road")
    press(browser, Keys.ARROW_RIGHT)
    assert_shows(browser, whole, 1, 100.0, 5.0)
    browser.execute_script("document.getElementById('chart').focus()")
    press(browser, Keys.ARROW_RIGHT)
    press(browser, Keys.ARROW_DOWN)
    assert_shows(browser, whole, 1, 1000.0, 0.5)
    press(browser, Keys.ARROW_DOWN)  # there is no lower pressure
    assert_shows(browser, whole, 1, 1000.0, 0.5)
    assert words(browser, "summary").startswith("Scale 1 at 1000 mm/s, 0.5 MPa: friction 0.")


def total_at(whole: Any, speed: float, pressure: float) -> Any:
    """Return the row of the table of totals."""
    table = whole.totals
    return table[(table["velocity_mm_per_s"] == speed) & (table["pressure_MPa"] == pressure)].iloc[0]


def test_total_stands_beside_the_sum_of_the_scales(browser: WebDriver, whole: Any) -> None:
    open_explorer(browser, whole.path, "scale=total&pressure=0.5&speed=1000")
    row = total_at(whole, 1000.0, 0.5)
    assert_gives(words(browser, "headline"), row["friction_direct"], row["friction_direct_error"])
    assert "All scales at once on one road, with these phases. ± covers mesh and solver" in words(browser, "covers")
    parts = [whole.at("friction_coefficient", scale, 1000.0, 0.5) for scale in (1, 2)]
    drawn = traces(browser, "picture")
    bars = [trace for trace in drawn if trace.get("type") == "bar"]
    assert [bar["y"][2] for bar in bars] == pytest.approx(parts, rel=1e-7)
    heights = {trace["name"]: trace["y"][2] for trace in drawn if trace.get("name") in ("sum", "total")}
    assert heights == pytest.approx({"sum": sum(parts), "total": 0.7 * sum(parts)}, rel=1e-7)
    compared = next(trace for trace in traces(browser, "chart") if trace.get("name") == "sum of the scales")
    assert compared["y"][2] == pytest.approx(sum(parts), rel=1e-7)
    errors = [whole.at("friction_coefficient_error", scale, 1000.0, 0.5) for scale in (1, 2)]
    wanted = [*zip(parts, errors, strict=True)]
    for way in ("sum", "corrected", "cascade", "persson", "direct"):
        wanted.append((row[f"friction_{way}"], row[f"friction_{way}_error"]))
    found = [one[0] for one in MEASURED.finditer(words(browser, "numbers"))]
    for text, (friction, error) in zip(found, [*wanted, wanted[-1]], strict=True):
        assert_gives(text, friction, error)
    small = browser.execute_script("return [...document.querySelectorAll('.small canvas')].map((one) => one.width)")
    assert len(small) == 3
    browser.find_elements("css selector", ".small")[2].click()
    settled(browser)
    assert_shows(browser, whole, 2, 1000.0, 0.5)


def test_refused_total_is_crossed_and_says_what_its_error_covers(browser: WebDriver, whole: Any) -> None:
    open_explorer(browser, whole.path, "scale=total&pressure=0.5&speed=10000")
    row = total_at(whole, 10000.0, 0.5)
    assert_gives(words(browser, "headline"), row["friction_sum"], row["friction_sum_error"])
    said = words(browser, "covers")
    assert said.startswith("Sum of the scales. ± covers mesh and solver")
    assert "coupling of the scales" in said
    assert "No solution." in said
    assert "not solved at once there" in words(browser, "marks")
    assert "refused" in words(browser, "numbers")
    crosses = traces(browser, "chart")[-1]
    assert (crosses["x"], crosses["y"]) == ([10000.0], pytest.approx([row["friction_sum"]], rel=1e-7))


def test_block_on_the_whole_road_is_shown_with_a_spot(browser: WebDriver, whole: Any) -> None:
    open_explorer(browser, whole.path, "scale=whole&pressure=0.5&speed=1000")
    scene = whole.scenes[0, 1000.0, 0.5]
    friction, error = float(scene.friction_coefficient), float(scene.friction_coefficient_error)
    assert_gives(words(browser, "headline"), friction, error)
    assert words(browser, "scene-title").startswith("Whole road at 1000")
    profile = next(trace for trace in traces(browser, "picture") if trace.get("yaxis") == "y2")
    assert max(profile["y"]) == pytest.approx(float(scene.contact_pressure.max()), rel=1e-6)
    frame = "const { shapes } = document.getElementById('picture').layout; return [shapes[0].x0, shapes[0].x1]"
    left, right = browser.execute_script(frame)
    assert right - left == pytest.approx(0.75 * 2.0 * np.pi / 35.0)
    canvas = "return document.querySelector('#spot canvas').toDataURL()"
    before = browser.execute_script(canvas)
    browser.execute_script("choose({ spot: 0.2 })")
    settled(browser)
    browser.execute_async_script("requestAnimationFrame(() => requestAnimationFrame(arguments[0]))")
    moved = browser.execute_script(frame)
    assert sum(moved) / 2.0 == pytest.approx(0.2)
    assert browser.execute_script(canvas) != before
    show(browser, "scale=whole&pressure=0.5&speed=10000")
    assert words(browser, "headline") == "Refused"
    assert words(browser, "covers") == "It was too fast."
    assert browser.execute_script("return document.getElementById('spot').hidden")
    show(browser, "scale=whole&pressure=5&speed=1")
    assert words(browser, "headline") == "Not run"
    assert not console_errors(browser)


def test_address_brings_a_view_back(browser: WebDriver, whole: Any) -> None:
    open_explorer(browser, whole.path, "scale=2&view=map&pressure=0.5&speed=100", fresh=True)
    assert settled(browser) == "#scale=2&view=map&pressure=0.5&speed=100"
    assert words(browser, "scene-title") == "Scale 2 at 100 mm/s, 0.5 MPa"
    show(browser, "scale=1&pressure=5")
    assert words(browser, "scene-title") == "Scale 1 at 100 mm/s, 5 MPa"
    open_explorer(browser, whole.path, "scale=9&view=none&pressure=x&speed=-1&more=<b>", fresh=True)
    assert settled(browser).startswith("#scale=total&view=curves&pressure=")
    assert not console_errors(browser)


def test_narrow_screen_shows_all_of_it(browser: WebDriver, whole: Any) -> None:
    resize(browser, 360, 740, touch=True)
    open_explorer(browser, whole.path)
    widest = """
    const right = (one) => one.getBoundingClientRect().right;
    return Math.max(...[...document.querySelectorAll("body *:not(svg *)")].map(right));
    """
    for scale, view in product(("total", "whole", "1"), ("curves", "map")):
        show(browser, f"scale={scale}&view={view}")
        assert browser.execute_script("return document.documentElement.scrollWidth") <= 360
        assert browser.execute_script(widest) <= 360.5
    assert not console_errors(browser)


def test_peak_is_named_only_where_it_is_one(browser: WebDriver, whole: Any) -> None:
    open_explorer(browser, whole.path, "scale=1")
    for scale, pressure in product((1, 2), PRESSURES):
        show(browser, f"scale={scale}&pressure={pressure:g}")
        values = [whole.at("friction_coefficient", scale, speed, pressure) for speed in SPEEDS]
        errors = [whole.at("friction_coefficient_error", scale, speed, pressure) for speed in SPEEDS]
        top = int(np.argmax(values))
        ends = max(values[0] + errors[0], values[-1] + errors[-1])
        said = words(browser, "peak")
        assert ("the peak is" in said) == (ends < values[top] - errors[top])
        assert_gives(said, values[top], errors[top])


def test_page_prints_on_paper(browser: WebDriver, whole: Any) -> None:
    open_explorer(browser, whole.path, "scale=1")
    printed = browser.execute_cdp_cmd("Page.printToPDF", {"printBackground": True})
    assert len(printed["data"]) > 20000
    browser.execute_cdp_cmd("Emulation.setEmulatedMedia", {"media": "print"})
    try:
        hidden = "return getComputedStyle(document.getElementById('choices')).display"
        assert browser.execute_script(hidden) == "none"
    finally:
        browser.execute_cdp_cmd("Emulation.setEmulatedMedia", {"media": ""})


def test_one_scene_is_a_campaign(browser: WebDriver, explorer: Callable[..., Any]) -> None:
    lonely = explorer(kept=lambda place: place == (2, 100.0, 5.0))
    open_explorer(browser, lonely.path)
    assert settled(browser) == "#scale=2&view=curves&pressure=5&speed=100"
    assert_shows(browser, lonely, 2, 100.0, 5.0)
    assert "too few speeds to name a peak" in words(browser, "peak")
    choose(browser, "view", "map")
    assert not console_errors(browser)


def test_gaps_are_shown(browser: WebDriver, explorer: Callable[..., Any]) -> None:
    gaps = {(1, 100.0, 0.5), (2, 1000.0, 0.5)}
    page = explorer(kept=lambda place: place not in gaps, pictured=lambda place: place != (1, 1.0, 5.0))
    open_explorer(browser, page.path, "scale=1&pressure=0.5&speed=100")
    assert words(browser, "headline") == "Not run"
    assert "1 of 4 speeds have no result" in words(browser, "peak")
    assert curve(browser, 0.5)["y"][1] is None
    choose(browser, "place", "total")
    assert words(browser, "headline") == "Not run"
    assert "2 of 4 speeds have no result" in words(browser, "peak")
    open_explorer(browser, page.path, "scale=1&view=map&pressure=5&speed=1")
    assert_gives(
        words(browser, "headline"), *(page.at(f"friction_coefficient{part}", 1, 1.0, 5.0) for part in ("", "_error"))
    )
    assert browser.execute_script("return document.getElementById('picture').hidden")
    assert not console_errors(browser)


def test_names_are_words_and_nothing_else(browser: WebDriver, explorer: Callable[..., Any]) -> None:
    name = "</script><script>window.broken = 1</script><b>R&D ü</b>"
    page = explorer(rubber=name, kept=lambda place: place[0] == 1)
    open_explorer(browser, page.path)
    assert browser.title == f"Friction of rubber {name} on road road"
    assert words(browser, "headline").startswith("μ = ")
    assert browser.execute_script("return window.broken === undefined")
    assert not console_errors(browser)


def test_without_javascript_a_sentence_says_so(browser: WebDriver, whole: Any) -> None:
    browser.execute_cdp_cmd("Emulation.setScriptExecutionDisabled", {"value": True})
    try:
        browser.get(whole.path.resolve().as_uri())
        assert "draws with JavaScript" in browser.find_element("tag name", "noscript").text
    finally:
        browser.execute_cdp_cmd("Emulation.setScriptExecutionDisabled", {"value": False})


def test_temperature_is_chosen_and_part_of_the_address(browser: WebDriver, warm: Path) -> None:
    open_explorer(browser, warm, "scale=1&view=curves&pressure=0.5&speed=100")
    assert "Rubber at 20" in words(browser, "about")
    cool = words(browser, "headline")
    choose(browser, "temperature", "1")
    assert settled(browser) == "#scale=1&view=curves&pressure=0.5&speed=100&temperature=60"
    assert "Rubber at 60" in words(browser, "about")
    assert words(browser, "headline") != cool
    open_explorer(browser, warm, "scale=1&temperature=20")
    settled(browser)
    assert "Rubber at 20" in words(browser, "about")
    assert console_errors(browser) == []


def test_every_window_of_a_measured_road_is_chosen_beside_the_mean(browser: WebDriver, measured: Any) -> None:
    open_explorer(browser, measured.path, "scale=whole&view=curves&pressure=0.3&speed=1", fresh=True)
    assert settled(browser).endswith("&speed=1&road=1")
    row = total_at(measured, 1.0, 0.3)
    heads = []
    for road in (1, 2):
        choose(browser, "road", str(road - 1))
        scene = measured.scenes[road, 1.0, 0.3]
        assert_gives(words(browser, "headline"), row["friction_total"], row["friction_total_error"])
        alone = words(browser, "covers").partition(f"Window {road} alone:")[2]
        assert_gives(alone, float(scene.friction_coefficient), float(scene.friction_coefficient_error))
        profile = next(trace for trace in traces(browser, "picture") if trace.get("yaxis") == "y2")
        assert max(profile["y"]) == pytest.approx(float(scene.contact_pressure.max()), rel=1e-6)
        assert f"{int(scene.columns)} × {int(scene.rows)} cells" in words(browser, "numbers")
        heads.append(words(browser, "headline"))
    assert heads[0] == heads[1]
    said = words(browser, "covers")
    assert said.startswith("The profile itself, mean over 2 windows of the measured road. ± covers mesh and solver (")
    assert "so few windows" in said
    assert "Circles: each window" in words(browser, "marks")
    friction = float(measured.scenes[1, 1.0, 0.3].friction_coefficient)
    assert "Window 1" in hover_words(browser, "chart", place(browser, "chart", 1.0, friction))
    click_at(browser, "chart", place(browser, "chart", 1.0, friction))
    assert settled(browser).endswith("&road=1")
    show(browser, "scale=whole&speed=100&road=2")
    assert "Window 2 was refused: It folds." in words(browser, "covers")
    assert browser.execute_script("return document.getElementById('picture').hidden")
    show(browser, "scale=total&speed=1")
    browser.execute_script("document.querySelector('input[name=pressure]:checked').focus()")
    press(browser, Keys.TAB)
    assert focused(browser) == "road"
    press(browser, Keys.ARROW_LEFT)
    assert settled(browser).endswith("&road=1")
    show(browser, "scale=1")
    assert browser.execute_script("return document.getElementById('roads').hidden")
    assert not console_errors(browser)


@pytest.mark.parametrize("width", [390, 800, 1400])
def test_page_of_windows_fits_its_screen(browser: WebDriver, measured: Any, width: int) -> None:
    resize(browser, width, 800, touch=width < 500)
    open_explorer(browser, measured.path, fresh=True)
    for scale, view in product(("total", "whole"), ("curves", "map")):
        show(browser, f"scale={scale}&view={view}&road=2")
        assert browser.execute_script("return document.documentElement.scrollWidth") <= width
