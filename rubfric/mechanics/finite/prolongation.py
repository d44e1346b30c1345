"""Fields of one mesh on another, as a start for the solver there."""

from __future__ import annotations

import numpy as np

from rubfric.arrays import Real
from rubfric.mechanics.finite.block import Fields, FiniteBlock


def prolong(fields: Fields, old: FiniteBlock, new: FiniteBlock) -> Fields:
    """Return fields of one mesh on another: by harmonics along the road, linearly over the height.

    Parameters
    ----------
    fields : Fields
    old : FiniteBlock
        The block of the fields.
    new : FiniteBlock
        The same block on another mesh.
    """
    return Fields(
        _over_height(
            _along_road(fields.displacement, new.block.columns, 0.0), old.block.row_positions, new.block.row_positions
        ),
        _between_points(fields.log_thickness, old, new),
        _between_points(fields.volume[None], old, new)[0],
    )


def _between_points(field: Real, old: FiniteBlock, new: FiniteBlock) -> Real:
    """Return a field at the points of the cells of one mesh at those of another."""
    # The points stand half a column to the right of the nodes.
    shift = 0.5 / new.block.columns - 0.5 / old.block.columns
    along = _along_road(field, new.block.columns, shift)
    parts, columns = len(field), new.block.columns
    points = field.shape[1]
    stacked = along.swapaxes(1, 2).reshape(parts, old.block.rows * points, columns)
    moved = _over_height(stacked, _point_heights(old, points), _point_heights(new, points))
    return moved.reshape(parts, new.block.rows, points, columns).swapaxes(1, 2)


def _point_heights(finite: FiniteBlock, points: int) -> Real:
    """Return the heights of the quadrature points, or of the one centre of each cell, mm, upwards."""
    rows = finite.block.row_positions
    share = finite.quadrature.shapes[:, 2:].sum(axis=1) if points > 1 else np.array([0.5])
    return (rows[:-1, None] + np.diff(rows)[:, None] * share).ravel()


def _along_road(field: Real, columns: int, shift: float) -> Real:
    """Return a periodic field on another number of columns, shifted by a share of the wavelength."""
    before = field.shape[-1]
    spectrum = np.fft.rfft(field, axis=-1)
    spectrum[..., -1] = 0.0  # its phase is unknown
    spectrum *= np.exp(2j * np.pi * shift * np.arange(before // 2 + 1))
    answer: Real = np.fft.irfft(spectrum[..., : columns // 2 + 1], columns, axis=-1)
    return answer * (columns / before)


def _over_height(field: Real, old: Real, new: Real) -> Real:
    """Return a field, rows last but one, at other heights."""
    below = np.clip(np.searchsorted(old, new, side="right") - 1, 0, len(old) - 2)
    share = ((new - old[below]) / (old[below + 1] - old[below]))[:, None]
    return field[..., below, :] * (1.0 - share) + field[..., below + 1, :] * share
