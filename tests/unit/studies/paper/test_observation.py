"""What claims are judged by, scene by scene."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
import xarray as xr

import rubfric
from rubfric.studies.paper.observation import (
    DEAR,
    DEPTH,
    SCALARS,
    WHOLE,
    among,
    depth_measures,
    observe,
    over_axes,
    refusals,
    table,
)

CAMPAIGN = rubfric.load(Path(rubfric.__file__).resolve().parents[1] / "config" / "config.yaml").reading(
    "instantaneous_moduli"
)


def profile(density: list[float], depth: list[float] | None = None) -> xr.Dataset:
    values = np.array(density)
    at = np.linspace(0.0, 3.0, len(values)) if depth is None else np.array(depth)
    return xr.Dataset({"strain_energy_density_profile": ("depth", values)}, coords={"depth": at})


@pytest.mark.parametrize(
    ("density", "fall", "rise", "unsteadiness"),
    [
        ([4.0, 3.0, 2.0, 2.0], 0.5, 0.0, 0.0),
        ([2.0, 4.0, 1.0, 1.0], 0.25, 0.5, 0.0),
        ([4.0, 2.0, 3.0, 2.0], 0.5, 0.25, 0.25),
        ([1.0, 2.0, 3.0, 4.0], -0.75, 0.75, 0.25),
        ([0.0, 0.0, 0.0, 0.0], 0.0, 0.0, 0.0),
    ],
)
def test_depth_is_measured(density: list[float], fall: float, rise: float, unsteadiness: float) -> None:
    assert list(depth_measures(profile(density)).values()) == pytest.approx([fall, rise, unsteadiness])


def test_third_away_from_the_road_is_by_distance_not_by_rows() -> None:
    measures = depth_measures(profile([4.0, 3.0, 2.0, 1.0], [0.0, 0.1, 0.2, 3.0]))
    assert measures["depth_unsteadiness"] == 0.0


def test_scene_is_observed_like_its_result() -> None:
    scene = CAMPAIGN.scene(1, 100, 0.5)
    row, result = observe(scene), rubfric.simulate(scene)
    assert row["note"] == ""
    assert {name: row[name] for name in SCALARS} == {name: float(result[name]) for name in SCALARS}
    assert {name: row[name] for name in DEPTH} == depth_measures(result)


def test_refused_scene_keeps_its_place_and_its_reason() -> None:
    crushed = CAMPAIGN.scene(1, 0.1, 5, plane="stress", kinematics="finite")
    rows = table([observe(crushed), observe(CAMPAIGN.scene(1, 100, 0.5))])
    assert "must be at most" in rows["note"][0]
    assert refusals(rows).startswith("1 of 2 scenes were refused, the first since pressure of ")
    assert refusals(rows[1:]) == ""
    over = over_axes(rows)
    assert dict(over.sizes) == {"scale": 1, "velocity": 2, "pressure": 2, "aspect": 1}
    assert int(over["friction_coefficient"].notnull().sum()) == 1


def test_observations_are_chosen_by_their_axes() -> None:
    rows = table({"scale": scale, "velocity": velocity} for scale in (1, 2) for velocity in (1.0, 10.0))
    assert list(among(rows, {"scale": [2], "velocity": [10, 100]})) == [False, False, False, True]


def test_whole_road_is_observed_where_it_is_cheap() -> None:
    row = observe(CAMPAIGN.scene("all", 1000, 5))
    assert (row["scale"], row["note"]) == (WHOLE, "")
    assert 0.0 < row["friction_coefficient_error"] < 0.1 * row["friction_coefficient"]
    dear = observe(CAMPAIGN.scene("all", 10, 5, kinematics="finite"))
    assert dear["note"] == DEAR
    assert "friction_coefficient" not in dear
