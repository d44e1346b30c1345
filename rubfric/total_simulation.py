"""The friction of the whole road at given speeds and pressures, without the workflow and by the same functions."""

from __future__ import annotations

import json
from collections.abc import Callable, Mapping, Sequence
from contextlib import suppress
from dataclasses import replace
from pathlib import Path

import numpy as np
import pandas as pd
import xarray as xr

import rubfric
from rubfric.checksums import fingerprint
from rubfric.config.campaign import Campaign
from rubfric.config.pairs import never_covered
from rubfric.config.temperature import rubber_at
from rubfric.errors import BrokenResult
from rubfric.results import answer, kept
from rubfric.results.campaign import COLLECTED, collect
from rubfric.results.dataset import load, write
from rubfric.results.draws import mean_road
from rubfric.results.provenance import CONVENTIONS, PAPER, SOFTWARE, SOLVER
from rubfric.results.temperature import MATERIALS
from rubfric.results.totals import total_tables
from rubfric.results.whole_road import WholeRoad
from rubfric.rules import LARGEST, Integer, Items, Number
from rubfric.scene.scene import Scene
from rubfric.scene_jobs import SCENES, WHOLE, Job, solve_all
from rubfric.sources import code
from rubfric.workers import cores

# What all scenes share, as JSON, and what stands for all of them.
_SHARED = ("material", MATERIALS, "numerics", COLLECTED)


def run(
    campaign: Campaign,
    velocities: float | Sequence[float] | None = None,
    pressures: float | Sequence[float] | None = None,
    temperatures: float | Sequence[float] | None = None,
    jobs: int | None = None,
    progress: bool | Callable[[str], None] = True,
) -> xr.Dataset:
    """Return the friction of the whole road with its errors, that of every scale, and the way that counts.

    Scenes are solved side by side. Results are kept in the folder ``.cache`` of the campaign's results, under digests
    of all that they depend on, code included: the next call, and one that was interrupted, begins with them, and with
    those of the workflow.

    Parameters
    ----------
    campaign : Campaign
        As from ``rubfric.load``.
    velocities : float or sequence of float, optional
        mm/s; by default the grid's, as for the following.
    pressures : float or sequence of float, optional
        Nominal, MPa.
    temperatures : float or sequence of float, optional
        degC, of a rubber with shift factors.
    jobs : int, optional
        How many scenes at a time; as many as there are cores by default.
    progress : bool or callable
        Whether a line on standard error says what is done and how long the rest may take; or what takes such a line
        after every scene.

    Returns
    -------
    xarray.Dataset
        As from ``rubfric.results.answer.dataset``: ``friction_total``, its errors, ``way`` and more over temperature
        (degC, where there is one), pressure (MPa) and velocity (mm/s); ``friction_scale`` and its error over scale too.

    Raises
    ------
    InvalidInput
        For points that the rubber or the model has not.
    NotConverged
        For a scale without a solution; where the whole road has none, a cheaper way stands in for it.

    Examples
    --------
    >>> import rubfric
    >>> campaign = rubfric.load({"multiscale": "sum", "kinematics": "small"})
    >>> result = rubfric.run(campaign, velocities=[100], pressures=[0.5], progress=False)
    >>> print(f"{result.friction_total.item():.2f} +- {result.friction_total_error.item():.2f}")
    0.65 +- 0.10
    """
    asked = at_points(campaign, velocities, pressures, temperatures)
    if jobs is not None:
        Integer().check("jobs", jobs)
    parameters = {warm: one.whole_parameters() for warm, one in asked.by_temperature.items()}
    scenes = {SCENES: asked.scenes(), WHOLE: asked.whole_scenes()}
    named = [f"{name} {scene.digest}" for of in scenes.values() for name, scene in of.items()]
    which = fingerprint([code(__name__), asked.words(), *named, json.dumps([*parameters.values()])])
    known = kept.place(asked.results) / f"{which}.nc"
    if known.is_file():
        with suppress(BrokenResult):
            return load(known)
    with kept.opened(known.parent) as folder:
        found = _solved(asked, parameters, scenes, folder, jobs or cores(), progress)
        write(found, folder / known.name)
    return found


