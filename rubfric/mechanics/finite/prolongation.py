"""Fields of one mesh on another, as a start for the solver there."""

from __future__ import annotations

import numpy as np
from scipy import fft

from rubfric.arrays import Complex, Real
from rubfric.mechanics.finite.block import Fields, FiniteBlock
from rubfric.mechanics.finite.layers import even_cells, even_nodes


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
    nodes, below = np.empty((2, new.shape[0] + 1, new.block.columns)), old.block.row_positions
    known = [_harmonics(fields.displacement[:, :1])]
    known += [_harmonics(layer.nodes_of(fields.displacement)) for layer in old.layers]
    nodes[:, :1] = _on_columns(known[0], new.block.columns)
    for layer in new.layers:
        heights = new.block.row_positions[layer.rows.start + 1 : layer.rows.stop + 1]
        layer.nodes_of(nodes)[:] = _on_columns(_over_height(known, below, heights, layer.columns), layer.columns)
    return Fields(
        nodes, _between_points(fields.log_thickness, old, new), _between_points(fields.volume[None], old, new)[0]
    )


def on_all_columns(fields: Fields, finite: FiniteBlock) -> Fields:
    """Return fields of a block with layers on all columns of all of its rows.

    Parameters
    ----------
    fields : Fields
    finite : FiniteBlock
        The block of the fields.
    """
    return Fields(
        even_nodes(finite.layers, fields.displacement),
        even_cells(finite.layers, fields.log_thickness),
        even_cells(finite.layers, fields.volume),
    )


def _between_points(field: Real, old: FiniteBlock, new: FiniteBlock) -> Real:
    """Return a field at the points of the cells of one mesh at those of another."""
    parts, points = field.shape[:2]
    # The points stand half a column to the right of the nodes.
    shift = 0.5 / new.block.columns - 0.5 / old.block.columns
    known = []
    for layer in old.layers:
        spectrum = _harmonics(layer.of(field)) * np.exp(2j * np.pi * shift * np.arange(layer.harmonics))
        known.append(spectrum.swapaxes(1, 2).reshape(parts, points * spectrum.shape[2], layer.harmonics))
    answer = np.empty((parts, points, *new.shape))
    heights = _point_heights(new, points)
    for layer in new.layers:
        there = heights[points * layer.rows.start : points * layer.rows.stop]
        found = _on_columns(_over_height(known, _point_heights(old, points), there, layer.columns), layer.columns)
        rows = layer.rows.stop - layer.rows.start
        layer.of(answer)[:] = found.reshape(parts, rows, points, layer.columns).swapaxes(1, 2)
    return answer


def _point_heights(finite: FiniteBlock, points: int) -> Real:
    """Return the heights of the quadrature points, or of the one centre of each cell, mm, upwards."""
    rows = finite.block.row_positions
    share = finite.quadrature.shapes[:, 2:].sum(axis=1) if points > 1 else np.array([0.5])
    return (rows[:-1, None] + np.diff(rows)[:, None] * share).ravel()


def _harmonics(field: Real) -> Complex:
    """Return the amplitudes of the harmonics of rows of a field."""
    spectrum: Complex = fft.rfft(field, axis=-1, norm="forward")
    spectrum[..., -1] = 0.0  # its phase is unknown
    return spectrum


def _on_columns(spectrum: Complex, columns: int) -> Real:
    """Return the field of given amplitudes on some columns."""
    answer: Real = fft.irfft(spectrum[..., : columns // 2 + 1], columns, axis=-1, norm="forward")
    return answer


def _over_height(known: list[Complex], old: Real, new: Real, columns: int) -> Complex:
    """Return as many amplitudes as columns carry, rows last but one, linearly at other heights.

    Parameters
    ----------
    known : list of ndarray of complex, shape (..., rows, n)
        Rows upwards, some of them of fewer harmonics.
    old : ndarray, shape (all of these rows,)
        Their heights, mm.
    new : ndarray, shape (m,)
        Heights, mm.
    columns : int
    """
    harmonics = min(columns // 2 + 1, known[0].shape[-1])
    below = np.clip(np.searchsorted(old, new, side="right") - 1, 0, len(old) - 2)
    share = ((new - old[below]) / (old[below + 1] - old[below]))[:, None]
    first, last = int(below.min()), int(below.max()) + 2
    rows: Complex = np.zeros((*known[0].shape[:-2], last - first, harmonics), dtype=complex)
    start = -first
    for part in known:
        begin, end = max(start, 0), min(start + part.shape[-2], last - first)
        if end > begin:
            common = min(harmonics, part.shape[-1])
            rows[..., begin:end, :common] = part[..., begin - start : end - start, :common]
        start += part.shape[-2]
    found: Complex = rows[..., below - first, :] * (1.0 - share) + rows[..., below - first + 1, :] * share
    return found
