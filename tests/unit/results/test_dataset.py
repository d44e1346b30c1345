"""A scene's result as a file: units, conventions, provenance, and whole or not at all."""

from __future__ import annotations

import json
import re
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
import pytest
import xarray as xr

from rubfric.errors import BrokenResult
from rubfric.mechanics.finite.energy import evaluate_finite
from rubfric.mechanics.finite.steady import solve_finite
from rubfric.mechanics.small.energy import evaluate_small
from rubfric.mechanics.small.steady import solve_small
from rubfric.mechanics.theory.compression import pressed
from rubfric.mechanics.theory.kinematics import Decision, decide
from rubfric.results import dataset
from rubfric.results.scalars import SCALARS
from rubfric.results.warnings import warnings
from rubfric.road.sine import SineScale
from rubfric.rubber.material import Material
from rubfric.scene.numerics import Numerics
from rubfric.scene.scene import Scene
from rubfric.simulation import simulate

RUBBER = Material("small", 4.17, 0.49, (0.3, 0.4), (1e-3, 1e-5))
ROAD = SineScale(0.015, 35.0)
COARSE = Numerics(
    contact_nodes=16,
    finite_contact_nodes=12,
    columns_min=64,
    finite_columns_min=64,
    columns_max=1024,
    row_growth=1.4,
    output_columns=32,
)
PARTIAL = Scene(1, ROAD, 100.0, 0.1, 0.75, RUBBER, "stress", COARSE, "small")
FULL = replace(PARTIAL, pressure=5.0)
FINITE = replace(PARTIAL, kinematics="finite")
FINITE_FULL = replace(FULL, kinematics="finite")
NODAL = ("displacement_x", "displacement_y", "strain_energy_density")


@pytest.fixture(scope="module")
def partial() -> xr.Dataset:
    return simulate(PARTIAL)


@pytest.fixture(scope="module")
def full() -> xr.Dataset:
    return simulate(FULL)


@pytest.fixture(scope="module")
def finite() -> xr.Dataset:
    return simulate(FINITE)


@pytest.fixture(scope="module")
def finite_full() -> xr.Dataset:
    return simulate(FINITE_FULL)


@pytest.fixture(params=["partial", "full", "finite", "finite_full"])
def result(request: pytest.FixtureRequest) -> xr.Dataset:
    return request.getfixturevalue(request.param)


@pytest.fixture(params=["partial", "full"])
def small_result(request: pytest.FixtureRequest) -> xr.Dataset:
    return request.getfixturevalue(request.param)


@pytest.fixture(params=["finite", "finite_full"])
def finite_result(request: pytest.FixtureRequest) -> xr.Dataset:
    return request.getfixturevalue(request.param)


@pytest.fixture(scope="module")
def stored(partial: xr.Dataset, tmp_path_factory: pytest.TempPathFactory) -> Path:
    path = tmp_path_factory.mktemp("stored") / "scene.nc"
    dataset.write(partial, path)
    return path


def on_grid(result: xr.Dataset, name: str) -> np.ndarray:
    """Return a nodal field by rows from the road to the top and columns along it."""
    return result[name].values.reshape(result.sizes["depth"], -1)


@pytest.mark.parametrize(("some", "all_over"), [("partial", "full"), ("finite", "finite_full")])
def test_scenes_are_in_partial_and_full_contact(some: str, all_over: str, request: pytest.FixtureRequest) -> None:
    partial, full = request.getfixturevalue(some), request.getfixturevalue(all_over)
    assert 0.0 < float(partial["contact_fraction"]) < 0.5
    assert float(full["contact_fraction"]) == 1.0
    assert int(partial["columns"]) > COARSE.output_columns


def test_file_holds_what_was_written(partial: xr.Dataset, stored: Path) -> None:
    xr.testing.assert_identical(dataset.read(stored), partial)


def test_file_holds_what_was_written_in_finite_strain(finite: xr.Dataset, tmp_path: Path) -> None:
    dataset.write(finite, tmp_path / "finite.nc")
    xr.testing.assert_identical(dataset.read(tmp_path / "finite.nc"), finite)


