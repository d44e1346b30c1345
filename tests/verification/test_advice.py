"""What a refusal of a scene tells its reader to do is tried: it leads to a result."""

from __future__ import annotations

import re
from collections.abc import Callable
from dataclasses import replace
from pathlib import Path
from typing import Any

import pytest

import rubfric
from rubfric.errors import InvalidInput, NotConverged
from rubfric.scene.procedure import Procedure
from rubfric.scene.scene import Scene

pytestmark = pytest.mark.thorough

CAMPAIGN = rubfric.load(Path(__file__).resolve().parents[2] / "config/config.yaml")


def scene(*point: float, accuracy: float | None = None, **numerics: Any) -> Scene:
    """Return a scene of the paper in plane stress and small strain, or as ``numerics`` says."""
    words = {name: numerics.pop(name) for name in ("kinematics", "plane") if name in numerics}
    made = CAMPAIGN.scene(*point, preset="draft", **{"kinematics": "small"} | words)
    return replace(made, numerics=replace(made.numerics, **numerics | ({"accuracy": accuracy} if accuracy else {})))


def whole(velocity: float, pressure: float) -> Scene:
    """Return a scene of the whole road on few columns."""
    made = CAMPAIGN.scene("all", velocity, pressure, preset="draft", kinematics="small")
    return replace(made, numerics=replace(made.numerics, columns_max=4096))


def with_pressure(asked: Scene, said: re.Match[str]) -> Scene:
    return replace(asked, pressure=float(next(filter(None, said.groups()))))


def with_ratio(asked: Scene, said: re.Match[str]) -> Scene:
    return replace(asked, material=replace(asked.material, poissons_ratio=float(said[1])))


def with_numerics(**changes: Any) -> Callable[[Scene, re.Match[str]], Scene]:
    return lambda asked, _: replace(asked, numerics=replace(asked.numerics, **changes))


def in_small_strain(asked: Scene, _: re.Match[str]) -> Scene:
    return replace(asked, kinematics="small")


LIGHT = r"must be at least about (\S+) MPa|raise the pressure to about (\S+) MPa"
FEW = {"columns_min": 64, "columns_max": 64, "finite_columns_min": 64}
INCOMPRESSIBLE = replace(CAMPAIGN.material, poissons_ratio=0.4999999999)
REFUSALS = {
    "light: pressure": (scene(4, 1e3, 1e-5), LIGHT, with_pressure),
    "lighter: pressure": (scene(4, 1e3, 1e-7), LIGHT, with_pressure),
    "lighter, whole road": (whole(1e3, 1e-7), LIGHT, with_pressure),
    "light, stress: pressure": (scene(1, 1e4, 1e-5, 0.3), LIGHT, with_pressure),
    "light, strain: pressure": (scene(2, 1.0, 1e-6, plane="strain"), LIGHT, with_pressure),
    "light, slow: pressure": (scene(3, 0.1, 1e-7, 1.5), LIGHT, with_pressure),
    "light: columns": (scene(1, 1e3, 0.2, **FEW), "numerics.columns_max", with_numerics(columns_max=8192)),
    "light, finite: small": (scene(4, 1e3, 5e-4, kinematics="finite"), "kinematics: small", in_small_strain),
    "incompressible": (replace(scene(1, 10.0, 1.0), material=INCOMPRESSIBLE), r"at most (\S+) in", with_ratio),
    "incompressible, finite": (
        replace(scene(1, 10.0, 1.0, kinematics="finite", tolerance=1e-9), material=INCOMPRESSIBLE),
        r"at most (\S+) in",
        with_ratio,
    ),
}


@pytest.mark.parametrize("refusal", REFUSALS)
def test_advice_leads_to_a_result(refusal: str) -> None:
    asked, says, follow = REFUSALS[refusal]
    with pytest.raises((InvalidInput, NotConverged)) as caught:
        rubfric.simulate(asked)
    said = re.search(says, str(caught.value))
    assert said, str(caught.value)
    found = rubfric.simulate(follow(asked, said))
    assert float(found["friction_coefficient"]) > 0.0


def test_advice_leads_to_a_march() -> None:
    asked, procedure = scene(1, 1e3, 0.02), Procedure(columns=16, steps_per_wavelength=32, wavelengths=1)
    with pytest.raises(InvalidInput, match=r"procedure.columns is 16, but must be at least about \d+") as caught:
        rubfric.march(asked, procedure)
    procedure = replace(procedure, columns=int(re.findall(r"at least about (\d+)", str(caught.value))[0]))
    with pytest.raises(NotConverged, match=r"; raise procedure\.columns and procedure\.steps_per_wavelength$"):
        rubfric.march(asked, procedure)
    procedure = replace(procedure, columns=2 * procedure.columns, steps_per_wavelength=64)
    assert rubfric.march(asked, procedure).contact_nodes >= 2.0


def test_march_with_few_nodes_in_contact_is_told_what_helps() -> None:
    asked, procedure = scene(1, 1e3, 0.2), Procedure(columns=16, steps_per_wavelength=32, wavelengths=1)
    with pytest.raises(NotConverged, match=r"at least 2 make a contact: raise procedure\.columns or the pressure"):
        rubfric.march(asked, procedure)
    assert rubfric.march(asked, replace(procedure, columns=48)).contact_nodes >= 2.0
    assert rubfric.march(replace(asked, pressure=2.0), procedure).contact_nodes >= 2.0
