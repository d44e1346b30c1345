"""The deformed block as an image of a field, repeated along the road."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
import xarray as xr
from numpy.typing import NDArray

from rubfric.errors import InvalidInput

Array = NDArray[np.float64]


@dataclass(frozen=True)
class DeformedBlock:
    """Copies of the block side by side.

    Attributes
    ----------
    density : numpy.ndarray
        Strain-energy density, MPa, at equidistant heights (rows, upwards) and abscissae (columns).
    extent : tuple of float
        Left, right, lower and upper edge of that image, mm.
    outline : numpy.ndarray
        Corners of the block, mm, from left to right along the lower face and back along the upper face.
    lower_face : numpy.ndarray
        Abscissae and heights of the lower face, mm, from left to right.
    """

    density: Array
    extent: tuple[float, float, float, float]
    outline: Array
    lower_face: Array


def wavelength(result: xr.Dataset) -> float:
    """Return the width of the block, in mm."""
    x = result["mesh_node_x"].values
    return float(x.max() - x.min())


def deform(result: xr.Dataset, left: float, right: float, heights: Array) -> DeformedBlock:
    """Return the block deformed in height between two abscissae, without its mean compression.

    The lower face is where the contact has it. Above it every row of nodes keeps its distance from the lower face in
    the mean, whatever the load compresses the block by: small strain would turn a soft block under a high load inside
    out. Horizontal displacements are left out, for contact at small strain is between the road and what was above it
    before; with them a few hundredths of a wavelength of the flanks would seem to part from the road.

    Parameters
    ----------
    result : xarray.Dataset
        As built by ``rubfric.dataset.build``.
    left, right : float
        Abscissae that the copies must cover, mm.
    heights : numpy.ndarray
        Equidistant heights above the road's mean plane at which the field is wanted, mm.
    """
    x, y, density = _columns(result)
    width, step = wavelength(result), float(x[1] - x[0])
    first = math.floor((left - float(x[0])) / width)
    copies = np.arange(first, math.ceil((right - float(x[0])) / width))
    image = np.stack([np.interp(heights, column, field) for column, field in zip(y.T, density.T, strict=True)], axis=1)
    # A node stands in the middle of its pixel.
    start, rise = float(x[0]) + first * width - 0.5 * step, 0.5 * float(heights[1] - heights[0])
    abscissae = (x + width * copies[:, None]).ravel()
    lower, upper = (np.stack((abscissae, np.tile(face, copies.size))) for face in (y[0], y[-1]))
    return DeformedBlock(
        density=np.tile(image, copies.size),
        extent=(start, start + width * copies.size, float(heights[0]) - rise, float(heights[-1]) + rise),
        outline=np.concatenate((lower, upper[:, ::-1]), axis=1).T,
        lower_face=lower,
    )


def _columns(result: xr.Dataset) -> tuple[Array, Array, Array]:
    """Return the columns' abscissae, and the heights and the density of the nodes by row and column.

    The last column of the mesh, which is the first one again, is left out.
    """
    x, y = result["mesh_node_x"].values, result["mesh_node_y"].values
    order = np.lexsort((x, y))
    columns = np.unique(x).size
    if columns < 3 or x.size % columns or not np.array_equal(x[order].reshape(-1, columns)[0], np.unique(x)):
        raise InvalidInput(f"the mesh of {x.size} nodes cannot be drawn, but must be made of rows and columns")
    rows = {
        name: result[name].values[order].reshape(-1, columns)[:, :-1]
        for name in ("mesh_node_y", "displacement_y", "strain_energy_density")
    }
    moved = rows["displacement_y"]
    mean = moved.mean(axis=1, keepdims=True)
    height = rows["mesh_node_y"] + moved - (mean - mean[0])
    return np.unique(x)[:-1], height, rows["strain_energy_density"]
