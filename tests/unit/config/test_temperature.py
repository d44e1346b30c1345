"""Temperatures of the grid: the rubber at each, names, what figures show, and what is refused."""

from __future__ import annotations

from dataclasses import replace
from typing import Any

import pytest

import rubfric
from rubfric.config.campaign import Campaign
from rubfric.errors import InvalidInput

WLF = {"law": "wlf", "c1": 8.0, "c2": 100.0, "reference_temperature": 20.0}


def warm(temperatures: Any, shift: Any = WLF, **more: Any) -> Campaign:
    rubbers = {"zhou2019": {"shift": shift}} if shift else {}
    return rubfric.load({"rubbers": rubbers, "grid": {"velocities": [1, 100], "temperatures": temperatures}, **more})


def test_every_scene_has_the_rubber_at_its_temperature() -> None:
    campaign = warm([60, -10, 20])
    scenes = campaign.scenes()
    assert campaign.temperatures == (-10.0, 20.0, 60.0)
    assert len(scenes) == 3 * len(campaign.at(20.0).scenes()) == 3 * 4 * 2 * 6
    assert set(campaign.at(60.0).scenes()) < set(scenes)
    cold = scenes["scale2_v100_p5_T-10_aspect0.75_stress"]
    factor = 10.0 ** (8.0 * 30.0 / 70.0)
    for time, reference in zip(cold.material.relaxation_times, campaign.material.relaxation_times, strict=True):
        assert time == pytest.approx(factor * reference, rel=1e-11)
    assert scenes["scale2_v100_p5_T20_aspect0.75_stress"].material == campaign.material
    assert campaign.scene(2, 100.0, 5.0, temperature=-10.0) == cold
    assert campaign.whole_parameters()["material"]["relaxation_times"] == campaign.material.relaxation_times
    assert campaign.at(-10.0).whole_parameters()["material"]["relaxation_times"] == cold.material.relaxation_times


def test_entropic_moduli_follow_absolute_temperature() -> None:
    campaign = warm([20, 60], WLF | {"vertical": "entropic"})
    ratio = campaign.scene(1, 1.0, 1.0, temperature=60.0).material.youngs_modulus / campaign.material.youngs_modulus
    assert ratio == pytest.approx(333.15 / 293.15, rel=1e-11)


@pytest.mark.parametrize(
    ("temperatures", "given", "shown"),
    [([0, 20, 60], None, 20.0), ([0, 30, 60], None, 30.0), ([0, 20, 60], 60, 60.0), ([0, 40], None, 0.0)],
)
def test_figures_show_the_temperature_nearest_to_the_reference(
    temperatures: list[float], given: float | None, shown: float
) -> None:
    figures = {} if given is None else {"figures": {"temperature": given}}
    campaign = warm(temperatures, transient={}, aspect_study={"aspects": [0.5]}, **figures)
    assert campaign.figures.temperature == shown
    fields, marches = campaign.field_scenes(), campaign.marches()
    studied = {name: one for name, one in campaign.scenes().items() if one.aspect == 0.5}
    assert min(map(len, (fields, marches, studied))) > 0
    assert {one.temperature for some in (fields, marches, studied) for one in some.values()} == {shown}
    assert set(fields) <= set(campaign.scenes())


def test_a_campaign_without_temperatures_has_scenes_without() -> None:
    campaign = warm([])
    assert {scene.temperature for scene in campaign.scenes().values()} == {None}
    assert list(campaign.by_temperature) == [None]
    assert "temperature" not in campaign.choices()["figures"]
    plain = replace(warm([], None), shift=campaign.shift)
    assert plain.scenes() == campaign.scenes()
    assert campaign.scene(1, 1.0, 1.0, temperature=0.0).name == "scale1_v1_p1_T0_aspect0.75_stress"


def test_what_follows_from_the_grid_is_a_config_again() -> None:
    campaign = warm([0, 60])
    chosen = {"figures": campaign.choices()["figures"]}
    assert warm([0, 60], **chosen) == campaign


@pytest.mark.parametrize(
    ("temperatures", "shift", "says"),
    [
        (
            [0, 20],
            None,
            r"grid.temperatures has 0, 20 degC, but rubber zhou2019 is known at one temperature only",
        ),
        ([-80, 0], WLF, r"grid.temperatures has -80 degC, but the WLF equation holds above .* -80 degC only"),
        ([20, 20.0], WLF, r"grid.temperatures\[1\] is 20 degC, the same as grid.temperatures\[0\]; keep one"),
        ([-300], WLF, r"grid.temperatures\[0\] is -300 degC, but must be at least -200"),
        (
            [20],
            {"law": "wlf", "c1": 8.0, "reference_temperature": 20},
            r"rubbers.zhou2019.shift.c2 is missing",
        ),
        ([20], WLF | {"c3": 1}, r"rubbers.zhou2019.shift has the unknown key 'c3'; allowed are law"),
        ([20], {"law": "wlf", "c1": 8.0, "c2": 100.0}, r"rubbers.zhou2019.shift lacks the key 'reference_temperature'"),
        (
            [0, 70],
            {"law": "table", "temperatures": [0, 50], "log_factors": [3, -1], "reference_temperature": 20},
            r"grid.temperatures has 70 degC, but shift factors are given from 0 to 50 degC only",
        ),
    ],
)
def test_temperatures_that_cannot_be_are_refused(temperatures: Any, shift: Any, says: str) -> None:
    with pytest.raises(InvalidInput, match=says) as refused:
        warm(temperatures, shift)
    assert len(refused.value.faults) == 1


def test_temperature_of_the_figures_is_one_of_the_grid() -> None:
    with pytest.raises(InvalidInput, match=r"figures.temperature has 30, but must be chosen from grid.*: 0, 20"):
        warm([0, 20], figures={"temperature": 30})
    with pytest.raises(InvalidInput, match="temperature is 5 degC, but rubber zhou2019 is known at one"):
        rubfric.load().scene(1, 100.0, 5.0, temperature=5.0)


def test_kelvin_and_rubbers_that_do_not_relax_are_unlikely() -> None:
    said = warm([20, 293.15]).unlikely()
    assert any("the temperature 293.15 degC is above" in one and "is it in K, 20 degC?" in one for one in said)
    assert any("rubber zhou2019 at 293.15 degC dissipates next to nothing" in one for one in said)
    assert not any("at 20 degC" in one for one in said)
    cold = rubfric.load({"rubbers": {"zhou2019": {"shift": WLF}}, "grid": {"temperatures": [-30, 20]}}).unlikely()
    assert [one.rpartition(": ")[2] for one in cold] == ["its series has none so fast"]
    assert cold[0].startswith("rubber zhou2019 at -30 degC is elastic at the highest speeds: the road excites it at ")
