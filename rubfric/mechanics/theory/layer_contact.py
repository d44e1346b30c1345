"""Contact of a road with a viscoelastic layer that slides steadily: boundary elements in small strain, no mesh.

The surface yields to pressures by ``layer_compliance``. Milliseconds where few nodes touch: what a finite-element block
would say in small strain, to a percent.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass, replace
from functools import lru_cache

import numpy as np

from rubfric.arrays import Complex, Flags, Real
from rubfric.mechanics.block.contact import Contact, full_contact, solve_contact
from rubfric.mechanics.theory.layer import filling_pressures, layer_compliance, westergaard_contact_fraction
from rubfric.mechanics.theory.persson import contact_fractions
from rubfric.road.road import Road, finest_waves
from rubfric.road.sine import SineScale
from rubfric.road.waves import WaveRoad
from rubfric.rubber.material import Material

# Surface nodes wanted in contact on a sine, and the least and most along it.
_NODES, _FEWEST, _MOST = 32, 64, 16384
# On a whole road: nodes along the finest wave and in contact that are enough, and most nodes of all.
_PER_WAVE, _TOUCHING = 16, 128
# By how much friction from pressures on slopes may differ from the energy that the layer dissipates, relative.
_AGREEMENT = 0.04
# The first guess of the contact: that of an elastic half-space, this much wider.
_FIRST_GUESS = 1.2


@dataclass(frozen=True)
class Layer:
    """A viscoelastic layer that slides steadily.

    Attributes
    ----------
    material : Material
    velocity : float
        v, mm/s.
    height : float
        H, mm.
    plane : {"stress", "strain"}
    """

    material: Material
    velocity: float
    height: float
    plane: str

    def compliance(self, wavenumber: Real) -> Complex:
        """Return ``layer_compliance``, mm/MPa, at wavenumbers in 1/mm of any shape."""
        return layer_compliance(self.material, wavenumber, self.velocity, self.height, self.plane)

    def filling(self, road: Road) -> Real:
        """Return ``filling_pressures`` of a road's waves, MPa."""
        return filling_pressures(self.material, road, self.velocity, self.height, self.plane)


@dataclass(frozen=True, eq=False)
class Loaded:
    """A road under a nominal pressure.

    Attributes
    ----------
    friction : float
        Its friction coefficient.
    pressure : ndarray, shape (m,)
        Of the nodes in contact, MPa, ascending.
    fraction : float
        Share of the nodes in contact.
    """

    friction: float
    pressure: Real
    fraction: float


@lru_cache(maxsize=4096)
def load_sine(layer: Layer, road: SineScale, pressure: float) -> Loaded:
    """Return the contact of a layer with a sine.

    Parameters
    ----------
    layer : Layer
    road : SineScale
    pressure : float
        Nominal, MPa.

    Raises
    ------
    NotConverged
        As ``solve_contact`` does.
    """
    return _loaded(layer, road, _on_sine(layer, road, pressure), pressure)


def load_road(layer: Layer, road: WaveRoad, pressure: float) -> Loaded:
    """Return the contact of a layer with a road of many waves.

    Surfaces of twice as many nodes each follow one another, to 16 on the finest wave and 128 in contact.

    Parameters
    ----------
    layer : Layer
    road : WaveRoad
    pressure : float
        Nominal, MPa.

    Raises
    ------
    NotConverged
        As ``solve_contact`` does.
    """
    return _loaded(layer, road, _on_road(layer, road, pressure), pressure)


def sample_friction(layer: Layer, samples: Sequence[Material], road: Road, pressure: float) -> Real:
    """Return friction coefficients of a layer, and of the same with other rubbers that differ little from its own.

    All are found on the same surface nodes, so that their differences are those of the rubbers.

    Parameters
    ----------
    layer : Layer
    samples : sequence of Material
    road : Road
    pressure : float
        Nominal, MPa.

    Returns
    -------
    ndarray, shape (1 + samples,)
        The layer's own first.

    Raises
    ------
    NotConverged
        As ``solve_contact`` does.
    """
    first = _on_sine(layer, road, pressure) if isinstance(road, SineScale) else _on_road(layer, road, pressure)
    nodes, start = len(first.pressure), first.touching
    others = [replace(layer, material=each) for each in samples]
    contacts = [first, *(_slide(other, road, pressure, nodes, start) for other in others)]
    found = zip([layer, *others], contacts, strict=True)
    return np.array([_loaded(other, road, contact, pressure).friction for other, contact in found])


