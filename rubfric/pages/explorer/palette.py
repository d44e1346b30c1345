"""Colours of the page: those of the figures, as plotly has them."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np
from plotly import colors

from rubfric.figures.palette import scale_colour

# Ordered curves run over the same part of the same map as in the figures: its lightest quarter is too pale on white.
_ORDERED, _LIGHTEST = "Plasma", 0.76
# Other rubbers and roads beside the ordered curves: none of their hues.
_BESIDE = ("#117733", "#44aa99", "#999933", "#88ccee", "#666666")


def palette(pressures: int, scales: Sequence[int]) -> dict[str, Any]:
    """Return the colours of pressures and scales, and evenly spaced stops of the two maps, from low to high.

    Parameters
    ----------
    pressures : int
        How many of them.
    scales : sequence of int
        Their numbers, from 1 for the longest wave: a scale has its colour in every campaign.

    Returns
    -------
    dict
        ``pressures``, ``scales``, ``beside``, ``energy`` and ``friction``: hexadecimal colours.
    """
    places = np.linspace(0.0, _LIGHTEST, pressures).tolist()
    ordered = colors.sample_colorscale(_ORDERED, places, colortype="tuple")
    return {
        "pressures": [_hexadecimal(colour) for colour in ordered],
        "scales": [scale_colour(number) for number in scales],
        "beside": list(_BESIDE),
        "energy": _stops("Viridis"),
        "friction": _stops("dense"),
    }


def _stops(name: str) -> list[str]:
    sampled = colors.sample_colorscale(name, np.linspace(0.0, 1.0, 12).tolist(), colortype="tuple")
    return [_hexadecimal(colour) for colour in sampled]


def _hexadecimal(colour: tuple[float, ...]) -> str:
    return "#" + "".join(f"{round(255 * part):02x}" for part in colour)
