"""The cascade: each finer scale of a road is loaded by the contact pressures that the coarser one leaves.

Patches of contact are taken to be wide beside the finer waves. With mu_i(p) the friction and q(x) the contact pressure
of scale i alone under the nominal pressure p,

    F_i(p) = mu_i(p) + mean over x of q F_(i+1)(q) / p,    F = 0 beyond the finest,

and the total is F_1 at the nominal pressure. Each F_i is tabulated over a ladder of pressures that is the same for all
scales and loads, so that contacts are solved once.
"""

from __future__ import annotations

import math

import numpy as np
from scipy.interpolate import PchipInterpolator

from rubfric.arrays import Real
from rubfric.mechanics.theory.layer_contact import Layer, Loaded, load_sine
from rubfric.road.sine import SineScale

# Rungs of the ladder of pressures in a decade, and the lowest of them over the nominal pressure: contact carries next
# to none of the load there.
_RUNGS, _LOWEST = 6, 0.05
# Contact pressures of a sliding layer may peak above those of the standing one.
_MARGIN = 1.5


class _Friction:
    """F_i over the ladder, interpolated in the logarithm of pressure; constant beyond its ends."""

    def __init__(self, rungs: Real, values: Real) -> None:
        self._ends = float(rungs[0]), float(rungs[-1])
        self._curve = PchipInterpolator(np.log(rungs), values)

    def __call__(self, pressure: Real) -> Real:
        values: Real = self._curve(np.log(np.clip(pressure, *self._ends)))
        return values


def cascade_friction(layer: Layer, scales: tuple[SineScale, ...], pressure: float) -> float:
    """Return the friction coefficient of all scales, each loaded by the contact pressures of the one before.

    Parameters
    ----------
    layer : Layer
    scales : tuple of SineScale
        From coarse to fine, at least one.
    pressure : float
        Nominal, MPa.

    Raises
    ------
    NotConverged
        As ``solve_contact`` does.
    """
    finer: _Friction | None = None
    lowest = math.floor(_RUNGS * math.log10(_LOWEST * pressure))
    for number in range(len(scales) - 1, 0, -1):
        highest = math.ceil(_RUNGS * math.log10(_highest(layer, scales[:number], pressure)))
        rungs = 10.0 ** (np.arange(lowest, highest + 1) / _RUNGS)
        values = [_with_finer(load_sine(layer, scales[number], p), p, finer) for p in rungs.tolist()]
        finer = _Friction(rungs, np.array(values))
    return _with_finer(load_sine(layer, scales[0], pressure), pressure, finer)


def _with_finer(found: Loaded, pressure: float, finer: _Friction | None) -> float:
    """Return F_i(p) from the contact of scale i and F_(i+1)."""
    if finer is None:
        return found.friction
    share = found.fraction * float(np.mean(found.pressure * finer(found.pressure))) / pressure
    return found.friction + share


def _highest(layer: Layer, scales: tuple[SineScale, ...], pressure: float) -> float:
    """Return about the highest contact pressure, MPa, that some scales leave: by Westergaard, with a margin."""
    highest = pressure
    for scale in scales:
        filling = float(layer.filling(scale)[0])
        highest = highest + filling if highest > filling else _MARGIN * 2.0 * math.sqrt(highest * filling)
    return highest
