from __future__ import annotations

from collections.abc import Callable
from itertools import combinations
from pathlib import Path

import numpy as np
import pytest
import xarray as xr

from rubfric.errors import InvalidInput
from rubfric.figures import fig4, style

Maker = Callable[..., xr.Dataset]


@pytest.fixture
def results(make_result: Maker) -> list[xr.Dataset]:
    return [make_result(pressure, speed) for pressure in (0.2, 5.0) for speed in (1.0, 100.0, 10000.0)]


def test_rows_of_pressures_and_columns_of_speeds(results: list[xr.Dataset]) -> None:
    figure = fig4.draw(results[::-1])
    *panels, bar = figure.axes
    assert len(panels) == 6
    assert [panel.get_title() for panel in panels[:3]] == ["1 mm/s", "100 mm/s", "10\N{NO-BREAK SPACE}000 mm/s"]
    assert bar.get_ylabel() == "strain-energy density (MPa)"
    rows = sorted({round(panel.get_position().y0, 6) for panel in panels})
    assert len(rows) == 2


def test_all_panels_have_one_window_at_equal_scales(results: list[xr.Dataset]) -> None:
    figure = fig4.draw(results)
    *panels, _ = figure.axes
    assert len({(panel.get_xlim(), panel.get_ylim()) for panel in panels}) == 1
    (left, right), (bottom, top) = panels[0].get_xlim(), panels[0].get_ylim()
    # A crest in the middle, and half a wavelength above the road.
    assert 0.5 * (left + right) == pytest.approx(0.05)
    assert right - left == pytest.approx(0.25)
    assert top == pytest.approx(0.1)
    place = panels[0].get_position()
    width, height = figure.get_size_inches()
    across = place.width * width / (right - left)
    assert place.height * height / (top - bottom) == pytest.approx(across, rel=1e-6)


def test_one_colour_scale_for_all_panels(results: list[xr.Dataset]) -> None:
    *panels, _ = fig4.draw(results).axes
    images = [panel.get_images()[0] for panel in panels]
    assert len({id(image.norm) for image in images}) == 1
    density = np.concatenate([result["strain_energy_density"].values for result in results])
    assert images[0].norm.vmax == density.max()
    assert 0.0 < images[0].norm.vmin < np.median(density)


def test_contact_and_letters_stand_in_the_panels(results: list[xr.Dataset]) -> None:
    results[1]["contact_fraction"] = xr.DataArray(0.034)
    *panels, _ = fig4.draw(results).axes
    assert [text.get_text() for panel in panels for text in panel.texts] == [
        "(a) contact 28 %",
        "(b) contact 3 %",
        "(c) contact 28 %",
        "(d) contact 28 %",
        "(e) contact 28 %",
        "(f) contact 28 %",
    ]


def test_many_columns_leave_the_word_to_the_note(make_result: Maker, words: Callable[..., list[str]]) -> None:
    figure = fig4.draw([make_result(1.0, speed) for speed in (0.1, 1.0, 10.0, 100.0, 1000.0, 10000.0)])
    assert figure.axes[0].texts[0].get_text() == "(a) 28 %"
    assert "share of the nominal area in contact" in " ".join(words(figure)).replace("\n", " ")


def test_figure_says_what_it_shows(results: list[xr.Dataset], words: Callable[..., list[str]]) -> None:
    said = words(fig4.draw(results))
    for text in ("distance along the road (mm)", "height (mm)", "0.2\nMPa", "5\nMPa"):
        assert text in said
    note = " ".join(said).replace("\n", " ")
    assert "slides to the right" in note
    assert "without the mean compression of the block (3.6 % at 0.2 MPa, 90 % at 5 MPa)" in note


@pytest.mark.parametrize("speeds", [(10.0,), (1.0, 100.0), (0.1, 1.0, 10.0, 100.0, 1000.0, 10000.0)])
def test_nothing_is_written_over_anything_else(make_result: Maker, speeds: tuple[float, ...]) -> None:
    figure = fig4.draw([make_result(pressure, speed) for pressure in (0.2, 5.0) for speed in speeds])
    figure.draw_without_rendering()
    boxes = [text.get_window_extent() for text in figure.texts] + [panel.get_tightbbox() for panel in figure.axes]
    for one, other in combinations(boxes, 2):
        assert not one.overlaps(other)
    for box in boxes:
        assert figure.bbox.x0 <= box.x0 < box.x1 <= figure.bbox.x1
        assert figure.bbox.y0 <= box.y0 < box.y1 <= figure.bbox.y1


def test_result_without_a_road_is_refused(make_result: Maker) -> None:
    with pytest.raises(InvalidInput, match=r"^the result made up lacks surface_x, road_height$"):
        fig4.draw([make_result().drop_vars(["road_height", "surface_x"])])


def test_nothing_is_coloured_outside_the_block(make_result: Maker) -> None:
    panel, _ = fig4.draw([make_result(aspect=0.25)]).axes
    outline = panel.get_images()[0].get_clip_path().get_fully_transformed_path().get_extents()
    low, high = panel.transData.inverted().transform([outline.p0, outline.p1])[:, 1]
    assert low == pytest.approx(-0.015, abs=1e-6)
    # The block is 0.05 mm high, the window twice that.
    assert high == pytest.approx(0.05, abs=0.004)


def test_unstrained_block_on_a_flat_road_is_drawn(make_result: Maker, tmp_path: Path) -> None:
    result = make_result()
    for name in ("strain_energy_density", "displacement_y", "road_height"):
        result[name] = 0.0 * result[name]
    style.save(fig4.draw([result]), tmp_path / "a.png", tmp_path / "a.pdf")
