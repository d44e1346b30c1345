"""From a profile as measured to one to slide over: plates, spikes, gaps, tilt and form are removed and counted."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, replace

import numpy as np

from rubfric.arrays import Flags, Real
from rubfric.errors import InvalidInput
from rubfric.profile.measured import Profile
from rubfric.profile.plates import plates
from rubfric.profile.spikes import spikes

# Gaps up to this length, mm, are bridged by straight lines.
LONGEST_GAP = 5.0
_FORMS = {0: "nothing", 1: "tilt", 2: "tilt and form"}
# Share of bridged points above which that is said to be much.
_MUCH = 0.1
_FEWEST = 64


@dataclass(frozen=True, eq=False)
class Cleaned:
    """A profile without gaps, and what was removed from it.

    Attributes
    ----------
    measured : Profile
        As it was read.
    first, last : int
        The points that were kept, ``measured.heights[first:last]``.
    heights : ndarray, shape (last - first,)
        mm, without gaps, their mean zero.
    bridged : ndarray of bool, shape (last - first,)
        Where heights are interpolated, over gaps and spikes.
    spikes : ndarray of bool, shape (points as measured,)
        Where there was a spike.
    form : ndarray, shape (last - first,)
        The polynomial that was subtracted, mm.
    plates : tuple of int, shape (2,)
        Points of a plate at the begin and at the end.
    removed : tuple of (str, str)
        What was removed, and how much of it, with numbers.
    warnings : tuple of str
        What makes the profile doubtful.
    """

    measured: Profile
    first: int
    last: int
    heights: Real
    bridged: Flags
    spikes: Flags
    form: Real
    plates: tuple[int, int]
    removed: tuple[tuple[str, str], ...]
    warnings: tuple[str, ...]

    @property
    def profile(self) -> Profile:
        """The clean profile."""
        start = self.measured.start + self.first * self.measured.spacing
        return replace(self.measured, start=start, heights=self.heights)


def clean(profile: Profile, longest_gap: float = LONGEST_GAP, form: int = 1, keep_ends: bool = False) -> Cleaned:
    """Return a profile without plates, spikes, gaps, tilt and form.

    Parameters
    ----------
    profile : Profile
    longest_gap : float
        Gaps up to this length are bridged by a straight line, mm. Longer ones part the profile, whose longest stretch
        is taken.
    form : {0, 1, 2}
        Order of the polynomial that is subtracted: the mean alone, tilt, or tilt and form.
    keep_ends : bool
        Whether flat ends belong to the road.

    Raises
    ------
    InvalidInput
        Where too little is left.
    """
    heights = profile.heights.copy()
    dx = profile.spacing
    removed, warnings = [], []
    ends = (0, 0) if keep_ends else plates(heights)
    first, last = ends[0], len(heights) - ends[1]
    for name, count in zip(("begin", "end"), ends, strict=True):
        removed.append((f"Plate at the {name}", f"{count * dx:.4g} mm, flat" if count else "none"))
    peaks = np.zeros(len(heights), dtype=bool)
    peaks[first:last] = spikes(heights[first:last])
    share = peaks.sum() / max(np.isfinite(heights[first:last]).sum(), 1)
    runs = list(_runs(peaks))
    removed.append(("Spikes", f"{len(runs)}, of {peaks.sum()} points ({share:.2%})" if runs else "none"))
    if share > _MUCH:
        warnings.append(f"{share:.0%} of the heights are spikes: the instrument saw little of this road")
    heights[peaks] = np.nan
    first, last, how = _stretch(heights, first, last, longest_gap, dx)
    removed += how
    if last - first < _FEWEST:
        raise InvalidInput(
            f"{profile.source} has no stretch of {_FEWEST} heights without a gap longer than {longest_gap:g} mm: allow "
            "longer ones with --longest-gap, or measure again"
        )
    kept = heights[first:last]
    gone = np.isnan(kept)
    gaps = [end - begin for begin, end in _runs(gone)]
    if gaps:
        words = f"{len(gaps)}, of {gone.sum()} points ({gone.mean():.2%}), the longest {max(gaps) * dx:.3g} mm"
        removed.append(("Gaps bridged, spikes among them", words))
    if gone.mean() > _MUCH:
        warnings.append(f"{gone.mean():.0%} of the profile is bridged by straight lines, where the road is not known")
    place = np.arange(len(kept))
    kept[gone] = np.interp(place[gone], place[~gone], kept[~gone])
    shape, words = _form(kept, ~gone, dx, form)
    removed.append((f"Subtracted: {_FORMS[form]}", words))
    smooth = kept - shape
    offset = float(smooth.mean())
    return Cleaned(
        profile, first, last, smooth - offset, gone, peaks, shape + offset, ends, tuple(removed), tuple(warnings)
    )


def _runs(flags: Flags) -> Iterator[tuple[int, int]]:
    """Yield begin and end of each run of set flags."""
    edges = np.flatnonzero(np.diff(np.concatenate(([0], flags.astype(np.int8), [0]))))
    yield from zip(edges[::2].tolist(), edges[1::2].tolist(), strict=True)


def _stretch(heights: Real, first: int, last: int, longest: float, dx: float) -> tuple[int, int, list[tuple[str, str]]]:
    """Return the longest stretch without a gap that is too long, and what is left out for it."""
    gone = np.isnan(heights[first:last])
    parts, begin = [], 0
    for start, end in _runs(gone):
        if (end - start) * dx > longest or start == 0 or end == last - first:
            parts.append((begin, start))
            begin = end
    parts.append((begin, last - first))
    best = max(parts, key=lambda part: part[1] - part[0])
    left = last - first - (best[1] - best[0])
    if not left:
        return first, last, []
    long = sum(1 for start, end in _runs(gone) if (end - start) * dx > longest and start > 0 and end < last - first)
    why = f"{long} gaps are longer than {longest:g} mm" if long else "gaps at the ends"
    words = f"{left * dx:.4g} mm of {(last - first) * dx:.4g} mm, since there are {why}" if long else why
    words = words if long else f"{left * dx:.4g} mm, {why}"
    return first + best[0], first + best[1], [("Left out", words)]


def _form(heights: Real, known: Flags, dx: float, order: int) -> tuple[Real, str]:
    """Return the polynomial of least squares through the known heights, and what it amounts to."""
    place = np.linspace(-1.0, 1.0, len(heights))
    parts = np.polynomial.legendre.legfit(place[known], heights[known], order)
    shape = np.polynomial.legendre.legval(place, parts)
    length = dx * (len(heights) - 1)
    words = [f"mean {parts[0]:.4g} mm"] if order == 0 else []
    if order >= 1:
        words.append(f"tilt {2.0 * parts[1] / length * 1e3:.3g} mm/m ({2.0 * parts[1]:.3g} mm in all)")
    if order >= 2:
        words.append(f"bow {1.5 * abs(parts[2]):.3g} mm between ends and middle")
    return shape, ", ".join(words)
