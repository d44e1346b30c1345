from __future__ import annotations

from collections.abc import Callable
from itertools import product
from pathlib import Path

import numpy as np
import pytest
import xarray as xr
from matplotlib.axes import Axes
from matplotlib.collections import LineCollection
from matplotlib.figure import Figure
from matplotlib.patches import Rectangle

from rubfric.errors import InvalidInput
from rubfric.figures import fig11, style
from rubfric.figures.deformation import profile

Maker = Callable[..., xr.Dataset]


def panels(figure: Figure) -> tuple[list[Axes], list[Axes]]:
    """Return strips and spots, row by row."""
    return figure.axes[:-1:2], figure.axes[1:-1:2]


def touching(panel: Axes) -> list[np.ndarray]:
    """Return the stretches of contact in a panel, abscissae and heights."""
    left, right = panel.get_xlim()
    lines = [np.stack(line.get_data()) for line in panel.get_lines() if line.get_gid() == "contact"]
    return [line for line in lines if line[0].max() > left and line[0].min() < right]


def test_every_scene_has_a_strip_and_a_spot_to_scale(make_whole: Maker) -> None:
    results = [make_whole(pressure, speed) for pressure, speed in product((5.0, 0.2), (1.0, 100.0, 1000.0))]
    figure = fig11.draw(results)
    strips, spots = panels(figure)
    assert len(strips) == len(spots) == 6
    assert [panel.get_title() for panel in strips[:3]] == ["1 mm/s", "100 mm/s", "1000 mm/s"]
    assert figure.axes[-1].get_ylabel() == "Strain-energy density (MPa)"
    road = profile(results[0])
    for strip, spot in zip(strips, spots, strict=True):
        assert strip.get_xlim() == (0.0, road.period)
        assert spot.get_position().y1 < strip.get_position().y0
        for panel in (strip, spot):
            box = panel.get_window_extent()
            width, height = np.ptp(panel.get_xlim()), np.ptp(panel.get_ylim())
            assert box.height / box.width == pytest.approx(height / width, rel=1e-9)


def test_first_of_random_roads_is_called_so(make_whole: Maker, words: Callable[[Figure], list[str]]) -> None:
    def note(draws: int) -> str:
        return " ".join(words(fig11.draw([make_whole()], draws))[-1].split())

    assert "the first of 6 with random phases, and friction that on this road alone" in note(6)
    assert "random" not in note(0)


def test_window_of_a_measured_road_has_a_spot_of_some_finest_waves(
    make_whole: Maker, words: Callable[[Figure], list[str]], overlaps: Callable[..., list[tuple[str, str]]]
) -> None:
    results = [make_whole(pressure, speed) for pressure, speed in product((5.0, 0.2), (1.0, 1000.0))]
    figure = fig11.draw(results, 3, windows=True)
    strips, spots = panels(figure)
    period = profile(results[0]).period
    assert np.ptp(spots[0].get_xlim()) == pytest.approx(0.25 * period)
    # Two columns take the width of a page.
    assert strips[0].get_position().width * figure.get_figwidth() > 2.8
    assert overlaps(figure) == []
    note = " ".join(words(figure)[-1].split())
    assert note.startswith(f"The first of 3 windows of the measured road, {period:.3g} mm of it, made periodic, under")
    assert "random" not in note
    net = next(lines for lines in spots[0].collections if isinstance(lines, LineCollection))
    (left, right), (bottom, top) = spots[0].get_xlim(), spots[0].get_ylim()
    for line in net.get_segments():
        assert line[:, 0].max() >= left
        assert line[:, 0].min() <= right
        assert line[:, 1].max() >= bottom
        assert line[:, 1].min() <= top


def test_spot_is_framed_and_holds_the_highest_crest(make_whole: Maker) -> None:
    result = make_whole()
    ((strip,), (spot,)) = panels(fig11.draw([result]))
    (frame,) = (patch for patch in strip.patches if isinstance(patch, Rectangle) and patch.get_gid() == "spot")
    assert (frame.get_x(), frame.get_x() + frame.get_width()) == pytest.approx(spot.get_xlim())
    x = np.linspace(*strip.get_xlim(), 10_000)
    heights = profile(result).height(x)
    assert spot.get_xlim()[0] < x[np.argmax(heights)] < spot.get_xlim()[1]
    assert spot.get_ylim()[1] > heights.max()
    (net,) = (lines for lines in spot.collections if isinstance(lines, LineCollection))
    assert net.get_segments()


