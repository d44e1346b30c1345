"""Files of instruments, read by SurfaceTopography where the extra ``topography`` is installed."""

from __future__ import annotations

import numpy as np

from rubfric.arrays import Real
from rubfric.columns.units import factor
from rubfric.errors import InvalidInput
from rubfric.profile.scan import Scan

_HOW = "install it with   pip install 'rubfric[topography]'   or export the file as text (CSV) or ISO 25178-71 (.sdf)"


def read_topography(path: str) -> Scan:
    """Read a line or an areal scan in an instrument's own format.

    Parameters
    ----------
    path : str

    Raises
    ------
    InvalidInput
        Where SurfaceTopography is not installed, does not know the file, or finds no unit in it.
    """
    try:
        import SurfaceTopography
    except ImportError:
        raise InvalidInput(f"{path} is an instrument's own format, which SurfaceTopography reads: {_HOW}") from None
    try:
        found = SurfaceTopography.read_topography(path)
        heights: Real = np.ma.filled(np.ma.asarray(found.heights(), dtype=float), np.nan)
    except Exception as error:  # whatever its many readers raise
        raise InvalidInput(f"{path} cannot be read by SurfaceTopography ({type(error).__name__}: {error})") from error
    scale = factor("length", str(found.unit or ""))
    if scale is None:
        raise InvalidInput(f"{path} has the unit {found.unit!r}, but must say one of length: export it as text (CSV)")
    if not found.is_uniform:
        raise InvalidInput(f"{path} has points at uneven distances: export it as text (CSV)")
    sizes = [scale * one / count for one, count in zip(found.physical_sizes, found.nb_grid_pts, strict=True)]
    if heights.ndim == 1:
        return Scan(path, (sizes[0], sizes[0]), scale * heights[None, :])
    return Scan(path, (sizes[0], sizes[1]), scale * heights.T)
