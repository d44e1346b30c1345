"""What the plane model makes of an areal road: its profiles along the direction of sliding, taken for ridges."""

from __future__ import annotations

import json

import numpy as np
import xarray as xr

import rubfric
from rubfric.arrays import Real
from rubfric.errors import InvalidInput, RubfricError
from rubfric.mechanics.small.steady import solve_small
from rubfric.mechanics.steady.error import friction_error
from rubfric.mechanics.theory.kinematics import Decision
from rubfric.results.provenance import CONVENTIONS, SOFTWARE
from rubfric.results.scalars import attributes
from rubfric.road.profile import ProfileRoad
from rubfric.scene.areal import ArealScene
from rubfric.scene.numerics import Numerics
from rubfric.scene.scene import ALL, Scene

_SMALL = Decision("small", 0.25, "areal roads are solved in small strain")
_COLUMNS = {
    "friction_coefficient": "friction coefficient on a profile, by the plane model",
    "friction_coefficient_error": "its estimated error, absolute",
    "contact_fraction": "contact area over nominal area on a profile",
}


def slide_profiles(scene: ArealScene, count: int) -> xr.Dataset:
    """Slide over profiles of an areal road in the plane model: plane strain, small strain, a block of the same height.

    Parameters
    ----------
    scene : ArealScene
    count : int
        Profiles, evenly spread over the road.

    Returns
    -------
    xarray.Dataset
        Friction, its error and contact by ``profile``; NaN where a profile was refused, and why in the attribute
        ``refused``, a sentence a line.
    """
    rows, refused = [], []
    try:
        profiles: list[Real] = list(profile_heights(scene, count))
    except InvalidInput as error:
        profiles, refused = [], [str(error)]
    for number, heights in enumerate(profiles, 1):
        try:
            solution = solve_small(_ridges(scene, heights), _SMALL)
        except RubfricError as error:
            refused.append(f"profile {number}: {error}")
            rows.append((np.nan, np.nan, np.nan))
        else:
            friction = solution.friction.stress_power
            rows.append((friction, friction_error(solution), solution.contact_fraction))
    values = np.array(rows).reshape(-1, len(_COLUMNS))
    variables = {
        name: ("profile", values[:, place], attributes("1", about))
        for place, (name, about) in enumerate(_COLUMNS.items())
    }
    about = {
        "title": f"Profiles of an areal road in the plane model: {scene.name}",
        "Conventions": CONVENTIONS,
        "source": f"rubfric {rubfric.__version__}",
        "software": SOFTWARE,
        "scene": scene.name,
        "scene_parameters": json.dumps(scene.parameters(), sort_keys=True),
        "scene_digest": scene.digest_of_profiles(count),
        "velocity": scene.velocity,
        "pressure": scene.pressure,
        "units_of_attributes": "velocity mm s-1, pressure MPa",
        "refused": "\n".join(refused),
    }
    return xr.Dataset(variables, attrs=about)


def profile_heights(scene: ArealScene, count: int) -> Real:
    """Return profiles of the road in the direction of sliding, from one end of its period to the other.

    Parameters
    ----------
    scene : ArealScene
        That slides along x or y, forwards or backwards: profiles in other directions do not repeat.
    count : int

    Returns
    -------
    ndarray, shape (count, points)
        mm.

    Raises
    ------
    InvalidInput
        For another direction.
    """
    turns, rest = divmod(scene.direction, 90.0)
    if rest:
        raise InvalidInput(
            f"the direction is {scene.direction:g} degrees, but profiles repeat along 0, 90, 180 and 270 degrees only"
        )
    spectrum = scene.road.spectrum
    nx, ny = (2 * int(number) + 2 for number in np.abs(spectrum.harmonics).max(axis=0, initial=1))
    along_y = bool(int(turns) % 2)
    nx, ny = (-(-nx // count) * count, ny) if along_y else (nx, -(-ny // count) * count)
    heights = spectrum.heights((ny, nx))
    lines = heights.T if along_y else heights
    lines = lines[:: len(lines) // count]
    return lines[:, ::-1] if int(turns) % 4 in (2, 3) else lines


def _ridges(scene: ArealScene, heights: Real) -> Scene:
    """Return the scene on a profile."""
    period = scene.road.spectrum.periods[int(scene.direction // 90.0) % 2]
    waves = (len(heights) - 1) // 2
    road = ProfileRoad.of_heights(heights, period, period / waves)
    aspect = float(f"{scene.height / road.wavelength:.6g}")
    numerics = Numerics(accuracy=scene.numerics.accuracy)
    return Scene(
        ALL,
        road,
        scene.velocity,
        scene.pressure,
        aspect,
        scene.material,
        plane="strain",
        kinematics="small",
        numerics=numerics,
        temperature=scene.temperature,
    )
