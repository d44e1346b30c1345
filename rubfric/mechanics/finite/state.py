"""What a block in finite strain carries from step to step: its branch tensors, and what they store and dissipate.

All in D_i = A_i - Cb^-1, by how much a branch is behind its equilibrium, so that branches that keep up lose no digits.
"""

from __future__ import annotations

import dataclasses
from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

import numpy as np

from rubfric.arrays import Flags, Real
from rubfric.mechanics.finite.block import Fields, FiniteBlock
from rubfric.mechanics.finite.law import Inverted, elongation, excess, inverted, trace, volumetric_energy
from rubfric.mechanics.finite.memory import StepPast
from rubfric.rubber.maxwell import Relaxation

# Points and weights in a step at which dissipation is taken: Gauss, exact for what varies as a parabola, and beyond.
_POINTS, _WEIGHTS = np.polynomial.legendre.leggauss(3)
_FIELDS = tuple(field.name for field in dataclasses.fields(Fields))


@dataclass(frozen=True)
class FiniteState:
    """All that the next step depends on.

    Attributes
    ----------
    fields, before : Fields
        Now, and before the last step.
    inverse, inverse_change : ndarray, shape (4, points, rows, columns)
        Cb^-1, and its change in the last step.
    volume_change : ndarray, shape of ``Fields.volume``
        Change of the volume ratio in the last step.
    behind : ndarray, shape (4, branches, points, rows, columns)
        D_i.
    volume_behind : ndarray, shape (branches or 0, ...)
        J - J_i, in the shape of ``Fields.volume``; without entries where the bulk does not relax.
    touching : ndarray of bool, shape (columns,)
    force : ndarray, shape (2, columns)
        Forces of the road on the surface nodes, N per mm of thickness.
    duration : float
        Length of the last step, s; infinite where there was none.
    advance : float
        How far the road went past in it, mm.
    offset : float
        How far the road has gone past in all, mm.
    pressure : float
        Nominal, MPa.
    stored : float
        Strain energy, N mm per mm of thickness.
    """

    fields: Fields
    before: Fields
    inverse: Real
    inverse_change: Real
    volume_change: Real
    behind: Real
    volume_behind: Real
    touching: Flags
    force: Real
    duration: float
    advance: float
    offset: float
    pressure: float
    stored: float

    def arrays(self) -> dict[str, Any]:
        """Return the state as arrays."""
        plain = {field.name: getattr(self, field.name) for field in dataclasses.fields(self)}
        arrays: dict[str, Any] = {}
        for name, value in plain.items():
            if isinstance(value, Fields):
                arrays |= {f"{name}.{part}": getattr(value, part) for part in _FIELDS}
            else:
                arrays[name] = np.asarray(value)
        return arrays

    @classmethod
    def from_arrays(cls, arrays: Mapping[str, Any]) -> FiniteState:
        """Return the state that ``arrays`` gave."""
        given: dict[str, Any] = {}
        for name in (field.name for field in dataclasses.fields(cls)):
            if name in ("fields", "before"):
                given[name] = Fields(*(arrays[f"{name}.{part}"] for part in _FIELDS))
            else:
                given[name] = arrays[name] if arrays[name].ndim else float(arrays[name])
        return cls(**given)


