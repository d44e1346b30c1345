"""Figures of a fitted rubber: isotherms, master curve, shift factors, loss factor, spectrum, residuals."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from rubfric.dma.bootstrap import Bands
from rubfric.dma.laws import LN10, law_of
from rubfric.dma.result import Fit
from rubfric.figures.scaling import plain
from rubfric.figures.style import COLUMN, applied, colours

# Height of a figure, inches, and opacity of bands.
_HEIGHT, _OPACITY = 2.75, 0.25
_SIZE = 2.2
_LABELS = {"wlf": "WLF", "arrhenius": "Arrhenius"}
# Most entries of a legend of temperatures.
_MOST = 7


@applied()
def draw(fit: Fit, bands: Bands) -> dict[str, Figure]:
    """Return the figures of a fit by name, in the order in which a page shows them.

    Parameters
    ----------
    fit : Fit
    bands : Bands
    """
    figures = {}
    if not fit.data.is_master:
        figures["isotherms"] = _isotherms(fit)
    figures["master curve"] = _master(fit, bands)
    if not fit.data.is_master:
        figures["shift factors"] = _shift_factors(fit, bands)
    figures["loss factor"] = _loss_factor(fit, bands)
    figures["van Gurp-Palmen plot"] = _van_gurp_palmen(fit)
    figures["spectrum"] = _spectrum(fit, bands)
    figures["residuals"] = _residuals(fit)
    return figures


def _axes(abscissa: str, ordinate: str) -> tuple[Figure, Axes]:
    figure = Figure(figsize=(COLUMN, _HEIGHT), layout="constrained")
    panel = figure.subplots()
    panel.set_xlabel(abscissa)
    panel.set_ylabel(ordinate)
    return figure, panel


def _series(fit: Fit) -> Iterator[tuple[np.ndarray, Any, str]]:
    """Yield the points of each isotherm from cold to warm, their colour, and the legend's entry or nothing."""
    count = len(fit.data.temperatures)
    named = set(np.linspace(0, count - 1, min(count, _MOST)).round().astype(int).tolist())
    for place, colour in enumerate(colours(count)):
        own = fit.data.isotherm == place
        label = f"{plain(round(float(fit.data.temperatures[place]), 1))} °C" if count > 1 and place in named else ""
        yield own, colour, label


def _reduced(fit: Fit) -> Any:
    """Return reduced frequencies in Hz."""
    return fit.data.frequency * 10.0 ** fit.log_shifts[fit.data.isotherm] / (2.0 * np.pi)


def _at_reference(fit: Fit) -> tuple[Any, Any]:
    """Return the measured moduli, vertical shifts taken out."""
    scale = 10.0 ** fit.log_scales[fit.data.isotherm]
    return fit.data.storage / scale, fit.data.loss / scale


def _frequencies(fit: Fit) -> Any:
    low, high = fit.window
    return np.geomspace(low, high, 300)


def _abscissa(fit: Fit) -> str:
    return "Frequency (Hz)" if fit.data.is_master else f"Reduced frequency $a_T f$ at {plain(fit.reference, 4)} °C (Hz)"


def _legend(panel: Axes, **where: Any) -> None:
    panel.legend(handlelength=1.2, labelspacing=0.25, **where)


def _isotherms(fit: Fit) -> Figure:
    kind = fit.data.kind
    figure, panel = _axes("Frequency (Hz)", f"${kind}'$, ${kind}''$ (MPa)")
    hertz = fit.data.frequency / (2.0 * np.pi)
    for own, colour, label in _series(fit):
        panel.plot(hertz[own], fit.data.storage[own], "o-", color=colour, ms=_SIZE, lw=0.6, label=label or None)
        panel.plot(hertz[own], fit.data.loss[own], "^--", color=colour, ms=_SIZE, lw=0.6, markerfacecolor="white")
    panel.set(xscale="log", yscale="log")
    panel.set_title(f"Full ${kind}'$, open ${kind}''$", loc="left")
    figure.legend(*panel.get_legend_handles_labels(), loc="outside right upper", handlelength=1.2)
    return figure


def _master(fit: Fit, bands: Bands) -> Figure:
    kind = fit.data.kind
    figure, panel = _axes(_abscissa(fit), f"${kind}'$, ${kind}''$ (MPa)")
    reduced, (storage, loss) = _reduced(fit), _at_reference(fit)
    for own, colour, _ in _series(fit):
        panel.plot(reduced[own], storage[own], "o", color=colour, ms=_SIZE)
        panel.plot(reduced[own], loss[own], "^", color=colour, ms=_SIZE, markerfacecolor="white")
    grid = _frequencies(fit)
    parts = zip(fit.moduli_at(grid), bands.moduli(grid), ("-", "--"), ("'", "''"), strict=True)
    for curve, (low, high), dashes, prime in parts:
        panel.plot(grid / (2.0 * np.pi), curve, "k", linestyle=dashes, lw=0.9, label=f"${kind}{prime}$ fitted")
        panel.fill_between(grid / (2.0 * np.pi), low, high, color="0.3", alpha=_OPACITY, linewidth=0.0)
    panel.set(xscale="log", yscale="log")
    _legend(panel, loc="upper left")
    return figure


