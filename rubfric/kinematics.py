"""Small or finite strain: what a scene requires, from closed forms alone.

What small strain leaves out of friction grows with three small numbers:

- the compression of the relaxed block under its load, p over its confined modulus;
- the square of the steepest slope in contact, (a k)² p / p*, by Westergaard, with p* the pressure that fills the road;
- the largest contact pressure over the bulk modulus: 2 sqrt(p p*), or p + p* where the road is filled.

Their weights bound what was measured on rubbers of Poisson's ratios from 0.46 to 0.4975, slopes from 0.26 to 0.6,
speeds from 0.1 to 10^4 mm/s and pressures from 0.1 to 10 MPa, in plane stress and plane strain.
"""

from __future__ import annotations

import math

from rubfric.reference import full_contact_pressure
from rubfric.scene import Scene
from rubfric.solution import Decision

_COMPRESSION, _SLOPE, _PRESSURE = 1.5, 0.5, 0.15


def decide(scene: Scene) -> Decision:
    """Return the kinematics in which to solve a scene, and why: those asked for, or the least that is accurate."""
    correction, accuracy = estimated_correction(scene), scene.numerics.accuracy
    if scene.kinematics != "auto":
        return Decision(scene.kinematics, correction, f"{scene.kinematics} strain was asked for")
    small = correction <= accuracy
    reason = (
        f"finite strain is estimated to change friction by {correction:.2%}, "
        f"{'within' if small else 'more than'} the accuracy asked for, {accuracy:.2%}"
    )
    return Decision("small" if small else "finite", correction, reason)


def estimated_correction(scene: Scene) -> float:
    """Return about the largest relative change of friction that finite strain may make, dimensionless."""
    material, pressure = scene.material, scene.pressure
    compression = pressure / material.confined_modulus(scene.plane)
    filling = full_contact_pressure(material, scene.road, scene.velocity, scene.height, scene.plane)
    filled = pressure >= filling
    slope_squared = scene.road.steepest_slope**2 * (1.0 if filled else pressure / filling)
    highest = pressure + filling if filled else 2.0 * math.sqrt(pressure * filling)
    bulk = float(abs(material.complex_bulk_modulus(scene.road.excitation_frequency(scene.velocity))))
    return _COMPRESSION * compression + _SLOPE * slope_squared + _PRESSURE * highest / bulk
