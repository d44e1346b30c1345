"""The deformed block as a mesh with a field, repeated along the road."""

from __future__ import annotations

import json
import math
from dataclasses import dataclass

import numpy as np
import xarray as xr
from numpy.typing import NDArray

from rubfric.errors import InvalidInput
from rubfric.road.waves import WaveRoad

Array = NDArray[np.float64]

# What ``deform`` needs of a result.
VARIABLES = (
    "mesh_node_x",
    "mesh_node_y",
    "displacement_x",
    "displacement_y",
    "strain_energy_density",
    "finite_strain",
)
_FIELDS = VARIABLES[:-1]
# Width of the squares of the net over that of the block.
_PITCH = 0.125
# The width of the magnified part of a road in coarsest wavelengths; of a measured one in finest.
_SPOT, _FINEST = 0.75, 10.0


@dataclass(frozen=True)
class DeformedBlock:
    """Copies of the block side by side, without a seam.

    Attributes
    ----------
    x, y : numpy.ndarray, shape (rows, columns)
        Where the nodes are, mm, from the lower face upwards and from left to right.
    density : numpy.ndarray, shape (rows, columns)
        Strain-energy density at the nodes, MPa.
    net : tuple of numpy.ndarray
        Abscissae and heights, mm, shape (2, points), of lines that form a square net in the undeformed block; none
        in small strain, where the picture leaves out part of the deformation.
    """

    x: Array
    y: Array
    density: Array
    net: tuple[Array, ...]

    @property
    def lower_face(self) -> Array:
        """Abscissae and heights of the lower face, mm, shape (2, columns)."""
        return np.stack((self.x[0], self.y[0]))

    @property
    def upper_face(self) -> Array:
        """Abscissae and heights of the upper face, mm, shape (2, columns)."""
        return np.stack((self.x[-1], self.y[-1]))


def wavelength(result: xr.Dataset) -> float:
    """Return the width of the block, in mm."""
    x = result["mesh_node_x"].values
    return float(x.max() - x.min())


def is_finite(result: xr.Dataset) -> bool:
    """Return whether a scene was solved in finite strain."""
    return bool(result["finite_strain"])


def profile(result: xr.Dataset) -> WaveRoad:
    """Return the road of a scene on a whole road, of a refused one too."""
    return WaveRoad(**json.loads(result.attrs["scene_parameters"])["road"])


def spot_width(road: WaveRoad, windows: bool) -> float:
    """Return the width of the part of a whole road that is magnified, mm.

    Parameters
    ----------
    road : WaveRoad
    windows : bool
        Whether it is a window of a measured profile, whose coarsest wave is as long as the window: then it holds the
        finest waves some times; else three quarters of the coarsest.
    """
    if not windows:
        return _SPOT * road.wavelength
    return min(_FINEST * 2.0 * math.pi / max(road.wavenumbers), 0.25 * road.period)


def deform(result: xr.Dataset, left: float, right: float, pitch: float | None = None) -> DeformedBlock:
    """Return the deformed block between two abscissae.

    In finite strain every node is where its displacement takes it. In small strain the lower face is where the contact
    puts it, and above it every row of nodes keeps its mean distance from the lower face, whatever the load compresses
    the block by: small strain would turn a soft block under a high load inside out. Horizontal displacements are left
    out there too, since contact in small strain is between the road and the undeformed position above it; with them
    the flanks would seem to separate from the road by a few hundredths of a wavelength.

    Parameters
    ----------
    result : xarray.Dataset
        As built by ``rubfric.results.dataset.build``.
    left, right : float
        Abscissae that the copies must cover at every height, mm.
    pitch : float, optional
        Width of the squares of the net, mm; an eighth of the block's by default.
    """
    fields = _by_row_and_column(result)
    width, finite = wavelength(result), is_finite(result)
    x, y = _moved(fields, finite)
    copies = np.arange(math.floor((left - x.max()) / width) - 1, math.ceil((right - x.min()) / width) + 2)
    ahead = np.repeat(width * copies, x.shape[1])
    x, y, made = (np.tile(field, copies.size) for field in (x, y, fields["mesh_node_x"]))
    x, made = x + ahead, made + ahead
    seen = np.flatnonzero((x.max(axis=0) >= left) & (x.min(axis=0) <= right))
    window = np.s_[:, seen[0] - 1 : seen[-1] + 2]
    density = np.tile(fields["strain_energy_density"], copies.size)[window]
    x, y, across, up = x[window], y[window], made[window][0], fields["mesh_node_y"][:, 0]
    return DeformedBlock(x, y, density, _net(across, up, x, y, pitch or _PITCH * width) if finite else ())


def _by_row_and_column(result: xr.Dataset) -> dict[str, Array]:
    """Return the fields of the nodes by row and column, without the last column, which is the first one again."""
    x, y = result["mesh_node_x"].values, result["mesh_node_y"].values
    order = np.lexsort((x, y))
    columns = np.unique(x).size
    if columns < 3 or x.size % columns or not np.array_equal(x[order].reshape(-1, columns)[0], np.unique(x)):
        raise InvalidInput(f"the mesh of {x.size} nodes cannot be drawn, but must be made of rows and columns")
    return {name: result[name].values[order].reshape(-1, columns)[:, :-1] for name in _FIELDS}


def _moved(fields: dict[str, Array], finite: bool) -> tuple[Array, Array]:
    """Return where the nodes of one copy are drawn."""
    lift = fields["displacement_y"]
    if finite:
        return fields["mesh_node_x"] + fields["displacement_x"], fields["mesh_node_y"] + lift
    mean = lift.mean(axis=1, keepdims=True)
    return fields["mesh_node_x"], fields["mesh_node_y"] + lift - (mean - mean[0])


def _net(across: Array, up: Array, x: Array, y: Array, pitch: float) -> tuple[Array, ...]:
    """Return lines that were upright and level at multiples of a pitch before nodes at ``across``, ``up`` moved."""
    columns = pitch * np.arange(math.ceil(across[0] / pitch), math.floor(across[-1] / pitch) + 1)
    rows = pitch * np.arange(1, math.ceil(up[-1] / pitch - 1e-6))
    upright = zip(_between(across, x.T, columns), _between(across, y.T, columns), strict=True)
    level = zip(_between(up, x, rows), _between(up, y, rows), strict=True)
    return tuple(np.stack(line) for lines in (upright, level) for line in lines)


def _between(places: Array, field: Array, wanted: Array) -> Array:
    """Interpolate a field along its first axis."""
    above = np.clip(np.searchsorted(places, wanted), 1, places.size - 1)
    share = ((wanted - places[above - 1]) / (places[above] - places[above - 1]))[:, None]
    interpolated: Array = (1.0 - share) * field[above - 1] + share * field[above]
    return interpolated
