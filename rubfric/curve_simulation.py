"""Friction over speed at one pressure, on a scale or the whole road, with speeds added until it is known in between."""

from __future__ import annotations

import os
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, replace
from pathlib import Path
from tempfile import TemporaryDirectory

import numpy as np
import pandas as pd

from rubfric.checks import written
from rubfric.errors import InvalidInput, NotConverged
from rubfric.results.campaign import collect
from rubfric.results.curves import curve_of
from rubfric.results.dataset import write
from rubfric.results.draws import mean_road
from rubfric.results.kept import fits, path_of
from rubfric.results.limits import MOST
from rubfric.results.provenance import refusal
from rubfric.results.selection import NOT_NEEDED
from rubfric.results.tables import scale_table
from rubfric.results.totals import total_tables
from rubfric.results.whole_road import WholeRoad
from rubfric.scene.scene import Scene
from rubfric.simulation import simulate

# The folder of scalars alone, within that of what is kept.
_SCALARS = "scalars"
# Paths of results, and the digests that they must have.
Results = Mapping[str, str]


@dataclass(frozen=True)
class Sliding:
    """What is slid over at every speed of a curve.

    Attributes
    ----------
    scales : tuple of Scene
        At any speed: one scale; or all of them, for the whole road.
    whole : mapping of str to Scene
        The whole road by the name of the draw or window, as ``Campaign.whole_scenes`` has them.
    road : WholeRoad or None
        None for one scale.
    """

    scales: tuple[Scene, ...]
    whole: Mapping[str, Scene]
    road: WholeRoad | None

    def rows(self, scales: Results, whole: Mapping[str, Results]) -> pd.DataFrame:
        """Return friction at the speeds of some results, as the tables of scales or of the total have it.

        Parameters
        ----------
        scales : mapping
        whole : mapping
            By the name of the draw or window.
        """
        found, scene = collect(scales, scales.values()), self.scales[0]
        if self.road is None:
            return scale_table(found, int(scene.scale))
        roads = {draw: collect(paths, paths.values()) for draw, paths in whole.items()}
        return total_tables(found, mean_road(roads), {scene.temperature: self.road})

    def needed(self, speed: float) -> str:
        """Return by which way the whole road is found at a speed (mm/s): "direct" where its own scenes are solved."""
        road = self.road
        return road.cheapest(speed, self.scales[0].pressure) if road and road.way == "auto" else "direct"


def added_points(
    sliding: Sliding,
    scales: Results,
    whole: Mapping[str, Results],
    accuracy: float,
    kept: str | os.PathLike[str],
    progress: Callable[[str], None] = print,
) -> pd.DataFrame:
    """Return friction at the speeds that have to be added to those of the grid for a curve to be known between them.

    One speed after the other is added in the interval that is least known, until all are known to the accuracy, or as
    well as their ends, or ``MOST`` were added.

    Parameters
    ----------
    sliding : Sliding
    scales, whole : mapping
        The grid's results of the curve, as for ``Sliding.rows``.
    accuracy : float
        Relative, of interpolation.
    kept : path-like
        Folder in which results are kept, and looked for, as from ``rubfric.results.kept.opened``.
    progress : callable
        Takes a line for every speed that is added.

    Returns
    -------
    pandas.DataFrame
        Of the added speeds alone; without rows where there is none. A speed at which a scale has no solution is left
        out.
    """
    grid = sliding.rows(scales, whole)
    rows, refused = [grid], np.zeros(0)
    with TemporaryDirectory(prefix="rubfric-") as folder:
        for count in range(1, MOST + 1):
            curve = curve_of(pd.concat(rows))
            speed = curve.next_speed(accuracy, refused) if curve else None
            if curve is None or speed is None:
                break
            try:
                rows.append(sliding.rows(*_at(sliding, speed, Path(kept), Path(folder))))
            except (InvalidInput, NotConverged) as reason:
                refused = np.append(refused, speed)
                progress(f"{count}: {written(speed)} mm/s has no friction: {reason}")
            else:
                progress(
                    f"{count}: {written(speed)} mm/s added, where friction may be off by {100.0 * curve.worst:.2g} %"
                )
    return pd.concat([grid.iloc[:0], *rows[1:]], ignore_index=True)


def _at(sliding: Sliding, speed: float, kept: Path, folder: Path) -> tuple[Results, dict[str, Results]]:
    """Return the results at one speed (mm/s), those that are kept, and others, which are solved."""
    scales = [replace(scene, velocity=speed) for scene in sliding.scales]
    whole = {draw: replace(scene, velocity=speed) for draw, scene in sliding.whole.items()}
    way = sliding.needed(speed) if whole else "direct"
    found: dict[str, Results] = {}
    for draw, scene in whole.items():
        if way == "direct":
            found[draw] = {_solved(scene, kept, refusable=True): scene.digest}
        else:  # which does not depend on the scene alone, and is not kept
            path = str(folder / f"{scene.digest}.nc")
            write(refusal(scene, NOT_NEEDED + way), path)
            found[draw] = {path: scene.digest}
    return {_solved(scene, kept): scene.digest for scene in scales}, found


def _solved(scene: Scene, kept: Path, refusable: bool = False) -> str:
    """Return the path of the scalars of a scene, which is solved unless they are kept.

    Parameters
    ----------
    scene : Scene
    kept : Path
        As for ``added_points``.
    refusable : bool
        Whether a scene that is refused has a result that says why.
    """
    whole, path = path_of(kept, scene), kept / _SCALARS / f"{scene.digest}.nc"
    if fits(whole, scene):
        return str(whole)
    if not fits(path, scene):
        try:
            result = simulate(scene)
        except (InvalidInput, NotConverged) as reason:
            if not refusable:
                raise
            result = refusal(scene, reason)
        write(result[[name for name, variable in result.variables.items() if not variable.dims]], path)
    return str(path)


def sliding_of(scales: Sequence[Mapping], whole: Mapping[str, Mapping], road: Mapping | None) -> Sliding:  # type: ignore[type-arg]
    """Return what is slid over, from plain values.

    Parameters
    ----------
    scales, whole
        Parameters of the scenes of ``Sliding``.
    road : mapping or None
        Those of ``WholeRoad``.
    """
    return Sliding(
        tuple(Scene.from_parameters(dict(one)) for one in scales),
        {draw: Scene.from_parameters(dict(one)) for draw, one in whole.items()},
        WholeRoad.from_parameters(road) if road else None,
    )
