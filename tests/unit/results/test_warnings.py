"""Warnings about a scene: each where it applies, and only there."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from typing import Any

import numpy as np
import pytest

from rubfric.mechanics.finite.steady import FiniteSolution, solve_finite
from rubfric.mechanics.small.steady import SmallSolution, solve_small
from rubfric.mechanics.steady import resolution
from rubfric.mechanics.steady.error import friction_error
from rubfric.mechanics.steady.solution import SteadySolution
from rubfric.mechanics.theory.kinematics import Decision
from rubfric.results.warnings import below_noise_warning, warnings
from rubfric.road.sine import SineScale
from rubfric.rubber.material import Material
from rubfric.scene.numerics import Numerics
from rubfric.scene.scene import Scene

RUBBER = Material("soft", 4.17, 0.49, (0.3, 0.4), (1e-3, 1e-5))
COARSE = Numerics(
    contact_nodes=16, finite_contact_nodes=8, columns_min=64, finite_columns_min=32, columns_max=1024, row_growth=1.4
)
SCENE = Scene(1, SineScale(0.015, 35.0), 100.0, 0.1, 0.75, RUBBER, "stress", COARSE)
NOTHING: list[str] = []
Solve = Callable[[Scene], SteadySolution]


def small(scene: Scene, correction: float = 0.0) -> SmallSolution:
    return solve_small(replace(scene, kinematics="small"), Decision("small", correction, "small strain was asked for"))


def finite(scene: Scene) -> FiniteSolution:
    return solve_finite(replace(scene, kinematics="finite"), Decision("finite", 0.9, "finite strain was asked for"))


def negative_ratio(paper_rubber: Material) -> Scene:
    """Return a scene whose shear modulus has risen past the bulk modulus."""
    return replace(SCENE, scale=4, road=SineScale(0.002, 300.0), velocity=1e4, pressure=1.0, material=paper_rubber)


def test_harmless_scenes_need_none() -> None:
    assert warnings(small(SCENE), 0.0) == NOTHING
    assert warnings(finite(SCENE), 0.0) == NOTHING


@pytest.mark.parametrize("solve", [small, finite])
@pytest.mark.parametrize(("closure", "noted"), [(0.0099, False), (0.0101, True)])
def test_routes_that_differ_are_noted(solve: Solve, closure: float, noted: bool) -> None:
    expected = "The three friction coefficients differ by 1.0%: the mesh does not resolve this scene."
    assert warnings(solve(SCENE), closure) == ([expected] if noted else NOTHING)


def test_negative_effective_poissons_ratio_is_noted(paper_rubber: Material) -> None:
    (note,) = warnings(small(negative_ratio(paper_rubber)), 0.0)
    ratio = float(paper_rubber.effective_poissons_ratio(3e6))
    assert ratio < 0.0
    assert note.startswith(f"The effective Poisson's ratio is {ratio:.2f}: the shear modulus")
    assert "bulk: proportional avoids this" in note


def test_proportional_bulk_avoids_that_note(paper_rubber: Material) -> None:
    assert warnings(small(negative_ratio(replace(paper_rubber, bulk="proportional"))), 0.0) == NOTHING


@pytest.mark.parametrize(("frequency", "noted"), [(4.2e5, False), (5e5, True)])
def test_poissons_ratio_is_noted_where_it_is_negative(paper_rubber: Material, frequency: float, noted: bool) -> None:
    scene = replace(SCENE, velocity=frequency / 35.0, material=paper_rubber)
    assert (float(paper_rubber.effective_poissons_ratio(frequency)) < 0.0) == noted
    assert ("Poisson" in "".join(warnings(small(scene), 0.0))) == noted


def test_speed_near_that_of_shear_waves_is_noted() -> None:
    heavy = replace(SCENE, material=replace(RUBBER, density=1e-4))
    for solution in (small(heavy), finite(heavy)):
        (note,) = warnings(solution, 0.0)
        assert note.endswith("of the shear-wave speed: inertia is neglected, but matters there.")


def test_estimate_of_what_finite_strain_changes_is_noted_from_the_accuracy_on() -> None:
    accurate, indicative = (warnings(small(SCENE, correction), 0.0) for correction in (0.0099, 0.0101))
    assert accurate == NOTHING
    compression = 0.1 / RUBBER.confined_modulus("stress")
    assert indicative == [
        f"Finite strain may change friction by up to 1.0% (nominal compression {compression:.1%}, slope 0.53): "
        "small strain is only indicative here."
    ]


def test_accuracy_asked_for_decides_what_is_noted() -> None:
    loose = replace(SCENE, numerics=replace(COARSE, accuracy=0.1))
    assert warnings(small(loose, 0.05), 0.0) == NOTHING
    assert len(warnings(small(loose, 0.15), 0.0)) == 1


@pytest.mark.parametrize(("share", "noted"), [(0.99, False), (1.01, True)])
def test_compression_to_nothing_is_no_prediction(share: float, noted: bool) -> None:
    scene = replace(SCENE, pressure=share * RUBBER.confined_modulus("stress"))
    expected = (
        "The load presses the block by 101% of its height, more than small strain can represent: the number is no "
        "prediction; kinematics: finite gives one."
    )
    assert warnings(small(scene), 0.0) == ([expected] if noted else NOTHING)
    # One sentence is enough where small strain means nothing.
    assert len(warnings(small(scene, 0.5), 0.0)) == 1


def test_finite_strain_has_no_such_limits() -> None:
    solution = finite(replace(SCENE, pressure=1.5 * RUBBER.confined_modulus("stress")))
    assert solution.compression < 1.0
    assert warnings(solution, 0.0) == NOTHING


@pytest.mark.parametrize(("stretch", "noted"), [(0.11, False), (0.09, True)])
def test_surface_about_to_fold_is_noted(monkeypatch: pytest.MonkeyPatch, stretch: float, noted: bool) -> None:
    solution = finite(SCENE)
    monkeypatch.setattr(FiniteSolution, "surface_stretch", np.full(solution.block.columns, stretch))
    expected = ["The surface is about to fold: finer meshes will differ."]
    assert warnings(solution, 0.0) == (expected if noted else NOTHING)


@pytest.mark.parametrize("solve", [small, finite])
def test_contact_that_the_mesh_cannot_resolve_is_noted(solve: Solve) -> None:
    few = replace(COARSE, accuracy=0.5, columns_max=64, contact_nodes=32, finite_contact_nodes=32)
    solution = solve(replace(SCENE, numerics=few))
    touching = np.count_nonzero(solution.contact.touching)
    assert touching < 0.9 * 32
    assert warnings(solution, 0.0) == [
        f"Only {touching} surface nodes touch the road, fewer than asked for: raise numerics.columns_max."
    ]


@pytest.mark.parametrize("solve", [small, finite])
def test_accuracy_that_is_not_met_is_noted(solve: Solve) -> None:
    scene = replace(SCENE, numerics=replace(COARSE, refinements=0))
    solution = solve(scene)
    error = friction_error(solution) / solution.friction.stress_power
    for accuracy, noted in ((0.99 * error, True), (1.01 * error, False)):
        asked = replace(solution, scene=replace(scene, numerics=replace(scene.numerics, accuracy=accuracy)))
        note = (
            f"The accuracy asked for, {100.0 * accuracy:.2g} %, is not met: the estimated error is "
            f"{100.0 * error:.2g} % after "
            f"{len(solution.meshes)} meshes; raise numerics.refinements."
        )
        assert warnings(asked, 0.0) == ([note] if noted else NOTHING)


@pytest.mark.parametrize(
    ("solve", "numerics", "remedy"),
    [
        (small, {"refinements": 0}, "raise numerics.refinements"),
        (finite, {"refinements": 0}, "raise numerics.refinements"),
        (small, {"columns_max": 64}, "raise numerics.columns_max"),
        (finite, {"columns_max": 64}, "raise numerics.columns_max"),
        (small, {"refinements": 12}, "small strain takes no mesh of more than 9,000 cells"),
        (finite, {"refinements": 12}, "finite strain takes no mesh of more than 9,000 cells"),
        (small, {"first_row": 4.0}, "lower numerics.first_row"),
    ],
)
def test_what_would_help_is_told(
    monkeypatch: pytest.MonkeyPatch, solve: Solve, numerics: dict[str, Any], remedy: str
) -> None:
    for name in ("MOST_CELLS", "MOST_SMALL_CELLS"):
        monkeypatch.setattr(resolution, name, 9000)
    solution = solve(replace(SCENE, numerics=replace(COARSE, **{"accuracy": 1e-6} | numerics)))
    (line,) = (line for line in warnings(solution, 0.0) if "is not met" in line)
    assert line.startswith("The accuracy asked for, 0.0001 %, is not met: the estimated error is ")
    assert line.endswith(f" after {len(solution.meshes)} meshes; {remedy}.")
    assert solution.block.columns * solution.block.rows <= 9000


def test_a_finer_mesh_without_a_solution_is_told() -> None:
    solution = small(replace(SCENE, numerics=replace(COARSE, accuracy=1e-6)))
    (line,) = (line for line in warnings(replace(solution, unsolved=4800), 0.0) if "is not met" in line)
    assert line.endswith("meshes; a finer mesh, of 4800 columns, has no solution.")


@pytest.mark.parametrize("solve", [small, finite])
def test_scene_without_friction_has_no_relative_accuracy(solve: Solve) -> None:
    elastic = Material("elastic", 4.17, 0.49, (), ())
    assert warnings(solve(replace(SCENE, material=elastic)), 0.0) == NOTHING


def test_warnings_add_up(paper_rubber: Material) -> None:
    scene = replace(negative_ratio(replace(paper_rubber, density=1e-3)), numerics=replace(COARSE, columns_max=64))
    notes = warnings(small(scene, 0.5), 0.3)
    subjects = ("Poisson's ratio", "sliding speed", "Finite strain", "three friction coefficients")
    subjects += ("accuracy asked for", "surface nodes")
    assert len(notes) == len(subjects)
    assert all(subject in note for subject, note in zip(subjects, notes, strict=True))


@pytest.mark.parametrize(("friction", "told"), [(1e-9, True), (1e-6, False), (0.1, False), (0.0, False)])
def test_friction_that_cannot_be_told_from_zero_says_so(friction: float, told: bool) -> None:
    said = below_noise_warning(friction, 5e-7)
    assert bool(said) == told
    assert all("cannot distinguish from zero" in sentence for sentence in said)
