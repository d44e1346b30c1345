"""The colours of the scales of a road, the same in figures and pages."""

from __future__ import annotations

# From the muted scheme of P. Tol (Colour Schemes, SRON/EPS/TN/09-002, 2021), which the colour-blind tell apart.
SCALES = ("#332288", "#cc6677", "#117733", "#ddaa33", "#88ccee", "#882255", "#44aa99", "#999933", "#aa4499")


def scale_colour(scale: int) -> str:
    """Return the colour of a scale, of which 1 has the longest wave; colours repeat after nine scales."""
    return SCALES[(scale - 1) % len(SCALES)]
