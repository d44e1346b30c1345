"""Shift factors: the laws, their limits, and that temperature is speed."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import replace
from typing import Any

import numpy as np
import pytest

from rubfric.errors import InvalidInput
from rubfric.rubber.material import Material
from rubfric.rubber.shift import Shift, ShiftedRubber
from rubfric.scene.scene import Scene
from rubfric.simulation import simulate

WLF = Shift("wlf", 20.0, c1=8.86, c2=101.6)


def test_laws() -> None:
    assert WLF.factor(20.0) == 1.0
    assert math.log10(WLF.factor(0.0)) == pytest.approx(8.86 * 20.0 / 81.6)
    warm = Shift("arrhenius", 20.0, activation_energy=100.0)
    assert math.log(warm.factor(60.0)) == pytest.approx(100e3 / 8.314462618 * (1 / 333.15 - 1 / 293.15))
    table = Shift("table", 25.0, temperatures=(0.0, 20.0, 30.0), log_factors=(3.0, 1.0, -1.0))
    assert [math.log10(table.factor(at)) for at in (10.0, 25.0, 30.0)] == pytest.approx([2.0, 0.0, -1.0])
    assert replace(WLF, vertical="entropic").modulus_factor(60.0) == pytest.approx(333.15 / 293.15)
    own = replace(WLF, vertical="table", temperatures=(0.0, 40.0), log_moduli=(0.0, 0.1))
    assert own.modulus_factor(40.0) == pytest.approx(10.0**0.05)


@pytest.mark.parametrize(
    ("given", "words"),
    [
        ({"law": "vft"}, "shift.law is 'vft'"),
        ({"law": "wlf", "c1": 8.0}, "shift.c2 is missing, but law: wlf needs it"),
        ({"law": "wlf", "c1": 8.0, "c2": 90.0, "activation_energy": 9.0}, "law: wlf has no use for it"),
        ({"law": "table", "temperatures": (0.0, 9.0), "log_factors": (0.0, 1.0)}, "rise with temperature"),
        ({"law": "table", "temperatures": (0.0, 9.0), "log_factors": (0.0,)}, "must have as many as"),
        ({"law": "table", "temperatures": (9.0, 0.0), "log_factors": (1.0, 0.0)}, "in ascending order"),
        ({"law": "table", "temperatures": (0.0, 9.0), "log_factors": (1.0, 0.0)}, "must lie within shift.temperatures"),
        ({"law": "wlf", "c1": 8.0, "c2": 90.0, "reference_temperature": 900.0}, "must be at most 500"),
    ],
)
def test_wrong_shifts_are_refused(given: dict[str, Any], words: str) -> None:
    with pytest.raises(InvalidInput, match=words):
        Shift(**{"reference_temperature": 20.0} | given)


def test_temperatures_out_of_reach_are_refused(paper_rubber: Material) -> None:
    with pytest.raises(InvalidInput, match=r"above T_ref - C2 = -81\.6 degC only"):
        WLF.factor(-90.0)
    with pytest.raises(InvalidInput, match="from 0 to 9 degC only"):
        Shift("table", 5.0, temperatures=(0.0, 9.0), log_factors=(1.0, 0.0)).factor(10.0)
    with pytest.raises(InvalidInput, match="out of the model's range"):
        ShiftedRubber(paper_rubber, WLF).at(-81.0)


def test_friction_at_a_temperature_is_that_at_another_speed(
    paper_scene: Callable[..., Scene], paper_rubber: Material
) -> None:
    scene = paper_scene(velocity=10.0, pressure=0.5)
    cold = ShiftedRubber(paper_rubber, WLF).at(0.0)
    times = np.array(cold.relaxation_times) / np.array(paper_rubber.relaxation_times)
    assert times == pytest.approx(WLF.factor(0.0), rel=1e-11)
    there = simulate(replace(scene, material=cold))
    here = simulate(replace(scene, velocity=10.0 * WLF.factor(0.0)))
    # Speeds and times are rounded to twelve digits.
    assert float(there["friction_coefficient"]) == pytest.approx(float(here["friction_coefficient"]), rel=1e-9)
