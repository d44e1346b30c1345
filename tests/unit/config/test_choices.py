"""What a config chooses out of its campaign: an aspect study and what the figures show."""

from __future__ import annotations

from typing import Any

import pytest
from rubfric.config.choices import AspectStudy, FigureChoice, read_aspect_study, read_figures, scale_number

from rubfric.errors import InvalidInput

STUDY: dict[str, Any] = {"aspects": [0.5, 1], "scales": [1, 3], "pressures": [5]}
FIELDS: dict[str, Any] = {"scale": 2, "velocities": [1, 100], "pressures": [0.5]}
FIGURES: dict[str, Any] = {"total_pressure": 5, "fields": FIELDS}
VELOCITIES, PRESSURES = (1.0, 10.0, 100.0), (0.5, 5.0)


def test_aspect_study_is_read() -> None:
    assert read_aspect_study(STUDY, 4) == AspectStudy((0.5, 1.0), (1, 3), (5.0,))


def test_figures_are_read() -> None:
    assert read_figures(FIGURES, 4, VELOCITIES, PRESSURES) == FigureChoice(5.0, 2, (1.0, 100.0), (0.5,))


@pytest.mark.parametrize(
    ("change", "says"),
    [
        ({"scales": [5]}, "aspect_study.scales is 5, but must be one of the road's scales, 1 to 4"),
        ({"aspects": [0]}, "aspect_study.aspects"),
        ({"pressures": []}, "aspect_study.pressures"),
        ({"colour": "red"}, "aspect_study has the unknown key 'colour'"),
    ],
)
def test_bad_aspect_studies_are_refused(change: dict[str, Any], says: str) -> None:
    with pytest.raises(InvalidInput, match=says):
        read_aspect_study(STUDY | change, 4)


@pytest.mark.parametrize(
    ("change", "says"),
    [
        ({"scale": 5}, "figures.fields.scale is 5, but must be one of the road's scales, 1 to 4"),
        ({"velocities": [2]}, "figures.fields.velocities has 2, but must be chosen from grid.velocities: 1, 10, 100"),
        ({"pressures": [1]}, "figures.fields.pressures has 1, but must be chosen from grid.pressures: 0.5, 5"),
        ({"colour": "red"}, "figures.fields has the unknown key 'colour'"),
    ],
)
def test_bad_figures_are_refused(change: dict[str, Any], says: str) -> None:
    with pytest.raises(InvalidInput, match=says):
        read_figures(FIGURES | {"fields": FIELDS | change}, 4, VELOCITIES, PRESSURES)


def test_total_is_one_of_the_grids_pressures() -> None:
    with pytest.raises(InvalidInput, match=r"figures.total_pressure has 3, but must be chosen from grid.pressures"):
        read_figures(FIGURES | {"total_pressure": 3}, 4, VELOCITIES, PRESSURES)


@pytest.mark.parametrize("value", [0, 5, 1.5, "1"])
def test_scale_is_one_of_the_roads(value: Any) -> None:
    with pytest.raises(InvalidInput, match=r"^scale is .*, but must be"):
        scale_number("scale", value, 4)
    assert scale_number("scale", 4, 4) == 4
