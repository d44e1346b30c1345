"""Areal scans as roads: files of ISO 25178-71, or what SurfaceTopography reads."""

from __future__ import annotations

from pathlib import Path

from rubfric.errors import InvalidInput
from rubfric.profile.sdf import is_sdf, read_sdf
from rubfric.profile.topography import read_topography
from rubfric.road.areal_scan import BLEND, ScannedRoad

_HEAD = 64


def scanned_road(path: str, degree: int = 1, blend: float = BLEND, cut_off: float | None = None) -> ScannedRoad:
    """Return a measured surface as a road.

    Parameters
    ----------
    path : str
    degree : {0, 1, 2}
        Of the form that is removed: mean, plane, or paraboloid.
    blend : float
        Share of the window over which its ends are blended.
    cut_off : float, optional
        Shortest wavelength that is kept, mm.

    Raises
    ------
    InvalidInput
        For a file that cannot be read, or is no areal scan.
    """
    try:
        with Path(path).open("rb") as stream:
            head = stream.read(_HEAD)
    except OSError as error:
        raise InvalidInput(f"{path} cannot be read: {error.strerror}") from error
    scan = read_sdf(path) if is_sdf(head) else read_topography(path)
    try:
        return ScannedRoad.of_heights(scan.heights, scan.spacing, degree=degree, blend=blend, cut_off=cut_off)
    except InvalidInput as error:
        raise InvalidInput(f"{path}: {error}") from error
