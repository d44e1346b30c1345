"""What a solved scene dissipates and stores, however it was solved: three routes to one friction coefficient."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from rubfric.arrays import Real
from rubfric.road.road import finest_waves
from rubfric.scene.scene import Scene

# Friction below this is the difference of forces that cancel, and round-off.
ROUND_OFF = 1e-11
# Routes to one number that differ by more than the first are no number; nor, if it is larger than the second, by more
# than so many times the accuracy asked for.
MOST_CLOSURE, _LEAST_CLOSURE, _ACCURACIES = 0.25, 0.05, 5.0
# The output columns of a road are asked for as those of so many of its finest waves; most nodes of the output.
_WAVES, _MOST_NODES = 4, 100_000


def disagreement(routes: tuple[float, ...], resolution: float) -> float:
    """Return the largest difference between routes to one number over the largest of them, or over ``resolution``.

    Parameters
    ----------
    routes : tuple of float
    resolution : float
        What cannot be told from zero.
    """
    return (max(routes) - min(routes)) / max(*(abs(route) for route in routes), resolution)


def most_closure(accuracy: float) -> float:
    """Return how far routes to friction may differ where it is asked for with some accuracy: 5 % for 1 %."""
    return min(MOST_CLOSURE, max(_LEAST_CLOSURE, _ACCURACIES * accuracy))


@dataclass(frozen=True)
class Energies:
    """What a scene dissipates and stores.

    Attributes
    ----------
    stress_power, dissipation, contact : float
        Friction coefficient by each of the three routes, dimensionless.
    depth_profile : ndarray, shape (rows + 1,)
        Mean over a wavelength of the stored strain-energy density, MPa (= N mm/mm³), at the rows of nodes.
    density : ndarray, shape (rows + 1, m)
        Stored strain-energy density at the nodes of m evenly spread columns, MPa.
    displacement : ndarray, shape (rows + 1, 2, m)
        Displacement of those nodes, mm.
    resolution : float
        Friction that the solver cannot tell from zero: in small strain round-off, in finite strain its tolerance.
    """

    stress_power: float
    dissipation: float
    contact: float
    depth_profile: Real
    density: Real
    displacement: Real
    resolution: float = ROUND_OFF

    @property
    def closure(self) -> float:
        """Largest difference between two routes over the largest of them, or over ``resolution`` if that is larger."""
        return disagreement((self.stress_power, self.dissipation, self.contact), self.resolution)


def rows_to_nodes(heights: Real, cells: Real) -> Real:
    """Average a quantity of the rows of cells to the rows of nodes, by area.

    Parameters
    ----------
    heights : ndarray, shape (rows,)
        mm.
    cells : ndarray, shape (rows,)
    """
    total, area = np.zeros(len(heights) + 1), np.zeros(len(heights) + 1)
    for part in (slice(None, -1), slice(1, None)):
        total[part] += heights * cells
        area[part] += heights
    return total / area


def output_stride(scene: Scene, columns: int, rows: int) -> int:
    """Return the least stride that leaves few enough columns, the crest, the trough and the flanks among them.

    ``numerics.output_columns`` are kept for every four of the finest wave, up to so many that a file takes some three
    megabytes.

    Parameters
    ----------
    scene : Scene
    columns, rows : int
        Of nodes of the mesh that was solved.
    """
    waves = finest_waves(scene.road)
    most = scene.numerics.output_columns
    if waves > _WAVES:
        most = max(most, min(most * waves // _WAVES, _MOST_NODES // rows))
    quarter = columns // 4
    return next(stride for stride in range(1, quarter + 1) if quarter % stride == 0 and columns // stride <= most)
