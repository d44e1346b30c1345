"""Scenes gathered into one dataset over scale, speed, pressure and height-to-width ratio."""

from __future__ import annotations

import re
from pathlib import Path
from typing import Any

import numpy as np
import pytest
import xarray as xr

from rubfric.checksums import fingerprint
from rubfric.errors import BrokenResult
from rubfric.results.campaign import AXES, collect, read
from rubfric.results.dataset import load, write
from rubfric.results.scalars import SCALARS
from rubfric.road.sine import SineScale
from rubfric.rubber.material import Material
from rubfric.scene.numerics import Numerics
from rubfric.scene.scene import Scene
from rubfric.simulation import simulate

SHARED = {
    "rubber": "r",
    "plane": "stress",
    "kinematics": "auto",
    "scene_digest": "d",
    "scene_parameters": '{"material": {"name": "r"}, "numerics": {"contact_nodes": 64}}',
}
ROAD = {1: {"amplitude": 0.015, "wavenumber": 35.0}, 2: {"amplitude": 0.006, "wavenumber": 80.0}}


def store(folder: Path, scale: int, velocity: float, pressure: float, friction: float, **changes: Any) -> Path:
    """Write a stand-in for a result: its scalars and the attributes that place it."""
    point = {"scale": scale, "velocity": velocity, "pressure": pressure, "aspect": 0.75}
    routes = ("friction_coefficient", "friction_coefficient_dissipation", "friction_coefficient_contact")
    values = dict.fromkeys(SCALARS, 0.5) | dict.fromkeys(routes, friction) | {"energy_closure": 0.0}
    values |= {name: changes.pop(name) for name in set(changes) & set(SCALARS)}
    path = folder / f"{len(list(folder.iterdir()))}.nc"
    attributes = {"warnings": ""} | SHARED | ROAD[scale] | point | changes
    write(xr.Dataset(values, attrs=attributes), path)
    return path


def test_values_stand_at_their_places_and_the_rest_is_nan(tmp_path: Path) -> None:
    paths = [
        store(tmp_path, 2, 100.0, 5.0, 0.3),
        store(tmp_path, 1, 0.1, 5.0, 0.1),
        store(tmp_path, 1, 100.0, 0.5, 0.2, aspect=1.5),
    ]
    friction = collect(paths)["friction_coefficient"]
    assert friction.dims == ("scale", "velocity", "pressure", "aspect")
    assert friction.shape == (2, 2, 2, 2)
    assert float(friction.sel(scale=2, velocity=100.0, pressure=5.0, aspect=0.75)) == 0.3
    assert float(friction.sel(scale=1, velocity=0.1, pressure=5.0, aspect=0.75)) == 0.1
    assert float(friction.sel(scale=1, velocity=100.0, pressure=0.5, aspect=1.5)) == 0.2
    assert int(friction.isnull().sum()) == 16 - 3


def test_warnings_are_counted(tmp_path: Path) -> None:
    texts = {1.0: "", 2.0: "One thing.", 3.0: "One thing.\nAnother."}
    paths = [store(tmp_path, 1, velocity, 5.0, 0.3, warnings=text) for velocity, text in texts.items()]
    assert collect(paths)["warnings"].values.ravel().tolist() == [0.0, 1.0, 2.0]


def test_axes_are_sorted_whatever_the_order_of_files(tmp_path: Path, rng: np.random.Generator) -> None:
    points = [(scale, v, p) for scale in (1, 2) for v in (0.1, 10.0, 500.0, 2.0) for p in (5.0, 0.2)]
    paths = [store(tmp_path, *point, friction=number) for number, point in enumerate(points)]
    shuffled = [paths[place] for place in rng.permutation(len(paths))]
    campaign = collect(shuffled)
    xr.testing.assert_identical(campaign, collect(paths))
    assert campaign["velocity"].values.tolist() == [0.1, 2.0, 10.0, 500.0]
    assert campaign["pressure"].values.tolist() == [0.2, 5.0]
    assert campaign["scale"].values.tolist() == [1, 2]
    assert campaign["scale"].dtype == np.int64


def test_every_variable_has_a_unit_and_a_name(tmp_path: Path) -> None:
    campaign = collect([store(tmp_path, 1, 1.0, 1.0, 0.1)])
    assert set(campaign.coords) == set(AXES)
    assert set(campaign.data_vars) == {*SCALARS, "warnings", "amplitude", "wavenumber"}
    for name, variable in campaign.variables.items():
        assert variable.attrs["units"], name
        assert variable.attrs["long_name"], name


def test_road_and_what_all_scenes_share_are_kept(tmp_path: Path) -> None:
    campaign = collect([store(tmp_path, scale, 1.0, 1.0, 0.1) for scale in (2, 1)])
    assert campaign["amplitude"].values.tolist() == [0.015, 0.006]
    assert campaign["wavenumber"].values.tolist() == [35.0, 80.0]
    assert {name: SHARED[name] for name in ("rubber", "plane", "kinematics")}.items() <= campaign.attrs.items()
    assert campaign.attrs["numerics"] == '{"contact_nodes": 64}'


def test_second_result_of_a_scene_is_refused(tmp_path: Path) -> None:
    paths = [store(tmp_path, 1, 1.0, 1.0, friction) for friction in (0.1, 0.2)]
    with pytest.raises(BrokenResult, match=r"1.nc is a second result of its scene; keep one of them"):
        collect(paths)


