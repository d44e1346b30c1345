"""Douglas-Rachford splitting (Lions and Mercier 1979, SIAM J. Numer. Anal. 16, 964) of contact into balance and bound.

With any step lambda it converges for every C whose symmetric part is positive definite, if slowly:

    x = (1 + lambda C)^-1 (z + lambda (s - d)),  mean(x) = nominal;   r = max(2 x - z, 0);   z <- z + r - x.

At the end z = p + lambda gap, which is also where it starts from. Lambda is adapted ever more rarely, and so settles.
"""

from __future__ import annotations

import numpy as np
from scipy import fft

from rubfric.arrays import Complex, Real
from rubfric.mechanics.areal.surface import TOLERANCE, ArealSurface

# Lambda is doubled or halved where one of its two residuals is so many times the other.
_UNBALANCED = 4.0


class Splitting:
    """Douglas-Rachford splitting; ``run`` says whether its pressure is the solution.

    Parameters
    ----------
    surface : ArealSurface
    profile : ndarray, shape (ny, nx)
        s, mm.
    nominal : float
        Nominal pressure, MPa.
    near : tuple of ndarray, optional
        Pressure, MPa, and gap, mm, of a contact nearby.
    """

    def __init__(
        self, surface: ArealSurface, profile: Real, nominal: float, near: tuple[Real, Real] | None = None
    ) -> None:
        self._surface, self._nominal = surface, nominal
        self._profile = fft.rfft2(profile)
        self.steps, self.residual = 0, np.inf
        if near is None:
            self.pressure, gap = np.full(surface.shape, nominal), np.maximum(-profile + profile.mean(), 0.0)
        else:
            self.pressure, gap = near
        # The pressures and lambda times the gaps weigh alike.
        self._step = float(np.linalg.norm(self.pressure) / np.linalg.norm(gap)) if gap.any() else self._stiffest()
        self._state = self.pressure + self._step * gap

    def _stiffest(self) -> float:
        return float(1.0 / np.abs(self._surface.compliance[self._surface.compliance != 0.0]).min())

    def run(self, steps: int) -> bool:
        """Take so many steps, or fewer."""
        resolvent = self._resolvent()
        for _ in range(steps):
            series = fft.rfft2(self._state)
            series += self._step * self._profile
            series *= resolvent
            series[0, 0] = self._nominal * self._surface.nodes
            free = fft.irfft2(series, self._surface.shape, overwrite_x=True)
            bound = np.maximum(2.0 * free - self._state, 0.0)
            away = bound - free
            size = float(np.linalg.norm(bound)) or self._nominal
            dual = float(np.linalg.norm(self._state - free))
            change = float(np.linalg.norm(bound - self.pressure)) / (dual or 1.0)
            self._state += away
            self.pressure, self.steps = bound, self.steps + 1
            self.residual = max(float(np.linalg.norm(away)) / size, change * dual / size)
            if not self.residual > TOLERANCE:
                return bool(np.isfinite(self.residual))
            if self.steps & (self.steps - 1) == 0 and self.steps >= 8:
                primal = float(np.linalg.norm(away)) / size
                factor = 0.5 if primal > _UNBALANCED * change else 2.0 if change > _UNBALANCED * primal else 1.0
                if factor != 1.0:
                    self._state = bound + factor * (self._state - bound)
                    self._step *= factor
                    resolvent = self._resolvent()
        return False

    def _resolvent(self) -> Complex:
        return 1.0 / (1.0 + self._step * self._surface.compliance)
