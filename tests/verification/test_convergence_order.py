"""Errors against the closed form fall with the square of the size of columns and of rows."""

from __future__ import annotations

from collections.abc import Callable, Sequence

import numpy as np
import pytest
from numpy.typing import NDArray

from rubfric.mechanics.block.block import Block, graded_rows
from rubfric.mechanics.small.response import respond
from rubfric.mechanics.theory import layer as reference
from rubfric.road.sine import SineScale
from rubfric.rubber.material import Material
from rubfric.scene.numerics import Numerics
from rubfric.scene.scene import Scene
from rubfric.simulation import evaluate, solve

SceneMaker = Callable[..., Scene]
Real = NDArray[np.float64]
PLANES = pytest.mark.parametrize("plane", ["strain", "stress"])
ROAD = SineScale(0.015, 35.0)
HEIGHT = 0.75 * ROAD.wavelength
HARMONICS = np.array([1, 2, 3])
MANY_COLUMNS = 2**16


def order(sizes: Sequence[float] | Real, errors: Sequence[float] | Real) -> float:
    """Return the exponent of errors ~ sizes**exponent."""
    return float(np.polyfit(np.log(sizes), np.log(np.abs(errors)), 1)[0])


def compliance_errors(rubber: Material, plane: str, columns: int, rows: Real) -> Real:
    """Return the relative errors of the surface compliance, of low harmonics."""
    response = respond(Block(ROAD.wavelength, HEIGHT, columns, rows, plane), rubber, 100.0, HARMONICS)
    expected = reference.layer_compliance(rubber, ROAD.wavenumber * HARMONICS, 100.0, HEIGHT, plane)
    return np.abs(response.compliance / expected - 1.0)


def friction_error(paper_scene: SceneMaker, plane: str, numerics: Numerics) -> float:
    """Return the relative error of the friction coefficient of a filled road."""
    scene = paper_scene(100.0, 8.0, plane=plane, numerics=numerics)
    expected = reference.full_contact_friction(scene.material, scene.road, 100.0, 8.0, scene.height, plane)
    return evaluate(solve(scene)).stress_power / expected - 1.0


@PLANES
def test_compliance_is_second_order_in_the_width_of_columns(paper_rubber: Material, plane: str) -> None:
    columns, rows = np.array([16, 32, 64, 128]), graded_rows(HEIGHT, HEIGHT / 4000.0, 1.001)
    errors = np.array([compliance_errors(paper_rubber, plane, count, rows) for count in columns])
    for harmonic in range(len(HARMONICS)):
        assert order(1.0 / columns, errors[:, harmonic]) == pytest.approx(2.0, abs=0.1)


@PLANES
def test_compliance_is_second_order_in_the_height_of_even_rows(paper_rubber: Material, plane: str) -> None:
    rows = np.array([32, 64, 128, 256])
    errors = np.array(
        [compliance_errors(paper_rubber, plane, MANY_COLUMNS, np.linspace(0.0, HEIGHT, count + 1)) for count in rows]
    )
    for harmonic in range(len(HARMONICS)):
        assert order(1.0 / rows, errors[:, harmonic]) == pytest.approx(2.0, abs=0.05)


@PLANES
def test_compliance_is_second_order_in_the_growth_of_rows(paper_rubber: Material, plane: str) -> None:
    meshes = [graded_rows(HEIGHT, ROAD.wavelength / 2**14, growth) for growth in (1.6, 1.4, 1.2, 1.1, 1.05)]
    growths = [np.log(rows[2] - rows[1]) - np.log(rows[1]) for rows in meshes]
    errors = np.array([compliance_errors(paper_rubber, plane, 2**14, rows) for rows in meshes])
    for harmonic in range(len(HARMONICS)):
        assert order(growths, errors[:, harmonic]) == pytest.approx(2.0, abs=0.05)


@PLANES
def test_friction_is_second_order_in_columns(paper_scene: SceneMaker, plane: str) -> None:
    columns = np.array([16, 32, 64, 128])
    errors = [
        friction_error(
            paper_scene,
            plane,
            # The first row stays a thousandth of the wavelength, and all rows thin.
            Numerics(
                columns_min=count, finite_columns_min=8, columns_max=count, row_growth=1.001, first_row=count / 1000.0
            ),
        )
        for count in columns
    ]
    assert order(1.0 / columns, errors) == pytest.approx(2.0, abs=0.05)
    assert abs(errors[-1]) < 1e-3


@PLANES
def test_friction_is_second_order_in_even_rows(paper_scene: SceneMaker, plane: str) -> None:
    first_rows = np.array([96.0, 48.0, 24.0, 12.0])
    errors = [
        friction_error(
            paper_scene, plane, Numerics(columns_min=16384, columns_max=16384, row_growth=1.00001, first_row=first)
        )
        for first in first_rows
    ]
    assert order(first_rows, errors) == pytest.approx(2.0, abs=0.05)
    assert abs(errors[-1]) < 1e-4


@PLANES
def test_friction_of_partial_contact_settles_as_the_mesh_is_refined(paper_scene: SceneMaker, plane: str) -> None:
    friction = [
        evaluate(
            solve(paper_scene(1000.0, 2.0, plane=plane, numerics=Numerics(contact_nodes=nodes, row_growth=growth)))
        ).stress_power
        for nodes, growth in ((32, 1.3), (64, 1.15), (512, 1.03))
    ]
    assert friction[0] == pytest.approx(friction[-1], rel=0.01)
    assert friction[1] == pytest.approx(friction[-1], rel=2e-3)