OTHER_NUMERICS = '{"material": {"name": "r"}, "numerics": {"contact_nodes": 8}}'


@pytest.mark.parametrize(
    ("change", "says"),
    [
        ({"rubber": "other"}, "rubber other"),
        ({"plane": "strain"}, "plane strain"),
        ({"kinematics": "finite"}, "kinematics finite"),
        ({"scene_parameters": OTHER_NUMERICS}, 'numerics {"contact_nodes": 8}'),
    ],
)
def test_results_that_do_not_belong_together_are_refused(tmp_path: Path, change: dict[str, str], says: str) -> None:
    paths = [store(tmp_path, 1, 1.0, 1.0, 0.1), store(tmp_path, 1, 2.0, 1.0, 0.1, **change)]
    with pytest.raises(BrokenResult, match=rf"1.nc has the {re.escape(says)}, but the results before it"):
        collect(paths)


def test_results_of_two_roads_are_refused(tmp_path: Path) -> None:
    paths = [store(tmp_path, 1, 1.0, 1.0, 0.1), store(tmp_path, 1, 2.0, 1.0, 0.1, amplitude=0.03)]
    with pytest.raises(BrokenResult, match=r"1.nc "):
        collect(paths)


def test_nothing_to_collect_is_refused() -> None:
    with pytest.raises(BrokenResult, match="there are no results to collect"):
        collect([])


@pytest.mark.parametrize("kept", [0, 100, -100])
def test_truncated_file_is_named(tmp_path: Path, kept: int) -> None:
    whole, broken = (store(tmp_path, 1, velocity, 1.0, 0.1) for velocity in (1.0, 2.0))
    broken.write_bytes(broken.read_bytes()[:kept])
    with pytest.raises(BrokenResult, match=r"1.nc cannot be read: .* checksum[^;]*; delete it and run again$"):
        collect([whole, broken])


def test_file_without_a_scalar_is_named(tmp_path: Path) -> None:
    old = tmp_path / "old.nc"
    write(load(store(tmp_path, 1, 1.0, 1.0, 0.1)).drop_vars("energy_closure"), old)
    with pytest.raises(BrokenResult, match=r"old.nc is no readable result: .*energy_closure"):
        collect([old])


def test_foreign_and_missing_files_are_named(tmp_path: Path) -> None:
    foreign = tmp_path / "weather.nc"
    xr.Dataset({"temperature": ((), 1.0)}).to_netcdf(foreign)
    with pytest.raises(BrokenResult, match=r"weather.nc cannot be read: it has no checksum, .* or no file of rubfric"):
        collect([foreign])
    with pytest.raises(BrokenResult, match=r"nowhere.nc cannot be read: No such file"):
        collect([tmp_path / "nowhere.nc"])


@pytest.mark.parametrize(
    ("change", "says"),
    [
        ({"friction_coefficient": np.nan}, "a number that is not finite"),
        ({"friction_coefficient": -0.6}, "a friction below zero by more than its error, routes to friction that"),
        ({"friction_coefficient": 0.2}, "routes to friction that do not differ by its energy_closure"),
        ({"energy_closure": 1e-3}, "routes to friction that do not differ by its energy_closure"),
        ({"friction_coefficient_error": -0.1}, "a negative error"),
        ({"contact_fraction": 1.5}, "a contact fraction outside 0 to 1"),
        ({"maximum_contact_pressure": -1.0}, "a negative pressure"),
    ],
)
def test_numbers_that_no_result_has_are_refused(tmp_path: Path, change: dict[str, float], says: str) -> None:
    with pytest.raises(BrokenResult, match=rf"0.nc has (.*, )?{says}.*, which no result has; delete it and run again$"):
        collect([store(tmp_path, 1, 1.0, 1.0, 0.1, **change)])


def test_collection_of_other_scenes_is_refused(tmp_path: Path) -> None:
    paths = [store(tmp_path, 1, velocity, 1.0, 0.1, scene_digest=f"of {velocity}") for velocity in (1.0, 2.0)]
    write(collect(paths), tmp_path / "campaign.nc")
    own = fingerprint(["of 1.0", "of 2.0"])
    xr.testing.assert_identical(read(tmp_path / "campaign.nc", own), collect(paths[::-1]))
    with pytest.raises(BrokenResult, match=r"campaign.nc is the result of another scene, rubber or numerics"):
        read(tmp_path / "campaign.nc", fingerprint(["of 1.0"]))


@pytest.mark.parametrize("kinematics", ["small", "finite"])
def test_real_results_are_collected(tmp_path: Path, kinematics: str) -> None:
    rubber = Material("r", 4.17, 0.49, (0.5,), (1e-4,))
    coarse = Numerics(
        contact_nodes=8,
        finite_contact_nodes=4,
        columns_min=32,
        finite_columns_min=32,
        row_growth=1.5,
        output_columns=16,
    )
    results = []
    for velocity in (1.0, 100.0):
        scene = Scene(1, SineScale(0.015, 35.0), velocity, 0.5, 0.75, rubber, "stress", coarse, kinematics)
        results.append(simulate(scene))
        write(results[-1], tmp_path / f"{scene.name}.nc")
    campaign = collect(sorted(tmp_path.iterdir()))
    line = campaign.sel(scale=1, pressure=0.5, aspect=0.75)
    for name in SCALARS:
        assert line[name].values.tolist() == [float(result[name]) for result in results]
