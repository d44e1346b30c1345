"""What a reader should know of a solved scene before trusting its numbers."""

from __future__ import annotations

import numpy as np

from rubfric.steady import SteadySolution

# Above this share of the shear-wave speed inertia would matter; the model has none.
_SPEED_LIMIT = 0.3
# Beyond this nominal compression small strain misjudges the block by more than its material does.
_COMPRESSION_LIMIT = 0.1
_SLOPE_LIMIT = 1.0
# The aim for the difference between the three friction coefficients.
_CLOSURE_LIMIT = 0.01


def nominal_compression(solution: SteadySolution) -> float:
    """Return p / M, the strain of the relaxed block under its load between tied sides, dimensionless."""
    return solution.scene.pressure / solution.scene.material.confined_modulus(solution.scene.plane)


def cautions(solution: SteadySolution, closure: float) -> list[str]:
    """Return what a reader should know before trusting the result, one sentence each; none is an error."""
    scene = solution.scene
    frequency = scene.road.excitation_frequency(scene.velocity)
    poisson = float(scene.material.effective_poissons_ratio(frequency))
    ratio = float(scene.velocity / scene.material.shear_wave_speed(frequency))
    compression = nominal_compression(solution)
    found = []
    if poisson < 0.0:
        found.append(
            f"The effective Poisson's ratio is {poisson:.2f}: the shear modulus has risen past the constant bulk "
            "modulus; bulk: proportional avoids this."
        )
    if ratio > _SPEED_LIMIT:
        found.append(
            f"The sliding speed is {ratio:.2g} of the shear-wave speed: inertia is neglected, but would matter."
        )
    if compression >= 1.0:
        found.append(
            f"The load presses the block by {compression:.0%} of its height, which small strain cannot mean: "
            "the number is no prediction."
        )
    elif compression > _COMPRESSION_LIMIT:
        found.append(
            f"The load presses the block by {compression:.0%} of its height: small strain is only indicative here."
        )
    if scene.road.steepest_slope > _SLOPE_LIMIT:
        found.append(f"The road's slope reaches {scene.road.steepest_slope:.2g}: small slopes are assumed.")
    if closure > _CLOSURE_LIMIT:
        found.append(f"The three friction coefficients differ by {closure:.1%}: the mesh does not resolve this scene.")
    if not solution.resolved:
        found.append(
            f"Only {np.count_nonzero(solution.contact.touching)} surface nodes touch the road, "
            f"fewer than the {scene.numerics.contact_nodes} asked for: raise numerics.columns_max."
        )
    return found
