"""Why scenes have no result: what their files and a collection of them say. Light: figures and pages read it."""

from __future__ import annotations

import json

import xarray as xr

# The attribute that says why a scene has no result.
REFUSAL = "refusal"
# What a scene of the whole road says in its place that was not needed, before the way that will do.
NOT_NEEDED = "not needed: the accuracy is met by "
# The attribute of a collection that holds the coordinates of refused scenes, and why they were refused.
REFUSALS = "refusals"


def refusals(collected: xr.Dataset) -> dict[tuple[float, ...], str]:
    """Return why scenes of a collection were refused, by scale, velocity (mm/s), pressure (MPa) and aspect."""
    listed = json.loads(collected.attrs.get(REFUSALS, "[]"))
    return {tuple(float(number) for number in point): reason for point, reason in listed}
