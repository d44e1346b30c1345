"""How finely a scene is meshed: columns along the road and growth of the rows, and coarser and finer of their kind."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from scipy.fft import next_fast_len

from rubfric.arrays import Flags
from rubfric.mechanics.block.block import Block
from rubfric.road.road import finest_waves
from rubfric.scene.scene import COLUMNS_PER_HEIGHT, Scene

# A mesh is a multiple of this many columns, so that the crest, the trough and both flanks fall on nodes.
COLUMN_STEP = 8
# Most columns, and cells, of a mesh in finite strain; most cells in small strain. Roads of very many waves may have
# more columns, so many times the fewest that the finest of them needs.
MOST_FINITE, MOST_CELLS, MOST_SMALL_CELLS = 4096, 450_000, 20_000_000
_TIMES_FEWEST = 2
# On many waves the spots of contact are many and small, and deep rows cost little.
MOST_FINITE_MANY, MOST_CELLS_MANY = 8192, 750_000
# Growth of rows below which they count as even.
_LEAST_GROWTH = 1.00001
# So many spots of contact together are resolved as finely as one alone.
_SPOTS = 3
# Fewest columns for the finest of many waves, in small and in finite strain.
_PER_WAVE, _PER_WAVE_FINITE = 16, 24
# A coarse mesh has no fewer columns, and its rows grow no faster.
_COARSEST_COLUMNS, _COARSEST_GROWTH = 32, 2.0


@dataclass(frozen=True)
class Resolution:
    """A mesh of the family that a scene may be solved on.

    Attributes
    ----------
    columns : int
        Columns of cells along a period of the road.
    growth : float
        Ratio of the heights of neighbouring rows.
    """

    columns: int
    growth: float

    def block(self, scene: Scene) -> Block:
        """Mesh the block of a scene."""
        numerics = scene.numerics
        return Block.graded(
            scene.road.period,
            scene.height,
            self.columns,
            scene.plane,
            self.growth,
            numerics.first_row,
            numerics.dilatation,
        )

    def affordable(self, scene: Scene, finite: bool) -> bool:
        """Return whether so fine a mesh may be solved.

        Parameters
        ----------
        scene : Scene
        finite : bool
            In finite strain.
        """
        return self.columns * self.block(scene).rows <= most_cells(scene, finite)

    def finer(self, scene: Scene, factor: float, finite: bool) -> Resolution:
        """Return the mesh with cells smaller by ``factor`` in both directions.

        Parameters
        ----------
        scene : Scene
        factor : float
            Above 1.
        finite : bool
            In finite strain.
        """
        growth = max(1.0 + (self.growth - 1.0) / factor, _LEAST_GROWTH)
        return Resolution(fit(scene, self.columns * factor, finite), growth)

    def coarser(self, scene: Scene, finite: bool) -> Resolution:
        """Return the mesh with cells about twice as large in both directions.

        Parameters
        ----------
        scene : Scene
        finite : bool
            In finite strain.
        """
        least = max(_COARSEST_COLUMNS, 0.5 * _fewest_columns(scene, finite))
        growth = min(1.0 + 2.0 * (self.growth - 1.0), _COARSEST_GROWTH)
        return Resolution(min(fit(scene, max(0.5 * self.columns, least), finite), self.columns), growth)

    def halfway(self, other: Resolution, scene: Scene, finite: bool) -> Resolution | None:
        """Return a mesh between this one and another, or None where there is none.

        Parameters
        ----------
        other : Resolution
        scene : Scene
        finite : bool
            In finite strain.
        """
        growth = 1.0 + math.sqrt((self.growth - 1.0) * (other.growth - 1.0))
        between = Resolution(fit(scene, math.sqrt(self.columns * other.columns), finite), growth)
        meshes = [(one.columns, one.block(scene).rows) for one in (self, between, other)]
        return between if len(set(meshes)) == len(meshes) else None


def needed(scene: Scene, fraction: float, finite: bool, spots: int = 1) -> Resolution:
    """Return the mesh that puts as many nodes as asked for into a contact of some fraction of the road.

    Parameters
    ----------
    scene : Scene
    fraction : float
        Contact area over nominal area.
    finite : bool
        In finite strain.
    spots : int
        Separate places of contact.
    """
    numerics = scene.numerics
    least = numerics.finite_columns_min if finite else numerics.columns_min
    columns = max(least, wanted_nodes(scene, finite, spots) / fraction, _fewest_columns(scene, finite))
    return Resolution(fit(scene, columns, finite), numerics.row_growth)


def wanted_nodes(scene: Scene, finite: bool, spots: int = 1) -> float:
    """Return how many surface nodes the contact should have; where there are many spots, their errors average out.

    Parameters
    ----------
    scene : Scene
    finite : bool
        In finite strain.
    spots : int
        Separate places of contact.
    """
    nodes = scene.numerics.finite_contact_nodes if finite else scene.numerics.contact_nodes
    return nodes * max(1.0, spots / _SPOTS)


def count_spots(scene: Scene, touching: Flags) -> int:
    """Return in how many separate places a road is touched: on one wave in one.

    Parameters
    ----------
    scene : Scene
    touching : ndarray of bool, shape (columns,)
        Surface nodes in contact.
    """
    if finest_waves(scene.road) == 1:
        return 1
    return max(1, int(np.count_nonzero(touching & ~np.roll(touching, 1))))


def _fewest_columns(scene: Scene, finite: bool) -> float:
    """Return the fewest columns that a block's shape and the finest of its road's waves ask for."""
    road, waves = scene.road, finest_waves(scene.road)
    by_shape = COLUMNS_PER_HEIGHT / scene.aspect * (road.period / road.wavelength)
    return max(by_shape, (_PER_WAVE_FINITE if finite else _PER_WAVE) * waves if waves > 1 else 0.0)


def fit(scene: Scene, columns: float, finite: bool) -> int:
    """Return about so many columns, fit for the mesh and for its transform, and no more than there may be.

    Parameters
    ----------
    scene : Scene
    columns : float
        As many as are wanted.
    finite : bool
        In finite strain.
    """
    steps = int(next_fast_len(math.ceil(columns / COLUMN_STEP), real=True))
    return min(COLUMN_STEP * steps, most_columns(scene, finite))


def most_columns(scene: Scene, finite: bool) -> int:
    """Return the most columns that a mesh may have.

    Parameters
    ----------
    scene : Scene
    finite : bool
        In finite strain.
    """
    most = scene.numerics.columns_max
    if not finite:
        return most
    waves = finest_waves(scene.road)
    return min(most, max(MOST_FINITE_MANY if waves > 1 else MOST_FINITE, _TIMES_FEWEST * _PER_WAVE_FINITE * waves))


def most_cells(scene: Scene, finite: bool) -> int:
    """Return the most cells that a mesh may have.

    Parameters
    ----------
    scene : Scene
    finite : bool
        In finite strain.
    """
    if not finite:
        return MOST_SMALL_CELLS
    return MOST_CELLS_MANY if finest_waves(scene.road) > 1 else MOST_CELLS
