"""A browser, and pages of small campaigns."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import dataclass
from itertools import product
from pathlib import Path

import pytest
import xarray as xr
from selenium.webdriver.remote.webdriver import WebDriver
from visit import MISSING, missing_program, requested_addresses, resize, start

import rubfric
from rubfric.pages.explorer.data import payload
from rubfric.pages.explorer.page import page
from rubfric.pages.render import write_page
from rubfric.results import campaign as collection
from rubfric.results import dataset

CONFIG = Path(rubfric.__file__).resolve().parents[1] / "config" / "config.yaml"
SCALES, SPEEDS, PRESSURES, ASPECT = (1, 2), (1.0, 100.0, 1000.0, 10000.0), (0.5, 5.0), 0.75


@dataclass(frozen=True)
class Explored:
    """A page, the campaign it was made of, and its scenes by scale, speed and pressure."""

    path: Path
    campaign: xr.Dataset
    scenes: dict[tuple[int, float, float], xr.Dataset]

    def at(self, name: str, scale: int, speed: float, pressure: float) -> float:
        return float(self.campaign[name].sel(scale=scale, velocity=speed, pressure=pressure, aspect=ASPECT))


Explorer = Callable[..., Explored]


@pytest.fixture(scope="session")
def chromium(tmp_path_factory: pytest.TempPathFactory) -> Iterator[WebDriver]:
    """Return Chromium, started once."""
    missing = missing_program()
    if missing:
        pytest.fail(MISSING.format(missing), pytrace=False)
    browser = start(tmp_path_factory.mktemp("profile"))
    yield browser
    browser.quit()


@pytest.fixture
def browser(chromium: WebDriver) -> WebDriver:
    """Return Chromium with a window of 1400 by 900 pixels and empty logs, on the page that the test before has left."""
    resize(chromium, 1400, 900)
    chromium.get_log("browser")
    requested_addresses(chromium)
    return chromium


@pytest.fixture(scope="session")
def solved(tmp_path_factory: pytest.TempPathFactory) -> dict[tuple[int, float, float], Path]:
    """Return the results of two scales, four speeds and two pressures."""
    campaign, folder = rubfric.load(CONFIG), tmp_path_factory.mktemp("scenes")
    found = {}
    for place in product(SCALES, SPEEDS, PRESSURES):
        scene = campaign.scene(*place, aspect=ASPECT, preset="draft")
        found[place] = folder / f"{scene.name}.nc"
        rubfric.write(rubfric.simulate(scene), found[place])
    return found


@pytest.fixture(scope="session")
def explorer(solved: dict[tuple[int, float, float], Path], tmp_path_factory: pytest.TempPathFactory) -> Explorer:
    """Return a function that makes the page of some of the scenes, of a rubber of any name."""

    def build(
        rubber: str = "made up",
        kept: Callable[[tuple[int, float, float]], bool] = lambda place: True,
        pictured: Callable[[tuple[int, float, float]], bool] = lambda place: True,
    ) -> Explored:
        files = {place: path for place, path in solved.items() if kept(place)}
        campaign = collection.collect(files.values()).assign_attrs(rubber=rubber)
        scenes = {place: dataset.read(path) for place, path in files.items()}
        shown = [scene for place, scene in scenes.items() if pictured(place)]
        path = tmp_path_factory.mktemp("page") / "explorer.html"
        write_page(page(payload(campaign, shown, ASPECT, "road")), path)
        return Explored(path, campaign, scenes)

    return build


@pytest.fixture(scope="session")
def whole(explorer: Explorer) -> Explored:
    """Return the page of all the scenes."""
    return explorer()
