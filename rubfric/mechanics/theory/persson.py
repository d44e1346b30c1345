"""Persson's theory of contact and friction for ridges: what each wave of a road adds to the total, in closed form.

Under the nominal pressure p the rubber touches, of the road smoothed of all waves finer than wave i, the share

    P_i = erf(p / p*_i),    p*_i² = sum of p*_j² over the waves j up to i,    p*_j = f a_j k_j |E*(k_j v)| / 2,

and wave i adds its friction in full contact, times the share and what contact leaves of its slopes there,

    mu_i = f a_i² k_i² Im E*(k_i v) / (4 p) P_i S_i,    S_i = gamma + (1 - gamma) P_i²

(Persson 2001, J. Chem. Phys. 115, 3840, has S = 1; Persson 2006, J. Phys.: Condens. Matter 18, 7789, gamma = 1/2).
Here f is the stiffness of the layer over that of the half-space. Waves of one wavenumber act as one.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike
from scipy.special import erf

from rubfric.arrays import Real
from rubfric.mechanics.theory.layer import layer_compliance
from rubfric.road.road import Road, fourier_series
from rubfric.rubber.material import Material


def scales(road: Road) -> tuple[Real, Real]:
    """Return the amplitudes, mm, and wavenumbers, 1/mm, of a road's scales from coarse to fine, each shape (scales,).

    Waves of one wavenumber are one scale; one whose waves cancel is none.
    """
    harmonics, series = fourier_series(road)
    amplitudes = 2.0 * np.abs(series)
    kept = amplitudes > 1e-13 * amplitudes.max(initial=0.0)
    return amplitudes[kept], harmonics[kept] * (2.0 * np.pi / road.period)


def contact_fractions(
    material: Material, road: Road, velocity: float, pressure: ArrayLike, height: float, plane: str
) -> Real:
    """Return the share P_i of the road that touches where it is seen down to scale i.

    Parameters
    ----------
    material : Material
    road : Road
    velocity : float
        v, mm/s.
    pressure : array_like, shape (...)
        Nominal, MPa, positive.
    height : float
        H, mm.
    plane : {"stress", "strain"}

    Returns
    -------
    ndarray, shape (scales, ...)
        From coarse to fine, dimensionless.
    """
    amplitudes, wavenumbers = scales(road)
    filling = amplitudes / np.abs(layer_compliance(material, wavenumbers, velocity, height, plane))
    share: Real = erf(np.multiply.outer(1.0 / np.sqrt(np.cumsum(filling**2)), np.asarray(pressure, dtype=float)))
    return share


def persson_friction(
    material: Material,
    road: Road,
    velocity: float,
    pressure: ArrayLike,
    height: float,
    plane: str,
    gamma: float = 1.0,
) -> Real:
    """Return the friction coefficient that each scale adds by Persson's theory.

    Parameters
    ----------
    material : Material
    road : Road
    velocity : float
        v, mm/s.
    pressure : array_like, shape (...)
        Nominal, MPa, positive.
    height : float
        H, mm.
    plane : {"stress", "strain"}
    gamma : float
        1 for the theory of 2001; 1/2 where contact is taken to leave less of the slopes, as since 2006.

    Returns
    -------
    ndarray, shape (scales, ...)
        From coarse to fine, dimensionless.
    """
    amplitudes, wavenumbers = scales(road)
    load = np.asarray(pressure, dtype=float)
    share = contact_fractions(material, road, velocity, load, height, plane)
    stiffness = (1.0 / layer_compliance(material, wavenumbers, velocity, height, plane)).imag
    full = np.multiply.outer(0.5 * amplitudes**2 * wavenumbers * stiffness, 1.0 / load)
    friction: Real = full * share * (gamma + (1.0 - gamma) * share**2)
    return friction
