from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

import numpy as np
import pytest
import xarray as xr
from matplotlib.axes import Axes

from rubfric.errors import InvalidInput
from rubfric.figures import fig2, style

Maker = Callable[..., xr.Dataset]


@pytest.fixture
def results(make_result: Maker) -> list[xr.Dataset]:
    return [make_result(pressure, speed) for pressure in (0.2, 5.0) for speed in (1.0, 100.0, 10000.0)]


def lines(panel: Axes, gid: str) -> list[tuple[np.ndarray, np.ndarray]]:
    return [
        (np.asarray(line.get_xdata()), np.asarray(line.get_ydata()))
        for line in panel.get_lines()
        if line.get_gid() == gid
    ]


def test_mean_and_range_of_every_speed_in_every_panel(results: list[xr.Dataset]) -> None:
    figure = fig2.draw(results[::-1])
    assert len(figure.axes) == 2
    for panel, scenes in zip(figure.axes, (results[:3], results[3:]), strict=True):
        means, edges = lines(panel, "mean"), lines(panel, "edge")
        assert (len(means), len(edges)) == (3, 6)
        for (depth, profile), scene in zip(means, scenes, strict=True):
            np.testing.assert_array_equal(depth, scene["depth"].values)
            np.testing.assert_array_equal(profile, scene["strain_energy_density_profile"].values)
        density = scenes[0]["strain_energy_density"].values.reshape(6, 17)
        np.testing.assert_array_equal(edges[0][1], density.min(axis=1))
        np.testing.assert_array_equal(edges[1][1], density.max(axis=1))


def test_steady_value_is_marked_where_the_profile_ends(make_result: Maker) -> None:
    figure = fig2.draw([make_result(2.0, aspect=3.0)])
    ((_, steady),) = lines(figure.axes[0], "steady")
    # p = 2 MPa, p / M = 0.36.
    np.testing.assert_allclose(steady, 0.36, rtol=1e-12)
    assert steady[0] == make_result(2.0, aspect=3.0)["pressed_energy_density"]
    ((_, profile),) = lines(figure.axes[0], "mean")
    assert profile[-1] == pytest.approx(0.36, rel=1e-6)


def test_steady_values_of_small_and_finite_strain_are_both_marked(make_result: Maker) -> None:
    kinds = ("finite", "small", "small")
    results = [make_result(5.0, speed, kinematics=kind) for speed, kind in zip((1.0, 10.0, 100.0), kinds, strict=True)]
    panel = fig2.draw(results).axes[0]
    levels = [float(level[0]) for _, level in lines(panel, "steady")]
    assert levels == [float(results[place]["pressed_energy_density"]) for place in (0, 1)]
    low, high = panel.get_ylim()
    assert low < levels[0] < levels[1] < high


def test_axes_hold_the_data_on_a_logarithmic_ordinate(results: list[xr.Dataset]) -> None:
    for panel, scene in zip(fig2.draw(results).axes, (results[0], results[3]), strict=True):
        assert panel.get_yscale() == "log"
        low, high = panel.get_ylim()
        assert low < scene["strain_energy_density"].values.min()
        assert high > scene["strain_energy_density"].values.max()
        assert panel.get_xlim() == (0.0, pytest.approx(0.15))


def test_of_many_speeds_the_ends_and_the_best_grip_are_drawn(make_result: Maker) -> None:
    speeds = (0.1, 1.0, 10.0, 100.0, 1000.0)
    figure = fig2.draw([make_result(1.0, speed) for speed in speeds])
    assert len(lines(figure.axes[0], "mean")) == 3
    assert [text.get_text() for text in figure.legends[0].get_texts()][:3] == [
        f"Mean at {speed} mm/s" for speed in ("0.1", "10", "1000")
    ]
    assert "but not 1, 100 mm/s" in figure.get_supxlabel().replace("\n", " ")


def test_result_without_a_profile_is_refused(make_result: Maker) -> None:
    with pytest.raises(InvalidInput, match=r"^the result made up lacks strain_energy_density_profile$"):
        fig2.draw([make_result().drop_vars("strain_energy_density_profile")])


def test_unstrained_block_is_drawn(make_result: Maker, tmp_path: Path) -> None:
    result = make_result()
    for name in ("strain_energy_density", "strain_energy_density_profile", "pressed_energy_density"):
        result[name] = 0.0 * result[name]
    style.save(fig2.draw([result]), tmp_path / "a.png")
