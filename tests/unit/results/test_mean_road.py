"""What is known of a whole road: its own scalars where it is one, the means over its draws or windows else."""

from __future__ import annotations

import pytest
import xarray as xr

from rubfric.results.draws import mean_road
from rubfric.results.selection import DRAWS, ROAD_ERROR


def road(friction: float) -> xr.Dataset:
    return xr.Dataset({"friction_coefficient": ("velocity", [friction])}, coords={"velocity": [1.0]})


def test_one_road_is_itself_and_none_is_none() -> None:
    one = road(0.5)
    assert mean_road({"": one}) is one
    assert mean_road({}) is None


@pytest.mark.parametrize(("kind", "words"), [("draw", "random phases"), ("window", "windows")])
def test_several_roads_are_their_mean_with_the_error_of_so_few(kind: str, words: str) -> None:
    found = mean_road({f"{kind}1/": road(0.4), f"{kind}2/": road(0.6)})
    assert found is not None
    assert found["friction_coefficient"].item() == pytest.approx(0.5)
    assert found[ROAD_ERROR].item() == pytest.approx(0.1)
    assert words in found[ROAD_ERROR].attrs["long_name"]
    assert found[DRAWS].item() == 2.0
