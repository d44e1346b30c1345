"""Estimated beside true errors: covered or not, how tightly, refusals, and the verdict on all of them."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from typing import Any

import numpy as np
import pandas as pd
import pytest
import xarray as xr

from rubfric.errors import InvalidInput, NotConverged
from rubfric.scene.numerics import Numerics
from rubfric.scene.scene import Scene
from rubfric.studies.accuracy import calibration
from rubfric.studies.accuracy.calibration import COVERAGE, EXCESS, calibrate, coverage_table, preset_rows
from rubfric.studies.accuracy.converged import Converged

SceneMaker = Callable[..., Scene]
PRESETS = {"draft": Numerics(accuracy=0.05), "standard": Numerics()}
REFERENCE = Converged(0.2, 1e-5, 1024, 100, "finite")


class Answers:
    """What simulation and reference answer, without solving anything."""

    def __init__(self) -> None:
        self.of: dict[Scene, tuple[float, float, str] | Exception] = {}
        self.reference: Converged | Exception = REFERENCE
        self.converged: list[Scene] = []

    def simulate(self, scene: Scene) -> xr.Dataset:
        answer = self.of[scene]
        if isinstance(answer, Exception):
            raise answer
        friction, error, warnings = answer
        return xr.Dataset(
            {"friction_coefficient": friction, "friction_coefficient_error": error},
            attrs={"kinematics_used": "finite", "warnings": warnings},
        )

    def converge(self, scene: Scene) -> Converged:
        self.converged.append(scene)
        if isinstance(self.reference, Exception):
            raise self.reference
        return self.reference


@pytest.fixture
def answers(monkeypatch: pytest.MonkeyPatch) -> Answers:
    found = Answers()
    monkeypatch.setattr(calibration, "simulate", found.simulate)
    monkeypatch.setattr(calibration, "converge", found.converge)
    return found


@pytest.fixture
def scene(paper_scene: SceneMaker) -> Scene:
    return paper_scene(100.0, 0.5, kinematics="auto", plane="stress")


def calibrated(
    answers: Answers,
    scene: Scene,
    draft: tuple[float, float, str] | Exception,
    standard: tuple[float, float, str] | Exception = (0.2001, 2e-4, ""),
) -> pd.DataFrame:
    for name, answer in (("draft", draft), ("standard", standard)):
        answers.of[replace(scene, numerics=PRESETS[name])] = answer
    return calibrate("some", "inside", scene, PRESETS).set_index("preset")


@pytest.mark.parametrize(
    ("friction", "estimate", "covered", "ratio"),
    [
        (0.21, 0.02, True, 2.0),
        (0.19, 0.02, True, 2.0),
        (0.21, 0.009, False, 0.9),
        (0.2, 0.001, True, 1e5),  # no error is taken smaller than a thousandth of the reference's own
    ],
)
def test_estimate_is_judged_by_the_true_error(
    answers: Answers, scene: Scene, friction: float, estimate: float, covered: bool, ratio: float
) -> None:
    table = calibrated(answers, scene, (friction, estimate, ""))
    row = table.loc["draft"]
    assert row["covered"] == covered
    assert row["ratio"] == pytest.approx(ratio, rel=1e-9)
    assert row["friction_coefficient"] == friction
    # Relative to the reference.
    assert row["error"] == pytest.approx(abs(friction - 0.2) / 0.2, rel=1e-9)
    assert row["estimate"] == pytest.approx(estimate / 0.2, rel=1e-12)
    assert (row["reference"], row["reference_error"]) == (0.2, 1e-5)
    assert len(answers.converged) == 1  # one reference for all presets


def test_rows_tell_the_scene(answers: Answers, scene: Scene) -> None:
    table = calibrated(answers, scene, (0.21, 0.02, "one.\nanother."))
    assert list(table.index) == ["draft", "standard"]
    assert set(table["scene"]) == {"some"}
    assert set(table["set"]) == {"inside"}
    assert set(table["kinematics"]) == {"finite"}
    assert list(table["note"]) == ["one. another.", ""]
    row = table.loc["draft"]
    assert (row["plane"], row["velocity"], row["pressure"], row["aspect"]) == ("stress", 100.0, 0.5, 0.75)
    assert (row["slope"], row["wavelength"]) == (scene.road.steepest_slope, scene.road.wavelength)


@pytest.mark.parametrize("refusal", [InvalidInput("too heavy a load"), NotConverged("some", 3, 0.5, "something")])
def test_refused_preset_has_its_reason_and_no_numbers(answers: Answers, scene: Scene, refusal: Exception) -> None:
    table = calibrated(answers, scene, refusal)
    row = table.loc["draft"]
    assert row["note"] == str(refusal)
    assert row[["friction_coefficient", "reference", "error", "estimate", "covered", "ratio"]].isna().all()
    assert table.loc["standard", "covered"]


def test_scene_refused_by_all_presets_needs_no_reference(answers: Answers, scene: Scene) -> None:
    refusal = InvalidInput("too heavy a load")
    table = calibrated(answers, scene, refusal, refusal)
    assert table["estimate"].isna().all()
    assert answers.converged == []


def test_scene_without_a_reference_is_judged_by_none(answers: Answers, scene: Scene) -> None:
    answers.reference = NotConverged("some", 3, 0.5, "something")
    table = calibrated(answers, scene, (0.21, 0.02, ""))
    assert set(table["note"]) == {f"no reference: {answers.reference}"}
    assert table[["friction_coefficient", "estimate", "covered", "ratio"]].isna().all(axis=None)


def test_other_errors_are_no_refusals(answers: Answers, scene: Scene) -> None:
    with pytest.raises(ZeroDivisionError):
        calibrated(answers, scene, ZeroDivisionError("a defect"))


def judged(kind: str, covered: list[bool], ratios: list[float], refused: int = 0) -> pd.DataFrame:
    """Return a table of one set, as of ``calibrate``."""
    rows: list[dict[str, Any]] = [
        {"set": kind, "estimate": 0.01, "covered": one, "ratio": ratio}
        for one, ratio in zip(covered, ratios, strict=True)
    ]
    rows += [{"set": kind, "estimate": np.nan, "covered": np.nan, "ratio": np.nan}] * refused
    return pd.DataFrame(rows).astype({"covered": object})


@pytest.mark.parametrize(
    ("missed", "ratio", "holds"),
    [
        (0, 3.0, True),
        (1, 3.0, True),  # 19 of 20
        (2, 3.0, False),
        (0, 10.0, True),
        (0, 10.1, False),
    ],
)
def test_verdict_asks_for_coverage_and_tightness(missed: int, ratio: float, holds: bool) -> None:
    assert (COVERAGE, EXCESS) == (0.95, 10.0)
    table = judged("inside", [False] * missed + [True] * (20 - missed), [ratio] * 20, refused=3)
    for _, row in coverage_table(table).iterrows():
        assert (row["scenes"], row["refused"]) == (20, 3)
        assert row["coverage"] == pytest.approx(1.0 - missed / 20.0)
        assert row["ratio"] == ratio
        assert row["holds"] == holds


def test_verdict_is_on_each_set_and_on_all_together() -> None:
    good = judged("ladder", [True] * 3, [1.0, 2.0, 90.0])
    bad = judged("outside", [True, False], [0.5, 4.0], refused=1)
    found = coverage_table(pd.concat([good, bad], ignore_index=True)).set_index("set")
    assert list(found.index) == ["ladder", "outside", "all"]
    assert list(found["scenes"]) == [3, 2, 5]
    assert list(found["refused"]) == [0, 1, 1]
    np.testing.assert_allclose(found["coverage"], [1.0, 0.5, 0.8])
    np.testing.assert_allclose(found["ratio"], [2.0, 2.25, 2.0])  # medians
    assert list(found["holds"]) == [True, False, False]


def test_verdict_on_refusals_alone_does_not_hold() -> None:
    found = coverage_table(judged("inside", [], [], refused=2)).set_index("set")
    assert list(found["scenes"]) == [0, 0]
    assert not found["holds"].any()


def test_presets_of_a_ladder_are_judged_alike() -> None:
    ladder = pd.DataFrame(
        {
            "scene": ["a"] * 4,
            "velocity": 1.0,
            "knob": ["preset", "preset", "mesh", "preset"],
            "rung": ["draft", "standard", "1", "reference"],
            "friction_coefficient": [0.21, 0.2, 0.3, np.nan],
            "reference": 0.2,
            "reference_error": 1e-5,
            "error": [0.05, 0.0, 0.5, np.nan],
            "estimate": [0.04, 0.001, 0.9, np.nan],
            "note": ["", "", "", "refused"],
        }
    )
    found = preset_rows(ladder).set_index("preset")
    assert list(found.index) == ["draft", "standard", "reference"]
    assert set(found["set"]) == {"ladder"}
    assert list(found["covered"])[:2] == [False, True]
    np.testing.assert_allclose(found["ratio"].astype(float)[:2], [0.8, 0.001 / 5e-8])
    row = coverage_table(found.reset_index()).set_index("set").loc["ladder"]
    assert (row["scenes"], row["refused"], row["coverage"]) == (2, 1, 0.5)