def friction(
    campaign: Campaign,
    velocities: float | Sequence[float] | None = None,
    pressures: float | Sequence[float] | None = None,
    temperatures: float | Sequence[float] | None = None,
    jobs: int | None = None,
    progress: bool | Callable[[str], None] = False,
) -> pd.DataFrame:
    """Return what ``run`` does as the table that the workflow writes to ``tables/friction_total.csv``.

    Parameters
    ----------
    campaign, velocities, pressures, temperatures, jobs, progress
        As for ``run``.

    Returns
    -------
    pandas.DataFrame
        As from ``rubfric.results.totals.total_tables``.

    Raises
    ------
    InvalidInput, NotConverged
        As ``run`` does.

    Examples
    --------
    >>> import rubfric
    >>> table = rubfric.friction(rubfric.load({"multiscale": "sum", "kinematics": "small"}), [100], [0.5])
    >>> print(f"{table['friction_total'][0]:.2f}")
    0.65
    """
    return answer.table(run(campaign, velocities, pressures, temperatures, jobs, progress))


def at_points(
    campaign: Campaign,
    velocities: float | Sequence[float] | None = None,
    pressures: float | Sequence[float] | None = None,
    temperatures: float | Sequence[float] | None = None,
) -> Campaign:
    """Return a campaign of the same rubber and road on another grid, without its other studies.

    Parameters
    ----------
    campaign : Campaign
    velocities, pressures, temperatures : float or sequence of float, optional
        mm/s, MPa and degC, in any order; by default the grid's.
    """
    warm = campaign.temperatures
    if temperatures is not None:
        warm = Items(each=Number(unit="degC", low=-LARGEST)).check("temperatures", _list(temperatures))
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


def _list(values: float | Sequence[float]) -> list[float]:
    return [values] if isinstance(values, (int, float, np.number)) else [*values]


def _positive(name: str, unit: str, values: float | Sequence[float]) -> tuple[float, ...]:
    return Items(each=Number(unit=unit)).check(name, _list(values))


def _solved(
    campaign: Campaign,
    parameters: Mapping[float | None, Mapping[str, object]],
    scenes: Mapping[str, Mapping[str, Scene]],
    folder: Path,
    at_once: int,
    progress: bool | Callable[[str], None],
) -> xr.Dataset:
    """Return the friction of the whole road out of the results of all scenes, solving those that are missing."""
    roads = {warm: WholeRoad.from_parameters(given) for warm, given in parameters.items()}
    made = Path(campaign.results)
    jobs = []
    for kind, of in scenes.items():
        for name, scene in of.items():
            warm = scene.temperature if campaign.temperatures else None
            # As in the workflow: only where any way will do is the whole road not needed everywhere.
            road = roads[warm] if kind == WHOLE and roads[warm].way == "auto" else None
            depends = [json.dumps(parameters[warm], sort_keys=True)] if road else []
            paths = (kept.path_of(folder, scene, *depends), kept.path_of(folder, scene))
            by_workflow = made / kind / campaign.material.name / campaign.road_name / f"{name}.nc"
            jobs.append(Job(kind, name, scene, *paths, by_workflow, road))
    found = {job: job.path if kept.fits(job.path, job.scene, not job.road) else job.made for job in jobs}
    missing = [job for job in jobs if found[job] == job.made and (job.road or not kept.fits(job.made, job.scene))]
    if missing:
        found |= {job: job.path for job in missing}
        solve_all(missing, at_once, progress)
    own = {found[job]: job.scene.digest for job in jobs if job.kind == SCENES}
    collected, drawn = collect(own, own.values()), {}
    for draw in campaign.whole_roads:
        own = {found[job]: job.scene.digest for job in jobs if job.kind == WHOLE and job.name == draw + job.scene.name}
        drawn[draw] = collect(own, own.values())
    about = {name: collected.attrs[name] for name in _SHARED if name in collected.attrs}
    return answer.dataset(total_tables(collected, mean_road(drawn), roads), collected, _about(campaign) | about)


def _about(campaign: Campaign) -> dict[str, str]:
    """Return what the dataset says of its campaign."""
    return {
        "title": "Friction of a rubber on a road over sliding speed and pressure",
        "Conventions": CONVENTIONS.split()[0],
        "source": f"rubfric {rubfric.__version__}",
        "references": PAPER,
        "software": SOFTWARE,
        "campaign": campaign.words(),
        "rubber": campaign.material.name,
        "road": campaign.road_name,
        "plane": campaign.plane,
        "kinematics": campaign.kinematics,
        "multiscale": campaign.multiscale.way,
        "not_covered": "; ".join(never_covered(campaign)),
        "code_digest": code(SOLVER),
    }
