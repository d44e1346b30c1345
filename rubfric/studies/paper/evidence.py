"""Whether single scenes bear out what the paper claims: numbers with their errors against limits, one by one."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from dataclasses import dataclass

import numpy as np
import pandas as pd
import xarray as xr

from rubfric.arrays import Real
from rubfric.results.scales import total_error, total_friction
from rubfric.results.selection import find_peak
from rubfric.studies.paper.observation import DEPTH

# A profile counts as filled where this share of it is in contact. ASSUME: the paper names no number.
FILLED = 0.99
# From this height-to-width ratio on the paper calls friction stable.
STABLE = 0.75


@dataclass(frozen=True)
class Evidence:
    """One number that bears on a claim.

    Attributes
    ----------
    claim, part : str
        As in ``rubfric.studies.paper.claims``.
    scale : int, optional
    pressure : float, optional
        Nominal, MPa.
    velocity : float, optional
        mm/s.
    value, error : float
        Dimensionless; the error absolute, and NaN where it was not estimated.
    limit : float
    sense : {"above", "below"}
        Where the value has to be for the claim to hold.
    simulated : bool
        Whether a simulation stands in for a measurement.
    outcome : {"yes", "no", "open"}
        ``open`` where the limit is within the error of the value.
    """

    claim: str
    part: str
    scale: int | None
    pressure: float | None
    velocity: float | None
    value: float
    error: float
    limit: float
    sense: str
    simulated: bool = False

    @property
    def margin(self) -> float:
        """How far the value is on the right side of its limit; negative on the wrong one."""
        return self.value - self.limit if self.sense == "above" else self.limit - self.value

    @property
    def outcome(self) -> str:
        """Whether the value bears the claim out: yes, no, or open."""
        error = 0.0 if np.isnan(self.error) else self.error
        if abs(self.margin) <= error:
            return "open"
        return "yes" if self.margin >= 0.0 else "no"


def gather(observed: xr.Dataset, aspect: float, studied: Iterable[float], difference: float) -> list[Evidence]:
    """Return what scenes say on the claims C1, C3, C4, C6 and C7.

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
        *_totals(grid),
    ]


def depth_evidence(depths: pd.DataFrame, difference: float) -> list[Evidence]:
    """Return what profiles over the depth say on C2; a table with the columns of ``DEPTH`` and the scenes' axes."""
    parts = ("lower at the top than at the road", "falls all the way", "settles")
    senses = ("above", "below", "below")
    return [
        Evidence("C2", part, int(row["scale"]), row["pressure"], row["velocity"], row[name], np.nan, difference, sense)
        for row in depths.dropna(subset=list(DEPTH)).to_dict("records")
        for part, name, sense in zip(parts, DEPTH, senses, strict=True)
    ]


def march_evidence(march: xr.Dataset, tolerance: float) -> Evidence:
    """Return what a march says on C5; undecided where it slid for less than the rubber remembers."""
    remembered = float(march["saturation_wavelengths"]) >= float(march["saturation_needed"])
    about = march.attrs
    return Evidence(
        *("C5", "saturates", int(about["scale"]), float(about["pressure"]), float(about["velocity"])),
        value=float(march["saturation_variation"]),
        error=0.0 if remembered else np.inf,
        limit=tolerance,
        sense="below",
    )


def march_note(evidence: Iterable[Evidence]) -> str:
    """Return in a sentence which marches were too short to decide, or nothing where none was."""
    short = [f"{one.velocity:g}" for one in evidence if one.claim == "C5" and np.isinf(one.error)]
    return f"At {', '.join(short)} mm/s the march ended before the rubber forgot its beginning." if short else ""


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
                yield _rise("C1", "rises below the peak", where, friction[-1], error[-1], friction[0], error[0])
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
        yield from _peak("C6", (int(scale), float(pressure)), *_known(at, "velocity"))
    for scale, velocity in _pairs(grid, "scale", "velocity"):
        friction, error = _known(grid.sel(scale=scale, velocity=velocity), "pressure")
        if len(friction) > 1:
            where = (int(scale), None, float(velocity))
            yield _spread("C6", "varies with pressure", where, friction, error, "above", difference)


def _totals(grid: xr.Dataset) -> Iterator[Evidence]:
    total = xr.Dataset(
        {
            "friction_coefficient": total_friction(grid["friction_coefficient"]),
            "friction_coefficient_error": total_error(grid["friction_coefficient_error"]),
        }
    )
    for pressure in total["pressure"].values:
        yield from _peak("C7", (None, float(pressure)), *_known(total.sel(pressure=pressure), "velocity"))


def _peak(claim: str, where: tuple[int | None, float], friction: Real, error: Real) -> Iterator[Evidence]:
    """Yield by how much friction between the ends exceeds that at the ends, where there are three speeds."""
    if len(friction) < 3:
        return
    inner = 1 + int(np.argmax(friction[1:-1]))
    end = 0 if friction[0] >= friction[-1] else len(friction) - 1
    yield _rise(claim, "peaks over speed", (*where, None), friction[inner], error[inner], friction[end], error[end])


def _rise(
    claim: str,
    part: str,
    where: tuple[int | None, float | None, float | None],
    upper: float,
    upper_error: float,
    lower: float,
    lower_error: float,
) -> Evidence:
    """Return by how much one friction exceeds another, relative to the other."""
    base = max(abs(lower), lower_error, float(np.finfo(float).tiny))
    return Evidence(claim, part, *where, (upper - lower) / base, (upper_error + lower_error) / base, 0.0, "above")


def _spread(
    claim: str,
    part: str,
    where: tuple[int | None, float | None, float | None],
    friction: Real,
    error: Real,
    sense: str,
    limit: float,
) -> Evidence:
    """Return the range of frictions, over their mean where they ought to be equal, and else over the largest."""
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
