"""Warnings about a solved scene: where its number is no prediction, inaccurate or below the noise of the solver."""

from __future__ import annotations

import numpy as np

from rubfric.mechanics.steady.error import allowance, friction_error
from rubfric.mechanics.steady.refinement import LEAST_WORTH
from rubfric.mechanics.steady.resolution import (
    Resolution,
    most_cells,
    most_columns,
)
from rubfric.mechanics.steady.solution import SteadySolution
from rubfric.mechanics.theory.layer import excitation_frequency
from rubfric.results.rubber_error import beyond_warning

# Above this share of the shear-wave speed inertia would matter; the model has none.
_SPEED_LIMIT = 0.3
# Below this stretch along the road the surface is about to fold, which the mesh cannot resolve.
_FOLD_LIMIT = 0.1
# Largest difference of the three friction coefficients, unless a lower accuracy was asked for.
_CLOSURE_LIMIT = 0.01
# Cells higher than wide by more than this at the road make the error so many times larger.
_SQUARE = 1.01


def warnings(solution: SteadySolution, closure: float) -> list[str]:
    """Return the warnings about a solved scene, one sentence each.

    Parameters
    ----------
    solution : SteadySolution
    closure : float
        Largest relative difference of the three friction coefficients.
    """
    scene = solution.scene
    frequency = excitation_frequency(scene.material, scene.road, scene.velocity, scene.height, scene.plane)
    poisson = float(scene.material.effective_poissons_ratio(frequency))
    ratio = float(scene.velocity / scene.material.shear_wave_speed(frequency))
    found = []
    if poisson < 0.0:
        found.append(
            f"The effective Poisson's ratio is {poisson:.2f}: the shear modulus has risen past the constant bulk "
            "modulus; bulk: proportional avoids this."
        )
    if ratio > _SPEED_LIMIT:
        found.append(
            f"The sliding speed is {ratio:.2g} of the shear-wave speed: inertia is neglected, but matters there."
        )
    if solution.decision.kinematics == "small":
        found += _small_strain(solution)
    elif solution.surface_stretch.min() < _FOLD_LIMIT:
        found.append("The surface is about to fold: finer meshes will differ.")
    if closure > max(_CLOSURE_LIMIT, scene.numerics.accuracy):
        found.append(f"The three friction coefficients differ by {closure:.1%}: the mesh does not resolve this scene.")
    found += beyond_warning(solution)
    found += _inaccurate(solution)
    if not solution.resolved:
        more = "raise numerics.columns_max"
        if solution.block.columns < scene.numerics.columns_max:
            more = "a mesh in finite strain has no more columns"
        touching = np.count_nonzero(solution.contact.touching)
        found.append(f"Only {touching} surface nodes touch the road, fewer than asked for: {more}.")
    return found


def _inaccurate(solution: SteadySolution) -> list[str]:
    """Return a warning with a remedy where the accuracy asked for is not met."""
    friction, error = abs(solution.friction.stress_power), friction_error(solution)
    if error <= solution.scene.numerics.accuracy * friction or friction <= solution.friction.resolution:
        return []
    return [
        f"The accuracy asked for, {100.0 * solution.scene.numerics.accuracy:.2g} %, is not met: the estimated error is "
        f"{100.0 * error / friction:.2g} % after {len(solution.meshes)} meshes; {_remedy(solution)}."
    ]


def _remedy(solution: SteadySolution) -> str:
    """Return what would make a scene more accurate, by what has ended its refinement."""
    scene, mesh, finite = solution.scene, solution.meshes[-1], solution.decision.kinematics == "finite"
    if mesh.first_row > _SQUARE:
        return "lower numerics.first_row"
    if allowance(solution) <= 0.0:
        return "lower numerics.folding"
    if solution.unsolved:
        return f"a finer mesh, of {solution.unsolved} columns, has no solution"
    if mesh.columns >= most_columns(scene, finite):
        if mesh.columns < scene.numerics.columns_max:
            return f"finite strain takes no mesh of more than {most_columns(scene, finite)} columns"
        return "raise numerics.columns_max"
    if not Resolution(mesh.columns, mesh.growth).finer(scene, LEAST_WORTH, finite).affordable(scene, finite):
        most = most_cells(scene, finite)
        return f"{solution.decision.kinematics} strain takes no mesh of more than {most:,} cells"
    return "raise numerics.refinements"


def below_noise_warning(friction: float, resolution: float) -> list[str]:
    """Return a warning where friction is positive but below the resolution of the solver.

    Parameters
    ----------
    friction, resolution : float
        Friction coefficient, and the friction below which it cannot be distinguished from zero; dimensionless.
    """
    if not 0.0 < friction < resolution:
        return []
    return [
        f"Friction is below {resolution:.1g}, which the solver cannot distinguish from zero: only this upper bound is "
        "certain."
    ]


def _small_strain(solution: SteadySolution) -> list[str]:
    """Return a warning where small strain, asked for, is inaccurate or invalid."""
    scene, correction = solution.scene, solution.decision.correction
    if solution.compression >= 1.0:
        return [
            f"The load presses the block by {solution.compression:.0%} of its height, more than small strain can "
            "represent: the number is no prediction; kinematics: finite gives one."
        ]
    if correction > scene.numerics.accuracy:
        return [
            f"Finite strain may change friction by up to {correction:.1%} (nominal compression "
            f"{solution.compression:.1%}, slope {scene.road.steepest_slope:.2g}): small strain is only indicative here."
        ]
    return []
