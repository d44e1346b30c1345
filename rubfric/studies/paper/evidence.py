"""Whether single scenes, marches and rig points support what the paper claims: numbers with errors against limits."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from dataclasses import replace
from typing import TypeAlias

import numpy as np
import pandas as pd
import xarray as xr

from rubfric.arrays import Real
from rubfric.results.selection import find_peak
from rubfric.studies.paper.claims import Evidence
from rubfric.studies.paper.observation import DEPTH

# A profile counts as filled where this share of it is in contact. ASSUME: the paper names no number.
FILLED = 0.99
# From this height-to-width ratio on the paper calls friction stable.
STABLE = 0.75
# Points of the rig have one pressure where each is at most this factor above the one before.
_NEAR = 1.1
_RIG_SPEED, _RIG_PRESSURE = "speed_mm_per_s", "pressure_MPa"

# Scale, pressure (MPa) and speed (mm/s) of a number; None where it is of several.
Where: TypeAlias = tuple[int | None, float | None, float | None]


def gather(observed: xr.Dataset, aspect: float, studied: Iterable[float], difference: float) -> list[Evidence]:
    """Return what scenes say on the claims C1, C3, C4 and C6.

    Parameters
    ----------
    observed : xarray.Dataset
        ``friction_coefficient``, its ``_error``, ``contact_fraction`` and ``columns`` over scale, velocity (mm/s),
        pressure (MPa) and aspect; NaN where a scene was not run or not solved.
    aspect : float
        That of the grid.
    studied : iterable of float
        Pressures of the study of aspects, MPa.
    difference : float
        Relative difference up to which two values are called equal.
    """
    grid = observed.sel(aspect=aspect)
    return [
        *_ratios(observed, aspect, set(studied), difference),
        *_filling(grid),
        *_speeds_and_loads(grid, difference),
    ]


def depth_evidence(depths: pd.DataFrame, difference: float) -> list[Evidence]:
    """Return what profiles over the depth say on C2.

    Parameters
    ----------
    depths : pandas.DataFrame
        Columns of ``DEPTH`` (dimensionless), scale, pressure (MPa) and velocity (mm/s); a row per scene.
    difference : float
        Share of the largest density up to which two densities are called equal.
    """
    parts = ("lower at the top than at the road", "falls all the way", "settles")
    senses = ("above", "below", "below")
    return [
        Evidence("C2", part, int(row["scale"]), row["pressure"], row["velocity"], row[name], np.nan, difference, sense)
        for row in depths.dropna(subset=list(DEPTH)).to_dict("records")
        for part, name, sense in zip(parts, DEPTH, senses, strict=True)
    ]


def march_evidence(march: xr.Dataset, tolerance: float) -> Evidence:
    """Return what a march says on C5; undecided where it slid for less than the memory of the rubber.

    Parameters
    ----------
    march : xarray.Dataset
        As built by ``rubfric.results.march.build``.
    tolerance : float
        Relative variation of friction up to which it counts as saturated.
    """
    long_enough = float(march["saturation_wavelengths"]) >= float(march["saturation_needed"])
    about = march.attrs
    return Evidence(
        *("C5", "saturates", int(about["scale"]), float(about["pressure"]), float(about["velocity"])),
        value=float(march["saturation_variation"]),
        error=0.0 if long_enough else np.inf,
        limit=tolerance,
        sense="below",
    )


def march_note(evidence: Iterable[Evidence]) -> str:
    """Return in a sentence which marches were too short to decide; empty if none was."""
    short = [f"{one.velocity:g}" for one in evidence if one.claim == "C5" and np.isinf(one.error)]
    return f"At {', '.join(short)} mm/s the march was shorter than the memory of the rubber." if short else ""


def rig_evidence(points: pd.DataFrame) -> list[Evidence]:
    """Return what points of the test rig say on C8: the largest friction of each pressure over that at both end speeds.

    Parameters
    ----------
    points : pandas.DataFrame
        As ``rubfric.rig.reduction.point_table`` returns it. Errors are the half-widths of the 95 % confidence
        intervals of both points, added. A pressure with fewer than three points decides nothing.
    """
    return [one for group in _by_pressure(points) if len(group) > 2 for one in _of_one_pressure(group)]


def rig_note(points: pd.DataFrame) -> str:
    """Return in a sentence whether the points were measured."""
    simulated = int((points["source"] == "simulated").sum())
    if not len(points):
        return "The test rig gave no point."
    if not simulated:
        return f"From {len(points)} measured points."
    return (
        f"{simulated} of {len(points)} points are SIMULATED: a virtual rig measured what was simulated. That shows "
        "what a rig would see; only a measurement, named in rig.data, can decide."
    )


def _ratios(observed: xr.Dataset, aspect: float, studied: set[float], difference: float) -> Iterator[Evidence]:
    for scale, pressure in _pairs(observed, "scale", "pressure"):
        at = observed.sel(scale=scale, pressure=pressure)
        if pressure not in studied or at["friction_coefficient"].notnull().any("velocity").sum() < 2:
            continue
        highest = find_peak(at["friction_coefficient"].sel(aspect=aspect).values).at
        for place, velocity in enumerate(at["velocity"].values):
            friction, error = _known(at.sel(velocity=velocity), "aspect")
            where = (int(scale), float(pressure), float(velocity))
            if highest is not None and place < highest and len(friction) > 1:
                yield _rise("C1", "rises below the peak", where, friction, error, -1, 0)
            if highest is not None and place > highest and len(friction) > 1:
                yield _spread("C1", "hardly differs above the peak", where, friction, error, "below", difference)
            friction, error = _known(at.sel(velocity=velocity, aspect=slice(STABLE, None)), "aspect")
            if len(friction) > 1:
                yield _spread("C3", "stable from 0.75 up", where, friction, error, "below", difference)


def _filling(grid: xr.Dataset) -> Iterator[Evidence]:
    for scale in grid["scale"].values:
        at = grid.sel(scale=scale)
        contact, node = at["contact_fraction"], 2.0 / at["columns"]  # either edge of a contact is known to one node
        corners = {
            "open when light and fast": ({"pressure": 0, "velocity": -1}, "below"),
            "filled when heavy and slow": ({"pressure": -1, "velocity": 0}, "above"),
        }
        for part, (corner, sense) in corners.items():
            value, error = float(contact.isel(corner)), float(node.isel(corner))
            if np.isfinite(value):
                where = (float(at["pressure"][corner["pressure"]]), float(at["velocity"][corner["velocity"]]))
                # A contact without an edge has none to be unsure of.
                yield Evidence("C4", part, int(scale), *where, value, error * (value < 1.0), FILLED, sense)
        for part, axis, along, sign in (
            ("fills with pressure", "velocity", "pressure", 1.0),
            ("opens with speed", "pressure", "velocity", -1.0),
        ):
            for held in at[axis].values if at.sizes[along] > 1 else ():
                ends = contact.sel({axis: held}).isel({along: [0, -1]}).values
                error = float(node.sel({axis: held}).isel({along: [0, -1]}).sum(skipna=False))
                pressure, velocity = (None, float(held)) if axis == "velocity" else (float(held), None)
                if np.isfinite(ends).all():
                    change = sign * float(ends[1] - ends[0])
                    yield Evidence("C4", part, int(scale), pressure, velocity, change, error, 0.0, "above")


def _speeds_and_loads(grid: xr.Dataset, difference: float) -> Iterator[Evidence]:
    for scale, pressure in _pairs(grid, "scale", "pressure"):
        at = grid.sel(scale=scale, pressure=pressure)
        yield from peak("C6", "peaks over speed", (int(scale), float(pressure)), *_known(at, "velocity"))
    for scale, velocity in _pairs(grid, "scale", "velocity"):
        friction, error = _known(grid.sel(scale=scale, velocity=velocity), "pressure")
        if len(friction) > 1:
            where = (int(scale), None, float(velocity))
            yield _spread("C6", "varies with pressure", where, friction, error, "above", difference)


def _by_pressure(points: pd.DataFrame) -> Iterator[pd.DataFrame]:
    """Yield the rig's points of each pressure, by speed."""
    ordered = points.sort_values(_RIG_PRESSURE)
    pressures = ordered[_RIG_PRESSURE].to_numpy(dtype=float)
    apart = np.append(False, pressures[1:] > _NEAR * pressures[:-1])[: len(pressures)]
    for _, group in ordered.groupby(np.cumsum(apart)):
        yield group.sort_values(_RIG_SPEED)


