from __future__ import annotations

from collections.abc import Callable

import pytest
import xarray as xr

from rubfric.figures.note import note_below
from rubfric.figures.scenes import SceneGrid, by_pressure_and_speed

SPEEDS = (1.0, 10.0, 100.0)
TO_SCALE = "Displacements are to scale; the white lines made squares before deformation."


@pytest.fixture
def make_grid(make_result: Callable[..., xr.Dataset]) -> Callable[[str], SceneGrid]:
    """Return a function that builds a grid at 0.2 and 5 MPa of small (s) and finite (f) strain, panel by panel."""

    def build(kinds: str) -> SceneGrid:
        places = [(pressure, speed) for pressure in (0.2, 5.0) for speed in SPEEDS]
        return by_pressure_and_speed(
            [
                make_result(*place, kinematics="finite" if kind == "f" else "small")
                for place, kind in zip(places, kinds, strict=True)
            ],
            (),
        )

    return build


@pytest.mark.parametrize(
    ("kinds", "told"),
    [
        ("ffffff", TO_SCALE),
        (
            "ssssss",
            "Only vertical displacements are shown, to scale, without the mean compression "
            "(3.6 % at 0.2 MPa, 90 % at 5 MPa).",
        ),
        (
            "sssfff",
            f"{TO_SCALE} In small strain (a to c) only vertical displacements are shown, to scale, "
            "without the mean compression (3.6 % at 0.2 MPa).",
        ),
        (
            "ssfsff",
            f"{TO_SCALE} In small strain (a, b, d) only vertical displacements are shown, to scale, "
            "without the mean compression (3.6 % at 0.2 MPa, 90 % at 5 MPa).",
        ),
    ],
)
def test_note_tells_what_is_left_out_and_where(make_grid: Callable[[str], SceneGrid], kinds: str, told: str) -> None:
    note = note_below(make_grid(kinds), whole=True, shares=False)
    assert note.replace("\N{NO-BREAK SPACE}", " ") == f"The block slides to the right. {told}"


def test_cut_block_and_percentages_are_explained(make_grid: Callable[[str], SceneGrid]) -> None:
    note = note_below(make_grid("ffffff"), whole=False, shares=True)
    assert note.startswith("Lower part of the block, which slides to the right.")
    assert note.endswith("Percentages: share of the nominal area in contact.")