def _shift_factors(fit: Fit, bands: Bands) -> Figure:
    figure, panel = _axes("Temperature (°C)", r"$\log_{10} a_T$")
    temperatures = fit.data.temperatures
    fine = np.linspace(temperatures[0], temperatures[-1], 200)
    for name, deviation in fit.deviations.items():
        law = law_of(name, fine, fit.reference)
        if name == fit.law:
            curve = law.shifts(fit.joint.parameters[: law.bounds[0].size]) / LN10
            panel.plot(fine, curve, "k-", lw=0.9, label=f"{_LABELS[name]}, fitted", zorder=1)
            free = fit.log_shifts + deviation.decades
            panel.errorbar(
                temperatures,
                free,
                2.0 * deviation.errors,
                fmt="o",
                ms=3.0,
                color="#117733",
                elinewidth=0.7,
                label="Free shifts",
            )
            failed = deviation.fails
            if failed.any():
                panel.plot(
                    temperatures[failed], free[failed], "x", color="#cc6677", ms=6, label=f"{_LABELS[name]} fails"
                )
    if fit.law == "free":
        low, high = bands.of("log_shifts")
        panel.fill_between(temperatures, low, high, color="#117733", alpha=_OPACITY, linewidth=0.0)
        panel.plot(temperatures, fit.log_shifts, "o-", ms=3.0, lw=0.7, color="#117733", label="Free shifts, taken")
    if np.ptp(fit.log_scales) > 0.0:
        panel.plot(temperatures, fit.log_scales, "s", ms=2.5, color="#332288", label=r"$\log_{10} b_T$")
    panel.axhline(0.0, color="0.8", lw=0.5, zorder=0)
    _legend(panel, loc="upper right")
    return figure


def _loss_factor(fit: Fit, bands: Bands) -> Figure:
    figure, panel = _axes(_abscissa(fit), r"Loss factor $\tan\delta$")
    reduced = _reduced(fit)
    for own, colour, _ in _series(fit):
        panel.plot(reduced[own], fit.data.loss[own] / fit.data.storage[own], "o", color=colour, ms=_SIZE)
    grid = _frequencies(fit)
    storage, loss = fit.moduli_at(grid)
    samples = np.array([np.divide(*sample.moduli_at(grid)) ** -1 for sample in bands.samples])
    if samples.size:
        panel.fill_between(grid / (2.0 * np.pi), *bands.band(samples), color="0.3", alpha=_OPACITY, linewidth=0.0)
    panel.plot(grid / (2.0 * np.pi), loss / storage, "k-", lw=0.9)
    panel.set(xscale="log")
    panel.set_ylim(bottom=0.0)
    return figure


def _van_gurp_palmen(fit: Fit) -> Figure:
    kind = fit.data.kind
    over = "" if fit.options.vertical == "none" else " / b_T"
    figure, panel = _axes(f"$|{kind}^*|{over}$ (MPa)", r"Phase angle $\delta$ (deg)")
    measured = _at_reference(fit)
    for own, colour, label in _series(fit):
        modulus = np.hypot(measured[0][own], measured[1][own])
        angle = np.degrees(np.arctan2(fit.data.loss[own], fit.data.storage[own]))
        panel.plot(modulus, angle, "o-", color=colour, ms=_SIZE, lw=0.5, label=label or None)
    storage, loss = fit.moduli_at(_frequencies(fit))
    panel.plot(np.hypot(storage, loss), np.degrees(np.arctan2(loss, storage)), "k-", lw=0.9, zorder=1)
    panel.set(xscale="log")
    panel.set_ylim(bottom=0.0)
    return figure


def _spectrum(fit: Fit, bands: Bands) -> Figure:
    kind = fit.data.kind
    figure, panel = _axes("Relaxation time (s)", f"${kind}_i$ (MPa)")
    low, high = fit.window
    panel.axvspan(1.0 / high, 1.0 / low, color="0.93", linewidth=0.0, zorder=0)
    if bands.samples:
        least, most = bands.of("moduli")
        floor = 1e-3 * fit.moduli.min()
        panel.vlines(fit.times, np.maximum(least, floor), most, color="0.5", lw=2.2, alpha=0.6)
    panel.plot(fit.times, fit.moduli, "o", color="#332288", ms=3.0)
    panel.axhline(fit.static, color="#cc6677", lw=0.9, linestyle="--", label=f"${kind}_\\infty$")
    panel.set(xscale="log", yscale="log")
    panel.set_ylim(bottom=0.3 * min(fit.moduli.min(), fit.static))
    panel.set_title("Grey: measured window", loc="left")
    _legend(panel, loc="upper right")
    return figure


def _residuals(fit: Fit) -> Figure:
    kind = fit.data.kind
    figure, panel = _axes(_abscissa(fit), "Residual (%)")
    reduced = _reduced(fit)
    for values, name, colour, marker in zip(fit.residuals, ("'", "''"), ("#332288", "#cc6677"), "o^", strict=True):
        panel.plot(
            reduced, 100.0 * values, marker, color=colour, ms=_SIZE, markerfacecolor="none", label=f"${kind}{name}$"
        )
    panel.axhline(0.0, color="0.4", lw=0.5, zorder=0)
    panel.set(xscale="log")
    _legend(panel, loc="best", ncols=2)
    return figure
