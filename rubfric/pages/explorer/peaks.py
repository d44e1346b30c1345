"""Whether friction has a peak among the speeds that were run, and where it can be."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

# With fewer points no peak can lie between others.
_FEWEST = 3


def find_peak(friction: NDArray[np.float64], error: NDArray[np.float64]) -> dict[str, Any]:
    """Return what a curve says of its peak, given how well its points are known.

    Parameters
    ----------
    friction : numpy.ndarray, shape (speeds,)
        In ascending order of the speeds, dimensionless; NaN where nothing is known.
    error : numpy.ndarray, shape (speeds,)
        Absolute; NaN, unknown, counts as none.

    Returns
    -------
    dict
        ``kind``: ``peak``, ``rising`` or ``falling`` where the last or the first point is highest, ``level`` where the
        highest cannot be told from one at an end, ``few`` points or ``none``. ``at``: number of the highest point, or
        None. ``between``: for a peak, the numbers of the points that enclose every point which may be the highest, so
        that a curve with a single peak has it between them; or None. ``missing``: how many points are not known.
    """
    known = np.flatnonzero(np.isfinite(friction))
    found: dict[str, Any] = {"kind": "none", "at": None, "between": None, "missing": int(friction.size - known.size)}
    if not known.size:
        return found
    values, slack = friction[known], np.nan_to_num(error[known], nan=0.0)
    top = int(np.argmax(values))
    found["at"] = int(known[top])
    highest = np.flatnonzero(values + slack >= values[top] - slack[top])
    first, last = int(highest[0]), int(highest[-1])
    if known.size < _FEWEST:
        found["kind"] = "few"
    elif first > 0 and last < known.size - 1:
        found |= {"kind": "peak", "between": [int(known[first - 1]), int(known[last + 1])]}
    elif top == known.size - 1 and first > 0:
        found["kind"] = "rising"
    elif top == 0 and last < known.size - 1:
        found["kind"] = "falling"
    else:
        found["kind"] = "level"
    return found
