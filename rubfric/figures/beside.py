"""Words beside a point of a panel, on the side where they cover least."""

from __future__ import annotations

from itertools import pairwise
from typing import Any

import numpy as np
from matplotlib.axes import Axes
from numpy.typing import NDArray

Array = NDArray[np.float64]

# The sides of a point, the preferred first: direction, and how the words are aligned.
_SIDES: tuple[tuple[tuple[float, float], str, str], ...] = (
    ((1.0, 0.0), "left", "center"),
    ((-1.0, 0.0), "right", "center"),
    ((0.7, 0.7), "left", "bottom"),
    ((-0.7, -0.7), "right", "top"),
    ((0.7, -0.7), "left", "top"),
    ((-0.7, 0.7), "right", "bottom"),
    ((0.0, -1.0), "center", "top"),
    ((0.0, 1.0), "center", "bottom"),
)
# Pieces in which a line counts as covered, and how much worse it is to cover words or to leave the panel.
_PIECES = 24
_WORSE = 1000


def write_beside(panel: Axes, place: tuple[float, float], words: str, lines: list[Array], distance: float) -> Any:
    """Write words beside a point where they cover the fewest pieces of lines, no other words, and stay in the panel.

    Parameters
    ----------
    panel : matplotlib.axes.Axes
        Laid out: its limits and its place in the figure are final.
    place : tuple of float
        The point, in the units of the axes.
    words : str
    lines : list of numpy.ndarray, each of shape (points, 2)
        What should not be covered, in the units of the axes.
    distance : float
        From the point to the words, points of type.

    Returns
    -------
    matplotlib.text.Annotation
    """
    written = [text.get_window_extent() for text in panel.texts]
    pieces = np.concatenate([_pieces(panel.transData.transform(line)) for line in lines]) if lines else np.empty((0, 2))
    tried = []
    for side, (direction, across, upright) in enumerate(_SIDES):
        note = panel.annotate(
            words,
            place,
            xytext=(distance * direction[0], distance * direction[1]),
            textcoords="offset points",
            ha=across,
            va=upright,
            fontweight="bold",
            zorder=5.0,
            in_layout=False,
        )
        box = note.get_window_extent().padded(1.5)
        inside = (pieces > (box.x0, box.y0)).all(axis=1) & (pieces < (box.x1, box.y1)).all(axis=1)
        frame = panel.get_window_extent()
        leaves = box.x0 < frame.x0 or box.x1 > frame.x1 or box.y0 < frame.y0 or box.y1 > frame.y1
        covers = any(box.overlaps(other) for other in written)
        tried.append((int(inside.sum()) + _WORSE * (leaves + covers), side, note))
    best = min(tried, key=lambda one: one[:2])[2]
    for _, _, note in tried:
        if note is not best:
            note.remove()
    return best


def _pieces(line: Array) -> Array:
    """Return points along a line, both ends included."""
    shares = np.linspace(0.0, 1.0, _PIECES)[:, None]
    parts = [(1.0 - shares) * start + shares * stop for start, stop in pairwise(line)]
    return np.concatenate([line, *parts])
