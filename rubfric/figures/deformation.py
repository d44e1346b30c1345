"""The deformed block as triangles, repeated along the road."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
import xarray as xr
from numpy.typing import NDArray

Array = NDArray[np.float64]


@dataclass(frozen=True)
class DeformedBlock:
    """Triangles of the block over a window.

    Attributes
    ----------
    x, y : numpy.ndarray
        Places of the nodes, mm; ``y`` is above the mean plane of the road.
    energy : numpy.ndarray
        Strain-energy density at the nodes, MPa.
    triangles : numpy.ndarray
        Three nodes each.
    lower_x, lower_y : numpy.ndarray
        Places of the lower face from left to right, mm.
    """

    x: Array
    y: Array
    energy: Array
    triangles: NDArray[np.int64]
    lower_x: Array
    lower_y: Array


def wavelength(result: xr.Dataset) -> float:
    """Return the width of the block, in mm."""
    x = result["mesh_node_x"].values
    return float(x.max() - x.min())


def deform(result: xr.Dataset, left: float, right: float, top: float) -> DeformedBlock:
    """Return the block deformed in height between two abscissae, up to a height at least, without its mean compression.

    The lower face is where the contact has it. Above it every row of nodes keeps its distance from the lower face in
    the mean, whatever the load compresses the block by: small strain would turn a soft block under a high load inside
    out. Horizontal displacements are left out, for contact at small strain is between the road and what was above it
    before; with them a few hundredths of a wavelength of the flanks would seem to part from the road.

    Parameters
    ----------
    result : xarray.Dataset
        As built by ``rubfric.dataset.build``.
    left, right : float
        Abscissae of the window, mm.
    top : float
        Height of the window's upper edge above the road's mean plane, mm.
    """
    x = result["mesh_node_x"].values
    y = result["mesh_node_y"].values + _relative_height(result)
    width = wavelength(result)
    copies = np.arange(math.ceil((left - float(x.max())) / width), math.floor((right - float(x.min())) / width) + 1)
    corners = result["mesh_face_nodes"].values.astype(np.int64)
    corners = corners[y[corners].min(axis=1) <= top]
    # Each quadrilateral makes two triangles, in every copy of the block.
    triangles = np.concatenate((corners[:, [0, 1, 2]], corners[:, [0, 2, 3]]))
    triangles = (triangles + x.size * np.arange(copies.size)[:, None, None]).reshape(-1, 3)
    repeated = (x + width * copies[:, None]).ravel()
    reach = repeated[triangles]
    lower = _lower_face(result)
    return DeformedBlock(
        x=repeated,
        y=np.tile(y, copies.size),
        energy=np.tile(result["strain_energy_density"].values, copies.size),
        triangles=triangles[(reach.max(axis=1) >= left) & (reach.min(axis=1) <= right)],
        lower_x=(x[lower] + width * copies[:, None]).ravel(),
        lower_y=np.tile(y[lower], copies.size),
    )


def _relative_height(result: xr.Dataset) -> Array:
    """Return the vertical displacement of the nodes less the mean of their row, plus that of the lowest row."""
    displacement = result["displacement_y"].values
    x = result["mesh_node_x"].values
    _, row = np.unique(result["mesh_node_y"].values, return_inverse=True)
    # The last column is the first one again.
    once = (x < x.max()).astype(np.float64)
    mean = np.bincount(row, displacement * once) / np.bincount(row, once)
    return np.asarray(displacement - (mean - mean[0])[row])


def _lower_face(result: xr.Dataset) -> NDArray[np.intp]:
    """Return the nodes of the lower face from left to right, the repeated one left out."""
    x, height = result["mesh_node_x"].values, result["mesh_node_y"].values
    lowest = np.flatnonzero((height == height.min()) & (x < x.max()))
    return np.asarray(lowest[np.argsort(x[lowest])])
