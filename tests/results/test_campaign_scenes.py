"""The paper's scene files: each the result of its scene, its fields physical."""

from __future__ import annotations

import numpy as np
import pytest
import xarray as xr
from project_copy import Project

from rubfric.dataset import read


@pytest.fixture(scope="module")
def results(paper: Project) -> dict[str, xr.Dataset]:
    return {name: read(path) for name, path in paper.scene_files.items()}


def test_every_scene_of_the_campaign_has_its_result(paper: Project, results: dict[str, xr.Dataset]) -> None:
    scenes = paper.campaign.scenes()
    assert len(results) == 224
    assert {name: result.attrs["scene_digest"] for name, result in results.items()} == {
        name: scene.digest for name, scene in scenes.items()
    }


def test_nothing_pulls_and_nothing_pierces(results: dict[str, xr.Dataset]) -> None:
    for name, result in results.items():
        pressure, gap = result["contact_pressure"].values, result["gap"].values
        assert pressure.min() >= 0.0, name
        assert gap.min() >= 0.0, name
        assert np.all((pressure == 0.0) | (gap == 0.0)), name


def test_contact_carries_the_nominal_pressure(results: dict[str, xr.Dataset]) -> None:
    for name, result in results.items():
        assert result["contact_pressure"].values.mean() == pytest.approx(result.attrs["pressure"], rel=1e-8), name


def test_stored_energy_is_nowhere_negative(results: dict[str, xr.Dataset]) -> None:
    for name, result in results.items():
        assert result["strain_energy_density"].values.min() >= 0.0, name
        assert result["strain_energy_density_profile"].values.min() > 0.0, name


def test_energy_is_largest_near_the_road(results: dict[str, xr.Dataset]) -> None:
    for name, result in results.items():
        profile = result["strain_energy_density_profile"].values
        assert profile[0] > profile[-1], name


def test_fields_are_finite_and_repeat_over_the_wavelength(results: dict[str, xr.Dataset]) -> None:
    for name, result in results.items():
        for field in ("displacement_x", "displacement_y", "strain_energy_density"):
            values = result[field].values.reshape(result.sizes["depth"], -1)
            assert np.isfinite(values).all(), name
            np.testing.assert_array_equal(values[:, 0], values[:, -1])


def test_no_contact_is_unresolved(results: dict[str, xr.Dataset]) -> None:
    assert not [name for name, result in results.items() if "columns_max" in result.attrs["warnings"]]


def test_heavily_pressed_scenes_say_so(results: dict[str, xr.Dataset]) -> None:
    for name, result in results.items():
        noted = "small strain is only indicative" in result.attrs["warnings"]
        assert noted == (0.1 < float(result["nominal_compression"]) < 1.0), name
    assert sum("small strain" in result.attrs["warnings"] for result in results.values()) > 0
