"""Mean profile depth of a road, ISO 13473-1."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from rubfric.arrays import Flags, Real

# Length of a segment, mm; -3 dB of the low-pass filter, mm; share of a segment that may be bridged.
SEGMENT, LOW_PASS, _MOST_BRIDGED = 100.0, 2.4, 0.1


@dataclass(frozen=True, eq=False)
class Depth:
    """The mean profile depth.

    Attributes
    ----------
    segments : ndarray, shape (segments,)
        Mean segment depth of each, mm; NaN where more than a tenth is bridged.
    mean, scatter : float
        Mean profile depth, mm, and the standard deviation of its segments (NaN for fewer than two).
    """

    segments: Real

    @property
    def mean(self) -> float:
        """Mean over the valid segments, mm; NaN where there is none."""
        valid = self.segments[np.isfinite(self.segments)]
        return float(valid.mean()) if valid.size else float("nan")

    @property
    def scatter(self) -> float:
        """Standard deviation over the valid segments, mm; NaN for fewer than two."""
        valid = self.segments[np.isfinite(self.segments)]
        return float(valid.std(ddof=1)) if valid.size > 1 else float("nan")


def mean_profile_depth(heights: Real, spacing: float, bridged: Flags | None = None) -> Depth:
    """Return the mean profile depth of the segments of 100 mm that a profile holds.

    In each segment the line of least squares is subtracted (slope suppression); the mean of the highest points of its
    two halves, over its mean, is the mean segment depth. Wavelengths below 2.4 mm are filtered out first, with the gain
    of a Butterworth filter of second order and without its phase. Slope suppression stands for the standard's high-pass
    filter, and heights are not resampled.

    Parameters
    ----------
    heights : ndarray, shape (points,)
        mm, without gaps.
    spacing : float
        mm.
    bridged : ndarray of bool, shape (points,), optional
        Where heights are interpolated.
    """
    points = round(SEGMENT / spacing)
    smooth = low_passed(heights, spacing)
    found = []
    for begin in range(0, len(heights) - points + 1, points):
        place = np.arange(points)
        part = smooth[begin : begin + points]
        level = part - np.polyval(np.polyfit(place, part, 1), place)
        many = bridged is not None and bridged[begin : begin + points].mean() > _MOST_BRIDGED
        half = points // 2
        found.append(np.nan if many else 0.5 * (level[:half].max() + level[half:].max()))
    return Depth(np.array(found))


def low_passed(heights: Real, spacing: float) -> Real:
    """Return heights without wavelengths below 2.4 mm: the gain is 1 / sqrt(1 + (2.4 mm / wavelength)^4).

    Parameters
    ----------
    heights : ndarray, shape (points,)
        mm, continued by their mirror image at both ends.
    spacing : float
        mm.
    """
    if spacing >= 0.5 * LOW_PASS:
        return heights
    mirrored = np.concatenate([heights, heights[::-1]])
    frequency = np.fft.rfftfreq(len(mirrored), spacing)
    gain = 1.0 / np.sqrt(1.0 + (LOW_PASS * frequency) ** 4)
    return np.fft.irfft(gain * np.fft.rfft(mirrored), len(mirrored))[: len(heights)]
