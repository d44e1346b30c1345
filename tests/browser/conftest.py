"""A browser, and pages of small campaigns."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import dataclass
from itertools import product
from pathlib import Path

import pandas as pd
import pytest
import xarray as xr
from selenium.webdriver.remote.webdriver import WebDriver
from synthetic_campaign import make_totals
from visit import MISSING, missing_program, requested_addresses, resize, start

import rubfric
from rubfric.pages.explorer.data import payload, together
from rubfric.pages.explorer.page import page
from rubfric.pages.explorer.roads import NUMBER
from rubfric.pages.render import write_page
from rubfric.results import campaign as collection
from rubfric.results import dataset
from rubfric.results.draws import over_draws
from rubfric.results.provenance import refusal
from rubfric.results.temperature import at_temperature
from rubfric.results.totals import total_table
from rubfric.results.whole_road import WholeRoad
from rubfric.scene.scene import Scene

CONFIG = Path(rubfric.__file__).resolve().parents[1] / "config" / "config.yaml"
SCALES, SPEEDS, PRESSURES, ASPECT = (1, 2), (1.0, 100.0, 1000.0, 10000.0), (0.5, 5.0), 0.75
# The whole road is solved at the light load, except where it is refused, and not at all at the heavy one.
REFUSED = (0, 10000.0, 0.5)


@dataclass(frozen=True)
class Explored:
    """A page, the campaign and the totals it was made of, and its scenes by scale (0: all), speed and pressure."""

    path: Path
    campaign: xr.Dataset
    totals: pd.DataFrame
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
def on_whole_road(tmp_path_factory: pytest.TempPathFactory) -> dict[tuple[int, float, float], Path]:
    """Return the results of the whole road at one pressure, the last a refusal."""
    campaign, folder = rubfric.load(CONFIG), tmp_path_factory.mktemp("whole")
    found = {}
    for speed in SPEEDS:
        scene = campaign.scene("all", speed, PRESSURES[0], aspect=ASPECT, preset="draft", kinematics="small")
        place = (0, speed, PRESSURES[0])
        found[place] = folder / f"{scene.name}.nc"
        result = refusal(scene, "it was too fast") if place == REFUSED else rubfric.simulate(scene)
        rubfric.write(result, found[place])
    return found


@pytest.fixture(scope="session")
def explorer(
    solved: dict[tuple[int, float, float], Path],
    on_whole_road: dict[tuple[int, float, float], Path],
    tmp_path_factory: pytest.TempPathFactory,
) -> Explorer:
    """Return a function that makes the page of some of the scenes, of a rubber of any name."""

    def build(
        rubber: str = "made up",
        kept: Callable[[tuple[int, float, float]], bool] = lambda place: True,
        pictured: Callable[[tuple[int, float, float]], bool] = lambda place: True,
    ) -> Explored:
        files = {place: path for place, path in solved.items() if kept(place)}
        campaign = collection.collect(files.values()).assign_attrs(rubber=rubber)
        roads = on_whole_road if len(campaign["scale"]) > 1 else {}
        scenes = {place: dataset.read(path) for place, path in (files | roads).items() if place != REFUSED}
        totals = make_totals(campaign, refused=[(REFUSED[2], REFUSED[1])], aspect=ASPECT)
        of_road = collection.collect(roads.values()) if roads else None
        shown = [scene for place, scene in scenes.items() if pictured(place)]
        path = tmp_path_factory.mktemp("page") / "explorer.html"
        write_page(page(payload(campaign, totals, shown, ASPECT, "road", of_road)), path)
        return Explored(path, campaign, totals, scenes)

    return build


@pytest.fixture(scope="session")
def whole(explorer: Explorer) -> Explored:
    """Return the page of all the scenes."""
    return explorer()


@pytest.fixture(scope="session")
def warm(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Return the page of a scale at two temperatures."""
    shift = {"law": "wlf", "c1": 8.0, "c2": 100.0, "reference_temperature": 20.0}
    campaign = rubfric.load({"rubbers": {"zhou2019": {"shift": shift}}})
    folder, payloads = tmp_path_factory.mktemp("warm"), {}
    for temperature in (20.0, 60.0):
        results = [
            rubfric.simulate(campaign.scene(1, speed, 0.5, preset="draft", kinematics="small", temperature=temperature))
            for speed in (1.0, 100.0)
        ]
        for result in results:
            rubfric.write(result, folder / f"{result.attrs['scene']}.nc")
        collected = collection.collect(folder.glob(f"*_T{temperature:g}_*.nc"))
        scales = at_temperature(collected, temperature)
        payloads[temperature] = payload(scales, make_totals(scales), results, ASPECT, "road", share=0.5)
    path = folder / "explorer.html"
    write_page(page(together(payloads, 20.0)), path)
    return path


@pytest.fixture(scope="session")
def measured(tmp_path_factory: pytest.TempPathFactory) -> Explored:
    """Return the page of two windows of a measured road, the second of which is refused at 100 mm/s."""
    street = {
        "profile": str(CONFIG.parents[1] / "examples/own_road/street.csv"),
        "scales": 2,
        "cutoff": 8,
        "windows": 2,
    }
    grid = {"velocities": [1.0, 100.0], "pressures": [0.3], "aspect": ASPECT}
    chosen = {"multiscale": "direct", "kinematics": "small", "numerics": {"preset": "draft"}}
    campaign = rubfric.load({"road": "street", "roads": {"street": street}, "grid": grid} | chosen)
    folder, scenes = tmp_path_factory.mktemp("measured"), {}

    def collected(named: dict[str, Scene], road: int) -> xr.Dataset:
        paths = {}
        for scene in named.values():
            refused = road == 2 and scene.velocity == 100.0
            result = refusal(scene, "it folds") if refused else rubfric.simulate(scene)
            path = folder / f"{road}{scene.name}.nc"
            rubfric.write(result, path)
            paths[path] = scene.digest
            scenes[road, scene.velocity, scene.name] = result.assign_attrs({NUMBER: road} if road else {})
        return collection.collect(paths, paths.values())

    scales = collected({name: one for name, one in campaign.scenes().items() if one.aspect == ASPECT}, 0)
    whole = campaign.whole_scenes()
    of_road = over_draws(
        [collected({n: s for n, s in whole.items() if n.startswith(f"window{road}/")}, road) for road in (1, 2)], True
    )
    totals = total_table(scales, of_road, WholeRoad.from_parameters(campaign.whole_parameters()))
    path = folder / "explorer.html"
    write_page(page(payload(scales, totals, scenes.values(), ASPECT, "street", of_road)), path)
    by_road = {(road, speed, 0.3): one for (road, speed, _), one in scenes.items() if road}
    return Explored(path, of_road, totals, by_road)
