"""The friction of the whole road at given speeds and pressures, without the workflow and by the same functions."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import replace
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import NamedTuple

import netCDF4
import pandas as pd

import rubfric
from rubfric.checksums import check_seal
from rubfric.config.campaign import Campaign
from rubfric.config.temperature import rubber_at
from rubfric.errors import BrokenResult, InvalidInput, NotConverged
from rubfric.results.campaign import collect
from rubfric.results.dataset import write
from rubfric.results.draws import over_draws
from rubfric.results.provenance import refusal
from rubfric.results.selection import NOT_NEEDED, REFUSAL
from rubfric.results.totals import total_tables
from rubfric.results.whole_road import WholeRoad
from rubfric.rules import LARGEST, Items, Number
from rubfric.scene.scene import Scene
from rubfric.simulation import simulate

_SCENES, _WHOLE = "scenes", "whole"


class _Job(NamedTuple):
    """A scene: the folder of its result within those of a campaign, its name there, and itself."""

    folder: str
    name: str
    scene: Scene


def friction(
    campaign: Campaign,
    velocities: Sequence[float] | None = None,
    pressures: Sequence[float] | None = None,
    temperatures: Sequence[float] | None = None,
    progress: Callable[[str], None] | None = None,
) -> pd.DataFrame:
    """Return the friction of the whole road with its errors, that of every scale, and the way that counts.

    It is the table that the workflow writes to ``tables/friction_total.csv``. Results in the campaign's folder are used
    where they are of the same scenes and of this version; the others are solved here, one by one, and not kept.

    Parameters
    ----------
    campaign : Campaign
        As from ``rubfric.load``.
    velocities : sequence of float, optional
        mm/s; by default the grid's, as for the following.
    pressures : sequence of float, optional
        Nominal, MPa.
    temperatures : sequence of float, optional
        degC, of a rubber with shift factors.
    progress : callable, optional
        Takes a line for every scene that is solved.

    Returns
    -------
    pandas.DataFrame
        As from ``rubfric.results.totals.total_tables``.

    Raises
    ------
    InvalidInput
        For points that the rubber or the model has not.
    NotConverged
        For a scale without a solution; where the whole road has none, a cheaper way stands in for it.

    Examples
    --------
    >>> import rubfric
    >>> table = rubfric.friction(rubfric.load({"multiscale": "sum", "kinematics": "small"}), [100], [0.5])
    >>> print(f"{table['friction_total'][0]:.2f}")
    0.65
    """
    asked = at_points(campaign, velocities, pressures, temperatures)
    roads = {warm: WholeRoad.from_parameters(one.whole_parameters()) for warm, one in asked.by_temperature.items()}
    jobs = [_Job(_SCENES, name, scene) for name, scene in asked.scenes().items()]
    jobs += [_Job(_WHOLE, name, scene) for name, scene in asked.whole_scenes().items()]
    with TemporaryDirectory(prefix="rubfric-") as folder:
        paths = _results(asked, jobs, roads, Path(folder), progress or (lambda line: None))
        digests = {paths[job]: job.scene.digest for job in jobs if job.folder == _SCENES}
        collected = collect(digests, digests.values())
        whole = {}
        for draw in asked.whole_roads:
            own = {
                paths[job]: job.scene.digest
                for job in jobs
                if job.folder == _WHOLE and job.name == draw + job.scene.name
            }
            whole[draw] = collect(own, own.values())
    mean = whole[""] if "" in whole else over_draws([*whole.values()], "window1/" in whole) if whole else None
    return total_tables(collected, mean, roads)


def at_points(
    campaign: Campaign,
    velocities: Sequence[float] | None = None,
    pressures: Sequence[float] | None = None,
    temperatures: Sequence[float] | None = None,
) -> Campaign:
    """Return a campaign of the same rubber and road on another grid, without its other studies.

    Parameters
    ----------
    campaign : Campaign
    velocities, pressures, temperatures : sequence of float, optional
        mm/s, MPa and degC, in any order; by default the grid's.
    """
    warm = campaign.temperatures
    if temperatures is not None:
        warm = Items(each=Number(unit="degC", low=-LARGEST)).check("temperatures", [*temperatures])
        for one in warm:
            rubber_at(campaign.material, campaign.shift, one)  # refuses one that the rubber has not
    return replace(
        campaign,
        velocities=campaign.velocities if velocities is None else _positive("velocities", "mm/s", velocities),
        pressures=campaign.pressures if pressures is None else _positive("pressures", "MPa", pressures),
        temperatures=warm,
        aspect_study=None,
        transient=None,
        rig=None,
        claims=None,
        others=(),
    )


def _positive(name: str, unit: str, values: Sequence[float]) -> tuple[float, ...]:
    return Items(each=Number(unit=unit)).check(name, [*values])


def _results(
    campaign: Campaign,
    jobs: Sequence[_Job],
    roads: Mapping[float | None, WholeRoad],
    folder: Path,
    progress: Callable[[str], None],
) -> dict[_Job, str]:
    """Return the paths of the results of all scenes: those that the workflow made, and others, made in a folder."""
    paths, missing = {}, []
    for place, job in enumerate(jobs):
        road = roads[job.scene.temperature if campaign.temperatures else None] if job.folder == _WHOLE else None
        # As in the workflow: only where any way will do is the whole road not needed everywhere.
        way = road.cheapest(job.scene.velocity, job.scene.pressure) if road and road.way == "auto" else "direct"
        own = str(folder / f"{place}.nc")
        kept = Path(campaign.results, job.folder, campaign.material.name, campaign.road_name, f"{job.name}.nc")
        if way != "direct":
            write(refusal(job.scene, NOT_NEEDED + way), own)
        elif _is_of(kept, job.scene):
            own = str(kept)
        else:
            missing.append(job)
        paths[job] = own
    for count, job in enumerate(missing, 1):
        progress(f"solving {count} of {len(missing)}: {job.name}")
        try:
            result = simulate(job.scene)
        except (InvalidInput, NotConverged) as reason:
            if job.folder != _WHOLE:
                raise
            result = refusal(job.scene, reason)
        write(result, paths[job])
    return paths


def _is_of(path: Path, scene: Scene) -> bool:
    """Return whether a file is a whole result of a scene by this version."""
    if not path.is_file():
        return False
    try:
        check_seal(path)
        with netCDF4.Dataset(path) as stored:
            known = [str(stored.getncattr(name)) for name in ("scene_digest", "source")]
            refused = str(stored.getncattr(REFUSAL)) if REFUSAL in stored.ncattrs() else ""
    except (BrokenResult, OSError, AttributeError):
        return False
    return known == [scene.digest, f"rubfric {rubfric.__version__}"] and not refused.startswith(NOT_NEEDED)
