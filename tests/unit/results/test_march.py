from __future__ import annotations

import json
from collections.abc import Callable
from dataclasses import asdict
from importlib import import_module
from pathlib import Path

import numpy as np
import pytest
import xarray as xr

from rubfric.marching import march
from rubfric.mechanics.march.result import Transient
from rubfric.results import dataset
from rubfric.results import march as marchdata
from rubfric.scene.procedure import Procedure
from rubfric.scene.scene import Scene

SceneMaker = Callable[..., Scene]
PROCEDURE = Procedure(start="relaxed", columns=16, steps_per_wavelength=8, wavelengths=2, until_saturated=False)


@pytest.fixture(scope="module")
def marched(paper_scene: SceneMaker) -> Transient:
    return march(paper_scene(100.0, 0.5), PROCEDURE)


@pytest.fixture(scope="module")
def result(marched: Transient) -> xr.Dataset:
    return marchdata.build(marched, 0.2)


def test_every_record_is_kept_step_by_step(result: xr.Dataset, marched: Transient) -> None:
    for name in marchdata.RECORDS:
        np.testing.assert_array_equal(result[name].values, marched.records[name])


def test_every_variable_has_a_unit_and_a_name(result: xr.Dataset) -> None:
    for name, variable in result.variables.items():
        assert variable.attrs["units"], name
        assert variable.attrs["long_name"], name


def test_means_over_wavelengths_end_in_what_saturation_judges(result: xr.Dataset) -> None:
    assert result.sizes["wavelength"] == 2
    assert float(result["mean_friction"][-1]) == float(result["saturation_friction"])
    assert int(result["saturation_wavelengths"]) == 2
    assert float(result["steady_friction_coefficient"]) == 0.2
    assert "after 2 wavelengths" in result.attrs["saturation"]


def test_what_it_takes_to_redo_it_stands_in_the_attributes(result: xr.Dataset, marched: Transient) -> None:
    assert Procedure(**json.loads(result.attrs["procedure"])) == PROCEDURE
    assert result.attrs["scene_digest"] == marched.scene.digest
    assert result.attrs["kinematics_used"] == "small"


def test_file_holds_what_was_written(result: xr.Dataset, tmp_path: Path) -> None:
    path = tmp_path / "march.nc"
    dataset.write(result, path)
    xr.testing.assert_identical(dataset.read(path), result)


@pytest.mark.parametrize("same_code", [True, False])
def test_checkpoint_of_another_march_or_of_other_code_does_not_stand_in_the_way(
    paper_scene: SceneMaker,
    tmp_path: Path,
    monkeypatch: pytest.MonkeyPatch,
    capsys: pytest.CaptureFixture[str],
    same_code: bool,
) -> None:
    monkeypatch.syspath_prepend(str(Path(__file__).resolve().parents[3] / "workflow" / "scripts"))
    script = import_module("march_scene")
    output = tmp_path / "march.nc"
    left = script.checkpoint_of(output) if same_code else tmp_path / ".march.nc.0123456789abcdef.checkpoint"
    left.write_bytes(b"of another march")
    script.main(str(output), paper_scene(100.0, 0.5).parameters(), asdict(PROCEDURE))
    assert dataset.read(output).sizes["wavelength"] == 2
    assert not left.exists()
    assert ("checkpoint of other code" not in capsys.readouterr().out) == same_code
