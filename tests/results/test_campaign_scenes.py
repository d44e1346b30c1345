"""The paper's scene files: each the result of its scene, its fields physical."""

from __future__ import annotations

import numpy as np
import pytest
import xarray as xr
from project_copy import Project

from rubfric.results.dataset import read


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


def test_energy_is_largest_near_the_road_under_loads_up_to_1_mpa(results: dict[str, xr.Dataset]) -> None:
    # Beyond, friction shears the rubber far from the road, and sliding stiffens that near it; a flat block is squeezed.
    chosen = [r for r in results.values() if r.attrs["pressure"] <= 1.0 and r.attrs["aspect"] >= 0.5]
    assert len(chosen) > 120
    for result in chosen:
        profile = result["strain_energy_density_profile"].values
        assert profile[0] > profile[-1], result.attrs["scene"]


def test_fields_are_finite_and_repeat_over_the_wavelength(results: dict[str, xr.Dataset]) -> None:
    for name, result in results.items():
        for field in ("displacement_x", "displacement_y", "strain_energy_density"):
            values = result[field].values.reshape(result.sizes["depth"], -1)
            assert np.isfinite(values).all(), name
            np.testing.assert_array_equal(values[:, 0], values[:, -1])


def test_no_contact_is_unresolved(results: dict[str, xr.Dataset]) -> None:
    assert not [name for name, result in results.items() if "columns_max" in result.attrs["warnings"]]


def test_every_scene_is_solved_in_finite_strain_because_it_needs_it(results: dict[str, xr.Dataset]) -> None:
    for name, result in results.items():
        assert result.attrs["kinematics"] == "auto", name
        assert result.attrs["kinematics_used"] == "finite", name
        assert int(result["finite_strain"]) == 1, name
        assert float(result["finite_strain_correction"]) > 0.01, name
        assert "more than half the accuracy asked for, 1.00%" in result.attrs["kinematics_reason"], name


def test_the_way_to_every_solution_is_told(results: dict[str, xr.Dataset]) -> None:
    for name, result in results.items():
        steps = result.attrs["solver_history"].splitlines()
        assert ": converged in " in steps[-1], name
        assert int(result["iterations"]) >= len(steps), name
        assert int(result["krylov_iterations"]) >= int(result["iterations"]), name


def test_only_a_negative_poissons_ratio_is_warned_of(results: dict[str, xr.Dataset]) -> None:
    for name, result in results.items():
        warnings = result.attrs["warnings"].splitlines()
        negative = float(result["effective_poissons_ratio"]) < 0.0
        assert len(warnings) == negative, name
        assert not negative or warnings[0].startswith("The effective Poisson's ratio is -"), name


def test_energy_closes_in_every_scene(results: dict[str, xr.Dataset]) -> None:
    for name, result in results.items():
        assert float(result["energy_closure"]) <= 0.01, name


def test_surface_is_nowhere_folded(results: dict[str, xr.Dataset]) -> None:
    for name, result in results.items():
        assert np.diff(result["surface_position"].values).min() > 0.0, name


def test_local_pressure_counts_the_deformed_area(results: dict[str, xr.Dataset]) -> None:
    for name, result in results.items():
        nominal, local = result["contact_pressure"].values, result["local_contact_pressure"].values
        np.testing.assert_array_equal(nominal > 0.0, local > 0.0, err_msg=name)
        assert 0.25 * nominal.max() < local.max() < 2.0 * nominal.max(), name
