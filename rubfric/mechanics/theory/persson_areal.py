"""Persson's theory of contact and friction on areal roads, wave by wave: its sum over directions and wavenumbers.

Of the road smoothed of all waves finer than q the rubber touches under the nominal pressure p the share

    P(q) = erf(p / sqrt(2 V(q))),    V(q) = sum over |q_j| <= q of (|A_j| q_j |E*(v . q_j)| / 2)² f² / 2,

V being the variance of the pressure in full contact, and a wave adds its friction in full contact, times the share and
what contact leaves of its slopes there,

    mu_j = |A_j|² (q_j . e) q_j f Im E*(v . q_j) / (4 p) P(q_j) S(q_j),    S = gamma + (1 - gamma) P²,

e being the direction of sliding and f the stiffness of the layer over that of the half-space (Persson 2001, J. Chem.
Phys. 115, 3840, with S = 1; Persson 2006, J. Phys.: Condens. Matter 18, 7789, with gamma = 1/2). Averaged over the
phases of an isotropic road these are the theory's integrals over C(q) and over the angle between q and v; written as
sums they hold for any road, exactly where contact is full.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from scipy.special import erf

from rubfric.arrays import Real
from rubfric.mechanics.theory.layer import layer_factor
from rubfric.road.areal import ArealSpectrum, unit_vector
from rubfric.rubber.material import Material


@dataclass(frozen=True, eq=False)
class ArealTheory:
    """What Persson's theory says of an areal road.

    Attributes
    ----------
    wavenumbers : ndarray, shape (rings,)
        The different |q|, 1/mm, ascending.
    contact : ndarray, shape (rings,)
        P(q): contact seen down to each.
    friction : ndarray, shape (rings,)
        What the waves of each add to the friction coefficient.
    """

    wavenumbers: Real
    contact: Real
    friction: Real

    @property
    def contact_fraction(self) -> float:
        """Contact seen down to the shortest waves."""
        return float(self.contact[-1]) if len(self.contact) else 1.0

    @property
    def friction_coefficient(self) -> float:
        """Of all waves."""
        return float(self.friction.sum())


def persson_areal(
    material: Material,
    spectrum: ArealSpectrum,
    velocity: float,
    pressure: float,
    height: float,
    direction: float = 0.0,
    gamma: float = 1.0,
) -> ArealTheory:
    """Return contact and friction of an areal road by Persson's theory.

    Parameters
    ----------
    material : Material
    spectrum : ArealSpectrum
        The road's waves.
    velocity : float
        v, mm/s.
    pressure : float
        Nominal, MPa, positive.
    height : float
        H of the layer, mm.
    direction : float
        Of sliding, degrees from x towards y.
    gamma : float
        1 for the theory of 2001; 1/2 where contact is taken to leave less of the slopes, as since 2006.
    """
    number, along = spectrum.wavenumbers, spectrum.wavevectors @ unit_vector(direction)
    modulus = material.plane_modulus(velocity * along, "strain") * layer_factor(number * height)
    size = np.abs(spectrum.amplitudes)
    order = np.argsort(number, kind="stable")
    # Waves whose wavenumbers differ by round-off are one ring.
    begins = np.concatenate(([0], np.flatnonzero(np.diff(number[order]) > 1e-9 * number[order][:-1]) + 1))
    if not len(order):
        return ArealTheory(number, number, number)

    def by_ring(values: Real) -> Real:
        return np.add.reduceat(values[order], begins)

    variance = np.cumsum(by_ring(0.125 * (size * number * np.abs(modulus)) ** 2))
    share = erf(pressure / np.sqrt(2.0 * np.maximum(variance, np.finfo(float).tiny)))
    full = by_ring(0.25 * size**2 * along * number * modulus.imag / pressure)
    return ArealTheory(number[order][begins], share, full * share * (gamma + (1.0 - gamma) * share**2))
