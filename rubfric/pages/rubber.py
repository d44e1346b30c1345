"""The page of a fitted rubber: what was found, how sure it is, figures, and the entry for the config."""

from __future__ import annotations

import base64
import math
from collections.abc import Iterator

import numpy as np

from rubfric.dma.bootstrap import Bands
from rubfric.dma.result import Fit
from rubfric.figures.dma import draw
from rubfric.figures.style import png
from rubfric.pages.render import render, sentence

_CAPTIONS = {
    "isotherms": "Moduli as measured, at each temperature.",
    "master curve": "Master curve: isotherms shifted to the reference temperature, the fit, and its 95 % band.",
    "shift factors": "Shift factors: the law beside free shifts, with two standard errors.",
    "loss factor": "Loss factor over reduced frequency.",
    "van Gurp-Palmen plot": "Phase angle over the modulus needs no shifting along the frequency: where isotherms leave "
    "the common curve, shifting is not legitimate.",
    "spectrum": "Moduli of the branches with 95 % bands. Branches outside the measured window shape its ends only.",
    "residuals": "Residuals, relative to the measured moduli. A trend is what the model does not hold.",
}


def rubber_page(fit: Fit, bands: Bands, name: str, entry: str, home: str = "") -> str:
    """Return the page.

    Parameters
    ----------
    fit : Fit
    bands : Bands
    name : str
        The rubber's name.
    entry : str
        Its entry in a config, as YAML.
    home : str
        Link to the page of all results; none where it is empty.
    """
    low, high = fit.window
    where = "a master curve" if fit.data.is_master else f"{len(fit.data.temperatures)} temperatures"
    lead = (
        f"Fitted to {len(fit.data.storage)} points of {where} in {fit.data.source}, from {low / math.tau:.3g} to "
        f"{high / math.tau:.3g} Hz of reduced frequency. Beyond that window the rubber is extrapolated."
    )
    figures = [
        (key, _CAPTIONS[key], base64.b64encode(png(figure)).decode("ascii")) for key, figure in draw(fit, bands).items()
    ]
    return render(
        "rubber.html",
        title=f"Rubber {name}",
        lead=lead,
        home=home,
        warnings=[sentence(words) for words in (*fit.warnings, *fit.data.notes)],
        rows=list(results(fit, bands)),
        figures=figures,
        branches=list(_branches(fit, bands)),
        entry=entry,
    )


def results(fit: Fit, bands: Bands) -> Iterator[tuple[str, str, str]]:
    """Yield name, value and 95 % band of what was fitted.

    Parameters
    ----------
    fit : Fit
    bands : Bands
    """
    storage, loss = fit.rms
    kind = fit.data.kind
    yield f"Residual of {kind}', rms", f"{storage:.2%}", ""
    yield f"Residual of {kind}'', rms", f"{loss:.2%}", ""
    if not fit.data.is_master:
        yield "Reference temperature", f"{fit.reference:g} °C", ""
        yield "Law of shifting", {"wlf": "WLF", "arrhenius": "Arrhenius", "free": "free shifts"}[fit.law], ""
    for name, label, unit in (
        ("c1", "C1", ""),
        ("c2", "C2", " K"),
        ("activation_energy", "Activation energy", " kJ/mol"),
    ):
        value = getattr(fit, name)
        if not math.isnan(value):
            yield label, f"{value:.4g}{unit}", _band(bands, name, unit)
    yield f"Static modulus {kind}", f"{fit.static:.4g} MPa", _band(bands, "static", " MPa")
    yield f"Instantaneous modulus {kind}", f"{fit.static + fit.moduli.sum():.4g} MPa", ""
    if bands.temperature_error > 0.0:
        yield "Error of the temperatures, from the scatter of shifts", f"{bands.temperature_error:.2g} K", ""
    low, high = fit.window
    yield "Branches", f"{len(fit.times)}, {len(fit.times) / math.log10(high / low):.2g} a decade", ""


def _band(bands: Bands, name: str, unit: str) -> str:
    if not bands.samples:
        return ""
    low, high = bands.of(name)
    return f"{low:.4g} to {high:.4g}{unit}"


def _plain(value: float) -> str:
    """Return a modulus with three digits that count, without an exponent."""
    return np.format_float_positional(value, 3, fractional=False, trim="-")


def _branches(fit: Fit, bands: Bands) -> Iterator[tuple[str, str, str, str]]:
    low, high = bands.of("moduli") if bands.samples else (fit.moduli, fit.moduli)
    total = fit.static + fit.moduli.sum()
    for time, modulus, least, most in zip(fit.times, fit.moduli, low, high, strict=True):
        band = f"{_plain(least)} to {_plain(most)}" if bands.samples else ""
        yield f"{time:.4g}", f"{modulus:.4g}", band, f"{modulus / total:.3g}"