class Branches:
    """The branches of one rubber on one mesh."""

    def __init__(self, finite: FiniteBlock) -> None:
        material = finite.material
        self._finite = finite
        self.times = np.asarray(material.relaxation_times, dtype=float)
        self._shear, self._bulk = material.branch_shear_moduli, material.branch_bulk_moduli
        self._bulk_relaxes = bool(self._bulk.any())

    def none(self, fields: Fields, inverse: Real) -> tuple[Real, Real]:
        """Return D_i and J - J_i of a relaxed block."""
        branches = len(self.times)
        volume = np.zeros((branches if self._bulk_relaxes else 0, *fields.volume.shape))
        return np.zeros((4, branches, *inverse.shape[1:])), volume

    def past(self, state: FiniteState, relaxation: Relaxation) -> StepPast:
        """Return what the rubber remembers at the end of a step from a state."""
        shear, lag = float(self._shear @ relaxation.share), float(self._shear @ relaxation.lag)
        driving = np.tensordot(self._shear * relaxation.decay, state.behind, axes=(0, 1))
        driving += shear * state.inverse + lag * state.inverse_change
        bulk: float = 0.0
        pressure: Real | float = 0.0
        if self._bulk_relaxes:
            bulk, lag = float(self._bulk @ relaxation.share), float(self._bulk @ relaxation.lag)
            kept = np.tensordot(self._bulk * relaxation.decay, state.volume_behind, axes=1)
            pressure = kept - bulk * state.fields.volume - lag * state.volume_change
        return StepPast(shear, bulk, driving, pressure, len(self._finite.block.harmonics))

    def follow(self, state: FiniteState, relaxation: Relaxation, inverse: Real, volume: Real) -> tuple[Real, Real]:
        """Return D_i and J - J_i at the end of a step from a state to some Cb^-1 and J.

        Raises
        ------
        Inverted
            Where a branch tensor is no longer positive: the step is too long.
        """
        decay, share, lag = (
            factor.reshape(-1, 1, 1, 1) for factor in (relaxation.decay, relaxation.share, relaxation.lag)
        )
        behind = decay * state.behind - share * (inverse - state.inverse)[:, None] + lag * state.inverse_change[:, None]
        if behind.size:
            _check(inverse[:, None] + behind)
        swollen = state.volume_behind
        if self._bulk_relaxes:
            swollen = decay * swollen + share * (volume - state.fields.volume) - lag * state.volume_change
        return behind, swollen

    def stored(self, squared: Real, inverse: Real, volume: Real, behind: Real, volume_behind: Real) -> float:
        """Return the energy stored in the block, N mm per mm of thickness, from Cb, Cb^-1, J and the branches."""
        material = self._finite.material
        density = 0.5 * material.long_term_shear_modulus * (trace(squared) - 3.0)
        each = elongation(behind, squared[:, None], inverse[:, None])
        density = density + np.tensordot(0.5 * self._shear, each, axes=1)
        density = density + volumetric_energy(material.long_term_bulk_modulus, volume)
        if self._bulk_relaxes:
            density = density + np.tensordot(0.5 * self._bulk, volume_behind**2, axes=1)
        return float((density * self._finite.weights).sum())

    def dissipated(self, state: FiniteState, relaxation: Relaxation, inverse: Real, volume: Real) -> float:
        """Return what a step dissipates from a state to some Cb^-1 and J, N mm per mm of thickness."""
        if not len(self.times):
            return 0.0
        growth = inverse - state.inverse
        bow = relaxation.bow(growth, state.inverse_change)
        factor, total = self._shear / (2.0 * self.times), 0.0
        for point, weight in zip(0.5 * (_POINTS + 1.0), 0.5 * _WEIGHTS, strict=True):
            decay, line, curve = (part.reshape(-1, 1, 1, 1) for part in relaxation.at(float(point)))
            there = state.inverse + point * growth + point * (point - 1.0) * bow
            behind = decay * state.behind - line * growth[:, None] - curve * bow[:, None]
            density = excess(behind, inverted(there)[:, None], there[:, None])
            total += weight * float(factor @ (density * self._finite.weights).sum(axis=(1, 2, 3)))
        if self._bulk_relaxes:
            change = volume - state.fields.volume
            square = relaxation.mean_square(state.volume_behind, change, state.volume_change)
            density = np.tensordot(self._bulk / self.times, square, axes=1)
            total += float((np.broadcast_to(density, inverse.shape[1:]) * self._finite.weights).sum())
        return relaxation.duration * total


def _check(branch: Real) -> None:
    smallest = (branch[0] * branch[1] - branch[2] * branch[2]).min()
    if not (smallest > 0.0 and branch[0].min() > 0.0 and branch[3].min() > 0.0):
        raise Inverted(f"smallest determinant of a branch tensor is {smallest:.3g}")
