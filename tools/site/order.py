"""The order of the examples: from one scene to what a measurement, an export and an error are worth."""

from __future__ import annotations

_FIRST = (
    "one_scene",
    "friction_over_speed",
    "friction_over_pressure",
    "temperature",
    "small_or_finite",
    "whole_road",
    "two_compounds",
    "measured_rubber",
    "road_spectrum",
    "cutoff",
    "windows",
    "areal_contact",
    "persson",
    "start_of_sliding",
    "friction_surface",
    "result_file",
    "accuracy",
    "three_routes",
    "westergaard",
)


class ReadingOrder:
    """Sort the scripts of a gallery; those without a place come last, by their names."""

    def __init__(self, folder: str) -> None:
        self.folder = folder

    def __call__(self, file: str) -> tuple[int, str]:
        """Return what the file is sorted by."""
        name = file.removeprefix("plot_").removesuffix(".py")
        return (_FIRST.index(name) if name in _FIRST else len(_FIRST)), file
