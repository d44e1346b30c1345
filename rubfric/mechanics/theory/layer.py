"""Closed forms that the simulation is verified against. Small strain; h = a sin(k x), q = k H.

On a road of many waves the pressures that fill each of them add up in squares (Persson 2001, J. Chem. Phys. 115, 3840).

Nothing here needs a mesh. The compliance of the layer also serves the steady solver to choose a mesh.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike

from rubfric.arrays import Complex, Real
from rubfric.road.road import Road
from rubfric.road.sine import SineScale
from rubfric.rubber.material import Material

# Beyond this q the layer is a half-space to the last digit, and sinh would only overflow later.
_DEEP = 40.0


def layer_factor(depth: ArrayLike) -> Real:
    """Return f(q) = (sinh q cosh q - q) / cosh² q, the stiffness of the layer over that of the half-space.

    The top carries uniform pressure and moves sideways as a whole.

    Parameters
    ----------
    depth : array_like, shape (...)
        q = wavenumber x height, dimensionless.
    """
    q = np.minimum(np.asarray(depth, dtype=float), _DEEP)
    series = 2.0 * q**3 / 3.0  # the difference cancels to this where q is small
    return np.where(q < 1e-3, series, np.sinh(q) * np.cosh(q) - q) / np.cosh(q) ** 2


def layer_compliance(material: Material, wavenumber: ArrayLike, velocity: float, height: float, plane: str) -> Complex:
    """Return surface displacement over pressure of a layer that slides steadily: C(k) = 2 / (k E*(k v) f(k H)).

    Parameters
    ----------
    material : Material
    wavenumber : array_like, shape (...)
        k, 1/mm, positive.
    velocity : float
        v, mm/s.
    height : float
        H, mm.
    plane : {"stress", "strain"}

    Returns
    -------
    ndarray of complex, shape (...)
        mm/MPa.
    """
    k = np.asarray(wavenumber, dtype=float)
    return 2.0 / (k * material.plane_modulus(k * velocity, plane) * layer_factor(k * height))


def filling_pressures(material: Material, road: Road, velocity: float, height: float, plane: str) -> Real:
    """Return the lowest nominal pressure that fills each wave of a road by itself, MPa: f a k |E*(k v)| / 2.

    Parameters
    ----------
    material : Material
    road : Road
    velocity : float
        v, mm/s.
    height : float
        H, mm.
    plane : {"stress", "strain"}

    Returns
    -------
    ndarray, shape (waves,)
    """
    waves = road.waves
    return waves.amplitudes / np.abs(layer_compliance(material, waves.wavenumbers, velocity, height, plane))


def excitation_frequency(material: Material, road: Road, velocity: float, height: float, plane: str) -> float:
    """Return k v, rad/s, of the wave that is hardest to fill: the frequency that matters most to the rubber.

    Parameters
    ----------
    material : Material
    road : Road
    velocity : float
        v, mm/s.
    height : float
        H, mm.
    plane : {"stress", "strain"}
    """
    hardest = int(np.argmax(filling_pressures(material, road, velocity, height, plane)))
    return float(road.waves.wavenumbers[hardest]) * velocity


def full_contact_pressure(material: Material, road: Road, velocity: float, height: float, plane: str) -> float:
    """Return the nominal pressure, MPa, that fills a sine; of many waves the root of the sum of their squares.

    The latter fills most of a road, not all of it: its measure of how far contact goes.

    Parameters
    ----------
    material : Material
    road : Road
    velocity : float
        v, mm/s.
    height : float
        H, mm.
    plane : {"stress", "strain"}
    """
    return float(np.linalg.norm(filling_pressures(material, road, velocity, height, plane)))


def full_contact_friction(
    material: Material, road: SineScale, velocity: float, pressure: float, height: float, plane: str
) -> float:
    """Return mu = f a² k² Im E*(k v) / (4 p), valid from ``full_contact_pressure`` on.

    Parameters
    ----------
    material : Material
    road : SineScale
    velocity : float
        v, mm/s.
    pressure : float
        Nominal, MPa.
    height : float
        H, mm.
    plane : {"stress", "strain"}
    """
    compliance = layer_compliance(material, road.wavenumber, velocity, height, plane)
    return float(road.amplitude * road.steepest_slope * (1.0 / compliance).imag / (2.0 * pressure))


def westergaard_contact_fraction(pressure_ratio: ArrayLike) -> Real:
    """Return the contact fraction A of an elastic half-space on a sine: sin²(pi A / 2) = p / p*.

    Parameters
    ----------
    pressure_ratio : array_like, shape (...)
        p / p*, with p* = E* k a / 2 the pressure of full contact.
    """
    ratio = np.clip(np.asarray(pressure_ratio, dtype=float), 0.0, 1.0)
    return 2.0 / np.pi * np.arcsin(np.sqrt(ratio))
