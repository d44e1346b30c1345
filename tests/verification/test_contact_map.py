"""One Maxwell element, far from symmetric compliances: every scene is solved that has nodes enough in its contact."""

from __future__ import annotations

import random
from dataclasses import replace
from pathlib import Path

import pytest

import rubfric
from rubfric.rubber.material import BULK, Material
from rubfric.scene.scene import Scene

pytestmark = pytest.mark.thorough

CAMPAIGN = rubfric.load(Path(__file__).resolve().parents[2] / "config/config.yaml")
SCENES, TIME = 24, 1e-4


def drawn(chance: random.Random) -> Scene:
    """Return a scene with relaxed shares from 1e-4 to 1, k v tau over six decades and p / E_inf over four."""
    share, turns = 10.0 ** chance.uniform(-4.0, -1e-3), 10.0 ** chance.uniform(-3.0, 3.0)
    rubber = Material("one", 1.0, chance.choice((0.3, 0.49, 0.4999)), (1.0 - share,), (TIME,), bulk=chance.choice(BULK))
    made = CAMPAIGN.scene(
        scale := chance.choice((1, 2)),
        turns / (CAMPAIGN.road[scale - 1].wavenumber * TIME),
        10.0 ** chance.uniform(-3.0, 1.0),
        chance.choice((0.3, 0.75, 1.5)),
        plane=chance.choice(("stress", "strain")),
        kinematics="small",
        preset="draft",
    )
    return replace(made, material=rubber)


def test_no_scene_is_refused() -> None:
    chance = random.Random(14)
    for _ in range(SCENES):
        found = rubfric.simulate(drawn(chance))
        assert float(found["friction_coefficient"]) > 0.0
        assert float(found["energy_closure"]) < 0.25


def test_finite_strain_has_no_hole_between_pressures() -> None:
    rubber = Material("one", 1.0, 0.49, (0.999,), (TIME,))
    friction = []
    for pressure in (0.078, 0.08, 0.082):
        asked = CAMPAIGN.scene(2, 0.0375, pressure, plane="stress", kinematics="finite", preset="standard")
        friction.append(float(rubfric.simulate(replace(asked, material=rubber))["friction_coefficient"]))
    assert friction[1] == pytest.approx(0.5 * (friction[0] + friction[2]), rel=0.01)