def test_contact_is_drawn_on_the_road_where_there_is_pressure(make_whole: Maker) -> None:
    result = make_whole()
    ((strip,), _) = panels(fig11.draw([result]))
    road = profile(result)
    stretches = touching(strip)
    for x, y in stretches:
        np.testing.assert_allclose(y, road.height(x), atol=1e-12)
    length = sum(np.ptp(np.clip(x, 0.0, road.period)) for x, _ in stretches)
    share = float((result["contact_pressure"] > 0.0).mean())
    assert length == pytest.approx(share * road.period, rel=1e-9)


def test_contact_across_the_end_of_the_period_is_whole(make_whole: Maker) -> None:
    result = make_whole()
    pressure = np.zeros(224)
    pressure[[0, 1, 223]] = 1.0
    result["contact_pressure"] = ("surface_x", pressure)
    ((strip,), _) = panels(fig11.draw([result]))
    column = profile(result).period / 224
    ends = sorted((x.min() / column, x.max() / column) for x, _ in touching(strip))
    assert ends == [pytest.approx(pair) for pair in ((-0.5, 1.5), (222.5, 223.5), (223.5, 225.5))]


def test_friction_with_error_and_contact_are_written(make_whole: Maker, words: Callable[..., list[str]]) -> None:
    said = words(fig11.draw([make_whole(0.2), make_whole(5.0)]))
    assert "(a) μ = 0.43 ± 0.02, contact 28 %" in said
    assert {"0.2\nMPa", "5\nMPa"} <= set(said)


def test_refused_scene_says_so_on_its_road(
    make_whole: Maker, words: Callable[..., list[str]], overlaps: Callable[..., list[tuple[str, str]]], tmp_path: Path
) -> None:
    reason = "made up: not converged after 34 steps, distance from balance is 0.01; ask for a lower pressure, " * 5
    figure = fig11.draw([make_whole(0.2, kinematics="small"), make_whole(5.0, refusal=reason)])
    style.save(figure, tmp_path / "fig11.png")
    said = words(figure)
    assert "(b) Refused" in said
    (shown,) = (text for text in said if "not converged" in text)
    assert shown.startswith("not converged after 34 steps")
    assert overlaps(figure) == []
    (_, (_, spot)) = panels(figure)
    assert [line.get_gid() for line in spot.get_lines()][:1] == ["road"]
    assert not touching(spot)


def test_only_refusals_still_show_the_road(make_whole: Maker, tmp_path: Path) -> None:
    style.save(fig11.draw([make_whole(refusal="no solution")]), tmp_path / "fig11.pdf")


@pytest.mark.thorough
def test_twelve_scenes_fit_on_the_page(
    make_whole: Maker, overlaps: Callable[..., list[tuple[str, str]]], tmp_path: Path
) -> None:
    results = [make_whole(pressure, speed) for pressure, speed in product((0.2, 1.0, 5.0), (0.1, 10.0, 100.0, 1e4))]
    figure = fig11.draw(results)
    style.save(figure, tmp_path / "fig11.png")
    assert figure.get_figwidth() <= style.DOUBLE_COLUMN + 1e-9
    assert overlaps(figure) == []


def test_gaps_and_results_of_one_scale_are_refused(make_whole: Maker, make_result: Maker) -> None:
    with pytest.raises(InvalidInput, match=r"^there is no result at pressure 5 MPa, speed 10 mm/s"):
        fig11.draw([make_whole(1.0, 1.0), make_whole(1.0, 10.0), make_whole(5.0, 1.0)])
    with pytest.raises(InvalidInput, match=r"lacks scene_parameters$"):
        fig11.draw([make_result()])
    with pytest.raises(InvalidInput, match=r"lacks contact_pressure$"):
        fig11.draw([make_whole().drop_vars("contact_pressure")])
