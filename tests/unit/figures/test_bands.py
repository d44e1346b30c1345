from __future__ import annotations

import numpy as np
import pytest
from matplotlib.colors import to_rgb
from matplotlib.figure import Figure

from rubfric.figures.bands import bands, draw_band, draw_parts, explain_parts, runs, upper

PLACES = np.array([1.0, 10.0, 100.0, 1000.0])
NAN = float("nan")


def test_band_lies_between_its_edges() -> None:
    panel = Figure().subplots()
    draw_band(panel, PLACES, np.array([0.1, 0.2, 0.3, 0.2]), np.array([0.01, 0.02, 0.03, 0.04]), "red")
    (band,) = bands(panel)
    corners = band.get_paths()[0].vertices
    for place, low, high in zip(PLACES, (0.09, 0.18, 0.27, 0.16), (0.11, 0.22, 0.33, 0.24), strict=True):
        heights = corners[corners[:, 0] == place, 1]
        assert (heights.min(), heights.max()) == pytest.approx((low, high))
    assert tuple(band.get_facecolor()[0][:3]) == to_rgb("red")
    assert 0.0 < band.get_alpha() < 0.5


def test_point_without_neighbours_has_a_bar() -> None:
    panel = Figure().subplots()
    draw_band(panel, PLACES, np.array([0.1, NAN, 0.3, 0.2]), np.array([0.01, 0.02, 0.03, 0.04]), "red")
    bar, band = bands(panel)
    np.testing.assert_allclose(bar.get_segments()[0], [[1.0, 0.09], [1.0, 0.11]])
    assert band.get_paths()[0].vertices[:, 0].min() == 100.0


def test_nothing_is_drawn_where_the_error_is_unknown() -> None:
    panel = Figure().subplots()
    draw_band(panel, PLACES, np.full(4, 0.1), np.array([NAN, np.inf, NAN, NAN]), "red")
    assert bands(panel) == []


def test_parts_of_an_error_lie_outside_of_each_other_and_are_paler() -> None:
    figure, values = Figure(), np.array([0.2, 0.3, 0.4, 0.5])
    panel = figure.subplots()
    panel.set_ylim(0.0, 0.6)
    parts = {"mesh and solver": 0.03 * values, "so few windows": 0.1 * values, "the rubber's data": 0.05 * values}
    draw_parts(panel, PLACES, values, list(parts.values()))
    outer, middle, inner = bands(panel)
    for band, share in ((outer, 0.18), (middle, 0.13), (inner, 0.03)):
        heights = band.get_paths()[0].vertices[:, 1]
        assert heights.max() == pytest.approx((1.0 + share) * 0.5)
    handles = explain_parts(figure, panel, values, parts)
    assert [one.get_label() for one in handles] == [
        "Error: mesh and solver,\nat most 3\N{NO-BREAK SPACE}%",
        "+ so few windows,\nat most 10\N{NO-BREAK SPACE}%",
        "+ the rubber's data,\nat most 5\N{NO-BREAK SPACE}%",
    ]
    # Where bands lie on one another they are as dark as the legend says.
    clear = np.cumprod([1.0 - (one.get_alpha() or 0.0) for one in (outer, middle, inner)])
    assert [one.get_alpha() for one in handles][::-1] == pytest.approx(1.0 - clear)
    (one,) = explain_parts(figure, panel, values, {"mesh and solver": 0.03 * values})
    assert one.get_label() == "Estimated error,\nat most 3\N{NO-BREAK SPACE}%"
    assert figure.get_supxlabel() == ""
    # What is too thin to be seen is in the note, and no entry of the legend.
    assert len(explain_parts(figure, panel, values, parts | {"mesh and solver": 0.001 * values})) == 2
    assert explain_parts(figure, panel, values, {"mesh and solver": 0.001 * values}) == []
    assert figure.get_supxlabel().splitlines() == [
        "Error from mesh and solver at most 0.1\N{NO-BREAK SPACE}%: too small for its band to be seen.",
        "Estimated error at most 0.1\N{NO-BREAK SPACE}%: too small for bands to be seen.",
    ]


def test_upper_edges_are_known_where_errors_are_not() -> None:
    edges = upper(np.array([0.1, 0.2, 0.3, NAN]), np.array([0.01, NAN, np.inf, 0.1]))
    np.testing.assert_allclose(edges, [0.11, 0.2, 0.3, NAN])


@pytest.mark.parametrize(
    ("known", "stretches"),
    [
        ([True, True, True], [(0, 3)]),
        ([False, True, False, True, True], [(1, 2), (3, 5)]),
        ([False, False], []),
        ([], []),
    ],
)
def test_runs_are_the_stretches_of_what_is_known(known: list[bool], stretches: list[tuple[int, int]]) -> None:
    assert [(run.start, run.stop) for run in runs(np.array(known, dtype=bool))] == stretches
