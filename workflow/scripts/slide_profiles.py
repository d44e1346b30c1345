"""Slide over profiles of an areal road in the plane model, and write what they came to."""

from typing import Any

from rubfric.areal_plane import slide_profiles
from rubfric.profile.areal import scanned_road
from rubfric.results.dataset import write
from rubfric.scene.areal import ArealScene


def main(output: str, parameters: dict[str, Any], profiles: int, scan: dict[str, Any] | None = None) -> None:
    """Slide over the profiles and write the result.

    Parameters
    ----------
    output : str
        Path of the result (netCDF).
    parameters : dict
        Those of the ``ArealScene``.
    profiles : int
        How many.
    scan : dict, optional
        Arguments of ``scanned_road``, where the road is a scan.
    """
    road = scanned_road(**scan) if scan else None
    result = slide_profiles(ArealScene.from_parameters(parameters, road), profiles)
    write(result, output)
    print(f"friction coefficient {float(result.friction_coefficient.mean()):.5g}, the mean of {profiles} profiles")
    print(result.attrs["refused"])
