from __future__ import annotations

import re
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import pytest
import xarray as xr
from matplotlib.axes import Axes

from rubfric.errors import InvalidInput
from rubfric.figures import fig5, style

WAVELENGTH, PER_WAVELENGTH, PRESSED, STARTING = 0.2, 16, 6, 8


def make_march(
    speed: float = 10.0,
    steady: float = 0.2,
    wavelengths: int = 5,
    saturated: bool = True,
    memory: float = 0.5,
    wave: float = 0.0,
    start: bool = True,
    **attributes: Any,
) -> xr.Dataset:
    """Return a march whose friction goes exponentially to a steady value, with a wave that stays."""
    share = np.arange(1.0, STARTING + 1.0) / STARTING if start else np.zeros(0)
    begin = 0.25 if start else 0.0
    count = wavelengths * PER_WAVELENGTH
    slid = np.concatenate([begin * share**3 * (2.0 - share), begin + np.arange(1.0, count + 1.0) / PER_WAVELENGTH])
    friction = steady * (1.0 - np.exp(-2.0 * slid) + wave * np.sin(2.0 * np.pi * slid))
    pressed = np.zeros(PRESSED if start else 0)
    means = friction[slid.size - count :].reshape(wavelengths, PER_WAVELENGTH).mean(axis=1)
    phase = np.repeat([0, 1, 2, 3], [pressed.size // 2, pressed.size // 2, share.size, count]).astype(np.int8)
    return xr.Dataset(
        {
            "slid": ("step", WAVELENGTH * np.concatenate([pressed, slid])),
            "phase": ("step", phase),
            "friction_contact": ("step", np.concatenate([pressed, friction])),
            "mean_friction": ("wavelength", means),
            "steady_friction_coefficient": steady,
            "saturated": int(saturated),
            "saturation_friction": means[-1] if wavelengths else np.nan,
            "memory_wavelengths": memory,
        },
        attrs={
            "scene": f"made up at {speed:g}",
            "velocity": speed,
            "pressure": 0.5,
            "scale": 1,
            "aspect": 0.75,
            "kinematics_used": "finite",
            "wavelength_mm": WAVELENGTH,
            "steps_per_wavelength": PER_WAVELENGTH,
        }
        | attributes,
    )


def three() -> list[xr.Dataset]:
    """Return marches in no order, the fastest not saturated."""
    slow, fast = make_march(1.0, 0.1, 3), make_march(10000.0, 0.05, 30, saturated=False, memory=632.3, wave=3.0)
    return [fast, slow, make_march(10.0, 0.2, 5)]


def marks(panel: Axes, name: str) -> list[tuple[list[float], list[float]]]:
    """Return the data of marks, by ascending speed."""
    found = [line for line in panel.get_lines() if line.get_gid() == name]
    return [(list(map(float, line.get_xdata())), list(map(float, line.get_ydata()))) for line in found[::-1]]


def test_lines_begin_where_the_block_moves(series: Callable[..., Any]) -> None:
    results = three()
    figure = fig5.draw(results)
    # The panel of means has no other lines.
    assert [len(series(panel)) for panel in figure.axes] == [3, 0]
    moving = results[2].isel(step=slice(PRESSED, None))
    steps, friction = series(figure.axes[0])[1]
    assert steps == list(range(1, STARTING + 5 * PER_WAVELENGTH + 1))
    assert friction == list(moving["friction_contact"].values)


def test_steady_values_cross_both_panels() -> None:
    for panel in fig5.draw(three()).axes:
        assert marks(panel, "steady") == [([0.0, 1.0], [value, value]) for value in (0.1, 0.2, 0.05)]


def test_means_lie_in_the_middle_of_their_wavelengths() -> None:
    results = three()
    by_step, by_distance = (marks(panel, "mean") for panel in fig5.draw(results).axes)
    places, values = by_distance[1]
    np.testing.assert_allclose(places, 0.25 + np.arange(5) + 0.5)
    assert values == list(results[2]["mean_friction"].values)
    assert by_step[1] == ([STARTING + 4.5 * PER_WAVELENGTH], values[-1:])


def test_rings_mark_what_is_saturated() -> None:
    results = three()
    for panel in fig5.draw(results).axes:
        heights = [height for _, (height,) in marks(panel, "saturated")]
        assert heights == [float(results[1]["saturation_friction"]), float(results[2]["saturation_friction"])]


def test_every_value_lies_within_the_axes() -> None:
    figure = fig5.draw(three())
    by_step, by_distance = figure.axes
    low, high = by_step.get_ylim()
    values = np.concatenate([result["friction_contact"].values for result in three()])
    assert low < values.min() < 0.0
    assert high > values.max()
    means = np.concatenate([result["mean_friction"].values for result in three()])
    assert by_distance.get_ylim()[0] <= means.min() < means.max() < by_distance.get_ylim()[1]
    assert by_step.get_xlim()[1] > STARTING + 30 * PER_WAVELENGTH
    assert by_distance.get_xlim()[1] > 30.25
    assert [len(marks(panel, "zero")) for panel in figure.axes] == [1, int(means.min() < 0.0)]


def test_negative_numbers_have_minus_signs_and_no_hyphens(words: Callable[..., list[str]], tmp_path: Path) -> None:
    figure = fig5.draw(three())
    style.save(figure, tmp_path / "fig5.pdf")
    numbers = [one for one in words(figure) if re.match(r"[-\N{MINUS SIGN}]\d", one)]
    assert numbers
    assert all(one.startswith("\N{MINUS SIGN}") for one in numbers)
    assert b"/Type3" not in (tmp_path / "fig5.pdf").read_bytes()


def test_a_start_from_steady_sliding(series: Callable[..., Any]) -> None:
    figure = fig5.draw([make_march(start=False)])
    by_step, by_distance = figure.axes
    assert series(by_step)[0][0][0] == 1.0
    np.testing.assert_allclose(marks(by_distance, "mean")[0][0], np.arange(5) + 0.5)
    assert marks(by_step, "mean")[0][0] == [4.5 * PER_WAVELENGTH]


@pytest.mark.parametrize("count", [1, 7, 12])
def test_nothing_is_written_over_anything_or_off_the_page(count: int, tmp_path: Path) -> None:
    speeds = np.logspace(-1.0, 5.0, count).round(1)
    figure = fig5.draw([make_march(speed, 0.1, saturated=False, memory=speed) for speed in speeds])
    style.save(figure, tmp_path / "fig5.pdf", tmp_path / "fig5.png")
    assert figure.get_figwidth() == style.DOUBLE_COLUMN
    page = figure.bbox
    below = next(text for text in figure.texts if text.get_text() == figure.get_supxlabel())
    boxes = [panel.get_tightbbox() for panel in figure.axes]
    boxes += [below.get_window_extent(), figure.legends[0].get_window_extent()]
    for number, box in enumerate(boxes):
        assert box.x0 >= page.x0
        assert box.y0 >= page.y0
        assert box.x1 <= page.x1
        assert box.y1 <= page.y1
        # Boxes that touch by rounding to pixels do not overlap.
        assert not any(box.padded(-2.0).overlaps(other) for other in boxes[:number])


@pytest.mark.parametrize(
    ("change", "said"),
    [
        ({"scale": 2}, "scale 2, pressure 0.5 MPa, height-to-width ratio 0.75"),
        ({"pressure": 5.0}, "scale 1, pressure 5 MPa, height-to-width ratio 0.75"),
        ({"aspect": 1.5}, "scale 1, pressure 0.5 MPa, height-to-width ratio 1.5"),
    ],
)
def test_different_blocks_are_refused(change: dict[str, float], said: str) -> None:
    with pytest.raises(InvalidInput, match=rf"^the marches are of .*{said}.*, but one figure shows one block$"):
        fig5.draw([make_march(1.0), make_march(10.0, **change)])


def test_what_cannot_be_drawn_is_refused() -> None:
    with pytest.raises(InvalidInput, match=r"^there are no marches to draw, but at least one is needed$"):
        fig5.draw([])
    with pytest.raises(InvalidInput, match=r"^there are two marches at speed 10 mm/s, but one line shows only one$"):
        fig5.draw([make_march(), make_march()])
    with pytest.raises(InvalidInput, match=r"^the march at speed 10 mm/s has no step in which the block slides$"):
        fig5.draw([make_march().isel(step=slice(0, PRESSED))])


@pytest.mark.parametrize("name", ["slid", "phase", "friction_contact", "mean_friction", "saturated"])
def test_lacking_variables_are_named(name: str) -> None:
    with pytest.raises(InvalidInput, match=rf"^the march made up at 10 lacks {name}$"):
        fig5.draw([make_march().drop_vars(name)])


def test_lacking_attributes_are_named() -> None:
    march = make_march()
    del march.attrs["wavelength_mm"], march.attrs["scene"]
    with pytest.raises(InvalidInput, match=r"^the march without a name lacks wavelength_mm$"):
        fig5.draw([march])
