"""One temperature out of a campaign of several: collections, refusals, tables, and what picks from them."""

from __future__ import annotations

import json
import re
from itertools import product
from pathlib import Path
from typing import Any

import numpy as np
import pandas as pd
import pytest
import xarray as xr
from synthetic_campaign import make_campaign, make_totals

import rubfric
from rubfric.errors import BrokenResult, InvalidInput
from rubfric.results.campaign import collect
from rubfric.results.dataset import write
from rubfric.results.friction_map import FrictionMap
from rubfric.results.provenance import about, refusal
from rubfric.results.scalars import SCALARS
from rubfric.results.selection import REFUSALS, pick, refusals
from rubfric.results.tables import by_temperature, scale_table
from rubfric.results.temperature import COLUMN, at_temperature, rows_at
from rubfric.results.totals import total_tables
from rubfric.results.whole_road import WholeRoad
from rubfric.scene.scene import Scene

TEMPERATURES, SPEEDS = (0.0, 20.0), (1.0, 10.0)
SHIFT = {"law": "wlf", "c1": 8.0, "c2": 100.0, "reference_temperature": 20.0}
CAMPAIGN = rubfric.load(
    {
        "rubbers": {"zhou2019": {"shift": SHIFT}},
        "grid": {"velocities": SPEEDS, "pressures": [0.5], "temperatures": TEMPERATURES},
    }
)


def friction(scene: Scene) -> float:
    """Return a friction of our own choice, another at each point."""
    return 0.1 * int(scene.scale) + 0.01 * scene.velocity + 0.001 * (scene.temperature or 0.0)


def stored(folder: Path, scene: Scene, refused: str = "") -> Path:
    """Write a stand-in for a result."""
    routes = ("friction_coefficient", "friction_coefficient_dissipation", "friction_coefficient_contact")
    values = dict.fromkeys(SCALARS, 0.5) | dict.fromkeys(routes, friction(scene)) | {"energy_closure": 0.0}
    made = refusal(scene, refused) if refused else xr.Dataset(values, attrs=about(scene, "t") | {"warnings": ""})
    write(made, folder / f"{scene.name}.nc")
    return folder / f"{scene.name}.nc"


@pytest.fixture(scope="module")
def files(tmp_path_factory: pytest.TempPathFactory) -> dict[str, Path]:
    folder = tmp_path_factory.mktemp("scenes")
    return {name: stored(folder, scene) for name, scene in CAMPAIGN.scenes().items()}


@pytest.fixture(scope="module")
def collected(files: dict[str, Path]) -> xr.Dataset:
    return collect(files.values(), [scene.digest for scene in CAMPAIGN.scenes().values()])


def test_every_scene_is_at_its_temperature(collected: xr.Dataset) -> None:
    assert collected["friction_coefficient"].dims == ("scale", "velocity", "pressure", "aspect", "temperature")
    assert collected["temperature"].attrs["units"] == "degC"
    for scene in CAMPAIGN.scenes().values():
        place = {name: getattr(scene, name) for name in ("scale", "velocity", "pressure", "aspect", "temperature")}
        assert float(collected["friction_coefficient"].sel(place)) == pytest.approx(friction(scene))


@pytest.mark.parametrize("temperature", TEMPERATURES)
def test_one_temperature_is_a_campaign_of_that_rubber(collected: xr.Dataset, temperature: float) -> None:
    one = at_temperature(collected, temperature)
    assert one["friction_coefficient"].dims == ("scale", "velocity", "pressure", "aspect")
    assert "temperature" not in one.variables
    rubber = CAMPAIGN.scene(1, 1.0, 0.5, temperature=temperature).material
    assert json.loads(one.attrs["material"])["relaxation_times"] == list(rubber.relaxation_times)
    xr.testing.assert_identical(one, at_temperature(one))
    taken = pick(collected, "friction_coefficient", scale=1, temperature=temperature)
    np.testing.assert_array_equal(taken.values, pick(one, "friction_coefficient", scale=1).values)
    found = FrictionMap.from_campaign(collected, 0.75, 1, temperature).friction
    np.testing.assert_array_equal(found, FrictionMap.from_campaign(one, 0.75, 1).friction)


