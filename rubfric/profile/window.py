"""Windows of a profile, made periodic by blending their ends, to slide over."""

from __future__ import annotations

import numpy as np

from rubfric.arrays import Real
from rubfric.errors import InvalidInput
from rubfric.profile.measured import Profile
from rubfric.road.profile import ProfileRoad

# Share of a window over which its ends are blended, unless another is given.
BLEND = 0.1


def count(profile: Profile, length: float, blend: float = BLEND) -> int:
    """Return how many windows side by side a profile has; InvalidInput where not even one fits.

    Parameters
    ----------
    profile : Profile
        Without gaps.
    length : float
        Of a window, mm.
    blend : float
        Share of a window over which its ends are blended.
    """
    points, over = _points(profile, length, blend)
    found = (len(profile.heights) - over) // points
    if found < 1:
        raise InvalidInput(
            f"the window is {length:g} mm long, and {over * profile.spacing:.3g} mm more are needed to blend its ends, "
            f"but {profile.source} has {profile.length:.4g} mm without long gaps: the longest window is "
            f"{longest(profile, blend):.4g} mm"
        )
    return int(found)


def longest(profile: Profile, blend: float = BLEND) -> float:
    """Return the length of the longest window that fits, rounded down to three digits, mm."""
    length = profile.length / (1.0 + blend) * (1.0 - 1e-3)
    unit = 10.0 ** (np.floor(np.log10(length)) - 2)
    return float(unit * np.floor(length / unit))


def _points(profile: Profile, length: float, blend: float) -> tuple[int, int]:
    """Return the heights of a window, and of what is blended."""
    points = max(round(length / profile.spacing), 2)
    return points, round(blend * points)


def window(profile: Profile, length: float, number: int = 1, blend: float = BLEND) -> tuple[Real, float]:
    """Return the heights of a window that repeats, and its period.

    The first heights are blended with those that follow on the window, so that its end goes over into its begin:
    s(x) = w s(x) + (1 - w) s(x + L), w = sin²(pi x / 2b) over the length b. A profile of period L is not changed. Where
    the two are uncorrelated, blending halves the variance in its middle.

    Parameters
    ----------
    profile : Profile
        Without gaps.
    length : float
        mm; rounded to a multiple of the spacing.
    number : int
        Which window, from 1.
    blend : float
        Share of a window over which its ends are blended.

    Returns
    -------
    heights : ndarray, shape (points,)
        mm, their mean zero.
    period : float
        L, mm.

    Raises
    ------
    InvalidInput
        For a window that the profile does not have.
    """
    there = count(profile, length, blend)
    if not 1 <= number <= there:
        raise InvalidInput(f"window {number} is asked for, but {profile.source} has {there} of {length:g} mm")
    points, over = _points(profile, length, blend)
    begin = (number - 1) * points
    heights = profile.heights[begin : begin + points].copy()
    if over:
        weight = np.sin(0.5 * np.pi * np.arange(over) / over) ** 2
        heights[:over] = weight * heights[:over] + (1.0 - weight) * profile.heights[begin + points :][:over]
    return heights - heights.mean(), points * profile.spacing


def road(profile: Profile, length: float, cutoff: float, number: int = 1, blend: float = BLEND) -> ProfileRoad:
    """Return a window as a road to slide over, without waves shorter than a cutoff.

    Parameters
    ----------
    profile : Profile
        Without gaps.
    length, cutoff : float
        mm.
    number : int
        Which window, from 1.
    blend : float
        Share of a window over which its ends are blended.

    Raises
    ------
    InvalidInput
        For a window or a cutoff that the profile does not have.
    """
    heights, period = window(profile, length, number, blend)
    return ProfileRoad.of_heights(heights, period, cutoff)
