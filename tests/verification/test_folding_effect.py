"""Leaving out and gathering Prony branches changes friction by less than the bound that goes with it."""

from __future__ import annotations

from collections.abc import Callable

import pytest

from rubfric.mechanics.steady.energies import Energies
from rubfric.mechanics.steady.solution import SteadySolution
from rubfric.scene.numerics import Numerics
from rubfric.scene.scene import Scene
from rubfric.simulation import evaluate, solve

SceneMaker = Callable[..., Scene]
ROUTES = ("stress_power", "dissipation", "contact")
SOLVER = 1e-5  # relative; Newton's method stops at a millionth of the road's amplitude
PLANES = pytest.mark.parametrize("plane", ["strain", "stress"])
KINEMATICS = pytest.mark.parametrize("kinematics", ["small", "finite"])
# At 0.1 mm/s fast branches are relaxed, at 10^4 mm/s slow ones frozen, between some of either.
POINTS = pytest.mark.parametrize(
    ("velocity", "pressure"), [(0.1, 0.5), (0.1, 5.0), (1e4, 0.5), (1e4, 5.0), (100.0, 2.0)]
)


@pytest.fixture
def slide(paper_scene: SceneMaker) -> Callable[..., tuple[SteadySolution, Energies]]:
    """Return a function: solution and energies to some accuracy, always on the same mesh."""

    def to_accuracy(velocity: float, pressure: float, plane: str, kinematics: str, accuracy: float):
        numerics = Numerics(
            accuracy=accuracy,
            contact_nodes=4,
            finite_contact_nodes=4,
            columns_min=128,
            finite_columns_min=128,
            columns_max=128,
        )
        solution = solve(paper_scene(velocity, pressure, plane=plane, kinematics=kinematics, numerics=numerics))
        assert solution.block.columns == 128
        return solution, evaluate(solution)

    return to_accuracy


@PLANES
@KINEMATICS
@POINTS
@pytest.mark.parametrize("accuracy", [0.01, 0.5])
def test_friction_changes_by_less_than_the_bound(
    slide, velocity: float, pressure: float, plane: str, kinematics: str, accuracy: float
) -> None:
    folded, reduced = slide(velocity, pressure, plane, kinematics, accuracy)
    whole, full = slide(velocity, pressure, plane, kinematics, 1e-6)
    assert whole.folding.bound == 0.0
    assert folded.folding.bound <= 0.01 * accuracy
    for route in ROUTES:
        assert abs(getattr(reduced, route) / getattr(full, route) - 1.0) <= folded.folding.bound + SOLVER


@KINEMATICS
def test_default_accuracy_leaves_out_a_branch_of_slow_sliding(slide, kinematics: str) -> None:
    solution, _ = slide(0.1, 0.5, "stress", kinematics, 0.01)
    assert solution.folding.relaxed == (5,)
    assert 0.0 < solution.folding.bound < 1e-4


@KINEMATICS
def test_rough_accuracy_gathers_branches_of_fast_sliding(slide, kinematics: str) -> None:
    solution, _ = slide(1e4, 0.5, "stress", kinematics, 0.5)
    assert solution.folding.frozen == (0, 1)


@PLANES
def test_bound_is_sharp_where_one_harmonic_is_excited(slide, plane: str) -> None:
    folded, reduced = slide(0.1, 5.0, plane, "small", 0.5)
    _, full = slide(0.1, 5.0, plane, "small", 1e-6)
    assert 1.0 - reduced.contact / full.contact == pytest.approx(folded.folding.bound, rel=0.02)
