"""Rows of cells on fewer columns, the deeper the fewer: what the road does to a block decays with depth.

Harmonic n decays as exp(-n k y). Where the upper half of the harmonics of some rows is gone, points in every other
column of cells say all about them; where three quarters are gone, in every fourth. Such rows form a layer. What is
between its nodes follows from their harmonics, so that a layer gives what all columns would give: its points are those
of every so many columns, and differences along the road are taken over the width of one column as everywhere else.

Arrays keep the shape (..., rows, columns): a row of them holds as many rows of a layer, side by side, as the layer
leaves out columns. Nodes between two layers belong to the lower one; the upper one sees their lower harmonics.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass

import numpy as np
from scipy import fft

from rubfric.arrays import Complex, Real
from rubfric.mechanics.block.block import Block

# A layer begins where the harmonic that it leaves out first has decayed by exp(-_DECAY).
_DECAY = 10.0
# Fewest columns of a layer, and fewest cells of a block that is worth dividing.
_FEWEST_COLUMNS, _FEWEST_CELLS = 32, 4096


@dataclass(frozen=True)
class Layer:
    """Rows of cells that are worked out on some of the columns of a block.

    Attributes
    ----------
    rows : slice
        Of cells of the block.
    stored : slice
        Rows of arrays that hold them.
    columns : int
    share : int
        Columns of the block over those of the layer; so many of its rows share a row of an array.
    """

    rows: slice
    stored: slice
    columns: int
    share: int

    @property
    def harmonics(self) -> int:
        """How many harmonics the layer has, the mean among them."""
        return self.columns // 2 + 1

    def kernel(self, harmonics: Complex) -> Complex:
        """Return the part of a kernel that the layer has harmonics for; the last is its own conjugate."""
        if self.share == 1:
            return harmonics
        own = harmonics[: self.harmonics].copy()
        own[-1] = own[-1].real
        return own

    def of(self, field: Real) -> Real:
        """Return the layer's rows of cells of a field, shape (..., rows, columns), as a view."""
        return self._open(field[..., self.stored, :])

    def nodes_of(self, field: Real) -> Real:
        """Return the nodes above the layer's rows of cells, shape (..., rows, columns), as a view."""
        return self._open(field[..., self.stored.start + 1 : self.stored.stop + 1, :])

    def mean(self, field: Real) -> Real:
        """Return the mean along the road of arrays of the layer alone, shape (..., stored rows, columns of the block).

        Returns
        -------
        ndarray, shape (..., rows)
        """
        means: Real = self._open(field).mean(axis=-1)
        return means

    def part(self, stored: slice) -> Layer:
        """Return the part of the layer that some rows of arrays hold."""
        first, last = (self.rows.start + self.share * (row - self.stored.start) for row in (stored.start, stored.stop))
        return Layer(slice(first, last), stored, self.columns, self.share)

    def _open(self, field: Real) -> Real:
        return field.reshape(*field.shape[:-2], self.share * field.shape[-2], self.columns)


def undivided(block: Block) -> tuple[Layer, ...]:
    """Return the one layer of a block whose rows all have its columns."""
    rows = slice(0, block.rows)
    return (Layer(rows, rows, block.columns, 1),)


