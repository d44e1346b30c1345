"""Friction at a temperature is friction at the reference at a_T times the speed and the pressure over b_T.

A rubber at T has every time multiplied by a_T and every modulus by b_T, so that the equations of a sliding block (Zhou,
Wang and Wei 2019, section 2) hold the speed in a_T v and the pressure in p / b_T only: exact, on the same mesh, to
round-off.
"""

from __future__ import annotations

from typing import Any

import pytest

import rubfric
from rubfric.config.campaign import Campaign

SHIFTS: dict[str, dict[str, Any]] = {
    "wlf": {"law": "wlf", "c1": 8.0, "c2": 110.0},
    "arrhenius": {"law": "arrhenius", "activation_energy": 80.0},
    "entropic": {"law": "wlf", "c1": 8.0, "c2": 110.0, "vertical": "entropic"},
}


def campaign(shift: str) -> Campaign:
    rubber = {"shift": SHIFTS[shift] | {"reference_temperature": 20.0}}
    return rubfric.load({"rubbers": {"zhou2019": rubber}, "multiscale": "sum"})


@pytest.mark.parametrize(
    ("shift", "temperature", "kinematics", "plane"),
    [
        ("wlf", 60.0, "small", "stress"),
        ("arrhenius", -10.0, "small", "strain"),
        ("entropic", 60.0, "small", "strain"),
        ("wlf", 5.0, "finite", "stress"),
        ("entropic", 60.0, "finite", "strain"),
    ],
)
def test_speed_and_temperature_are_one_variable(shift: str, temperature: float, kinematics: str, plane: str) -> None:
    chosen = campaign(shift)
    factors = chosen.shift
    assert factors is not None
    fast, heavy = factors.factor(temperature), factors.modulus_factor(temperature)
    how: dict[str, Any] = {"kinematics": kinematics, "plane": plane, "preset": "draft"}
    warm = rubfric.simulate(chosen.scene(1, 30.0, 0.5, temperature=temperature, **how))
    reference = rubfric.simulate(chosen.scene(1, 30.0 * fast, 0.5 / heavy, temperature=20.0, **how))
    same = rubfric.simulate(chosen.scene(1, 30.0 * fast, 0.5 / heavy, **how))
    assert float(warm["friction_coefficient"]) > 1e-3
    friction = float(reference["friction_coefficient"])
    # Error and closure, which is a share, are differences of frictions, and no more exact than those.
    scales = {"friction_coefficient": friction, "friction_coefficient_error": friction}
    for name, scale in (scales | {"contact_fraction": 1.0, "energy_closure": 1.0}).items():
        assert float(warm[name]) == pytest.approx(float(reference[name]), rel=0.0, abs=1e-7 * scale), name
        assert float(reference[name]) == float(same[name]), name
    pressures = [float(one["maximum_contact_pressure"]) for one in (warm, reference)]
    assert pressures[0] == pytest.approx(heavy * pressures[1], rel=1e-7)
    assert (warm.attrs["temperature"], reference.attrs["temperature"]) == (temperature, 20.0)
    assert "temperature" not in same.attrs
