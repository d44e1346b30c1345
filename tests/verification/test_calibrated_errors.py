"""The estimated error of friction covers the true one, on scenes drawn anew: none of those it was calibrated on."""

from __future__ import annotations

import dataclasses
from collections.abc import Iterator
from pathlib import Path

import pandas as pd
import pytest

from rubfric.config.campaign import load
from rubfric.mechanics.steady.error import friction_error
from rubfric.scene.scene import Scene
from rubfric.simulation import solve
from rubfric.studies.accuracy.calibration import COVERAGE, EXCESS, calibrate, coverage_table
from rubfric.studies.accuracy.scenes import SETS, drawn_scenes

pytestmark = pytest.mark.thorough

CAMPAIGN = load(Path(__file__).resolve().parents[2] / "config/config.yaml")
SEED = 20251
# Scenes of each set, by kinematics.
COUNTS = {"small": 12, "finite": 2}
PRESETS = {name: CAMPAIGN.presets[name] for name in ("draft", "standard")}


def drawn() -> Iterator[tuple[str, Scene]]:
    for kinematics, count in COUNTS.items():
        for name, scene in drawn_scenes(CAMPAIGN, count, SEED).items():
            yield name, dataclasses.replace(scene, kinematics=kinematics)


def test_estimates_cover_true_errors_and_not_much_more() -> None:
    table = pd.concat([calibrate(name, name.partition("_")[0], scene, PRESETS) for name, scene in drawn()])
    found = coverage_table(table).set_index("set").loc["all"]
    assert found["scenes"] + found["refused"] == len(SETS) * sum(COUNTS.values()) * len(PRESETS)
    assert found["refused"] <= 0.1 * len(table)
    assert found["coverage"] >= COVERAGE
    assert found["ratio"] <= EXCESS
    standard = table[(table["preset"] == "standard") & table["estimate"].notna()]
    assert (standard["error"] <= PRESETS["standard"].accuracy).all()


@pytest.mark.parametrize(
    ("velocity", "pressure", "plane", "kinematics", "preset", "reference"),
    [
        (1e4, 3.0, "strain", "small", "standard", 0.231242),  # the finest waves have 48 columns each
        (1e3, 5.0, "strain", "small", "draft", 0.551094),
        (1e4, 0.5, "stress", "finite", "draft", 0.058760),  # four nodes in a spot, on one number of columns
    ],
)
def test_estimates_cover_the_true_errors_of_whole_roads(
    velocity: float, pressure: float, plane: str, kinematics: str, preset: str, reference: float
) -> None:
    """References are those of ``converge``, within 0.1 %."""
    scene = CAMPAIGN.scene("all", velocity, pressure, plane=plane, kinematics=kinematics, preset=preset)
    solution = solve(scene)
    error = abs(solution.friction.stress_power - reference)
    assert error <= friction_error(solution) <= 0.1 * reference
