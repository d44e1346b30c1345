"""The estimated error of friction covers the true one, on scenes drawn anew: none of those it was calibrated on."""

from __future__ import annotations

import dataclasses
from collections.abc import Iterator
from pathlib import Path

import pandas as pd
import pytest

from rubfric.config.campaign import load
from rubfric.scene.scene import Scene
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
