"""Slips of units are named; rubbers, roads and loads that there are pass without a word."""

from __future__ import annotations

import re
from typing import Any

import pytest
from bad_configs import DEFAULT, MINIMAL

from rubfric.config.campaign import load
from rubfric.config.plausibility import check_area, check_plausible
from rubfric.errors import InvalidInput
from rubfric.road.sine import SineScale
from rubfric.rubber.material import Material

RUBBER: dict[str, Any] = {
    "name": "r",
    "youngs_modulus": 4.17,
    "poissons_ratio": 0.49,
    "shear_fractions": (0.2, 0.7),
    "relaxation_times": (1e-3, 1e-6),
}
# Rubber, scale of the road, pressure; what is said.
REFUSED = [
    ({"youngs_modulus": 4.17e6}, {}, 0.5, r"youngs_modulus is 4.17e\+06 MPa, .* probably in Pa, 4.17 MPa"),
    ({"youngs_modulus": 1e5}, {}, 0.5, r"youngs_modulus is 100000 MPa, .* probably in Pa, 0.1 MPa"),
    ({"shear_fractions": (0.5, 0.499999)}, {}, 0.5, r"leave a share of 1e-06 that never relaxes.*moduli: instant"),
    ({"relaxation_times": (1e-3, 1e11)}, {}, 0.5, r"relaxation_times\[1\] is 1e\+11 s, 3e\+03 years, but must be"),
    ({}, {"amplitude": 15}, 0.5, r"scale 1 .* the slope 525, but must be below 10: is the amplitude in µm, 0.015 mm\?"),
    ({}, {"wavenumber": 35e3}, 0.5, r"slope 525, but must be below 10: is the wavenumber per m, 35 rad/mm\?"),
    ({}, {}, 5e5, r"pressure 500000 MPa is above the bulk modulus of rubber r, .* below 69.5 MPa: .* in Pa, 0.5 MPa\?"),
    ({}, {}, 200, r"pressure 200 MPa is above .* is it in kPa, 0.2 MPa\?"),
]
UNLIKELY = [
    ({"youngs_modulus": 4170}, {}, 0.5, r"relaxed modulus of 4.2e\+03 MPa, .* in kPa, or the instantaneous modulus"),
    ({"youngs_modulus": 4.17e-3}, {}, 0.5, r"relaxed modulus of 0.0042 MPa, that of a soft gel: is it in GPa\?"),
    (
        {"youngs_modulus": 3.0, "moduli": "instantaneous", "shear_fractions": (0.5, 0.499)},
        {},
        0.5,
        r"moduli: long_term",
    ),
    ({"shear_fractions": (0.5, 0.4999)}, {}, 0.5, r"instantaneous modulus is 4.2e\+04 MPa, above that of any glass"),
    ({"relaxation_times": (1e-3, 1e8)}, {}, 0.5, r"relaxation_times\[1\] is 1e\+08 s, 3 years: times are in seconds"),
    ({"relaxation_times": (1.0, 1e-1)}, {}, 0.5, r"elastic at the highest speeds: .* shortest .* 0.1 s: is it in ms\?"),
    ({"relaxation_times": (1e-12, 1e-11)}, {}, 0.5, r"dissipates next to nothing.*are relaxation_times in s\?"),
    ({}, {"amplitude": 0.12}, 0.5, r"the slope 4.2, steeper than any road: is the amplitude in µm"),
    ({}, {"amplitude": 1.5e-5}, 0.5, r"the slope 0.0005, that of a mirror: is the amplitude in m, 0.015 mm\?"),
    ({}, {"amplitude": 1.5e-5, "wavenumber": 35e3}, 0.5, r"finer than 0.1 µm: lengths are in mm, .* not per m"),
    ({}, {}, 60, r"pressure 60 MPa is far above that of any tyre: is it in kPa, 0.06 MPa\?"),
]


def check(rubber: dict[str, Any], scale: dict[str, Any], pressure: float) -> list[str]:
    road = SineScale(**({"amplitude": 0.015, "wavenumber": 35} | scale))
    return check_plausible(Material(**RUBBER | rubber), [road], [0.1, 1e3], [pressure])


@pytest.mark.parametrize(("rubber", "scale", "pressure", "says"), REFUSED)
def test_what_cannot_be_meant_is_refused_with_the_likely_unit(
    rubber: dict[str, Any], scale: dict[str, Any], pressure: float, says: str
) -> None:
    with pytest.raises(InvalidInput, match=says) as caught:
        check(rubber, scale, pressure)
    assert len(caught.value.faults) == 1


@pytest.mark.parametrize(("rubber", "scale", "pressure", "says"), UNLIKELY)
def test_what_is_unlikely_is_said(rubber: dict[str, Any], scale: dict[str, Any], pressure: float, says: str) -> None:
    assert any(re.search(says, sentence) for sentence in check(rubber, scale, pressure))


@pytest.mark.parametrize(
    ("rubber", "scale", "pressure"),
    [
        ({}, {}, 5.0),
        ({"youngs_modulus": 0.05}, {"amplitude": 0.0}, 0.01),  # silicone gel on a flat road
        ({"youngs_modulus": 120.0}, {"amplitude": 3.0, "wavenumber": 0.6}, 20.0),  # ebonite on gravel
        ({"youngs_modulus": 0.3, "poissons_ratio": 0.1}, {}, 0.2),  # a foam, softer in bulk than in tension
        ({"youngs_modulus": 2e3, "moduli": "instantaneous", "shear_fractions": (0.5, 0.499)}, {}, 1.0),
        ({"relaxation_times": (1e6, 1e-9)}, {"amplitude": 2e-3, "wavenumber": 1.2e3}, 1.0),
        ({"shear_fractions": (), "relaxation_times": ()}, {}, 1.0),
    ],
)
def test_real_rubbers_roads_and_loads_pass(rubber: dict[str, Any], scale: dict[str, Any], pressure: float) -> None:
    assert check(rubber, scale, pressure) == []


def test_shipped_campaigns_pass() -> None:
    assert load(DEFAULT).unlikely() == load(DEFAULT, MINIMAL).unlikely() == []


@pytest.mark.parametrize(
    ("fractions", "says"),
    [
        ((0.1,) * 10, "add up to 1, but must stay below 1"),
        ((0.7, 0.2, 0.1), "add up to 1, but must stay below 1"),
        (((1.0 - 3e-12) / 2,) * 2, "leave a share of .e-12 that never relaxes, but must leave at least 5e-10"),
    ],
)
def test_shares_that_leave_nothing_but_round_off_are_refused(fractions: tuple[float, ...], says: str) -> None:
    with pytest.raises(InvalidInput, match=says):
        Material(**RUBBER | {"shear_fractions": fractions, "relaxation_times": (1.0,) * len(fractions)})


def test_area_in_square_metres_is_refused() -> None:
    assert check_area("area", 0.1) == 0.1
    with pytest.raises(InvalidInput, match=r"area is 0.0001 mm², .* it is probably in m², 100 mm²"):
        check_area("area", 1e-4)