def test_several_temperatures_have_to_be_chosen_from(collected: xr.Dataset) -> None:
    says = re.escape("temperature is not given, but the campaign has 0, 20 degC: choose one of them")
    for choose in (at_temperature, lambda campaign: pick(campaign, "friction_coefficient", scale=1)):
        with pytest.raises(InvalidInput, match=says):
            choose(collected)
    with pytest.raises(InvalidInput, match="temperature is 30 degC, but the campaign has 0, 20 degC"):
        at_temperature(collected, 30.0)
    with pytest.raises(InvalidInput, match="temperature is 20 degC, but the campaign has no temperatures"):
        at_temperature(make_campaign(), 20.0)
    with pytest.raises(InvalidInput, match="temperature 20 degC is not in the campaign, which has no such axis"):
        pick(make_campaign(), "friction_coefficient", temperature=20.0)
    alone = collected.isel(temperature=[0])
    xr.testing.assert_identical(at_temperature(alone), at_temperature(collected, 0.0))


def test_refusals_are_of_their_temperature(tmp_path: Path) -> None:
    scenes = [CAMPAIGN.scene(1, speed, 0.5, temperature=one) for one, speed in product(TEMPERATURES, SPEEDS)]
    collected = collect([stored(tmp_path, scene, "too cold" if scene.temperature == 0.0 else "") for scene in scenes])
    assert refusals(at_temperature(collected, 0.0)) == {(1.0, speed, 0.5, 0.75): "too cold" for speed in SPEEDS}
    assert REFUSALS not in at_temperature(collected, 20.0).attrs


def test_rubbers_that_do_not_belong_together_are_refused(tmp_path: Path, files: dict[str, Path]) -> None:
    warm = CAMPAIGN.scene(1, 1.0, 0.5, temperature=20.0)
    plain = stored(tmp_path, Scene.from_parameters(warm.parameters() | {"temperature": None, "velocity": 3.0}))
    with pytest.raises(BrokenResult, match="has no temperature, but the results before it have one"):
        collect([*files.values(), plain])
    with pytest.raises(BrokenResult, match="has a temperature, but the results before it have none"):
        collect([plain, *files.values()])
    other = stored(tmp_path, Scene.from_parameters(warm.parameters() | {"temperature": 0.0, "velocity": 3.0}))
    with pytest.raises(BrokenResult, match="has another rubber at 0 degC than the results before it"):
        collect([*files.values(), other])


def test_tables_have_the_temperature_in_a_column(collected: xr.Dataset) -> None:
    table = scale_table(collected, 2)
    assert list(table)[:4] == ["velocity_mm_per_s", "pressure_MPa", COLUMN, "aspect"]
    assert table[COLUMN].tolist() == [0.0, 0.0, 20.0, 20.0]
    for temperature in TEMPERATURES:
        alone = scale_table(at_temperature(collected, temperature), 2)
        pd.testing.assert_frame_equal(rows_at(table, temperature), alone)
        pd.testing.assert_frame_equal(rows_at(alone), alone)
    with pytest.raises(InvalidInput, match="temperature is not given, but the table has 0, 20 degC"):
        rows_at(table)
    with pytest.raises(InvalidInput, match="temperature is 20 degC, but the table has no temperatures"):
        rows_at(rows_at(table, 20.0), 20.0)


def test_totals_are_judged_by_the_rubber_at_each_temperature(
    collected: xr.Dataset, monkeypatch: pytest.MonkeyPatch
) -> None:
    def roads(way: str) -> dict[float | None, WholeRoad]:
        parameters = {one: each.whole_parameters() | {"way": way} for one, each in CAMPAIGN.by_temperature.items()}
        return {one: WholeRoad.from_parameters(each) for one, each in parameters.items()}

    asked: list[Any] = []
    monkeypatch.setattr(WholeRoad, "couplings", lambda self, *_: asked.append(self.material) or [])
    monkeypatch.setattr("rubfric.results.totals.MODELS", ())
    table = total_tables(collected, None, roads("sum"))
    assert table[COLUMN].tolist() == [0.0, 0.0, 20.0, 20.0]
    assert asked == [CAMPAIGN.scene(1, 1.0, 0.5, temperature=one).material for one in table[COLUMN]]
    summed = collected["friction_coefficient"].sum("scale").squeeze(drop=True).transpose("temperature", "velocity")
    np.testing.assert_allclose(table["friction_total"], summed.values.ravel(), rtol=1e-12)


def test_a_virtual_rig_takes_one_temperature() -> None:
    totals = make_totals(make_campaign())
    table = by_temperature({0.0: totals.copy(), 20.0: totals.copy()})
    with pytest.raises(InvalidInput, match="choose one of them"):
        FrictionMap.from_totals(table)
    np.testing.assert_array_equal(
        FrictionMap.from_totals(rows_at(table, 20.0)).friction, FrictionMap.from_totals(totals).friction
    )
