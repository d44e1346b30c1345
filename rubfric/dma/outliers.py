"""Points that a coarse fit shows to be wrong: single ones, and the highest frequency of a resonating instrument."""

from __future__ import annotations

import math

import numpy as np

from rubfric.arrays import Real
from rubfric.dma.measurements import Measurements

# A point is an outlier beyond so many robust standard deviations, and this relative residual.
_DEVIATIONS, _LEAST = 6.0, 0.08
# At most this share of the points is left out; beyond, the fit is to blame.
_MOST = 0.05
# The ends of all sweeps are wrong where the median residual there is beyond so many times the typical residual.
_SYSTEMATIC, _FEWEST = 3.0, 4


def without_resonance(data: Measurements, residuals: Real) -> Measurements:
    """Return the data without the highest frequency, where there the loss modulus is off at most temperatures.

    Near the resonance of sample and clamp the instrument reads its own inertia.

    Parameters
    ----------
    data : Measurements
    residuals : ndarray, shape (2 points,)
        Of a coarse fit.
    """
    loss = residuals[len(data.storage) :]
    ends = data.frequency > 0.98 * data.frequency.max()
    if np.count_nonzero(ends) < _FEWEST or len(np.unique(data.frequency)) < _FEWEST:
        return data
    typical = float(np.median(np.abs(loss[~ends])))
    off = float(np.median(loss[ends]))
    if abs(off) < max(_SYSTEMATIC * typical, _LEAST):
        return data
    hertz = data.frequency.max() / (2.0 * math.pi)
    kept = ~ends
    return data.subset(
        kept,
        f"{np.count_nonzero(ends)} points at {hertz:.4g} Hz left out: there the loss modulus is off by {off:+.0%} at "
        "the median of all temperatures, as near a resonance of the instrument",
    )


def without_outliers(data: Measurements, residuals: Real) -> Measurements:
    """Return the data without single points far from a coarse fit, which are named in the notes.

    Parameters
    ----------
    data : Measurements
    residuals : ndarray, shape (2 points,)
        Of that fit.
    """
    count = len(data.storage)
    far = np.zeros(count)
    for part in (residuals[:count], residuals[count:]):
        scale = 1.4826 * float(np.median(np.abs(part - np.median(part))))
        far = np.maximum(far, np.abs(part - np.median(part)) / max(_DEVIATIONS * scale, _LEAST))
    worst = np.flatnonzero(far > 1.0)
    if not len(worst):
        return data
    first = worst[np.argmax(far[worst])]
    where = f"the farthest at {data.frequency[first] / (2.0 * math.pi):.4g} Hz"
    if not data.is_master:
        where += f" and {data.temperatures[data.isotherm[first]]:.4g} degC"
    if len(worst) > _MOST * count:
        return data.subset(
            np.ones(count, dtype=bool), f"{len(worst)} of {count} points lie far from the fit, {where}; all were kept"
        )
    kept = np.ones(count, dtype=bool)
    kept[worst] = False
    return data.subset(kept, f"{len(worst)} outliers left out, {where}")
