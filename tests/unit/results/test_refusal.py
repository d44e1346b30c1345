"""A scene that was refused: a file that says why, which nothing takes for a result."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
import xarray as xr
from bad_configs import DEFAULT

from rubfric.config.campaign import load
from rubfric.errors import BrokenResult, NotConverged
from rubfric.results.campaign import collect
from rubfric.results.dataset import read, write
from rubfric.results.draws import over_draws
from rubfric.results.provenance import refusal
from rubfric.results.selection import refusals
from rubfric.scene.scene import Scene
from rubfric.simulation import simulate

REASON = NotConverged("all_v1_p5_aspect0.75_stress", 7, 0.25, "distance from balance", "lower the pressure")
SENTENCE = "all_v1_p5_aspect0.75_stress: not converged after 7 steps, distance from balance is 0.25; lower the pressure"


def scene(velocity: float) -> Scene:
    return load(DEFAULT).scene("all", velocity, 5.0, kinematics="small", preset="draft")


@pytest.fixture
def paths(tmp_path: Path) -> list[Path]:
    """A solved scene of the whole road, and a refused one."""
    found = [tmp_path / "solved.nc", tmp_path / "refused.nc"]
    write(simulate(scene(100.0)), found[0])
    write(refusal(scene(1.0), REASON), found[1])
    return found


def test_refusal_is_read_as_the_sentence_it_holds(paths: list[Path]) -> None:
    with pytest.raises(BrokenResult, match=r"refused\.nc holds no friction, since the scene was refused: ") as caught:
        read(paths[1], scene(1.0).digest)
    assert str(caught.value).endswith(SENTENCE)
    with pytest.raises(BrokenResult, match="another scene"):
        read(paths[1], scene(2.0).digest)


def test_collection_has_a_gap_and_the_reason(paths: list[Path]) -> None:
    whole = collect(paths, [scene(velocity).digest for velocity in (100.0, 1.0)])
    assert whole["scale"].values.tolist() == [0]
    friction = whole["friction_coefficient"].sel(scale=0, pressure=5.0, aspect=0.75)
    assert np.isfinite(friction.sel(velocity=100.0))
    assert np.isnan(friction.sel(velocity=1.0))
    assert refusals(whole) == {(0.0, 1.0, 5.0, 0.75): SENTENCE}
    with pytest.raises(BrokenResult, match="another scene"):
        collect(paths, [scene(velocity).digest for velocity in (100.0, 2.0)])


def test_collection_of_refusals_alone_has_its_axes(paths: list[Path], tmp_path: Path) -> None:
    whole = collect(paths[1:])
    assert whole["friction_coefficient"].shape == (1, 1, 1, 1)
    write(whole, tmp_path / "whole.nc")
    assert refusals(xr.load_dataset(tmp_path / "whole.nc")) == {(0.0, 1.0, 5.0, 0.75): SENTENCE}
    assert refusals(collect(paths[:1])) == {}


def drawn(friction: float, error: float) -> xr.Dataset:
    axes = ("scale", "velocity", "pressure", "aspect")
    fields = {"friction_coefficient": friction, "friction_coefficient_error": error, "warnings": 10.0 * friction}
    values = {name: (axes, np.full((1, 1, 1, 1), value)) for name, value in fields.items()}
    return xr.Dataset(values, coords={"scale": [0], "velocity": [1.0], "pressure": [5.0], "aspect": [0.75]})


def test_mean_over_draws_has_their_standard_error() -> None:
    mean = over_draws([drawn(0.2, 0.01), drawn(0.3, 0.02), drawn(0.4, 0.03), drawn(np.nan, np.nan)])
    assert mean["friction_coefficient"].item() == pytest.approx(0.3)
    assert mean["friction_coefficient_error"].item() == pytest.approx(0.02)
    assert mean["friction_road_error"].item() == pytest.approx(0.1 / 3**0.5)
    assert mean["draws"].item() == 3
    assert mean["warnings"].item() == pytest.approx(2 + 3 + 4)


def test_one_draw_does_not_know_its_scatter() -> None:
    mean = over_draws([drawn(0.2, 0.01)])
    assert mean["friction_coefficient"].item() == 0.2
    assert np.isnan(mean["friction_road_error"].item())


def test_refusals_of_draws_are_kept(paths: list[Path]) -> None:
    mean = over_draws([collect(paths[:1]), collect(paths[:1])])
    assert refusals(mean) == {}
    assert refusals(over_draws([collect(paths), collect(paths)])) == {(0.0, 1.0, 5.0, 0.75): SENTENCE}
