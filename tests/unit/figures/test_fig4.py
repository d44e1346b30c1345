from __future__ import annotations

from collections.abc import Callable
from itertools import combinations
from pathlib import Path

import numpy as np
import pytest
import xarray as xr
from matplotlib.axes import Axes
from matplotlib.collections import LineCollection, QuadMesh

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
    assert bar.get_ylabel() == "Strain-energy density (MPa)"
    rows = sorted({round(panel.get_position().y0, 6) for panel in panels})
    assert len(rows) == 2


@pytest.fixture
def finite(make_result: Maker) -> list[xr.Dataset]:
    return [
        make_result(pressure, speed, kinematics="finite") for pressure in (0.2, 5.0) for speed in (1.0, 100.0, 10000.0)
    ]


def drawn(panel: Axes) -> QuadMesh:
    """Return the mesh of the block in a panel."""
    (mesh,) = (artist for artist in panel.collections if isinstance(artist, QuadMesh))
    return mesh


def net(panel: Axes) -> LineCollection:
    (lines,) = (artist for artist in panel.collections if isinstance(artist, LineCollection))
    return lines


def face(panel: Axes, gid: str) -> np.ndarray:
    (line,) = (line for line in panel.get_lines() if line.get_gid() == gid)
    return np.stack((line.get_xdata(), line.get_ydata()))


@pytest.mark.parametrize(
    ("kinematics", "aspect", "highest"),
    [
        # Half a wavelength above the road.
        ("small", 0.75, 0.1),
        # All of a block 0.15 mm high and pressed by 3.5 % or 47 %, and 0.008 mm.
        ("finite", 0.75, 0.15 / 1.036 + 0.008),
        ("finite", 0.25, 0.05 / 1.036 + 0.008),
        # A wavelength above the road at most.
        ("finite", 1.5, 0.2),
    ],
)
def test_all_panels_have_one_window_at_equal_scales(
    make_result: Maker, kinematics: str, aspect: float, highest: float
) -> None:
    figure = fig4.draw(
        [make_result(pressure, speed, 1, aspect, kinematics) for pressure in (0.2, 5.0) for speed in (1.0, 10.0)]
    )
    *panels, _ = figure.axes
    assert len({(panel.get_xlim(), panel.get_ylim()) for panel in panels}) == 1
    (left, right), (bottom, top) = panels[0].get_xlim(), panels[0].get_ylim()
    # A crest in the middle.
    assert 0.5 * (left + right) == pytest.approx(0.05)
    assert right - left == pytest.approx(0.25)
    assert top == pytest.approx(highest, abs=0.004 if aspect == 0.25 else 2e-4)
    place = panels[0].get_position()
    width, height = figure.get_size_inches()
    across = place.width * width / (right - left)
    assert place.height * height / (top - bottom) == pytest.approx(across, rel=1e-6)


def test_one_colour_scale_for_all_panels(results: list[xr.Dataset]) -> None:
    *panels, _ = fig4.draw(results).axes
    (norm,) = {drawn(panel).norm for panel in panels}
    density = np.concatenate([result["strain_energy_density"].values for result in results])
    assert norm.vmax == density.max()
    assert 0.0 < norm.vmin < np.median(density)


def test_finite_strain_shows_the_whole_pressed_and_leaning_block(finite: list[xr.Dataset]) -> None:
    *panels, _ = fig4.draw(finite).axes
    for panel, compression in ((panels[0], 0.036 / 1.036), (panels[3], 0.9 / 1.9)):
        (left, right), (_, top) = panel.get_xlim(), panel.get_ylim()
        x, y = face(panel, "upper face")
        assert y.max() < top
        assert y.mean() == pytest.approx(0.15 * (1.0 - compression), rel=2e-3)
        assert x[0] < left
        assert x[-1] > right
        # Lines that were upright lean to the right by the shear.
        upright = [line for line in net(panel).get_segments() if len(line) == 6]
        assert len(upright) > 8
        for line in upright:
            assert line[-1, 0] - line[0, 0] == pytest.approx(0.075)


def test_small_strain_among_finite_keeps_its_height_and_has_no_net(
    make_result: Maker, words: Callable[..., list[str]]
) -> None:
    figure = fig4.draw([make_result(0.2, 10.0), make_result(5.0, 10.0, kinematics="finite")])
    small, finite, _ = figure.axes
    assert face(small, "upper face")[1].mean() == pytest.approx(0.15, rel=2e-3)
    assert (len(net(small).get_segments()) > 0, len(net(finite).get_segments()) > 0) == (False, True)
    said = " ".join(words(figure)).replace("\n", " ").replace("\N{NO-BREAK SPACE}", " ")
    assert "In small strain (a) only vertical displacements" in said


@pytest.mark.parametrize(
    ("warned", "said"), [((), ""), ((2,), "Panel c carries a warning."), ((0, 1, 2), "Panels a to c carry a warning.")]
)
def test_scenes_that_carry_a_warning_are_named(make_result: Maker, warned: tuple[int, ...], said: str) -> None:
    results = [make_result(1.0, speed) for speed in (1.0, 10.0, 100.0)]
    for place in warned:
        results[place].attrs["warnings"] = "It was fast."
    note = fig4.draw(results).texts[-1].get_text().replace("\n", " ")
    assert ("warning" in note) == bool(warned)
    assert said in note


@pytest.mark.parametrize("kinds", [("small", "small"), ("finite", "finite"), ("small", "finite"), ("finite",)])
@pytest.mark.parametrize("speeds", [(10.0,), (1.0, 100.0), (0.1, 1.0, 10.0, 100.0, 500.0, 1000.0, 10000.0)])
def test_nothing_is_written_over_anything_else(
    make_result: Maker, speeds: tuple[float, ...], kinds: tuple[str, ...]
) -> None:
    results = [
        make_result(pressure, speed, kinematics=kind) for pressure, kind in enumerate(kinds, 1) for speed in speeds
    ]
    figure = fig4.draw(results)
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


@pytest.mark.parametrize("kinematics", ["small", "finite"])
def test_nothing_is_coloured_outside_the_block(make_result: Maker, kinematics: str) -> None:
    panel, _ = fig4.draw([make_result(aspect=0.25, kinematics=kinematics)]).axes
    corners = np.asarray(drawn(panel).get_coordinates())
    for row, gid in ((0, "lower face"), (-1, "upper face")):
        np.testing.assert_array_equal(corners[row].T, face(panel, gid))


def test_pdf_holds_the_field_as_an_image(make_result: Maker, tmp_path: Path) -> None:
    figure = fig4.draw([make_result(kinematics="finite")])
    assert drawn(figure.axes[0]).get_rasterized()
    style.save(figure, tmp_path / "a.pdf")
    assert (tmp_path / "a.pdf").stat().st_size < 200_000


def test_unstrained_block_on_a_flat_road_is_drawn(make_result: Maker, tmp_path: Path) -> None:
    result = make_result()
    for name in ("strain_energy_density", "displacement_y", "road_height"):
        result[name] = 0.0 * result[name]
    style.save(fig4.draw([result]), tmp_path / "a.png", tmp_path / "a.pdf")
