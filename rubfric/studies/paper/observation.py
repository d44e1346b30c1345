"""What claims are judged by, scene by scene: scalars of the result, and how strain energy falls over the depth."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from typing import Any

import numpy as np
import pandas as pd
import xarray as xr

from rubfric.errors import InvalidInput, NotConverged
from rubfric.mechanics.theory.limits import estimated_fraction
from rubfric.scene.scene import ALL, Scene
from rubfric.simulation import simulate

SCALARS = ("friction_coefficient", "friction_coefficient_error", "contact_fraction", "columns", "nominal_compression")
DEPTH = {
    "depth_fall": "strain-energy density at the road less that at the top, over the largest",
    "depth_rise": "largest rise of strain-energy density with distance from the road, over the largest",
    "depth_unsteadiness": "range of strain-energy density in the third of the block away from the road, over the "
    "largest",
}
AXES = ("scale", "velocity", "pressure", "aspect")
# Columns that are text: the scene that was simulated, and why it was refused.
WORDS = ("scene_digest", "note")
# The number of the whole road among the scales.
WHOLE = 0
# Contact fraction beyond which all scales at once are not solved in finite strain, and why in words.
_MOST_CONTACT = 0.05
DEAR = f"over {_MOST_CONTACT:.0%} of the road is in contact, where all scales at once may take minutes in finite strain"


def depth_measures(result: xr.Dataset) -> dict[str, float]:
    """Return how far strain energy falls over the depth of a scene's result, rises again, and settles.

    Returns
    -------
    dict of str to float
        The measures of ``DEPTH``, dimensionless, of the mean over a wavelength as a function of the distance from the
        road.
    """
    profile = result["strain_energy_density_profile"]
    density = np.asarray(profile.values, dtype=np.float64)
    distance = np.asarray(profile[profile.dims[0]].values, dtype=np.float64)
    largest = float(density.max())
    if largest <= 0.0:
        return dict.fromkeys(DEPTH, 0.0)
    top = density[distance >= distance[0] + 2.0 / 3.0 * (distance[-1] - distance[0])]
    measures = (
        density[0] - density[-1],
        (density - np.minimum.accumulate(density)).max(),
        np.ptp(top),
    )
    return {name: float(measure) / largest for name, measure in zip(DEPTH, measures, strict=True)}


def observe(scene: Scene) -> dict[str, Any]:
    """Simulate a scene and return what claims are judged by; a scene that is refused has its reason in ``note``.

    So has a whole road that would take minutes.
    """
    row: dict[str, Any] = {name: getattr(scene, name) for name in AXES} | {"scene_digest": scene.digest}
    if scene.scale == ALL:
        row["scale"] = WHOLE
        if scene.kinematics != "small" and estimated_fraction(scene) > _MOST_CONTACT:
            return row | {"note": DEAR}
    try:
        result = simulate(scene)
    except (InvalidInput, NotConverged) as refusal:
        return row | {"note": str(refusal)}
    return row | {name: float(result[name]) for name in SCALARS} | depth_measures(result) | {"note": ""}


def profile_row(result: xr.Dataset) -> dict[str, Any]:
    """Return the coordinates of a result on the axes, and its measures over the depth."""
    return {name: float(result.attrs[name]) for name in AXES} | depth_measures(result)


def refusals(observations: pd.DataFrame) -> str:
    """Return in a sentence how many scenes were refused, and why the first was; empty if none was."""
    refused = observations[observations["friction_coefficient"].isna()]
    if refused.empty:
        return ""
    return f"{len(refused)} of {len(observations)} scenes were refused, the first since {refused['note'].iloc[0]}."


def among(observations: pd.DataFrame, chosen: Mapping[str, Iterable[float]]) -> pd.Series:
    """Return which observations have one of the chosen values on each of the named axes.

    Parameters
    ----------
    observations : pandas.DataFrame
        As from ``table``.
    chosen : mapping of str to iterable of float
        Values on each axis: scale, velocity (mm/s), pressure (MPa) or aspect.

    Returns
    -------
    pandas.Series of bool
    """
    fits = [observations[axis].isin(list(values)) for axis, values in chosen.items()]
    return pd.concat(fits, axis=1).all(axis=1)


def table(rows: Iterable[Mapping[str, Any]]) -> pd.DataFrame:
    """Return observations as a table with all columns, whether or not any scene was solved."""
    return pd.DataFrame(list(rows), columns=[*AXES, *SCALARS, *DEPTH, *WORDS])


def over_axes(observations: pd.DataFrame) -> xr.Dataset:
    """Return observations over scale, velocity (mm/s), pressure (MPa) and aspect; NaN where there is none.

    Parameters
    ----------
    observations : pandas.DataFrame
        As from ``table``; each scene once.
    """
    numbers = observations.drop(columns=list(WORDS)).astype(dict.fromkeys((*SCALARS, *DEPTH), float))
    return numbers.set_index(list(AXES)).to_xarray()