def test_any_netcdf_reader_opens_it(partial: xr.Dataset, stored: Path) -> None:
    with xr.open_dataset(stored) as opened:
        assert float(opened["friction_coefficient"]) == float(partial["friction_coefficient"])
        assert opened["contact_pressure"].dims == ("surface_x",)


def test_every_variable_has_a_unit_and_a_name(result: xr.Dataset) -> None:
    for name, variable in result.variables.items():
        assert variable.attrs["long_name"], name
        assert variable.attrs["units"], name


def test_scalars_are_those_declared(result: xr.Dataset) -> None:
    scalars = [name for name, variable in result.data_vars.items() if variable.ndim == 0 and name != "mesh"]
    assert scalars == list(SCALARS)
    for name, (unit, long_name) in SCALARS.items():
        assert result[name].attrs == {"units": unit, "long_name": long_name}
        assert np.isfinite(float(result[name])), name


def test_mesh_follows_ugrid(result: xr.Dataset) -> None:
    mesh = result["mesh"].attrs
    assert mesh["cf_role"] == "mesh_topology"
    assert mesh["topology_dimension"] == 2
    assert mesh["face_node_connectivity"] == "mesh_face_nodes"
    x, y = mesh["node_coordinates"].split()
    assert result[x].attrs["units"] == result[y].attrs["units"] == "mm"
    faces = result["mesh_face_nodes"]
    assert faces.attrs["cf_role"] == "face_node_connectivity"
    assert faces.attrs["start_index"] == 0
    assert faces.dtype == np.int32
    assert "UGRID-1.0" in result.attrs["Conventions"]
    assert "CF-1" in result.attrs["Conventions"]


def test_nodal_fields_name_their_mesh(result: xr.Dataset) -> None:
    assert [name for name, variable in result.data_vars.items() if "mesh" in variable.attrs] == list(NODAL)
    for name in NODAL:
        assert result[name].attrs["mesh"] == "mesh"
        assert result[name].attrs["location"] == "node"
        assert result[name].dims == result["mesh_node_x"].dims == ("node",)


def test_cells_run_counter_clockwise_and_fill_the_block(result: xr.Dataset) -> None:
    faces = result["mesh_face_nodes"].values
    x, y = result["mesh_node_x"].values[faces], result["mesh_node_y"].values[faces]
    areas = 0.5 * np.sum(x * np.roll(y, -1, axis=1) - np.roll(x, -1, axis=1) * y, axis=1)
    assert areas.min() > 0.0
    assert areas.sum() == pytest.approx(ROAD.wavelength * PARTIAL.height, rel=1e-12)
    assert set(faces.ravel()) == set(range(result.sizes["node"]))


def test_mesh_repeats_its_first_column_at_the_far_side(result: xr.Dataset) -> None:
    x = on_grid(result, "mesh_node_x")
    assert x[:, 0] == pytest.approx(0.0)
    assert x[:, -1] == pytest.approx(ROAD.wavelength)
    for name in NODAL:
        field = on_grid(result, name)
        np.testing.assert_array_equal(field[:, 0], field[:, -1])
        assert np.ptp(field[0, :-1]) > 0.0


def test_fields_keep_no_more_columns_than_asked_for(result: xr.Dataset) -> None:
    kept = on_grid(result, "mesh_node_x").shape[1] - 1
    assert kept <= COARSE.output_columns
    assert int(result["columns"]) % kept == 0
    assert result.sizes["surface_x"] == int(result["columns"])


def test_rows_of_the_mesh_are_the_depths(result: xr.Dataset) -> None:
    np.testing.assert_array_equal(on_grid(result, "mesh_node_y")[:, 0], result["depth"].values)
    assert result.sizes["depth"] == int(result["rows"]) + 1
    assert float(result["depth"][-1]) == pytest.approx(PARTIAL.height)


