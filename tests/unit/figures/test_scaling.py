from __future__ import annotations

import numpy as np
import pytest
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from rubfric.errors import InvalidInput
from rubfric.figures.scaling import plain, scale_decades, scale_friction, scale_speeds, tick_at


@pytest.fixture
def axes() -> Axes:
    panel: Axes = Figure().subplots()
    return panel


def ticks(panel: Axes, name: str) -> list[str]:
    """Return the numbers that are seen on an axis."""
    axis = getattr(panel, f"{name}axis")
    low, high = axis.get_view_interval()
    places = [place for place in axis.get_majorticklocs() if low <= place <= high]
    return [str(axis.get_major_formatter()(place)) for place in places]


def test_speeds_are_ticked_at_decades(axes: Axes) -> None:
    scale_speeds(axes, np.array([0.1, 500.0, 10000.0]))
    assert axes.get_xscale() == "log"
    assert ticks(axes, "x") == ["0.1", "1", "10", "100", "1000", "10\N{NO-BREAK SPACE}000"]
    low, high = axes.get_xlim()
    assert low < 0.1
    assert high > 10000.0


@pytest.mark.parametrize("speeds", [[70.0], [20.0, 30.0, 70.0]])
def test_few_speeds_are_ticked_themselves(axes: Axes, speeds: list[float]) -> None:
    scale_speeds(axes, np.array(speeds))
    assert ticks(axes, "x") == [f"{speed:g}" for speed in speeds]


@pytest.mark.parametrize(
    ("value", "digits", "said"),
    [
        *((-0.1, 12, "\N{MINUS SIGN}0.1"), (0.0785398, 3, "0.0785"), (1e-5, 12, "$10^{-5}$")),
        *((-2.5e-7, 12, "$\N{MINUS SIGN}2.5\\times 10^{-7}$"), (10000.0, 3, "10\N{NO-BREAK SPACE}000")),
    ],
)
def test_numbers_have_minus_signs_and_powers_of_ten(value: float, digits: int, said: str) -> None:
    assert plain(value, digits) == said


def test_speed_zero_is_refused(axes: Axes) -> None:
    with pytest.raises(InvalidInput, match=r"^speed 0 mm/s has no place on a logarithmic axis, but must be greater"):
        scale_speeds(axes, np.array([0.0, 1.0]))


@pytest.mark.parametrize(
    ("values", "low", "high"),
    [
        ([0.1, float("nan"), 0.5], 0.0, 0.54),
        ([0.0, 0.0], 0.0, 1.0),
        ([1e-17, -1e-17], -1.05e-17, 1.0),
        ([-0.1, 0.5], -0.105, 0.54),
    ],
)
def test_friction_starts_at_zero_and_holds_everything(axes: Axes, values: list[float], low: float, high: float) -> None:
    scale_friction(axes, np.array(values))
    assert axes.get_ylim() == pytest.approx((low, high), abs=1e-12)


@pytest.mark.parametrize(
    ("low", "high", "expected"),
    [
        (1e-3, 1e3, ["0.001", "0.01", "0.1", "1", "10", "100", "1000"]),
        (0.09, 1.1, ["0.1", "0.2", "0.5", "1"]),
        (1.5, 4.5, ["2", "3", "4"]),
    ],
)
def test_ordinates_of_decades_have_plain_numbers(axes: Axes, low: float, high: float, expected: list[str]) -> None:
    scale_decades(axes, low, high)
    assert ticks(axes, "y") == expected


def test_ticks_at_given_places(axes: Axes) -> None:
    axes.set_xlim(0.0, 2.0)
    tick_at(axes.xaxis, [0.25, 0.75, 1.5])
    assert ticks(axes, "x") == ["0.25", "0.75", "1.5"]
