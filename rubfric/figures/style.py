"""The look that all figures share, and how they are saved."""

from __future__ import annotations

import io
import math
import os
import threading
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Any

import matplotlib as mpl
import numpy as np
from matplotlib.colors import to_rgb
from matplotlib.figure import Figure

from rubfric.errors import InvalidInput
from rubfric.figures.palette import scale_colour
from rubfric.files import whole
from rubfric.results.selection import written

# Widths of a journal page, in inches as matplotlib wants them: 88 mm and 180 mm.
COLUMN = 88.0 / 25.4
DOUBLE_COLUMN = 180.0 / 25.4

# The fonts come with matplotlib, so that a figure looks the same on every machine.
RC_PARAMS: dict[str, Any] = {
    "font.family": ["DejaVu Sans"],
    "font.size": 7.0,
    "mathtext.fontset": "dejavusans",
    "axes.titlesize": 7.0,
    "axes.titlepad": 4.0,
    "axes.labelsize": 7.0,
    "axes.labelpad": 2.5,
    "axes.linewidth": 0.6,
    "axes.spines.top": False,
    "axes.spines.right": False,
    "axes.axisbelow": True,
    "xtick.labelsize": 6.5,
    "ytick.labelsize": 6.5,
    "xtick.major.width": 0.6,
    "ytick.major.width": 0.6,
    "ytick.minor.width": 0.4,
    "xtick.major.size": 3.0,
    "ytick.major.size": 3.0,
    "ytick.minor.size": 1.6,
    "lines.linewidth": 1.1,
    "lines.markersize": 4.0,
    "lines.markeredgewidth": 0.8,
    "hatch.linewidth": 0.4,
    "legend.fontsize": 6.5,
    "legend.title_fontsize": 6.5,
    "legend.frameon": False,
    "legend.handlelength": 3.0,
    "legend.borderaxespad": 0.3,
    "figure.constrained_layout.h_pad": 0.04,
    "figure.constrained_layout.w_pad": 0.04,
    "figure.dpi": 300.0,
    "savefig.dpi": 300.0,
    "savefig.bbox": "standard",
    "pdf.fonttype": 42,
}

# Markers and dashes repeat after 8 and after 5 series: 40 pairs, whatever becomes of the colours.
_MARKERS = ("o", "s", "^", "D", "v", "P", "X", "p")
_DASHES: tuple[Any, ...] = ("-", (0, (5, 1.5)), (0, (2.2, 1.2)), (0, (6, 1.5, 1.2, 1.5)), (0, (1, 1)))
# A ring around a point.
RING: dict[str, Any] = {
    **{"linestyle": "none", "marker": "o", "markersize": 8.0},
    **{"markerfacecolor": "none", "markeredgewidth": 0.9, "clip_on": False},
}
# Light hatches, of different direction or kind where areas touch.
HATCHES = ("////", "....", "\\\\\\\\", "xxxx", "----")
# Colours run from dark to light, evenly to the eye in colour, in grey and to the colour-blind;
# the lightest quarter of the map is too pale for a line on white.
_MAP = "plasma"
_LIGHTEST = 0.76

# Kinds without an order: the muted scheme of P. Tol (Colour Schemes, SRON/EPS/TN/09-002, 2021), which the colour-blind
# tell apart, and an orange.
_KINDS = (
    *("#332288", "#cc6677", "#117733", "#882255", "#44aa99"),
    *("#aa4499", "#999933", "#88ccee", "#ddaa33", "#e8601c"),
)

_METADATA: dict[str, dict[str, str | None]] = {
    "pdf": {"Creator": "rubfric", "CreationDate": None},
    "png": {},
}
# The parameters, the font cache and the parser of formulae of matplotlib are shared by all threads.
_LOCK = threading.RLock()


@contextmanager
def applied() -> Iterator[None]:
    """Draw with the shared look, one thread at a time; serves as a decorator too."""
    defaults: dict[Any, Any] = {key: mpl.rcParamsDefault[key] for key in mpl.rcParamsDefault if key != "backend"}
    with _LOCK, mpl.rc_context(defaults | RC_PARAMS):
        yield