def test_contact_and_gap_are_complementary(result: xr.Dataset) -> None:
    pressure, gap = result["contact_pressure"].values, result["gap"].values
    assert pressure.min() >= 0.0
    assert gap.min() >= 0.0
    assert np.all((pressure == 0.0) | (gap == 0.0))
    assert np.count_nonzero(pressure) == int(result["contact_nodes"])
    assert float(result["contact_fraction"]) == np.count_nonzero(pressure) / pressure.size
    assert float(result["maximum_contact_pressure"]) == pressure.max()


def test_contact_carries_the_load(result: xr.Dataset) -> None:
    assert result["contact_pressure"].values.mean() == pytest.approx(result.attrs["pressure"], rel=1e-10)


def test_road_height_is_the_road(result: xr.Dataset) -> None:
    expected = 0.015 * np.sin(35.0 * result["surface_x"].values)
    np.testing.assert_allclose(result["road_height"].values, expected, atol=1e-12)


def test_surface_lies_above_the_road_by_the_gap(small_result: xr.Dataset) -> None:
    height = (small_result["gap"] + small_result["road_height"]).values
    surface = on_grid(small_result, "displacement_y")[0, :-1]
    np.testing.assert_allclose(surface, height[:: len(height) // len(surface)], rtol=0.0, atol=1e-12 * ROAD.amplitude)


def test_deformed_surface_lies_above_the_road_by_the_gap_where_it_is(finite_result: xr.Dataset) -> None:
    position = finite_result["surface_position"].values
    surface = on_grid(finite_result, "displacement_y")[0, :-1]
    height = finite_result["gap"].values + ROAD.height(position)
    np.testing.assert_allclose(surface, height[:: len(height) // len(surface)], rtol=0.0, atol=1e-4 * ROAD.amplitude)


def test_surface_has_moved_by_its_displacement(finite_result: xr.Dataset) -> None:
    moved = on_grid(finite_result, "displacement_x")[0, :-1]
    along = (finite_result["surface_position"] - finite_result["surface_x"]).values
    np.testing.assert_allclose(moved, along[:: len(along) // len(moved)], rtol=0.0, atol=1e-12 * ROAD.amplitude)
    assert np.ptp(along) > 1e-2 * ROAD.amplitude


def test_small_strain_surface_stays_where_it_was_made(small_result: xr.Dataset) -> None:
    np.testing.assert_array_equal(small_result["surface_position"].values, small_result["surface_x"].values)
    np.testing.assert_array_equal(
        small_result["local_contact_pressure"].values, small_result["contact_pressure"].values
    )


@pytest.mark.parametrize("scene", [FINITE, FINITE_FULL, replace(FINITE, plane="strain")])
def test_local_pressure_is_that_on_the_stretched_surface(scene: Scene) -> None:
    solution = solve_finite(scene, Decision("finite", 0.0, "finite strain was asked for"))
    result = dataset.build(solution, evaluate_finite(solution), 1.0)
    local, nominal = result["local_contact_pressure"].values, result["contact_pressure"].values
    np.testing.assert_allclose(local * solution.surface_stretch, nominal, rtol=1e-12)
    assert np.ptp(solution.surface_stretch) > 1e-3
    assert float(result["maximum_local_contact_pressure"]) == local.max()


def test_top_moves_sideways_as_a_whole(result: xr.Dataset) -> None:
    sideways = on_grid(result, "displacement_x")
    assert np.ptp(sideways[-1]) < 1e-15
    assert np.ptp(sideways[0]) > 1e-4


def test_strain_energy_is_positive(result: xr.Dataset) -> None:
    assert result["strain_energy_density"].values.min() > 0.0
    assert result["strain_energy_density_profile"].values.min() > 0.0


def test_attributes_tell_where_a_result_comes_from(result: xr.Dataset) -> None:
    attributes = result.attrs
    assert attributes["scene"] == f"scale1_v100_p{attributes['pressure']:g}_aspect0.75_stress"
    assert attributes["rubber"] == "small"
    assert attributes["plane"] == "stress"
    assert "doi:10.1049/joe.2018.9163" in attributes["references"]
    for name in ("Python", "numpy", "scipy", "scikit-fem", "xarray", "netCDF4"):
        assert f"{name} " in attributes["software"]
    assert (attributes["velocity"], attributes["amplitude"], attributes["wavenumber"]) == (100.0, 0.015, 35.0)


def test_attributes_tell_how_small_strain_was_solved(small_result: xr.Dataset) -> None:
    attributes = small_result.attrs
    assert (attributes["kinematics"], attributes["kinematics_used"]) == ("small", "small")
    assert attributes["kinematics_reason"] == "small strain was asked for"
    assert "contact" in attributes["solver_history"]
    assert int(small_result["finite_strain"]) == int(small_result["krylov_iterations"]) == 0


def test_attributes_tell_how_finite_strain_was_solved(finite_result: xr.Dataset) -> None:
    attributes = finite_result.attrs
    assert (attributes["kinematics"], attributes["kinematics_used"]) == ("finite", "finite")
    assert attributes["kinematics_reason"] == "finite strain was asked for"
    columns = int(finite_result["columns"])
    last = attributes["solver_history"].splitlines()[-1]
    assert re.match(rf"{columns} columns, .*: converged in \d+ Newton steps, \d+ Krylov iterations$", last)
    assert int(finite_result["finite_strain"]) == 1
    assert int(finite_result["krylov_iterations"]) > 0


def test_kinematics_asked_for_and_used_differ_where_the_program_decided() -> None:
    solution = solve_small(replace(PARTIAL, kinematics="auto"), Decision("small", 0.003, "it is accurate enough"))
    result = dataset.build(solution, evaluate_small(solution), 1.0)
    assert (result.attrs["kinematics"], result.attrs["kinematics_used"]) == ("auto", "small")
    assert result.attrs["kinematics_reason"] == "it is accurate enough"
    assert float(result["finite_strain_correction"]) == 0.003


def test_only_small_strain_leaves_out_the_mean_shear(partial: xr.Dataset, finite: xr.Dataset) -> None:
    assert partial["displacement_x"].attrs["long_name"].endswith("without the mean shear that friction causes")
    assert finite["displacement_x"].attrs["long_name"] == "displacement along the road"


@pytest.mark.parametrize("asked", [PARTIAL, FINITE])
def test_attributes_suffice_to_compute_the_result_again(asked: Scene, tmp_path: Path) -> None:
    dataset.write(simulate(asked), tmp_path / "scene.nc")
    known = dataset.read(tmp_path / "scene.nc")
    scene = Scene.from_parameters(json.loads(known.attrs["scene_parameters"]))
    assert scene == asked
    assert scene.digest == known.attrs["scene_digest"]
    again = simulate(scene)
    assert again.attrs == known.attrs
    xr.testing.assert_allclose(again.drop_vars("wall_time"), known.drop_vars("wall_time"), rtol=1e-12, atol=1e-12)


def test_nominal_compression_is_that_on_a_flat_road(
    partial: xr.Dataset, full: xr.Dataset, finite: xr.Dataset, finite_full: xr.Dataset
) -> None:
    confined = RUBBER.confined_modulus("stress")
    assert float(partial["nominal_compression"]) == pytest.approx(0.1 / confined)
    assert float(full["nominal_compression"]) == pytest.approx(5.0 / confined)
    assert float(finite["nominal_compression"]) == pytest.approx(1.0 - pressed(RUBBER, 0.1, "stress")[0])
    assert float(finite_full["nominal_compression"]) == pytest.approx(1.0 - pressed(RUBBER, 5.0, "stress")[0])


def test_warnings_stand_among_the_attributes(full: xr.Dataset) -> None:
    expected = warnings(solve_small(FULL, decide(FULL)), float(full["energy_closure"]))
    assert len(expected) == 1
    assert full.attrs["warnings"].splitlines() == expected


def test_write_makes_the_folders(partial: xr.Dataset, tmp_path: Path) -> None:
    target = tmp_path / "a" / "b" / "scene.nc"
    dataset.write(partial, target)
    assert [path.name for path in target.parent.iterdir()] == ["scene.nc"]


@pytest.fixture
def broken_disk(monkeypatch: pytest.MonkeyPatch) -> None:
    """Let every write stop half-way."""

    def stop(_: xr.Dataset, path: Path, **__: object) -> None:
        path.write_bytes(b"half")
        raise OSError("no space left on device")

    monkeypatch.setattr(xr.Dataset, "to_netcdf", stop)


@pytest.mark.usefixtures("broken_disk")
def test_interrupted_write_leaves_nothing(partial: xr.Dataset, tmp_path: Path) -> None:
    with pytest.raises(OSError, match="no space left"):
        dataset.write(partial, tmp_path / "scene.nc")
    assert list(tmp_path.iterdir()) == []


@pytest.mark.usefixtures("broken_disk")
def test_interrupted_write_keeps_the_older_result(partial: xr.Dataset, tmp_path: Path) -> None:
    target = tmp_path / "scene.nc"
    target.write_bytes(b"older")
    with pytest.raises(OSError, match="no space left"):
        dataset.write(partial, target)
    assert [path.name for path in tmp_path.iterdir()] == ["scene.nc"]
    assert target.read_bytes() == b"older"


def test_part_file_is_hidden_and_beside_its_target(
    partial: xr.Dataset, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    parts: list[Path] = []
    to_netcdf = xr.Dataset.to_netcdf

    def watched(result: xr.Dataset, path: Path, **options: Any) -> None:
        parts.append(path)
        to_netcdf(result, path, **options)

    monkeypatch.setattr(xr.Dataset, "to_netcdf", watched)
    dataset.write(partial, tmp_path / "scene.nc")
    assert [part.parent for part in parts] == [tmp_path]
    assert parts[0].name.startswith(".scene.nc.")
    assert parts[0].suffix == ".part"


@pytest.mark.parametrize("share", [0.0, 0.01, 0.5, 0.999])
def test_truncated_file_is_refused(stored: Path, tmp_path: Path, share: float) -> None:
    content = stored.read_bytes()
    broken = tmp_path / "scene.nc"
    broken.write_bytes(content[: int(share * len(content))])
    with pytest.raises(BrokenResult, match=r"scene.nc cannot be read: .*; delete it and run again$"):
        dataset.read(broken)


def test_file_with_damaged_values_is_refused(partial: xr.Dataset, tmp_path: Path, rng: np.random.Generator) -> None:
    damaged = tmp_path / "scene.nc"
    dataset.write(partial.assign(bulky=("number", rng.random(50_000))), damaged)
    content = bytearray(damaged.read_bytes())
    middle = len(content) // 2
    content[middle : middle + 64] = bytes(64)
    damaged.write_bytes(content)
    with pytest.raises(BrokenResult, match=r"scene.nc cannot be read: .*; delete it and run again$"):
        dataset.read(damaged)


def test_missing_file_is_refused(tmp_path: Path) -> None:
    with pytest.raises(BrokenResult, match=r"nowhere.nc cannot be read: .*No such file"):
        dataset.read(tmp_path / "nowhere.nc")


def test_foreign_netcdf_is_refused(tmp_path: Path) -> None:
    foreign = tmp_path / "weather.nc"
    dataset.write(xr.Dataset({"temperature": ("time", [1.0, 2.0])}), foreign)
    with pytest.raises(BrokenResult, match=r"weather.nc is no result of rubfric: it lacks the attribute scene_digest"):
        dataset.read(foreign)


def test_file_that_is_no_netcdf_is_refused(tmp_path: Path) -> None:
    text = tmp_path / "notes.nc"
    text.write_text("a text, and long enough to be looked at\n" * 10)
    with pytest.raises(BrokenResult, match=r"notes.nc cannot be read: "):
        dataset.read(text)
