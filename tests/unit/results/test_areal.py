"""The dataset of a scene on an areal road: maps that fit together, friction by wavelength, what reproduces it."""

from __future__ import annotations

import json
from pathlib import Path

import numpy as np
import pytest
import xarray as xr

import rubfric
from rubfric.results import dataset
from rubfric.rubber.material import Material

ROAD = rubfric.SelfAffine(hurst=0.8, period=1.0, cut_off=0.125, rms_slope=0.25)


@pytest.fixture(scope="module")
def scene(paper_rubber: Material) -> rubfric.ArealScene:
    return rubfric.ArealScene(ROAD, 100.0, 0.5, paper_rubber, numerics=rubfric.ArealNumerics(nodes_max=64))


@pytest.fixture(scope="module")
def result(scene: rubfric.ArealScene) -> xr.Dataset:
    return rubfric.simulate_areal(scene)


def test_maps_fit_together_and_friction_is_the_sum_over_wavelengths(result: xr.Dataset) -> None:
    pressure, gap = result.contact_pressure.values, result.gap.values
    assert (pressure * gap == 0.0).all()
    assert pressure.mean() == pytest.approx(0.5, rel=1e-9)
    assert (pressure > 0.0).mean() == pytest.approx(float(result.contact_fraction))
    touching = pressure > 0.0
    surface = result.displacement.values - result.road_height.values - gap
    np.testing.assert_allclose(surface, surface.mean(), atol=1e-12)
    assert np.corrcoef(result.displacement.values[touching], result.road_height.values[touching])[0, 1] > 0.999
    assert float(result.friction_by_wavelength.sum()) == pytest.approx(float(result.friction_coefficient), rel=1e-12)
    assert result.friction_by_wavelength.values.argmax() < result.wavelength.size - 1
    assert float(result.persson_friction) == pytest.approx(float(result.friction_coefficient), rel=0.4)
    assert all("units" in variable.attrs for variable in result.variables.values())


def test_file_gives_the_result_back_with_what_reproduces_it(
    result: xr.Dataset, scene: rubfric.ArealScene, tmp_path: Path
) -> None:
    path = tmp_path / "areal.nc"
    rubfric.write(result, path)
    read = dataset.read(path, scene.digest)
    xr.testing.assert_identical(read, result)
    parameters = json.loads(read.attrs["scene_parameters"])
    road = parameters["road"]
    assert road.pop("kind") == "self_affine"
    assert rubfric.SelfAffine(**road) == ROAD
    assert parameters["pressure"] == 0.5
    assert "small strain" in read.attrs["warnings"]


def test_result_that_misses_its_accuracy_says_so(scene: rubfric.ArealScene) -> None:
    strict = rubfric.ArealScene(
        ROAD, 100.0, 0.5, scene.material, numerics=rubfric.ArealNumerics(nodes_max=64, accuracy=1e-4)
    )
    assert "raise numerics.nodes_max" in rubfric.simulate_areal(strict).attrs["warnings"]
