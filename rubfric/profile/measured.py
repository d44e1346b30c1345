"""A measured profile: heights at even distances along a line, with gaps where the instrument saw nothing."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

from rubfric.arrays import Real
from rubfric.errors import InvalidInput

# Part of the spacing within which distances are even; they are rounded in files.
_EVEN = 0.6
# A road longer than this, mm, and points further apart than this, mm, or heights that range over more, are slips of
# units: nothing that rubber feels would be left.
_LONGEST, _COARSEST, _HIGHEST = 1e6, 10.0, 1e3
# Root mean square slope above which heights and distances are not in the units that were said.
_STEEPEST = 50.0
_FEWEST = 64


@dataclass(frozen=True, eq=False)
class Profile:
    """Heights along a line.

    Attributes
    ----------
    source : str
        Where they come from, for messages.
    start : float
        Distance of the first height, mm.
    spacing : float
        mm.
    heights : ndarray, shape (points,)
        mm; NaN in gaps.
    notes : tuple of str
        What was guessed, inserted or left out in reading.
    """

    source: str
    start: float
    spacing: float
    heights: Real
    notes: tuple[str, ...] = ()

    @property
    def length(self) -> float:
        """Points times spacing, mm."""
        return self.spacing * len(self.heights)

    @property
    def distances(self) -> Real:
        """Of all heights, mm."""
        return self.start + self.spacing * np.arange(len(self.heights))

    def checked(self) -> Profile:
        """Return the profile if it can be that of a road; InvalidInput says what it lacks, or which unit is wrong."""
        there = np.isfinite(self.heights)
        if not there.any():
            raise InvalidInput(
                f"{self.source} has no height: all of its {len(there)} points are gaps; check the column of heights"
            )
        if there.sum() < _FEWEST:
            raise InvalidInput(
                f"{self.source} has {there.sum()} heights along the line, but a spectrum needs at least {_FEWEST}"
            )
        if self.length >= _LONGEST or self.spacing > _COARSEST:
            raise InvalidInput(
                f"{self.source} is a road of {self.length / 1e6:.3g} km with points {self.spacing:.4g} mm apart, but "
                f"must be shorter than {_LONGEST / 1e6:g} km, with points at most {_COARSEST:g} mm apart: the unit of "
                "its distances is probably a smaller one, mm or µm; say it with --unit"
            )
        span = float(np.nanmax(self.heights) - np.nanmin(self.heights))
        steps = np.diff(self.heights)
        slope = float(np.sqrt(np.nanmedian(steps**2))) / self.spacing if np.isfinite(steps).any() else 0.0
        if span > _HIGHEST:
            self._refuse_marks()
        if span > _HIGHEST or slope > _STEEPEST:
            raise InvalidInput(
                f"{self.source} has heights that range over {span:.4g} mm, with slopes of {slope:.3g} from point to "
                f"point, but a road ranges over at most {_HIGHEST:g} mm, with slopes up to {_STEEPEST:g}: the unit of "
                "its heights is probably a smaller one; say both with --unit, as in --unit mm,um"
            )
        return self

    def _refuse_marks(self) -> None:
        """Refuse one number that stands for missing heights."""
        known = self.heights[np.isfinite(self.heights)]
        for mark in (known.min(), known.max()):
            others = known[known != mark]
            if len(others) and np.ptp(others) <= _HIGHEST < abs(float(np.median(others)) - mark):
                raise InvalidInput(
                    f"{self.source} has the height {mark:.6g} mm at {len(known) - len(others)} points, far from all "
                    "others: if it marks heights that are missing, leave these fields empty"
                )


def at_distances(source: str, distances: Real, heights: Real, lines: list[int] | None = None) -> Profile:
    """Return a profile from heights at given distances, which rise.

    Distances that are even but for rounding are taken as even; steps of several spacings leave gaps; otherwise heights
    are interpolated at the median spacing.

    Parameters
    ----------
    source : str
        Where they come from, for messages.
    distances, heights : ndarray, shape (points,)
        mm; NaN where there is no height.
    lines : list of int, optional
        Of the file, for messages.

    Raises
    ------
    InvalidInput
        For fewer than two points, missing, unsorted or double distances.
    """
    if len(distances) < 2 or not np.isfinite(distances).all():
        missing = int(np.count_nonzero(~np.isfinite(distances)))
        what = f"lacks the distance in {missing} rows" if missing else "has fewer than two points"
        raise InvalidInput(f"{source} {what}, but every height must have its distance: check the column of distances")
    steps = np.diff(distances)
    notes: list[str] = []
    if (steps < 0.0).all():
        distances, heights, steps = distances[::-1], heights[::-1], -steps[::-1]
        notes.append("distances fall: the profile is read from its end")
    elif (steps <= 0.0).any():
        _refuse(source, distances, int(np.argmax(steps <= 0.0)), lines)
    typical = float(np.median(steps))
    counts = np.rint(steps / typical)
    even = (distances[-1] - distances[0]) / (len(distances) - 1)
    index = np.arange(len(distances))
    if np.abs(distances - distances[0] - even * index).max() <= _EVEN * even:
        return Profile(source, float(distances[0]), float(even), heights, tuple(notes))
    if counts.min() >= 1.0:
        # Steps of several spacings leave room for as many heights.
        index = np.concatenate(([0], np.cumsum(counts))).astype(int)
        spacing, start = np.polyfit(index, distances, 1)
        if np.abs(distances - start - spacing * index).max() <= _EVEN * spacing and index[-1] < 10 * len(index):
            filled = np.full(index[-1] + 1, np.nan)
            filled[index] = heights
            notes.append(f"{len(filled) - len(index)} distances left out in the file are gaps")
            return Profile(source, float(start), float(spacing), filled, tuple(notes))
    places = np.arange(distances[0], distances[-1] + 1e-9 * typical, typical)
    nearest = np.abs(places[:, None] - distances[_around(distances, places)]).min(axis=1)
    there = np.isfinite(heights)
    filled = np.interp(places, distances[there], heights[there]) if there.any() else np.full(len(places), np.nan)
    missing = np.isnan(np.interp(places, distances, heights)) | (nearest > typical)
    notes.append(
        f"distances are uneven, {steps.min():.4g} to {steps.max():.4g} mm apart: heights were interpolated at every "
        f"{typical:.4g} mm"
    )
    return Profile(source, float(places[0]), typical, np.where(missing, np.nan, filled), tuple(notes))


def _around(distances: Real, places: Real) -> np.ndarray:
    """Return for each place the points before and behind it."""
    behind = np.clip(np.searchsorted(distances, places), 1, len(distances) - 1)
    return np.stack([behind - 1, behind], axis=1)


def _refuse(source: str, distances: Real, place: int, lines: list[int] | None) -> None:
    where = f"line {lines[place + 1]}" if lines else f"point {place + 2}"
    here, there = distances[place + 1], distances[place]
    if here == there:
        raise InvalidInput(
            f"{source} has the distance {here:.6g} mm twice, again in {where}, but each distance must be there once: "
            "export more digits, average double points, or give the heights alone with --spacing"
        )
    raise InvalidInput(
        f"{source} has distances that go back, from {there:.6g} to {here:.6g} mm in {where}, but they must rise: sort "
        "the rows, and give each pass over the road a file of its own"
    )


def with_notes(profile: Profile, *notes: str) -> Profile:
    """Return a profile with further notes, before its own."""
    return replace(profile, notes=(*notes, *profile.notes))
