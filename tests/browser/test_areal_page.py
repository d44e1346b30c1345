"""The page of an areal road in a browser: contact follows speed and pressure, by keys too, at every width."""

from __future__ import annotations

from pathlib import Path

import pytest
from selenium.webdriver.common.by import By
from selenium.webdriver.common.keys import Keys
from selenium.webdriver.remote.webdriver import WebDriver
from visit import colours, console_errors, outside, requested_addresses, resize, violations

import rubfric
from rubfric.areal_plane import slide_profiles
from rubfric.pages.areal import areal_page
from rubfric.pages.render import write_page
from rubfric.results.areal_table import areal_table

ROAD = rubfric.SelfAffine(hurst=0.8, period=1.0, cut_off=0.25, rms_slope=0.25)
COLOURED = """
const map = document.getElementById("map");
const data = map.getContext("2d").getImageData(0, 0, map.width, map.height).data;
let found = 0;
for (let at = 0; at < data.length; at += 4) found += data[at] !== data[at + 1] || data[at] !== data[at + 2];
return found / (data.length / 4);
"""


@pytest.mark.thorough
def test_contact_follows_speed_and_pressure(browser: WebDriver, tmp_path: Path) -> None:
    material, numerics = rubfric.load().material, rubfric.ArealNumerics(nodes_max=32)
    places = [(1.0, 0.3), (100.0, 0.3), (1.0, 1.0), (100.0, 1.0)]
    scenes = [rubfric.ArealScene(ROAD, *place, material, numerics=numerics) for place in places]
    results = [rubfric.simulate_areal(scene) for scene in scenes]
    table = areal_table(results, [slide_profiles(scene, 4) for scene in scenes])
    path = tmp_path / "areal.html"
    write_page(areal_page(results, table, "runway"), path)
    browser.get(path.as_uri())
    contact = {place: float(one.contact_fraction) for place, one in zip(places, results, strict=True)}

    def shown() -> tuple[str, float]:
        return browser.find_element(By.ID, "speed-now").text, browser.execute_script(COLOURED)

    assert shown() == ("1 mm/s", pytest.approx(contact[1.0, 0.3]))
    browser.find_element(By.ID, "speed").send_keys(Keys.ARROW_RIGHT)
    assert shown() == ("100 mm/s", pytest.approx(contact[100.0, 0.3]))
    browser.find_elements(By.CSS_SELECTOR, "#loads input")[0].send_keys(Keys.ARROW_RIGHT)
    assert shown() == ("100 mm/s", pytest.approx(contact[100.0, 1.0]))
    numbers = browser.find_element(By.ID, "numbers").text
    row = table[(table["velocity_mm_per_s"] == 100.0) & (table["pressure_MPa"] == 1.0)].iloc[0]
    assert f"Profiles over surface {row['plane_over_surface']:.2f} ± " in numbers
    assert f"{row['contact_fraction']:.0%}"[:-1] in numbers
    for width in (390, 800, 1400):
        resize(browser, width, 900)
        assert browser.execute_script("return document.documentElement.scrollWidth <= window.innerWidth")
    for dark in (False, True):
        colours(browser, dark=dark)
        assert violations(browser) == []
    colours(browser)
    assert console_errors(browser) == []
    addresses = [one for one in outside(requested_addresses(browser)) if not one.startswith("chrome")]  # its first tab
    assert addresses == []
