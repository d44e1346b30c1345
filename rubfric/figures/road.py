"""Figures of a measured road: before and after cleaning, height distribution, spectrum, octaves, depth, a window."""

from __future__ import annotations

import math
from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from rubfric.figures.scaling import plain, tick_decades
from rubfric.figures.style import COLUMN, DOUBLE_COLUMN, applied
from rubfric.profile.analysis import Analysis
from rubfric.profile.depth import SEGMENT, low_passed
from rubfric.profile.window import window

_HEIGHT = 2.75
_ROAD, _REMOVED, _MODEL, _PALE = "#332288", "#cc6677", "#117733", "0.9"
# Points of a profile that are drawn at most: the extremes of stretches of equal length.
_MOST = 6000
# Octaves that are named at most.
_LABELS = 10


@applied()
def draw(found: Analysis) -> dict[str, Figure]:
    """Return the figures of a measured road by name, in the order in which a page shows them.

    Parameters
    ----------
    found : Analysis
    """
    figures = {
        "before and after": _profile(found),
        "height distribution": _distribution(found),
        "spectrum": _spectrum(found),
        "slope and height by octave": _octaves(found),
    }
    if len(found.depth.segments):
        figures["mean profile depth"] = _depth(found)
    return figures | {"window": _window(found)}


def _axes(width: float, abscissa: str, ordinate: str) -> tuple[Figure, Axes]:
    figure = Figure(figsize=(width, _HEIGHT), layout="constrained")
    panel = figure.subplots()
    panel.set(xlabel=abscissa, ylabel=ordinate)
    return figure, panel


def _drawn(x: Any, y: Any) -> tuple[Any, Any]:
    """Return a line with the lowest and the highest point of each of some stretches, where it has more points."""
    size = 2 * math.ceil(len(x) / _MOST)
    if size <= 2:
        return x, y
    places = []
    for begin in range(0, len(x), size):
        part = y[begin : begin + size]
        if np.isnan(part).all():
            places.append([begin, begin])
            continue
        places.append(sorted((begin + int(np.nanargmin(part)), begin + int(np.nanargmax(part)))))
    chosen = np.ravel(places)
    return x[chosen], y[chosen]


def _profile(found: Analysis) -> Figure:
    cleaned = found.cleaned
    measured, profile = cleaned.measured, cleaned.profile
    figure = Figure(figsize=(DOUBLE_COLUMN, 1.55 * _HEIGHT), layout="constrained")
    before, after = figure.subplots(2, sharex=True)
    place = measured.distances
    before.plot(*_drawn(place, measured.heights), "-", color="0.45", lw=0.6, label="As measured")
    if cleaned.spikes.any():
        before.plot(
            place[cleaned.spikes], measured.heights[cleaned.spikes], "x", color=_REMOVED, ms=3.5, label="Spikes"
        )
    for side, count in zip(
        (slice(0, cleaned.plates[0]), slice(len(place) - cleaned.plates[1], None)), cleaned.plates, strict=True
    ):
        if count:
            before.axvspan(place[side][0], place[side][-1], color="#ddaa33", alpha=0.3, lw=0.0, label="Plate")
    kept = profile.distances
    before.plot(kept, cleaned.form, "--", color=_MODEL, lw=0.9, label="Tilt and form")
    before.set(ylabel="Height (mm)")
    _legend(before)
    after.plot(*_drawn(kept, cleaned.heights), "-", color=_ROAD, lw=0.6, label="Clean")
    after.plot(
        *_drawn(kept, np.where(cleaned.bridged, cleaned.heights, np.nan)), "-", color=_REMOVED, lw=1.1, label="Bridged"
    )
    after.set(xlabel="Distance (mm)", ylabel="Height (mm)")
    _legend(after)
    return figure


def _legend(panel: Axes, **where: Any) -> None:
    labels = dict(zip(*reversed(panel.get_legend_handles_labels()), strict=True))
    where = where or {"loc": "lower left", "bbox_to_anchor": (0.0, 1.0), "ncols": 4}
    panel.legend(labels.values(), labels.keys(), handlelength=1.4, labelspacing=0.25, columnspacing=1.2, **where)


def _distribution(found: Analysis) -> Figure:
    figure, panel = _axes(COLUMN, "Height (mm)", "Density (1/mm)")
    heights = found.cleaned.heights
    rms, skewness, kurtosis = found.moments
    panel.hist(heights, bins=60, density=True, color=_ROAD, alpha=0.5, label="Heights")
    fine = np.linspace(heights.min(), heights.max(), 200)
    normal = np.exp(-0.5 * (fine / rms) ** 2) / (rms * math.sqrt(2.0 * math.pi))
    panel.plot(fine, normal, "k--", lw=0.9, label="Normal")
    panel.set_title(f"RMS {rms:.3g} mm, skewness {plain(round(skewness, 2))}, kurtosis {kurtosis:.2f}", loc="left")
    _legend(panel, loc="best")
    return figure