def _on_sine(layer: Layer, road: SineScale, pressure: float) -> Contact:
    share = float(westergaard_contact_fraction(pressure / layer.filling(road)[0]))
    nodes = _power(min(max(_NODES / share, _FEWEST), _MOST))
    return _slide(layer, road, pressure, nodes, _crests(road, nodes, _FIRST_GUESS * share))


def _on_road(layer: Layer, road: Road, pressure: float) -> Contact:
    least = _power(_PER_WAVE * finest_waves(road))
    share = contact_fractions(layer.material, road, layer.velocity, pressure, layer.height, layer.plane)[-1]
    nodes = least // 2
    start = _crests(road, nodes, min(_FIRST_GUESS * float(share), 1.0))
    while True:
        found = _slide(layer, road, pressure, nodes, start)
        touching = found.touching
        if nodes >= least and (np.count_nonzero(touching) >= _TOUCHING or nodes >= max(_MOST, least)):
            return found
        start, nodes = np.repeat(touching | np.roll(touching, 1) | np.roll(touching, -1), 2), 2 * nodes


def _slide(layer: Layer, road: Road, pressure: float, nodes: int, start: Flags) -> Contact:
    """Return the contact on so many surface nodes."""
    spectrum = np.zeros(nodes // 2 + 1, dtype=complex)
    spectrum[1:] = layer.compliance(2.0 * np.pi / road.period * np.arange(1, nodes // 2 + 1))
    profile = road.height(road.period / nodes * np.arange(nodes))
    label = f"layer at {layer.velocity:g} mm/s under {pressure:g} MPa on {nodes} surface nodes"
    return full_contact(spectrum, profile, pressure) or solve_contact(spectrum, profile, pressure, start, label)


def _loaded(layer: Layer, road: Road, contact: Contact, pressure: float) -> Loaded:
    """Return what a contact says; its friction is that of pressures on slopes, within bounds of the energy dissipated.

    Rubber that is nearly relaxed dissipates so little that the former is the difference of large numbers: round a patch
    of some nodes it may be anything, while the energy, mu p = -sum of k |p_k|² Im C(k) over all k, has no such error.
    """
    nodes, touching = len(contact.pressure), contact.touching
    slope = road.slope(road.period / nodes * np.arange(nodes))
    by_slope = float(np.mean(contact.pressure * slope)) / pressure
    wavenumber = 2.0 * np.pi / road.period * np.arange(1, nodes // 2 + 1)
    twice = np.where(np.arange(1, nodes // 2 + 1) == nodes / 2, 1.0, 2.0)
    power = twice * wavenumber * np.abs(np.fft.rfft(contact.pressure)[1:] / nodes) ** 2
    by_energy = float(-np.sum(power * layer.compliance(wavenumber).imag)) / pressure
    friction = float(np.clip(by_slope, (1.0 - _AGREEMENT) * by_energy, (1.0 + _AGREEMENT) * by_energy))
    return Loaded(friction, np.sort(contact.pressure[touching]), float(np.mean(touching)))


def _crests(road: Road, nodes: int, share: float) -> Flags:
    """Return the highest places of a road that make up about a share of it; shape (nodes,)."""
    height = road.height(road.period / nodes * np.arange(nodes))
    return height >= np.quantile(height, max(1.0 - share, 0.0)) - 1e-9 * float(np.ptp(height))


def _power(number: float) -> int:
    """Return the power of two from ``number`` on."""
    return int(2 ** math.ceil(math.log2(number) - 1e-9))
