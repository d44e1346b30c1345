"""A result that breaks a bound is found out, whatever the bound."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace

import numpy as np
import pytest
import xarray as xr

from rubfric.marching import march
from rubfric.mechanics.march.result import Transient
from rubfric.road.sine import SineScale
from rubfric.rubber.material import Material
from rubfric.scene.procedure import Procedure
from rubfric.scene.scene import Scene
from rubfric.simulation import simulate
from rubfric.studies.stability.bounds import judge_march, judge_steady

RUBBER = Material("plain", 4.17, 0.4, (0.5,), (1e-3,))
SCENE = Scene(1, SineScale(0.01, 35.0), 30.0, 0.2, 0.5, RUBBER, "strain", kinematics="small")
SHORT = Procedure(start="relaxed", columns=32, steps_per_wavelength=16, wavelengths=2, until_saturated=False)


@pytest.fixture(scope="module", params=["small", "finite"])
def result(request: pytest.FixtureRequest) -> xr.Dataset:
    return simulate(replace(SCENE, kinematics=request.param))


@pytest.fixture(scope="module")
def marched() -> Transient:
    return march(SCENE, SHORT)


def test_sound_result_breaks_nothing(result: xr.Dataset) -> None:
    verdict = judge_steady(result, 0.05)
    assert verdict.broken == ()
    assert verdict.friction[0] == float(result.friction_coefficient)
    assert verdict.closure == float(result.energy_closure)


def scaled(name: str, factor: float) -> Callable[[xr.Dataset], xr.Dataset]:
    return lambda result: result.assign({name: factor * result[name]})


def shifted(name: str, by: float) -> Callable[[xr.Dataset], xr.Dataset]:
    return lambda result: result.assign({name: result[name] + by})


@pytest.mark.parametrize(
    ("spoil", "said"),
    [
        (scaled("strain_energy_density", float("nan")), "not finite: strain_energy_density"),
        (scaled("friction_coefficient_contact", -1.0), "friction is negative"),
        (scaled("friction_coefficient_dissipation", -1.0), "dissipation is negative"),
        (shifted("friction_coefficient", 0.5), "friction exceeds the slope"),
        (shifted("contact_pressure", -1e-3), "contact pressure is negative"),
        (scaled("contact_pressure", 1.001), "more or less than the load"),
        (scaled("gap", -1.0), "a gap is negative"),
        (shifted("gap", 1e-3), "pressure acts across a gap"),
        (shifted("displacement_y", -1e-3), "inside the road"),
        (scaled("strain_energy_density", -1.0), "strain energy is negative"),
        (scaled("contact_fraction", 0.0), "contact fraction"),
        (shifted("energy_closure", 0.06), "the three friction coefficients differ by 6"),
    ],
)
def test_spoilt_result_is_found_out(result: xr.Dataset, spoil: Callable[[xr.Dataset], xr.Dataset], said: str) -> None:
    spoilt = spoil(result).assign_attrs(result.attrs)
    assert said in "; ".join(judge_steady(spoilt, 0.05).broken)


def test_what_a_result_says_of_itself_is_kept(result: xr.Dataset) -> None:
    spoken = result.assign_attrs(warnings="one\ntwo")
    assert judge_steady(spoken, 0.05).remarks == ("one", "two")


def test_sound_march_breaks_nothing(marched: Transient) -> None:
    verdict = judge_march(marched, 0.25)
    assert verdict.broken == ()
    assert verdict.friction[2] == pytest.approx(marched.means().mean(), rel=1e-12)
    assert 0.0 < verdict.resolution < verdict.friction[2]


@pytest.mark.parametrize(
    ("name", "change", "said"),
    [
        ("iterations", np.nan, "not finite: iterations"),
        ("friction_contact", -1.0, "friction is negative"),
        ("dissipated", -1.0, "dissipation is negative"),
        ("stored_energy", -1.0, "stored energy is negative"),
        ("friction_contact", 10.0, "friction exceeds the slope"),
        ("contact_fraction", 0.0, "contact fraction"),
        ("imbalance", 1e6, "the first law misses"),
        ("friction_work", 2.0, "friction by contact, work and energy differ"),
    ],
)
def test_spoilt_march_is_found_out(marched: Transient, name: str, change: float, said: str) -> None:
    records = marched.records | {name: marched.records[name] * change}
    if name == "imbalance":
        records[name] = np.full_like(marched.records[name], change)
    assert said in "; ".join(judge_march(replace(marched, records=records), 0.25).broken)