def divided(block: Block, stretch: float) -> tuple[Layer, ...]:
    """Return layers of a block for steady sliding, from the road upwards.

    Parameters
    ----------
    block : Block
    stretch : float
        Height of the block under its load over that as it was made: pressed together, it brings the road nearer.
    """
    if block.columns * block.rows < _FEWEST_CELLS:
        return undivided(block)
    decay = np.pi / block.width * stretch * block.row_positions[:-1]  # of the highest harmonic, over the columns
    shares = [1]
    while block.columns % (4 * shares[-1]) == 0 and block.columns >= 2 * shares[-1] * _FEWEST_COLUMNS:
        shares.append(2 * shares[-1])
    end, starts = block.rows, []
    for share in reversed(shares):
        first = int(np.searchsorted(decay * (block.columns // share), _DECAY)) if share > 1 else 0
        start = end - max(end - first, 0) // share * share
        starts.append((start, end, share))
        end = start
    layers, stored = [], 0
    for start, end, share in reversed(starts):
        if end > start:
            last = stored + (end - start) // share
            layers.append(Layer(slice(start, end), slice(stored, last), block.columns // share, share))
            stored = last
    return tuple(layers)


def gathered(parts: Sequence[Real]) -> Real:
    """Return the fields of points of one layer after another, shape (..., rows, columns), as one array."""
    if len(parts) == 1:
        return parts[0]
    columns = parts[0].shape[-1]
    stored = ((part.shape[-2] * part.shape[-1] // columns, part) for part in parts)
    return np.concatenate([part.reshape(*part.shape[:-2], rows, columns) for rows, part in stored], axis=-2)


def restricted(nodes: Real, columns: int) -> Real:
    """Return the lower harmonics of rows of nodes on fewer columns.

    Parameters
    ----------
    nodes : ndarray, shape (..., more columns)
    columns : int
    """
    spectrum = fft.rfft(nodes, axis=-1)[..., : columns // 2 + 1]
    spectrum[..., -1] = 0.0
    return fft.irfft(spectrum, columns, axis=-1) * (columns / nodes.shape[-1])


def spread(forces: Real, columns: int) -> Real:
    """Return forces on rows of nodes as forces on more columns that do the same work: ``restricted``, transposed.

    Parameters
    ----------
    forces : ndarray, shape (..., fewer columns)
    columns : int
    """
    spectrum = fft.rfft(forces, axis=-1)
    spectrum[..., -1] = 0.0
    return fft.irfft(spectrum, columns, axis=-1)


def refined(field: Real, columns: int) -> Real:
    """Return rows of a field on more columns, by their harmonics; itself where it has them.

    Parameters
    ----------
    field : ndarray, shape (..., fewer columns)
    columns : int
    """
    share = columns // field.shape[-1]
    return field if share == 1 else fft.irfft(share * fft.rfft(field, axis=-1), columns, axis=-1)


def even_cells(layers: Sequence[Layer], field: Real) -> Real:
    """Return a field of the points on all columns of all rows of cells.

    Parameters
    ----------
    layers : sequence of Layer
    field : ndarray, shape (..., stored rows, columns)
    """
    return field if len(layers) == 1 else _stacked(field, (layer.of(field) for layer in layers))


def even_nodes(layers: Sequence[Layer], field: Real) -> Real:
    """Return a field of the nodes on all columns of all rows of nodes.

    Parameters
    ----------
    layers : sequence of Layer
    field : ndarray, shape (..., stored rows + 1, columns)
    """
    if len(layers) == 1:
        return field
    return _stacked(field, (field[..., :1, :], *(layer.nodes_of(field) for layer in layers)))


def _stacked(field: Real, parts: Iterable[Real]) -> Real:
    return np.concatenate([refined(part, field.shape[-1]) for part in parts], axis=-2)


def node_harmonics(layers: Sequence[Layer], forces: Real) -> Complex:
    """Return the transform along the road of forces on the nodes, zero where a layer does not resolve it.

    Parameters
    ----------
    layers : sequence of Layer
    forces : ndarray, shape (2, stored rows + 1, columns)

    Returns
    -------
    ndarray of complex, shape (2, rows + 1, columns // 2 + 1)
    """
    if len(layers) == 1:
        return fft.rfft(forces, axis=-1)
    road = fft.rfft(forces[:, 0], axis=-1)
    spectrum = np.zeros((2, layers[-1].rows.stop + 1, layers[0].harmonics), dtype=road.dtype)
    spectrum[:, 0] = road
    for layer in layers:
        rows = slice(layer.rows.start + 1, layer.rows.stop + 1)
        spectrum[:, rows, : layer.harmonics] = fft.rfft(layer.nodes_of(forces), axis=-1)
    return spectrum


def node_fields(layers: Sequence[Layer], spectrum: Complex) -> Real:
    """Return displacements of the nodes from their transform on all columns.

    Parameters
    ----------
    layers : sequence of Layer
    spectrum : ndarray of complex, shape (2, rows + 1, columns // 2 + 1)

    Returns
    -------
    ndarray, shape (2, stored rows + 1, columns)
    """
    columns = layers[0].columns
    if len(layers) == 1:
        return fft.irfft(spectrum, columns, axis=-1)
    road = fft.irfft(spectrum[:, 0], columns, axis=-1)
    nodes = np.empty((2, layers[-1].stored.stop + 1, columns), dtype=road.dtype)
    nodes[:, 0] = road
    for layer in layers:
        rows = slice(layer.rows.start + 1, layer.rows.stop + 1)
        found = fft.irfft(spectrum[:, rows, : layer.harmonics], layer.columns, axis=-1)
        layer.nodes_of(nodes)[:] = found / layer.share
    return nodes