def _of_one_pressure(group: pd.DataFrame) -> Iterator[Evidence]:
    names = ("friction_coefficient", "friction_coefficient_ci95", _RIG_SPEED)
    friction, error, speed = (group[name].to_numpy(dtype=float) for name in names)
    top = int(np.argmax(friction))
    where = (None, float(f"{group[_RIG_PRESSURE].median():.3g}"), float(f"{speed[top]:.3g}"))
    simulated = bool((group["source"] == "simulated").any())
    for part, end in (("rises to a peak", 0), ("falls past the peak", -1)):
        yield replace(_rise("C8", part, where, friction, error, top, end), simulated=simulated)


def peak(claim: str, part: str, where: tuple[int | None, float], friction: Real, error: Real) -> Iterator[Evidence]:
    """Yield by how much friction between the ends exceeds that at the ends, where there are three speeds.

    Parameters
    ----------
    claim, part : str
    where : tuple
        Scale, or None for all, and pressure, MPa.
    friction, error : numpy.ndarray, shape (speeds,)
        Friction coefficients over ascending speed, and their absolute errors.
    """
    if len(friction) < 3:
        return
    inner = 1 + int(np.argmax(friction[1:-1]))
    end = 0 if friction[0] >= friction[-1] else -1
    yield _rise(claim, part, (*where, None), friction, error, inner, end)


def _rise(claim: str, part: str, where: Where, friction: Real, error: Real, upper: int, lower: int) -> Evidence:
    """Return by how much one friction exceeds another, relative to the other: their numbers ``upper`` and ``lower``."""
    base = max(abs(friction[lower]), error[lower], float(np.finfo(float).tiny))
    value = (friction[upper] - friction[lower]) / base
    return Evidence(claim, part, *where, value, (error[upper] + error[lower]) / base, 0.0, "above")


def _spread(claim: str, part: str, where: Where, friction: Real, error: Real, sense: str, limit: float) -> Evidence:
    """Return the range of frictions, over their mean where they should be equal, and otherwise over the largest."""
    top, bottom = int(np.argmax(friction)), int(np.argmin(friction))
    base = max(abs(float(friction.mean() if sense == "below" else friction[top])), float(np.finfo(float).tiny))
    value = (friction[top] - friction[bottom]) / base
    return Evidence(claim, part, *where, value, (error[top] + error[bottom]) / base, limit, sense)


def _known(at: xr.Dataset, axis: str) -> tuple[Real, Real]:
    """Return friction and its error along an axis, where they are known."""
    friction = at["friction_coefficient"].transpose(axis).values
    error = at["friction_coefficient_error"].transpose(axis).values
    known = np.isfinite(friction) & np.isfinite(error)
    return friction[known], error[known]


def _pairs(observed: xr.Dataset, first: str, second: str) -> Iterator[tuple[float, float]]:
    for one in observed[first].values:
        for other in observed[second].values:
            yield one, other
