"""The march of a scene as a dataset: every step, every wavelength, and the friction of the steady solver."""

from __future__ import annotations

import json
from dataclasses import asdict
from typing import Any

import numpy as np
import xarray as xr

import rubfric
from rubfric.mechanics.march.result import Transient
from rubfric.results.provenance import CONVENTIONS, PAPER
from rubfric.results.scalars import attributes
from rubfric.scene.procedure import PHASES
from rubfric.scene.scene import ALL, Scene

# record: (unit, long name)
RECORDS: dict[str, tuple[str, str]] = {
    "time": ("s", "time since pressing began"),
    "slid": ("mm", "distance slid"),
    "pressure": ("MPa", "nominal pressure"),
    "phase": ("1", "phase of the procedure: " + ", ".join(f"{place} {name}" for place, name in enumerate(PHASES))),
    "friction_contact": ("1", "friction coefficient from contact force, at the end of the step"),
    "friction_work": ("1", "friction coefficient from the work of the road, mean of the step"),
    "friction_energy": ("1", "friction coefficient from stored and dissipated energy, mean of the step"),
    "stored_energy": ("N", "strain energy stored in the block, N mm per mm of thickness"),
    "dissipated": ("N", "energy dissipated in the step, N mm per mm of thickness"),
    "road_work": ("N", "work of the road in the step, N mm per mm of thickness"),
    "load_work": ("N", "work of the load in the step, N mm per mm of thickness"),
    "imbalance": ("N", "imbalance of the first law in the step, N mm per mm of thickness"),
    "contact_fraction": ("1", "contact area over nominal area, counted by nodes"),
    "top_displacement": ("mm", "mean displacement of the top away from the road"),
    "iterations": ("1", "Newton steps or pivoting steps"),
    "krylov": ("1", "applications of the tangent stiffness"),
    "halvings": ("1", "number of times the step was halved"),
}
_SCALARS: dict[str, tuple[str, str]] = {
    "saturated": ("1", "1 where friction stayed within the tolerance over the memory of the rubber, else 0"),
    "saturation_friction": ("1", "friction coefficient, mean over the last wavelength"),
    "saturation_wavelengths": ("1", "wavelengths slid at full speed"),
    "saturation_needed": ("1", "wavelengths over which friction must not change"),
    "saturation_variation": ("1", "relative variation of friction over as many wavelengths, or over all there are"),
    "memory_wavelengths": ("1", "memory of the slowest Prony branch in wavelengths"),
    "first_law_imbalance": ("1", "imbalance of the first law at full speed over the work of the road"),
    "steady_friction_coefficient": ("1", "friction coefficient of steady sliding, solved directly"),
    "wall_time": ("s", "wall time of all steps"),
}


def build(march: Transient, steady_friction: float) -> xr.Dataset:
    """Return the dataset of a march.

    Parameters
    ----------
    march : Transient
    steady_friction : float
        Friction coefficient of the same scene by the steady solver.

    Returns
    -------
    xarray.Dataset
        ``RECORDS`` over ``step``, ``mean_friction`` (mean of the contact route) over ``wavelength``, scalars.
    """
    variables: dict[str, Any] = {
        name: ("step", march.records[name], attributes(*described)) for name, described in RECORDS.items()
    }
    variables["phase"] = ("step", march.records["phase"].astype(np.int8), attributes(*RECORDS["phase"]))
    means = march.means()
    variables["mean_friction"] = (
        "wavelength",
        means,
        attributes("1", "friction coefficient from contact force, mean over each wavelength at full speed"),
    )
    variables["wavelength"] = (
        "wavelength",
        np.arange(1, len(means) + 1),
        attributes("1", "wavelengths slid at full speed"),
    )
    for name, value in _values(march, steady_friction).items():
        variables[name] = ((), value, attributes(*_SCALARS[name]))
    return xr.Dataset(variables, attrs=_provenance(march))


def _values(march: Transient, steady_friction: float) -> dict[str, float | int]:
    found = march.saturation
    return {
        "saturated": int(found.reached),
        "saturation_friction": found.friction,
        "saturation_wavelengths": found.wavelengths,
        "saturation_needed": found.needed,
        "saturation_variation": found.variation,
        "memory_wavelengths": _memory(march.scene),
        "first_law_imbalance": march.imbalance,
        "steady_friction_coefficient": steady_friction,
        "wall_time": march.seconds,
    }


def _memory(scene: Scene) -> float:
    """Return the memory of the slowest branch in wavelengths, tau v / lambda."""
    return max(scene.material.relaxation_times, default=0.0) * scene.velocity / scene.road.period


def _provenance(march: Transient) -> dict[str, Any]:
    scene = march.scene
    return {
        "title": f"Press and slide of a rubber block on a sine road: {scene.name}",
        "Conventions": CONVENTIONS.split()[0],
        "source": f"rubfric {rubfric.__version__}",
        "references": PAPER,
        "scene": scene.name,
        "scene_parameters": json.dumps(scene.parameters(), sort_keys=True),
        "scene_digest": scene.digest,
        "procedure": json.dumps(asdict(march.procedure), sort_keys=True),
        "rubber": scene.material.name,
        "plane": scene.plane,
        "kinematics_used": march.kinematics,
        "velocity": scene.velocity,
        "pressure": scene.pressure,
        "scale": 0 if scene.scale == ALL else scene.scale,
        "aspect": scene.aspect,
        **({} if scene.temperature is None else {"temperature": scene.temperature}),
        "wavelength_mm": scene.road.wavelength,
        "steps_per_wavelength": march.procedure.steps_per_wavelength,
        "saturation": str(march.saturation),
    }
