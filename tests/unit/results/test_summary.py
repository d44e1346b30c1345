"""A result in words: friction first, then what it rests on, then warnings."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest
import xarray as xr

from rubfric.results.scalars import SCALARS
from rubfric.results.summary import summary

VALUES: dict[str, Any] = {
    "friction_coefficient": 0.123456,
    "friction_coefficient_dissipation": 0.123450,
    "friction_coefficient_contact": 0.123444,
    "friction_coefficient_error": 0.000456,
    "friction_resolution": 5.25e-07,
    "energy_closure": 9.72e-05,
    "contact_fraction": 0.45678,
    "maximum_contact_pressure": 11.2222,
    "maximum_local_contact_pressure": 12.3456,
    "nominal_compression": 0.08888,
    "pressed_energy_density": 0.02222,
    "finite_strain": 0,
    "finite_strain_correction": 0.00345,
    "branches_relaxed": 1,
    "branches_frozen": 2,
    "folding_bound": 1.1e-05,
    "effective_poissons_ratio": 0.31234,
    "shear_wave_speed_ratio": 0.01234,
    "excitation_frequency": 3500.0,
    "meshes": 3,
    "columns": 360,
    "rows": 21,
    "contact_nodes": 64,
    "iterations": 17,
    "krylov_iterations": 0,
    "wall_time": 0.0425,
}
ATTRIBUTES: dict[str, Any] = {
    "rubber": "zhou2019",
    "scale": 2,
    "amplitude": 0.006,
    "wavenumber": 80.0,
    "velocity": 100.0,
    "pressure": 0.5,
    "aspect": 0.75,
    "plane": "stress",
    "kinematics": "auto",
    "kinematics_used": "small",
    "kinematics_reason": "small strain is accurate enough",
    "warnings": "",
}


@pytest.fixture
def result() -> xr.Dataset:
    assert VALUES.keys() == SCALARS.keys()
    return xr.Dataset({name: ((), value) for name, value in VALUES.items()}, attrs=ATTRIBUTES)


def test_first_line_tells_the_scene_with_units(result: xr.Dataset) -> None:
    assert summary(result).splitlines()[0] == (
        "zhou2019 on scale 2: 0.006 mm sin(80/mm x), 100 mm/s, 0.5 MPa, height/width 0.75, plane stress, small strain"
    )


@pytest.mark.parametrize(
    ("label", "value"),
    [
        ("friction coefficient", "0.12346 +- 0.0005"),
        ("from viscous dissipation", "0.12345"),
        ("from contact pressure", "0.12344"),
        ("largest difference", "9.7e-05 (relative)"),
        ("contact fraction", "0.4568"),
        ("largest contact pressure", "11.22 MPa per undeformed area, 12.35 MPa per deformed area"),
        ("nominal compression", "0.0889"),
        ("effective Poisson's ratio", "0.3123"),
        ("speed over shear-wave speed", "0.012"),
        ("mesh", "360 x 21 cells, 64 nodes in contact; 3 meshes"),
        ("solved in", "42 ms, 17 contact steps"),
        ("kinematics", "small strain is accurate enough"),
    ],
)
def test_each_number_has_its_line(result: xr.Dataset, label: str, value: str) -> None:
    lines = [line for line in summary(result).splitlines() if line.strip().startswith(label)]
    assert len(lines) == 1
    assert lines[0].strip().removeprefix(label).strip() == value


def test_finite_strain_is_named_with_its_effort(result: xr.Dataset) -> None:
    result["finite_strain"], result["krylov_iterations"] = ((), 1), ((), 210)
    result.attrs |= {"kinematics_used": "finite", "kinematics_reason": "finite strain was asked for"}
    text = summary(result)
    assert text.splitlines()[0].endswith(", plane stress, finite strain")
    assert "42 ms, 17 Newton steps, 210 Krylov iterations" in text
    assert text.splitlines()[-1] == f"{'kinematics':<34}finite strain was asked for"


def test_warnings_follow_as_notes(result: xr.Dataset) -> None:
    result.attrs["warnings"] = "One thing.\nAnother thing."
    assert summary(result).splitlines()[-3:] == ["", "Note: One thing.", "Note: Another thing."]


def test_error_of_the_whole_road_says_what_it_covers(result: xr.Dataset) -> None:
    assert "the error covers" not in summary(result)
    whole = result.assign_attrs(scale=0, amplitude=[0.015, 0.006], wavenumber=[35.0, 80.0], phase=[0.0, 0.0])
    lines = summary(whole).splitlines()
    assert lines[0].startswith("zhou2019 on all 2 scales at once, ")
    assert lines[3].split(maxsplit=3)[3].startswith("mesh, solver, kinematics; not other phases of the waves, ")


def test_window_of_a_profile_is_no_road_of_scales(result: xr.Dataset) -> None:
    numbers = 2.0 * np.pi / 40.0 * np.arange(1, 21)
    window = result.assign_attrs(phase=0.0 * numbers, wavenumber=numbers, amplitude=0.1 / numbers)
    text = summary(window)
    assert " on a profile of 40 mm, waves of 2 mm and longer, " in text.splitlines()[0]
    assert "kinematics; not other stretches of the road," in text
    bent = window.assign_attrs(wavenumber=numbers * np.linspace(1.0, 1.1, 20))
    assert " on all 20 scales at once, " in summary(bent).splitlines()[0]
