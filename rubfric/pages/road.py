"""The page of a measured road: what was removed, what it is like, figures, and the entry for the config."""

from __future__ import annotations

import base64
import math
from collections.abc import Iterator

from rubfric.figures.road import draw
from rubfric.figures.style import png
from rubfric.pages.render import render, sentence
from rubfric.profile.analysis import Analysis
from rubfric.profile.walls import STEEP

_CAPTIONS = {
    "before and after": "The profile as measured, with what was taken out of it, and as it is used.",
    "height distribution": "Heights of the clean profile beside a normal distribution of the same variance.",
    "spectrum": "Power spectral density along the line, one-sided: its integral over q is the variance. Grey: not "
    "to be trusted.",
    "slope and height by octave": "What octaves of wavelength hold. Friction grows with slopes. Hatched: not to be "
    "trusted.",
    "mean profile depth": "Segments of 100 mm without waves below 2.4 mm and without their slope, their two highest "
    "points, and the mean of these.",
    "window": "The first window: made periodic by blending, and without waves shorter than the cutoff.",
}


# Figures as wide as the page.
_DOUBLE = ("before and after", "mean profile depth", "window")


def road_page(found: Analysis, name: str, entry: str, home: str = "") -> str:
    """Return the page.

    Parameters
    ----------
    found : Analysis
    name : str
        The road's name.
    entry : str
        Its entry in a config, as YAML.
    home : str
        Link to the page of all results; none where it is empty.
    """
    profile = found.cleaned.measured
    figures = [
        (key, _CAPTIONS[key], base64.b64encode(png(figure)).decode("ascii")) for key, figure in draw(found).items()
    ]
    lead = (
        f"Read from {profile.source}: {len(profile.heights)} points {profile.spacing:.4g} mm apart, "
        f"{profile.length:.4g} mm in all."
    )
    return render(
        "road.html",
        title=f"Road {name}",
        lead=lead,
        home=home,
        warnings=[sentence(words) for words in (*found.warnings(), *profile.notes)],
        removed=list(found.cleaned.removed),
        rows=list(results(found)),
        octaves=[
            (f"{one.wavelength:.3g}", f"{one.height:.3g}", f"{one.slope:.3g}", "yes" if found.is_trusted(one) else "no")
            for one in found.octaves
        ],
        figures=figures,
        double=_DOUBLE,
        entry=entry,
    )


def results(found: Analysis) -> Iterator[tuple[str, str]]:
    """Yield name and value of what was found.

    Parameters
    ----------
    found : Analysis
    """
    profile = found.cleaned.profile
    rms, skewness, kurtosis = found.moments
    shortest, longest = found.band.wavelengths
    yield "Clean profile", f"{profile.length:.4g} mm from {profile.start:.4g} mm on"
    yield "Root mean square height", f"{rms:.4g} mm"
    yield "Skewness, kurtosis (3 if normal)", f"{skewness:.3g}, {kurtosis:.3g}"
    yield f"Root mean square slope, waves of {shortest:.3g} mm and longer", f"{found.slope:.3g}"
    if found.walls.count:
        steep = found.walls
        words = f"{steep.count}, up to {steep.highest:.3g} mm high, {steep.share:.0%} of the mean square slope"
        yield f"Walls, steeper than {STEEP:g} from height to height", words
    depth = found.depth
    if math.isfinite(depth.mean):
        scatter = f" ± {depth.scatter:.2g}" if math.isfinite(depth.scatter) else ""
        yield (
            "Mean profile depth, ISO 13473-1",
            f"{depth.mean:.3g}{scatter} mm, {len(depth.segments)} segments of 100 mm",
        )
    yield "Wavelengths to be trusted", f"{shortest:.3g} to {longest:.3g} mm"
    yield "Shortest bounded by", found.band.why_high
    yield "Longest bounded by", found.band.why_low
    if not math.isnan(found.band.roll_off):
        yield "Spectrum flattens above", f"{2.0 * math.pi / found.band.roll_off:.3g} mm"
    if found.hurst is not None:
        law = found.hurst
        between = f"from {2.0 * math.pi / law.high:.3g} to {2.0 * math.pi / law.low:.3g} mm"
        yield f"Hurst exponent, {between}", f"{law.exponent:.3f} ± {law.error:.3f} (95 %)"
        if 0.0 < law.exponent < 1.0:
            yield "Fractal dimension of the profile, 2 - H", f"{2.0 - law.exponent:.3f}"
    yield "Windows", f"{found.windows} of {found.window:.4g} mm, {found.blend:.0%} of each blended"
    yield "Cutoff", f"{found.cutoff:g} mm"


def lost(found: Analysis) -> str:
    """Return in a sentence what the sines keep of the road.

    Parameters
    ----------
    found : Analysis
    """
    waves, heights = found.sines.waves, found.cleaned.heights
    height, slope = (
        math.sqrt(0.5 * float(((waves.amplitudes * waves.wavenumbers**order) ** 2).sum())) for order in (0, 1)
    )
    of_road = math.sqrt(found.spectrum.integral(0.0, 2.0 * math.pi / found.cutoff, 1))
    whole = float(heights.std())
    return (
        f"{len(waves.amplitudes)} sines with an rms height of {height:.3g} mm (the profile: {whole:.3g} mm, with "
        f"longer waves) and an rms slope of {slope:.3g} (the profile down to {found.cutoff:g} mm: {of_road:.3g}); its "
        "phases, its height distribution and its steepest places are lost"
    )
