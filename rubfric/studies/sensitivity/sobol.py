"""Sobol' indices: the share of the variance of friction that each parameter makes alone, and together with others.

All parameters vary at once, evenly within a range (Saltelli's estimators, of SciPy). Scenes are solved on the coarse
mesh of the derivatives: shares need no more.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from typing import Any, NamedTuple

import numpy as np
import pandas as pd
from numpy.typing import NDArray
from scipy.stats import sobol_indices, uniform

from rubfric.errors import InvalidInput, NotConverged
from rubfric.scene.scene import Scene
from rubfric.studies.sensitivity.differences import Base, Difference, logarithm
from rubfric.studies.sensitivity.parameters import Parameter
from rubfric.studies.sensitivity.sharing import shared

Array = NDArray[np.float64]

# Resamples of the bootstrap, and the probability of its intervals, per cent, either side.
_RESAMPLES, _TAILS = 999, (2.5, 97.5)
# Scenes that are solved at a time.
_BATCH = 32
# Largest share of the scenes that the derivatives may stand in for.
_MOST_REFUSED = 0.02


class Batch(NamedTuple):
    """Scenes to be solved in another process.

    Attributes
    ----------
    base : Base
    chosen : tuple of Parameter
    points : ndarray, shape (scenes, parameters)
        Their coordinates.
    """

    base: Base
    chosen: tuple[Parameter, ...]
    points: Array


def solve_batch(batch: Batch) -> list[float]:
    """Return the friction of every scene of a batch, on the coarse mesh; NaN where it has none."""
    found = []
    for point in batch.points:
        try:
            scene = together(batch.base.scene, batch.chosen, point)
            found.append(math.exp(logarithm(batch.base.near(scene, fine=False))))
        except (InvalidInput, NotConverged):
            found.append(math.nan)
    return found


def indices(
    base: Base,
    chosen: Sequence[Parameter],
    derivatives: Sequence[Difference],
    change: float,
    count: int,
    seed: int = 1,
    progress: Callable[[str], None] = lambda line: None,
    jobs: int | None = None,
) -> tuple[pd.DataFrame, list[str]]:
    """Return the indices of first and total order with 95 % intervals, and what is to be said of them.

    Parameters
    ----------
    base : Base
    chosen : sequence of Parameter
    derivatives : sequence of Difference
        Along each of them; they stand in for a few scenes without a solution.
    change : float
        Half the range of every parameter, relative.
    count : int
        N, a power of 2: N (parameters + 2) scenes are solved.
    seed : int
    progress : callable, optional
        Takes a line from time to time.
    jobs : int, optional
        Most processes to share long work among; as many as there are cores by default.

    Raises
    ------
    InvalidInput
        Where too many scenes are refused.
    """
    total, refused = count * (len(chosen) + 2), 0
    slopes = np.array([one.derivative for one in derivatives])
    own = logarithm(base.coarse)
    solved: list[Array] = []

    def friction(points: Array) -> Array:
        nonlocal refused
        steps = np.log1p(points).T
        starts = range(0, len(steps), _BATCH)
        batches = [Batch(base, tuple(chosen), steps[start : start + _BATCH]) for start in starts]
        found, done = np.empty(len(steps)), sum(map(len, solved))
        for place, values in shared(solve_batch, batches, jobs, ["Sobol' indices"] * len(batches)):
            found[starts[place] :][: len(values)] = values
            done += len(values)
            progress(f"Sobol' indices: solved {done} of {total}")
        lost = np.isnan(found)
        refused += int(lost.sum())
        if refused > max(1.0, _MOST_REFUSED * total):
            raise InvalidInput(
                f"{refused} of {total} scenes have no solution within {change:.0%} of their parameters: give a smaller "
                "--range, or --only some of the parameters"
            )
        found[lost] = np.exp(own + steps[lost] @ slopes)
        solved.append(found)
        return found

    spread = [uniform(-change, 2.0 * change)] * len(chosen)
    result = sobol_indices(func=friction, n=count, dists=spread, rng=np.random.default_rng(seed))
    low, high = _intervals(solved, count, seed)
    table = pd.DataFrame({"parameter": [one.name for one in chosen]})
    for row, name in enumerate(("first_order", "total_order")):
        table[name] = getattr(result, name)
        table[f"{name}_low"], table[f"{name}_high"] = low[row], high[row]
    notes = [f"the derivatives stand in for {refused} of {total} scenes, which have no solution"] if refused else []
    return table.sort_values("total_order", ascending=False, ignore_index=True), notes


def together(scene: Scene, chosen: Sequence[Parameter], point: Sequence[float] | Array) -> Scene:
    """Return a scene in which several parameters are changed, one after the other.

    Parameters
    ----------
    scene : Scene
    chosen : sequence of Parameter
        Of that scene.
    point : sequence of float
        A coordinate for each.
    """
    for one, coordinate in zip(chosen, point, strict=True):
        scene = one.change(scene, float(coordinate))
    return scene


def _intervals(solved: Sequence[Array], count: int, seed: int) -> tuple[Array, Array]:
    """Return the ends of the bootstrap's intervals, shape (2, parameters): first and total order.

    SciPy's own bootstrap of its indices takes no seed.
    """
    first, second, mixed = solved
    parts: dict[str, Any] = {"f_A": first[None], "f_B": second[None]}
    crossed = np.moveaxis(mixed.reshape(1, count, -1), -1, 0)
    rng = np.random.default_rng(seed)
    drawn = []
    for _ in range(_RESAMPLES):
        places = rng.integers(count, size=count)
        sample = {name: part[:, places] for name, part in parts.items()} | {"f_AB": crossed[..., places]}
        one = sobol_indices(func=sample, n=count)
        drawn.append((one.first_order, one.total_order))
    low, high = np.percentile(drawn, _TAILS, axis=0)
    return low, high
