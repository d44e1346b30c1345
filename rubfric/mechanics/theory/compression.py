"""The block pressed on a flat road: confined compression of the relaxed rubber, in finite strain."""

from __future__ import annotations

import math
from functools import lru_cache

from scipy.optimize import brentq

from rubfric.rubber.material import Material

# Stretches are sought between e^-30 and e^30: beyond any load that a number can name in practice.
_RANGE = 30.0


@lru_cache(maxsize=64)
def pressed(material: Material, pressure: float, plane: str) -> tuple[float, float]:
    """Return the stretch of a relaxed block along its height, and across its thickness.

    The sides are tied; the load is dead: a force per area of the block as it was made. Solved once for each rubber,
    load and plane.

    Parameters
    ----------
    material : Material
    pressure : float
        Nominal, MPa.
    plane : {"stress", "strain"}
    """

    def excess(log_stretch: float) -> float:
        """Return the nominal stress along the height plus the pressure, over the shear modulus."""
        thickness = _thickness(material, log_stretch) if plane == "stress" else 0.0
        return _stresses(material, log_stretch, thickness)[0] + pressure / material.long_term_shear_modulus

    stretch = float(brentq(excess, -_RANGE, 0.0, xtol=1e-15, rtol=1e-14)) if pressure > 0.0 else 0.0
    across = _thickness(material, stretch) if plane == "stress" else 0.0
    return math.exp(stretch), math.exp(across)


def pressing(material: Material, stretch: float, plane: str) -> float:
    """Return the nominal pressure, MPa, that presses a relaxed block to a stretch along its height.

    Parameters
    ----------
    material : Material
    stretch : float
        Height over that without load, dimensionless.
    plane : {"stress", "strain"}
    """
    along = math.log(stretch)
    across = _thickness(material, along) if plane == "stress" else 0.0
    return -_stresses(material, along, across)[0] * material.long_term_shear_modulus


def stored_energy(material: Material, stretch: float, thickness: float) -> float:
    """Return W of a relaxed block at the stretches that ``pressed`` returns, MPa.

    W = K / 4 (J² - 1) - K / 2 ln J + G / 2 (J^(-2/3) (1 + stretch² + thickness²) - 3), J = stretch x thickness.

    Parameters
    ----------
    material : Material
    stretch, thickness : float
        Along the height and across the thickness, dimensionless.
    """
    volume = stretch * thickness
    bulk = material.long_term_bulk_modulus
    trace = (1.0 + stretch * stretch + thickness * thickness) * volume ** (-2.0 / 3.0)
    volumetric = 0.25 * bulk * (volume * volume - 1.0) - 0.5 * bulk * math.log(volume)
    return volumetric + 0.5 * material.long_term_shear_modulus * (trace - 3.0)


def _thickness(material: Material, log_stretch: float) -> float:
    """Return the logarithm of the stretch across the thickness where no stress acts there."""
    return float(brentq(lambda z: _stresses(material, log_stretch, z)[1], -_RANGE, _RANGE, xtol=1e-15, rtol=1e-14))


def _stresses(material: Material, log_stretch: float, log_thickness: float) -> tuple[float, float]:
    """Return P_yy and C_zz S_zz over the shear modulus."""
    along, across = math.exp(2.0 * log_stretch), math.exp(2.0 * log_thickness)
    log_volume = log_stretch + log_thickness
    isochoric = math.exp(-2.0 / 3.0 * log_volume)
    third = (1.0 + along + across) / 3.0
    bulk = 0.5 * material.long_term_bulk_modulus / material.long_term_shear_modulus * math.expm1(2.0 * log_volume)
    return (isochoric * (along - third) + bulk) * math.exp(-log_stretch), isochoric * (across - third) + bulk
