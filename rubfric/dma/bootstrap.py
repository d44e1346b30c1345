"""What the scatter of the data leaves open: the fit repeated on resampled residuals (Efron 1979).

Residuals of storage and of loss moduli are drawn with replacement from their own, widened by the degrees of freedom
that the fit has used. Where neighbours along an isotherm scatter together, with lag-one correlation c, fewer of them
are independent: residuals are widened by sqrt((1 + c) / (1 - c)) too.
"""

from __future__ import annotations

import dataclasses
from dataclasses import dataclass

import numpy as np

from rubfric.arrays import Real
from rubfric.dma.joint import repeat
from rubfric.dma.result import Fit, assembled

# Percentiles of the 95 % band.
_BAND = (2.5, 97.5)
# Correlation beyond which residuals are as good as one.
_MOST_CORRELATED = 0.9
# A resampled modulus stays positive.
_LARGEST = 0.9


@dataclass(frozen=True, eq=False)
class Bands:
    """Fits of resampled data.

    Attributes
    ----------
    samples : tuple of Fit
    correlation : float
        Lag-one correlation of residuals along isotherms.
    """

    samples: tuple[Fit, ...]
    correlation: float

    def band(self, values: list[float] | Real) -> tuple[Real, Real]:
        """Return the 95 % band of what the samples give.

        Parameters
        ----------
        values : array_like, shape (samples, ...)
        """
        low, high = np.percentile(np.asarray(values), _BAND, axis=0)
        return low, high

    def moduli(self, frequency: Real) -> tuple[tuple[Real, Real], tuple[Real, Real]]:
        """Return the bands of storage and loss modulus, MPa, at the reference temperature.

        Parameters
        ----------
        frequency : ndarray, shape (frequencies,)
            Angular frequencies, rad/s.
        """
        found = np.array([sample.moduli_at(frequency) for sample in self.samples])
        return self.band(found[:, 0]), self.band(found[:, 1])

    def of(self, name: str) -> tuple[Real, Real]:
        """Return the band of an attribute of the fits: c1, c2, activation_energy, static, moduli, log_shifts."""
        return self.band([getattr(sample, name) for sample in self.samples])


def correlation(fit: Fit) -> float:
    """Return the lag-one correlation of neighbouring residuals along isotherms, both moduli together."""
    pairs = np.diff(fit.data.isotherm) == 0
    products = variances = 0.0
    for part in fit.residuals:
        own = part - part.mean()
        products += float(np.mean((own[1:] * own[:-1])[pairs])) if pairs.any() else 0.0
        variances += float(np.mean(own**2))
    return products / variances if variances > 0.0 else 0.0


def bootstrap(fit: Fit) -> Bands:
    """Repeat a fit on resampled data.

    Parameters
    ----------
    fit : Fit
        ``fit.options`` says how often, and with which seed.
    """
    rng = np.random.default_rng(fit.options.seed)
    data, count = fit.data, len(fit.data.storage)
    found = correlation(fit)
    # Chance alone gives a correlation of about 1 / sqrt(n).
    sure = min(max(found - 2.0 / np.sqrt(2.0 * count), 0.0), _MOST_CORRELATED)
    unknowns = fit.joint.unknowns
    width = np.sqrt((1.0 + sure) / (1.0 - sure) * 2.0 * count / max(2 * count - unknowns, count))
    storage, loss = (width * (part - part.mean()) for part in fit.residuals)
    samples = []
    for _ in range(fit.options.samples):
        drawn = [
            measured * (1.0 - own) * (1.0 + np.clip(rng.choice(part, count), -_LARGEST, None))
            for measured, own, part in zip((data.storage, data.loss), fit.residuals, (storage, loss), strict=True)
        ]
        again = dataclasses.replace(data, storage=drawn[0], loss=drawn[1])
        joint = repeat(again, fit.joint, fit.options.static)
        samples.append(assembled(again, fit.options, fit.reference, joint, {}, []))
    return Bands(tuple(samples), found)
