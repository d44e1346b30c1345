"""As many branches as the data justify: the Bayesian information criterion decides.

Dense, evenly spaced branches show where moduli are needed; neighbours become one, whose time is fitted too; then what
the criterion does not miss is left out, one branch after another.
"""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from rubfric.arrays import Real
from rubfric.dma.joint import MARGIN, Joint, follow, merge, own_parameters, refine
from rubfric.dma.measurements import Measurements

# Branches a decade to begin with.
_DENSITIES = (2.0, 3.0, 4.0)
# By how much the criterion of evenly spaced branches has to be better than that of fewer ones: decisive evidence.
_DECISIVE = 10.0
# Decades by which the halves of a split branch are moved apart, and the least gain of the criterion.
_APART, _LEAST_GAIN = 0.25, 1.0
# Beyond so many branches none is split: continuous spectra need no more, and it takes long.
_MOST_SPLIT = 20


def choose_branches(data: Measurements, joint: Joint, static: float | None) -> Joint:
    """Return the fit with the branches that the data justify.

    Parameters
    ----------
    data : Measurements
    joint : Joint
        A coarse fit.
    static : float, optional
        Static modulus, MPa, where it is known.
    """
    even = [refine(data, joint, density, MARGIN, static) for density in _DENSITIES]
    few = [_thinned(data, merge(data, dense, static), static) for dense in even]
    dense, sparse = (min(fits, key=lambda each: each.bic) for fits in (even, few))
    sparse = _split(data, sparse, static)
    return dense if dense.bic < sparse.bic - _DECISIVE else sparse


def _thinned(data: Measurements, joint: Joint, static: float | None) -> Joint:
    """Return the fit without the branches that the criterion does not miss."""
    while len(joint.times) > 1:
        weight = _importance(joint)
        fewer = None
        for branch in np.argsort(weight)[:2]:
            times = np.delete(joint.times, branch)
            tried = follow(
                data, joint.law, joint.vertical, joint.reference, own_parameters(joint), times, static, moving=True
            )
            if tried.bic < joint.bic and (fewer is None or tried.bic < fewer.bic):
                fewer = tried
        if fewer is None:
            return joint
        joint = fewer
    return joint


def _split(data: Measurements, joint: Joint, static: float | None) -> Joint:
    """Return the fit with branches split in two, one at a time, while the criterion asks for it."""
    best = joint
    while len(joint.times) <= _MOST_SPLIT:
        for branch in range(len(joint.times)):
            pair = joint.times[branch] * np.array([10.0**-_APART, 10.0**_APART])
            times = np.concatenate((np.delete(joint.times, branch), pair))
            start = own_parameters(joint)
            tried = follow(data, joint.law, joint.vertical, joint.reference, start, times, static, moving=True)
            best = min(best, tried, key=lambda each: each.bic)
        if best.bic >= joint.bic - _LEAST_GAIN:
            break
        joint = best
    return joint


def _importance(joint: Joint) -> Real:
    """Return how much of the moduli each branch carries where it carries most, times what its neighbours cannot."""
    share = np.linalg.norm(joint.spectrum.by_time, axis=0)
    order = np.argsort(joint.times)
    gaps = np.diff(np.log(joint.times[order]))
    nearest = np.empty(len(order))
    nearest[order] = np.minimum(np.append(gaps, np.inf), np.insert(gaps, 0, np.inf))
    return share * np.minimum(nearest, 1.0) ** 2


def without_idle(joint: Joint) -> Joint:
    """Return the fit without branches whose modulus is 0.

    Parameters
    ----------
    joint : Joint
    """
    kept = joint.spectrum.moduli[1:] > 0.0
    spectrum = replace(
        joint.spectrum,
        moduli=joint.spectrum.moduli[np.insert(kept, 0, True)],
        by_time=joint.spectrum.by_time[:, kept],
    )
    parameters, jacobian = joint.parameters, joint.jacobian
    if joint.moving:
        there = np.concatenate((np.ones(len(own_parameters(joint)), dtype=bool), kept))
        parameters, jacobian = parameters[there], jacobian[:, there]
    return replace(joint, times=joint.times[kept], spectrum=spectrum, parameters=parameters, jacobian=jacobian)
