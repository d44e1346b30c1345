"""The result of a scene on an areal road as a dataset: maps, friction by wavelength, Persson's theory beside it."""

from __future__ import annotations

import json
import math
from typing import Any

import numpy as np
import xarray as xr
from scipy import fft

import rubfric
from rubfric.arrays import Real
from rubfric.mechanics.areal.steady import ArealSolution
from rubfric.mechanics.theory.persson_areal import persson_areal
from rubfric.results.provenance import CONVENTIONS, SOFTWARE
from rubfric.results.scalars import attributes

# Bands of wavelengths in which friction is summed, an octave.
_BANDS = 4

_FINITE = (
    "small strain; what finite strain would change is not in the error: rubfric simulate with kinematics auto "
    "estimates it for ridges of the same slopes"
)


def build(solution: ArealSolution, wall_time: float) -> xr.Dataset:
    """Return the dataset of a solved scene on an areal road.

    Parameters
    ----------
    solution : ArealSolution
    wall_time : float
        Of the solution, s.

    Returns
    -------
    xarray.Dataset
        ``road_height``, ``gap``, ``displacement`` (mm) and ``contact_pressure`` (MPa) over ``y`` and ``x``; friction by
        ``wavelength``; what each mesh came to; scalars, and the scene's parameters.
    """
    scene, fine = solution.scene, solution.meshes[-1]
    spectrum, (ny, nx) = scene.road.spectrum, fine.shape
    axes = {
        name: (name, period / nodes * np.arange(nodes), attributes("mm", f"position along {name}, repeating"))
        for name, period, nodes in zip("xy", spectrum.periods, (nx, ny), strict=True)
    }
    maps = {
        "road_height": (spectrum.heights(fine.shape), "mm", "height of the road above its mean plane"),
        "contact_pressure": (solution.contact.pressure, "MPa", "pressure of the road on the rubber"),
        "gap": (solution.contact.gap, "mm", "height of the rubber above the road"),
        "displacement": (
            solution.displacement,
            "mm",
            "displacement of the surface away from the road, but for its mean",
        ),
    }
    variables: dict[str, Any] = axes | {
        name: (("y", "x"), field, attributes(unit, about)) for name, (field, unit, about) in maps.items()
    }
    variables |= _by_wavelength(solution) | _by_mesh(solution)
    variables |= {
        name: ((), value, attributes(unit, about)) for name, (value, unit, about) in _scalars(solution).items()
    }
    variables["wall_time"] = ((), wall_time, attributes("s", "time that the scene took"))
    warnings = [_FINITE]
    if not solution.resolved:
        warnings.append(
            f"the estimated error exceeds the accuracy asked for, {scene.numerics.accuracy:g}: raise numerics.nodes_max"
        )
    return xr.Dataset(variables, attrs=_provenance(solution) | {"warnings": "\n".join(warnings)})


def _scalars(solution: ArealSolution) -> dict[str, tuple[float, str, str]]:
    scene, fine = solution.scene, solution.meshes[-1]
    theory, later = (
        persson_areal(
            scene.material,
            scene.road.spectrum,
            scene.velocity,
            scene.pressure,
            scene.height,
            scene.direction,
            gamma,
        )
        for gamma in (1.0, 0.5)
    )
    return {
        "friction_coefficient": (solution.friction_coefficient, "1", "friction coefficient, from what waves dissipate"),
        "friction_error": (solution.friction_error, "1", "estimated error of the friction coefficient, absolute"),
        "friction_coefficient_contact": (fine.contact, "1", "friction coefficient from pressures on slopes"),
        "friction_across": (fine.across, "1", "force across the direction of sliding over the load, towards its left"),
        "contact_fraction": (fine.fraction, "1", "contact area over nominal area"),
        "persson_friction": (theory.friction_coefficient, "1", "friction coefficient by Persson 2001, S = 1"),
        "persson_friction_reduced": (
            later.friction_coefficient,
            "1",
            "friction coefficient by Persson 2006, gamma = 1/2",
        ),
        "persson_contact_fraction": (theory.contact_fraction, "1", "contact area over nominal area by Persson"),
        "rms_height": (scene.road.spectrum.rms_height, "mm", "root mean square of the road's heights"),
        "rms_slope": (scene.road.spectrum.rms_slope, "1", "root mean square of the road's gradient"),
        "block_height": (scene.height, "mm", "height of the block"),
    }


def _by_wavelength(solution: ArealSolution) -> dict[str, Any]:
    """Return what waves of pressure dissipate, in quarters of an octave of their wavelength."""
    shape, (lx, ly) = solution.meshes[-1].shape, solution.scene.road.spectrum.periods
    ny, nx = shape
    lost = solution.dissipated()
    kx, ky = np.arange(nx // 2 + 1) / lx, fft.fftfreq(ny, 1.0 / ny) / ly
    number = np.hypot(kx, ky[:, None]).ravel()[1:]  # without the mean
    band = np.floor(_BANDS * np.log2(number / number.min()) + 0.5).astype(int)
    total = np.bincount(band, weights=lost.ravel()[1:])
    length: Real = 2.0 ** (-np.arange(len(total)) / _BANDS) / number.min()
    return {
        "wavelength": (
            "wavelength",
            length,
            attributes("mm", "middle of a band of wavelengths, a quarter of an octave"),
        ),
        "friction_by_wavelength": ("wavelength", total, attributes("1", "friction coefficient that the band adds")),
    }


def _by_mesh(solution: ArealSolution) -> dict[str, Any]:
    meshes = solution.meshes
    columns = {
        "mesh_nodes": ([math.prod(mesh.shape) for mesh in meshes], "nodes of a resolution"),
        "mesh_friction_coefficient": ([mesh.dissipation for mesh in meshes], "friction coefficient on it"),
        "mesh_contact_fraction": ([mesh.fraction for mesh in meshes], "contact area over nominal area on it"),
    }
    return {name: ("mesh", np.array(values), attributes("1", about)) for name, (values, about) in columns.items()}


def _provenance(solution: ArealSolution) -> dict[str, Any]:
    scene, contact = solution.scene, solution.contact
    warm = {} if scene.temperature is None else {"temperature": scene.temperature}
    return warm | {
        "title": f"Steady sliding of a rubber block on an areal road: {scene.name}",
        "Conventions": CONVENTIONS,
        "source": f"rubfric {rubfric.__version__}",
        "software": SOFTWARE,
        "scene": scene.name,
        "scene_parameters": json.dumps(scene.parameters(), sort_keys=True),
        "scene_digest": scene.digest,
        "rubber": scene.material.name,
        "kinematics": "small",
        "velocity": scene.velocity,
        "pressure": scene.pressure,
        "direction": scene.direction,
        "units_of_attributes": "velocity mm s-1, pressure MPa, direction degrees, temperature degC",
        "solver_history": f"{contact.pivots} pivoting and {contact.splittings} splitting steps on all nodes",
    }
