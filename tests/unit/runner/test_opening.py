"""What a run says first, and the time that it foresees from the first line on."""

from __future__ import annotations

from pathlib import Path

import pytest

from rubfric.config.campaign import load
from rubfric.progress import Progress, kind
from rubfric.runner.opening import Costs, understood

CONFIG = Path(__file__).resolve().parents[3] / "config" / "config.yaml"
OWN = """
road: r
roads: {r: [{amplitude: 15.0e-6, wavenumber: 35}]}
grid: {velocities: [1, 10], pressures: [0.5]}
"""


def test_paper_is_understood() -> None:
    lines = understood(load(CONFIG), own=False)
    assert "scale 4: wavelength 0.02094 mm, amplitude 0.002 mm, steepest slope 0.6" in lines
    assert lines[5] == (
        "the road excites the rubber at 3.5 to 3e+06 rad/s, where E' is 4.17 to 337 MPa and the loss factor 0.019 to "
        "1.7"
    )
    assert lines[6:] == [
        "168 scenes: 4 scales at 7 speeds and 6 loads, 56 more of the aspect study, 42 of the whole road"
    ]


def test_moduli_are_said_at_each_temperature() -> None:
    rubber = {"shift": {"law": "wlf", "c1": 8.0, "c2": 100.0, "reference_temperature": 20.0}}
    temperatures = [float(one) for one in range(0, 80, 10)]
    grid = {"velocities": [1, 10], "pressures": [0.5], "temperatures": temperatures}
    lines = understood(load({"rubbers": {"zhou2019": rubber}, "grid": grid}), own=True)
    assert "the road excites the rubber at 35 to 3e+03 rad/s" in lines
    assert [line.split(" E' ")[0] for line in lines if line.startswith("at ")] == [
        "at 0 degC (a_T = 100)",
        "at 20 degC (a_T = 1)",
        "at 40 degC (a_T = 0.0464)",
        "at 50 degC (a_T = 0.0143)",
        "at 70 degC (a_T = 0.00215)",
    ]
    assert "64 scenes: 4 scales at 2 speeds and 1 load at 8 temperatures, 16 of the whole road" in lines


def test_pairs_are_named_and_counted() -> None:
    other = {"fine": [{"amplitude": 15e-6, "wavelength": 0.2}]}
    lines = understood(load({"road": ["zhou2019", "fine"], "roads": other, "grid": {"velocities": [1, 10]}}), own=True)
    said = "of rubber zhou2019 and roads zhou2019, fine, this is zhou2019 on zhou2019, the first: "
    assert f"{said}all tables and figures but the comparison are of it; name another first to draw its own" in lines
    assert "1 other pair: 12 scenes, 12 of the whole road" in lines
    assert lines[-1].startswith("UNLIKELY: scale 1 of road fine, ")


def test_own_campaign_says_what_is_off_and_what_is_unlikely(tmp_path: Path) -> None:
    (tmp_path / "mine.yaml").write_text(OWN)
    lines = understood(load(CONFIG, tmp_path / "mine.yaml"), own=True)
    assert lines[1].startswith("a campaign of your own, the grid only, without aspect_study, transient, rig, claims")
    assert "2 scenes: 1 scale at 2 speeds and 1 load, 2 of the whole road" in lines
    assert lines[-1].startswith("UNLIKELY: scale 1 of the road, ")
    assert "in m, 0.015 mm?" in lines[-1]


def test_costs_follow_accuracy_kinematics_and_steps(tmp_path: Path) -> None:
    paths = {name: tmp_path / f"{name}.yaml" for name in ("draft", "small", "long")}
    paths["draft"].write_text("numerics: {preset: draft}")
    paths["small"].write_text("kinematics: small")
    paths["long"].write_text("transient: {columns: 128}")
    paper, draft, small, long = (Costs.of(load(CONFIG, *path)) for path in [(), *((one,) for one in paths.values())])
    assert draft.job("scene", "scene") == pytest.approx(0.44 * paper.job("scene", "scene"))
    assert small.job("scene", "scene") < 0.2 * paper.job("scene", "scene")
    assert long.job("march", "march") == pytest.approx(2.0 * paper.job("march", "march"))
    assert paper.job("fig_figure", kind("fig_figure")) > 0.0


def test_time_left_is_known_at_once_and_follows_the_machine() -> None:
    now = [0.0]
    progress = Progress({"scene": 100}, lambda: now[0], expected=lambda rule: 2.0, at_once=2)
    assert progress.remaining() == pytest.approx(100.0)
    for number in range(50):  # a machine five times as fast
        progress.start(number, "scene", f"scene{number}")
        now[0] += 0.4
        progress.finish(number)
    assert progress.remaining() == pytest.approx(50 * 0.4 / 2, rel=0.15)
    assert "about 10 s left" in progress.line()


def test_added_speeds_are_counted_before_they_are_solved() -> None:
    lines = understood(load({"grid": {"refine": 0.01}}), own=False)
    assert (
        "grid.refine 0.01 adds 24 speeds at most to each of 30 curves of friction: 1152 scenes and 144 of the whole "
        "road more at most, and half as many or fewer as a rule"
    ) in lines
    assert not any("refine" in line for line in understood(load(), own=False))
    costs = Costs.of(load({"grid": {"refine": 0.01}}))
    assert costs.job("refined_curve", "refined_curve") > 10.0 * costs.job("scene", "scene")