def _spectrum(found: Analysis) -> Figure:
    figure, panel = _axes(COLUMN, "Wavenumber $q$ (1/mm)", "Power spectral density $C(q)$ (mm³)")
    bins = found.spectrum.binned(6)
    low, high = bins.interval()
    panel.fill_between(bins.wavenumbers, low, high, color=_ROAD, alpha=0.2, lw=0.0, label="95 %")
    panel.plot(bins.wavenumbers, bins.density, "-", color=_ROAD, lw=0.9, label="Measured")
    panel.set(xscale="log", yscale="log")
    ends = panel.get_xlim()
    floor = 0.3 * bins.density[bins.density > 0.0].min()
    panel.set_ylim(bottom=floor)
    for span in ((ends[0], found.band.low), (found.band.high, ends[1])):
        panel.axvspan(*span, color=_PALE, lw=0.0, zorder=0)
    panel.set_xlim(ends)
    if found.hurst is not None:
        law = found.hurst
        q = np.geomspace(law.low, law.high, 20)
        label = f"$H$ = {law.exponent:.2f} ± {law.error:.2f}"
        panel.plot(q, law.level * (q / law.reference) ** -(1.0 + 2.0 * law.exponent), "k--", lw=0.9, label=label)
    panel.axvline(2.0 * math.pi / found.cutoff, color=_REMOVED, lw=0.8, linestyle=":", label="Cutoff")
    upper = panel.secondary_xaxis("top", functions=(_wavelength, _wavelength))
    upper.set_xlabel("Wavelength (mm)")
    for axis in (panel.xaxis, upper.xaxis):
        tick_decades(axis, *sorted(axis.get_view_interval()))
    _legend(panel, loc="lower left")
    return figure


def _wavelength(q: Any) -> Any:
    with np.errstate(divide="ignore"):
        return 2.0 * math.pi / np.asarray(q, dtype=float)


def _octaves(found: Analysis) -> Figure:
    figure = Figure(figsize=(COLUMN, _HEIGHT), layout="constrained")
    slope, height = figure.subplots(2, sharex=True)
    place = np.arange(len(found.octaves))
    solid = np.array([found.is_trusted(one) for one in found.octaves])
    for panel, name, colour in ((slope, "slope", _MODEL), (height, "height", _ROAD)):
        values = np.array([getattr(one, name) for one in found.octaves])
        panel.bar(place[solid], values[solid], 0.8, color=colour, label="Trusted")
        panel.bar(
            place[~solid],
            values[~solid],
            0.8,
            color="white",
            edgecolor=colour,
            hatch="////",
            lw=0.6,
            label="Not trusted",
        )
    slope.set(ylabel="RMS slope")
    height.set(ylabel="RMS height (mm)", xlabel="Octave of wavelength, its centre (mm)")
    every = math.ceil(len(place) / _LABELS)
    height.set_xticks(place[::every], [f"{one.wavelength:.2g}" for one in found.octaves[::every]])
    _legend(slope)
    return figure


def _depth(found: Analysis) -> Figure:
    figure, panel = _axes(DOUBLE_COLUMN, "Distance (mm)", "Height (mm)")
    profile = found.cleaned.profile
    smooth, place = low_passed(profile.heights, profile.spacing), profile.distances
    points = round(SEGMENT / profile.spacing)
    for number, depth in enumerate(found.depth.segments):
        part = slice(number * points, (number + 1) * points)
        level = smooth[part] - np.polyval(np.polyfit(place[part], smooth[part], 1), place[part])
        panel.plot(*_drawn(place[part], level), "-", color=_ROAD, lw=0.6)
        panel.axvline(place[part][-1], color="0.7", lw=0.5)
        if math.isfinite(depth):
            panel.plot(place[part][[0, -1]], [depth, depth], "-", color=_REMOVED, lw=1.0, label="Mean segment depth")
        for half in (slice(0, points // 2), slice(points // 2, None)):
            at = int(np.argmax(level[half])) + (half.start or 0)
            panel.plot(place[part][at], level[at], "v", color=_MODEL, ms=3.0, label="Highest point of a half")
    panel.axhline(0.0, color="0.7", lw=0.5)
    _legend(panel)
    return figure


def _window(found: Analysis) -> Figure:
    figure, panel = _axes(DOUBLE_COLUMN, "Distance in the window (mm)", "Height (mm)")
    road = found.road()
    profile = found.cleaned.profile
    points = round(road.period / profile.spacing)
    place = profile.spacing * np.arange(points)
    # Beyond what is blended, both are the profile, but for short waves.
    raw = profile.heights[:points] - (
        profile.heights[points - 1] - window(profile, found.window, 1, found.blend)[0][-1]
    )
    panel.axvspan(0.0, found.blend * road.period, color=_PALE, lw=0.0, zorder=0, label="Blended")
    panel.plot(place, raw, "-", color="0.5", lw=0.6, label="Profile")
    fine = np.linspace(0.0, road.period, min(4 * points, 8000))
    panel.plot(
        fine,
        road.height(fine),
        "-",
        color=_REMOVED,
        lw=0.8,
        label=f"Periodic, waves of {plain(found.cutoff, 4)} mm and longer",
    )
    panel.set_xlim(0.0, road.period)
    _legend(panel)
    return figure
