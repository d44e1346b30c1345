"""What every file of a scene says about it, and the file of a scene that was refused."""

from __future__ import annotations

import json
import platform
from importlib.metadata import version
from typing import Any

import xarray as xr

import rubfric
from rubfric.results.selection import REFUSAL
from rubfric.road.waves import WaveRoad
from rubfric.scene.scene import ALL, Scene
from rubfric.sources import code

PAPER = "Zhou, Wang and Wei 2019, J. Eng. 2019(23), 8986-8990, doi:10.1049/joe.2018.9163"
CONVENTIONS = "CF-1.11 UGRID-1.0"
# Message about a result of other parameters.
OTHER_SCENE = "is the result of another scene, rubber or numerics than the config asks for"

# What a result is made by, as the workflow has it too; its code has a digest in every file.
SOLVER = "rubfric.simulation"
# Read once: looking up versions takes as long as a scene.
SOFTWARE = ", ".join(
    [f"Python {platform.python_version()}"]
    + [f"{name} {version(name)}" for name in ("numpy", "scipy", "scikit-fem", "xarray", "netCDF4")]
)


def about(scene: Scene, title: str) -> dict[str, Any]:
    """Return the attributes of the file of a scene: its parameters, its place in a campaign, and the versions.

    Parameters
    ----------
    scene : Scene
    title : str
    """
    attributes: dict[str, Any] = {
        "title": title,
        "Conventions": CONVENTIONS,
        "source": f"rubfric {rubfric.__version__}",
        "references": PAPER,
        "kinematics": scene.kinematics,
        "scene": scene.name,
        "scene_parameters": json.dumps(scene.parameters(), sort_keys=True),
        "scene_digest": scene.digest,
        "code_digest": code(SOLVER),
        "rubber": scene.material.name,
        "plane": scene.plane,
        "software": SOFTWARE,
    }
    units = {"velocity": "mm s-1", "pressure": "MPa", "aspect": "1", "scale": "1"}
    warm = {} if scene.temperature is None else {"temperature": "degC"}
    units |= warm
    attributes |= {name: getattr(scene, name) for name in units}
    attributes["scale"] = 0 if scene.scale == ALL else scene.scale
    road = {"amplitude": "mm", "wavenumber": "mm-1"}
    if isinstance(scene.road, WaveRoad):
        road["phase"] = "rad"
        attributes |= {name: getattr(scene.road.waves, f"{name}s") for name in road}
    else:
        attributes |= {name: getattr(scene.road, name) for name in road}
    listed = {"velocity": "mm s-1", "pressure": "MPa"} | warm | road
    attributes["units_of_attributes"] = ", ".join(f"{name} {unit}" for name, unit in listed.items())
    return attributes


def refusal(scene: Scene, reason: Exception | str) -> xr.Dataset:
    """Return what stands in place of the result of a scene that was refused.

    Parameters
    ----------
    scene : Scene
    reason : Exception or str
        InvalidInput or NotConverged, or the sentence that says why there is no result.

    Returns
    -------
    xarray.Dataset
        Without variables; ``rubfric.results.dataset.read`` refuses it with the reason, and
        ``rubfric.results.campaign.collect`` takes the scene for one without friction.
    """
    return xr.Dataset(attrs=about(scene, f"Refused: {scene.name}") | {REFUSAL: " ".join(str(reason).split())})