def colours(count: int) -> list[Any]:
    """Return colours from dark to light, one for each of an ordered series."""
    return [mpl.colormaps[_MAP](place) for place in np.linspace(0.0, _LIGHTEST, count)]


def lines(count: int) -> list[dict[str, Any]]:
    """Return the colour, marker and dashes of each line of an ordered series, as keywords of ``Axes.plot``.

    Markers are full and open by turns, and not cut off at the axes.
    """
    looks = []
    for place, colour in enumerate(colours(count)):
        look = {
            "color": colour,
            "marker": _MARKERS[place % len(_MARKERS)],
            "linestyle": _DASHES[place % len(_DASHES)],
            "markerfacecolor": "white" if place % 2 else colour,
            "clip_on": False,
        }
        looks.append(look)
    return looks


def kinds(count: int) -> list[dict[str, Any]]:
    """Return the colour and marker of each of some kinds that have no order, as keywords of ``Axes.plot``.

    They repeat after forty kinds.
    """
    looks = []
    for place in range(count):
        colour = _KINDS[place % len(_KINDS)]
        face = "white" if place % 2 else colour
        looks.append({"color": colour, "marker": _MARKERS[place % len(_MARKERS)], "markerfacecolor": face})
    return looks


def dashes(count: int) -> list[Any]:
    """Return the dashes of each of some lines; they repeat after five."""
    return [_DASHES[place % len(_DASHES)] for place in range(count)]


def scale_area(scale: int) -> dict[str, Any]:
    """Return how the area of a scale is filled, 1 having the longest wave: its colour mixed with white, and hatched."""
    tint = tuple(0.45 * np.asarray(to_rgb(scale_colour(scale))) + 0.55)
    return {"facecolor": tint, "edgecolor": "0.15", "hatch": HATCHES[(scale - 1) % len(HATCHES)], "linewidth": 0.5}


def percent(share: float) -> str:
    """Return a share as it is printed in figures, with two digits at most, rounded up: 0.0123 is 1.3 %."""
    value = 100.0 * share
    if value <= 0.0 or not math.isfinite(value):
        return f"{value:g}\N{NO-BREAK SPACE}%"
    unit = 10.0 ** (math.floor(math.log10(value)) - 1)
    # What rounding adds to a number of two digits must not raise it.
    return f"{written(min(unit, 1.0) * math.ceil(value / min(unit, 1.0) - 1e-9))}\N{NO-BREAK SPACE}%"


def save(figure: Figure, *paths: str | os.PathLike[str]) -> None:
    """Write a figure to PDF and PNG files (300 dots per inch), each whole or not at all.

    The same figure gives the same bytes: no date is stored. Fonts are embedded as TrueType.

    Parameters
    ----------
    figure : matplotlib.figure.Figure
    *paths : path-like
        Names that end in ``.pdf`` or ``.png``; missing folders are created.

    Raises
    ------
    InvalidInput
        For any other ending; nothing is written then.
    """
    targets = [Path(path) for path in paths]
    for target in targets:
        if target.suffix[1:] not in _METADATA:
            endings = " or ".join(f".{ending}" for ending in _METADATA)
            raise InvalidInput(f"a figure cannot be saved as {target}, but its name must end in {endings}")
    with applied():
        lay_out(figure)
        for target in targets:
            _save_one(figure, target)


def png(figure: Figure, resolution: float = 200.0) -> bytes:
    """Return a figure as the bytes of a PNG file, for a page that holds it.

    Parameters
    ----------
    figure : matplotlib.figure.Figure
    resolution : float
        Dots per inch.
    """
    stream = io.BytesIO()
    with applied():
        lay_out(figure)
        figure.savefig(stream, format="png", dpi=resolution, metadata=_METADATA["png"])
    return stream.getvalue()


def lay_out(figure: Figure) -> None:
    """Lay out the panels once for all files; matplotlib would do it twice for each."""
    engine = figure.get_layout_engine()
    if engine is not None:
        engine.execute(figure)
        figure.set_layout_engine(None)


def _save_one(figure: Figure, target: Path) -> None:
    ending = target.suffix[1:]
    with whole(target) as part:
        figure.savefig(part, format=ending, metadata=_METADATA[ending])
