"""Whether a result keeps the bounds of physics: of steady sliding from its dataset, of a march from its records.

Bounds are those that hold for any rubber, road, load and speed: no negative friction, contact pressure, gap, energy
or dissipation; contact forces that carry the load; friction below the steepest slope, since the road itself is
frictionless; the first law.
"""

from __future__ import annotations

import json
from dataclasses import dataclass

import numpy as np
import xarray as xr

from rubfric.mechanics.march.result import Transient
from rubfric.results.warnings import below_noise_warning
from rubfric.road.road import Road
from rubfric.scene.scene import Scene

# Share of the load, of the amplitude or of the energy turned over by which a bound may be missed: a solver's tolerance.
_SLACK = 1e-4
# Forces balance to round-off.
_BALANCE = 1e-9
# The unit of lengths on a flat road, as a share of the wavelength.
_FLAT = 1e-7
# Share of the largest pressure and of the amplitude below which both pressure and gap may be positive at a node.
_TOUCHING = 1e-9
# The first law is met in time to the second order of the step: share of the energy turned over that may be missing.
_FIRST_LAW = 0.05


@dataclass(frozen=True)
class Verdict:
    """A result checked against its bounds.

    Attributes
    ----------
    friction : tuple of float
        Friction coefficient by stress power, dissipation and contact; of a march by energy, by the work of the road
        and by contact, on average at full speed.
    closure : float
        Largest relative difference of the three (of ``resolution`` where that is larger).
    resolution : float
        Friction below which the solver cannot distinguish it from zero.
    broken : tuple of str
        Bounds that are not kept, one sentence each.
    remarks : tuple of str
        Warnings of the result.
    """

    friction: tuple[float, float, float]
    closure: float
    resolution: float
    broken: tuple[str, ...]
    remarks: tuple[str, ...]


def judge_steady(result: xr.Dataset, most_closure: float) -> Verdict:
    """Check the dataset of a scene.

    Parameters
    ----------
    result : xarray.Dataset
        As built by ``rubfric.results.dataset.build``.
    most_closure : float
        Largest allowed relative difference of the routes to friction.
    """
    routes = ("friction_coefficient", "friction_coefficient_dissipation", "friction_coefficient_contact")
    power, lost, contact = (float(result[name]) for name in routes)
    floor, closure = float(result["friction_resolution"]), float(result["energy_closure"])
    road = Scene.from_parameters(json.loads(result.attrs["scene_parameters"])).road
    slope, tallest = road.steepest_slope, float(road.waves.amplitudes.sum())
    pressure, gap = result["contact_pressure"].values, result["gap"].values
    amplitude = max(tallest, _FLAT * road.wavelength)
    least_gap = _least_gap(result, road)
    carried = float(abs(pressure.mean() / result.attrs["pressure"] - 1.0))
    both = (pressure > _TOUCHING * pressure.max()) & (gap > _TOUCHING * amplitude)
    unfinished = [str(name) for name, values in result.variables.items() if _not_finite(values.values)]
    checks = (
        (not unfinished, f"not finite: {', '.join(unfinished)}"),
        (min(power, lost, contact) >= -floor, "friction is negative"),
        (lost >= 0.0, "dissipation is negative"),
        (max(power, lost, contact) <= slope * (1.0 + most_closure) + floor, f"friction exceeds the slope, {slope:.3g}"),
        (pressure.min() >= 0.0, "contact pressure is negative"),
        (gap.min() >= 0.0, "a gap is negative"),
        (least_gap >= -_SLACK * amplitude, f"the surface is {-least_gap:.2g} mm inside the road"),
        (not both.any(), "pressure acts across a gap"),
        (carried <= _BALANCE, f"the contact carries {carried:.2g} more or less than the load"),
        (result["strain_energy_density"].values.min() >= 0.0, "strain energy is negative"),
        (0.0 < float(result["contact_fraction"]) <= 1.0, "the contact fraction is not between 0 and 1"),
        (closure <= most_closure, f"the three friction coefficients differ by {closure:.2%}"),
    )
    broken = tuple(sentence for kept, sentence in checks if not kept)
    remarks = tuple(filter(None, result.attrs["warnings"].split("\n")))
    return Verdict((power, lost, contact), closure, floor, broken, remarks)


def _least_gap(result: xr.Dataset, road: Road) -> float:
    """Return the smallest height of the deformed surface above the road at the output nodes, mm."""
    nodes = np.flatnonzero(result["mesh_node_y"].values == 0.0)
    place = result["mesh_node_x"].values[nodes] + result["displacement_x"].values[nodes]
    height = result["displacement_y"].values[nodes]
    if not int(result["finite_strain"]):  # small strain neglects horizontal displacement in contact
        place = result["mesh_node_x"].values[nodes]
    return float((height - road.height(place)).min())


def judge_march(found: Transient, most_closure: float) -> Verdict:
    """Check a march.

    Parameters
    ----------
    found : Transient
    most_closure : float
        Largest allowed relative difference of the routes to friction.
    """
    records = {name: values[found.sliding] for name, values in found.records.items()}
    slope, fraction = found.scene.road.steepest_slope, records["contact_fraction"]
    # All that moves between road, load, springs and branches.
    turned = float(sum(np.abs(records[name]).sum() for name in ("road_work", "load_work", "dissipated")))
    turned = max(turned, float(np.abs(records["stored_energy"]).max()), np.finfo(float).tiny)
    missing = float(abs(records["imbalance"].sum())) / turned
    unfinished = [name for name, values in records.items() if _not_finite(values)]
    checks = (
        (not unfinished, f"not finite: {', '.join(unfinished)}"),
        (min(found.friction) >= -found.resolution, "friction is negative"),
        (records["dissipated"].min() >= -_SLACK * turned, "dissipation is negative"),
        (records["stored_energy"].min() >= -_SLACK * turned, "stored energy is negative"),
        (
            np.abs(records["friction_contact"]).max() <= slope * (1.0 + _SLACK),
            f"friction exceeds the slope, {slope:.3g}",
        ),
        (bool((fraction > 0.0).all() and (fraction <= 1.0).all()), "the contact fraction is not between 0 and 1"),
        (missing <= _FIRST_LAW, f"the first law misses {missing:.2%} of the energy turned over"),
        (found.closure <= most_closure, f"friction by contact, work and energy differ by {found.closure:.2%}"),
    )
    broken = tuple(sentence for kept, sentence in checks if not kept)
    contact, work, energy = found.friction
    remarks = tuple(below_noise_warning(work, found.resolution))
    return Verdict((energy, work, contact), found.closure, found.resolution, broken, remarks)


def _not_finite(values: np.ndarray) -> bool:
    return bool(values.dtype.kind == "f" and not np.isfinite(values).all())
