"""Small or finite strain: what a scene requires, from closed forms alone.

What small strain leaves out of friction grows with four small numbers:

- the compression of the relaxed block, p over its confined modulus; of a flat block under the contact's own pressure;
- the square of the steepest slope in contact, (a k)² p / p*, by Westergaard, with p* the pressure that fills the road;
- the largest contact pressure over the bulk modulus: 2 sqrt(p p*), or p + p* where the road is filled;
- in plane stress, where rubber may bulge across, that pressure over the plane modulus at the excitation frequency.

Their weights bound what was measured on the paper's rubber and others of Poisson's ratios from 0.46 to 0.4975, at
slopes from 0.26 to 0.6, speeds from 0.1 to 10^4 mm/s, pressures from 0.005 to 10 MPa and height-to-width ratios from
0.25 to 1.5, in plane stress and plane strain. On a road of many waves p* is the root of the sum of their squares.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

from rubfric.mechanics.theory.layer import excitation_frequency, full_contact_pressure, layer_factor
from rubfric.scene.scene import Scene

# Share of the accuracy that small strain may use up; the mesh needs the rest.
_SHARE = 0.5
_COMPRESSION, _SLOPE, _PRESSURE, _BULGE = 1.5, 0.5, 0.15, 0.6


@dataclass(frozen=True)
class Decision:
    """Which kinematics a scene is solved in, and why.

    Attributes
    ----------
    kinematics : {"small", "finite"}
    correction : float
        Estimate of the relative change of friction from small to finite strain, dimensionless.
    reason : str
        One sentence.
    """

    kinematics: str
    correction: float
    reason: str


def decide(scene: Scene) -> Decision:
    """Return the kinematics in which to solve a scene, and why: those asked for, or the least that is accurate."""
    correction, accuracy = estimated_correction(scene), scene.numerics.accuracy
    if scene.kinematics != "auto":
        return Decision(scene.kinematics, correction, f"{scene.kinematics} strain was asked for")
    small = correction <= _SHARE * accuracy
    reason = (
        f"finite strain is estimated to change friction by {correction:.2%}, "
        f"{'within' if small else 'more than'} half the accuracy asked for, {accuracy:.2%}"
    )
    return Decision("small" if small else "finite", correction, reason)


def estimated_correction(scene: Scene) -> float:
    """Return about the largest relative change of friction that finite strain may make, dimensionless."""
    material, road, pressure, plane = scene.material, scene.road, scene.pressure, scene.plane
    filling = full_contact_pressure(material, road, scene.velocity, scene.height, plane)
    filled = pressure >= filling
    slope_squared = road.steepest_slope**2 * (1.0 if filled else pressure / filling)
    highest = pressure + filling if filled else 2.0 * math.sqrt(pressure * filling)
    flatness = 1.0 - float(layer_factor(road.waves.wavenumbers.min() * scene.height))
    compression = (pressure + 2.0 * flatness * highest) / material.confined_modulus(plane)
    frequency = excitation_frequency(material, road, scene.velocity, scene.height, plane)
    bulk = float(abs(material.complex_bulk_modulus(frequency)))
    correction = _COMPRESSION * compression + _SLOPE * slope_squared + _PRESSURE * highest / bulk
    if plane == "stress":
        correction += _BULGE * highest / float(abs(material.plane_modulus(frequency, plane)))
    return correction
