"""Estimated against true errors: every run where the table has it, and the numbers that the legend tells."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import pandas as pd
import pytest
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from rubfric.errors import InvalidInput
from rubfric.figures import calibration, style

Maker = Callable[..., pd.DataFrame]


def drawn(panel: Axes, gid: str) -> list[np.ndarray]:
    """Return the points of the lines of a kind, of shape (points, 2)."""
    return [np.stack(line.get_data(), axis=1) for line in panel.get_lines() if line.get_gid() == gid]


def told(figure: Figure) -> list[str]:
    return [text.get_text().replace("\N{NO-BREAK SPACE}", " ") for text in figure.legends[0].get_texts()]


def test_every_run_is_a_point_with_the_marker_of_its_kinematics(make_calibration: Maker) -> None:
    scatter, _ = calibration.draw(make_calibration()).axes
    small, finite = drawn(scatter, "runs small"), drawn(scatter, "runs finite")
    assert len(small) == len(finite) == 3
    for one, others in zip(small, finite, strict=True):
        np.testing.assert_allclose(one, [[0.1, 0.05]])
        np.testing.assert_allclose(others, [[0.2, 0.4], [0.4, 1.6], [0.8, 6.4]])
    looks = {line.get_gid(): line.get_marker() for line in scatter.get_lines()}
    assert looks["runs small"] != looks["runs finite"]
    assert len({line.get_color() for line in scatter.get_lines() if line.get_gid() == "runs small"}) == 3


def test_whiskers_are_the_reference_s_own_error(make_calibration: Maker) -> None:
    scatter, _ = calibration.draw(make_calibration(sets=("ladder",))).axes
    segments = [one for lines in scatter.collections if lines.get_gid() == "own" for one in lines.get_segments()]
    expected = [[[0.08, 0.05], [0.12, 0.05]], [[0.18, 0.4], [0.22, 0.4]]]
    np.testing.assert_allclose(segments[:2], expected)


def test_shares_are_those_of_the_ratios(make_calibration: Maker) -> None:
    _, shares = calibration.draw(make_calibration(sets=("inside",))).axes
    (steps,) = (patch for patch in shares.patches if patch.get_gid() == "shares")
    values, edges, _ = steps.get_data()
    np.testing.assert_allclose(values, [0.0, 25.0, 50.0, 75.0, 100.0])
    np.testing.assert_allclose(edges[1:-1], [0.5, 2.0, 4.0, 8.0])
    np.testing.assert_allclose(drawn(shares, "median")[0], [[3.0, 50.0]])


def test_ratios_beyond_the_panel_keep_their_share(make_calibration: Maker, tmp_path: Path) -> None:
    table = make_calibration(sets=("inside",))
    table["error"] = [0.0, 1e-12, 1e-3, 1e-3]
    table["estimate"] = [1e-3, 1e-3, 2e-3, 1e-9]
    figure = calibration.draw(table)
    shares = figure.axes[1]
    (steps,) = (patch for patch in shares.patches if patch.get_gid() == "shares")
    values, edges, _ = steps.get_data()
    left, right = shares.get_xlim()
    assert right / left < 1e5
    inside = (edges[:-1] < right) & (edges[1:] > left)
    assert values[inside].tolist() == [25.0, 50.0]
    style.save(figure, tmp_path / "beyond.png")


def test_refused_runs_need_not_be_judged(make_calibration: Maker) -> None:
    table = make_calibration(sets=("inside",)).astype({"covered": object, "kinematics": object})
    table.loc[1, ["error", "estimate", "covered", "kinematics"]] = np.nan
    assert told(calibration.draw(table))[0] == "Inside the paper's grid: 2 of 3 covered (66 %), median ratio 4"


@pytest.mark.thorough
@pytest.mark.parametrize(
    "sets", [("ladder",), ("ladder", "inside", "outside"), ("ladder", "inside", "outside", "a set of my own", "more")]
)
def test_no_words_cover_each_other(
    make_calibration: Maker,
    sets: tuple[str, ...],
    overlaps: Callable[[Figure], list[tuple[str, str]]],
    tmp_path: Path,
) -> None:
    figure = calibration.draw(make_calibration(sets))
    style.save(figure, tmp_path / "figure.png")
    assert overlaps(figure) == []


@pytest.mark.thorough
@pytest.mark.parametrize(
    "change",
    [{"error": 0.0}, {"estimate": 0.0}, {"error": 0.0, "estimate": 0.0}, {"reference": 0.0}, {"reference_error": 1.0}],
)
def test_zeros_and_vague_references_are_drawn(
    make_calibration: Maker, change: dict[str, float], tmp_path: Path
) -> None:
    figure = calibration.draw(make_calibration().assign(**change))
    style.save(figure, tmp_path / "figure.png")
    assert np.isfinite([*figure.axes[0].get_xlim(), *figure.axes[1].get_xlim()]).all()


@pytest.mark.parametrize(
    ("change", "complaint"),
    [
        ({"covered": "yes"}, r"^the column covered of the table of calibration must be True or False wherever there"),
        ({"kinematics": None}, r"^the column kinematics of the table of calibration has gaps"),
        ({"error": -0.1}, r"^the column error of the table of calibration has a number below 0"),
        ({"estimate": np.nan}, r"^the table of calibration has no run with both a true and an estimated error, but"),
        ({"set": None}, r"^the column set of the table of calibration has gaps"),
    ],
)
def test_bad_values_are_refused(make_calibration: Maker, change: dict[str, Any], complaint: str) -> None:
    with pytest.raises(InvalidInput, match=complaint):
        calibration.draw(make_calibration().assign(**change))
