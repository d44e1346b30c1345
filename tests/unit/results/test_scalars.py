"""The scalars of every result: as many values as are declared, each with its unit, in either kinematics."""

from __future__ import annotations

import numpy as np
import pytest

from rubfric import simulation
from rubfric.results.scalars import SCALARS, attributes, scalars
from rubfric.road.sine import SineScale
from rubfric.rubber.material import Material
from rubfric.scene.numerics import Numerics
from rubfric.scene.scene import Scene

COARSE = Numerics(accuracy=0.1, contact_nodes=16, finite_contact_nodes=8, columns_min=64, finite_columns_min=32)
RUBBER = Material("soft", 4.17, 0.49, (0.3, 0.4, 1e-6), (1e-3, 1e-5, 1e-12))
KINEMATICS = pytest.mark.parametrize("kinematics", ["small", "finite"])


@pytest.fixture
def scene() -> Scene:
    return Scene(1, SineScale(0.015, 35.0), 100.0, 0.5, 0.75, RUBBER, "stress", COARSE)


def values(scene: Scene, kinematics: str) -> dict[str, float | int]:
    solution = simulation.solve(Scene(**{**vars(scene), "kinematics": kinematics}))
    return scalars(solution, simulation.evaluate(solution), 0.25)


@KINEMATICS
def test_values_are_those_declared_in_their_order(scene: Scene, kinematics: str) -> None:
    found = values(scene, kinematics)
    assert list(found) == list(SCALARS)
    assert all(np.isfinite(value) for value in found.values())
    assert found["wall_time"] == 0.25


def test_every_scalar_has_a_unit_and_a_name() -> None:
    for unit, long_name in SCALARS.values():
        assert unit
        assert long_name[0].islower() or long_name.startswith(("1 ", "Prony", "Newton"))


@KINEMATICS
def test_pressures_are_nominal_and_local(scene: Scene, kinematics: str) -> None:
    found = values(scene, kinematics)
    assert found["maximum_contact_pressure"] > 0.5
    same = found["maximum_local_contact_pressure"] == found["maximum_contact_pressure"]
    assert same == (kinematics == "small")
    assert found["finite_strain"] == (kinematics == "finite")


@KINEMATICS
def test_folded_branches_are_counted(scene: Scene, kinematics: str) -> None:
    found = values(scene, kinematics)
    assert (found["branches_relaxed"], found["branches_frozen"]) == (1, 0)
    assert 0.0 < found["folding_bound"] <= 1e-3


def test_load_presses_less_in_finite_strain(scene: Scene) -> None:
    small, finite = (values(scene, kinematics) for kinematics in ("small", "finite"))
    for name in ("nominal_compression", "pressed_energy_density"):
        assert 0.8 * small[name] < finite[name] < small[name]


def test_attributes_carry_unit_and_name_and_more() -> None:
    assert attributes("mm", "a length", axis="Y") == {"units": "mm", "long_name": "a length", "axis": "Y"}
