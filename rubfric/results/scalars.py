"""The scalars of every result: their units, names and values."""

from __future__ import annotations

from typing import Any

import numpy as np

from rubfric.mechanics.steady.energies import Energies
from rubfric.mechanics.steady.error import friction_error
from rubfric.mechanics.steady.solution import SteadySolution
from rubfric.mechanics.theory.layer import excitation_frequency
from rubfric.results.rubber_error import beyond, spread
from rubfric.results.selection import BEYOND, RUBBER_ERROR

# name: (unit, long name); the scalars of every result, in the order in which they are shown
SCALARS: dict[str, tuple[str, str]] = {
    "friction_coefficient": ("1", "friction coefficient from stress power"),
    "friction_coefficient_dissipation": ("1", "friction coefficient from viscous dissipation"),
    "friction_coefficient_contact": ("1", "friction coefficient from contact pressure and road slope"),
    "friction_coefficient_error": ("1", "estimated error of the friction coefficient, absolute"),
    "energy_closure": ("1", "largest relative difference between the three friction coefficients"),
    "friction_resolution": ("1", "friction below which the solver cannot distinguish it from zero"),
    "contact_fraction": ("1", "contact area over nominal area, counted by nodes"),
    "maximum_contact_pressure": ("MPa", "largest contact pressure per undeformed area"),
    "maximum_local_contact_pressure": ("MPa", "largest contact pressure per deformed area"),
    "nominal_compression": ("1", "compression of the relaxed block by the load on a flat road, over its height"),
    "pressed_energy_density": ("MPa", "strain-energy density of the relaxed block on a flat road under the load"),
    "finite_strain": ("1", "1 where the scene was solved in finite strain, 0 in small strain"),
    "finite_strain_correction": ("1", "estimated relative change of friction from small to finite strain"),
    "branches_relaxed": ("1", "Prony branches omitted because they are relaxed at every harmonic"),
    "branches_frozen": ("1", "Prony branches merged because they are frozen at every harmonic"),
    "folding_bound": ("1", "bound on the relative change of the loss modulus by omitting and merging branches"),
    "effective_poissons_ratio": ("1", "real part of the complex Poisson's ratio at the excitation frequency"),
    "shear_wave_speed_ratio": ("1", "sliding speed over shear-wave speed at the excitation frequency"),
    "excitation_frequency": ("rad s-1", "angular frequency at which the road excites the rubber"),
    "meshes": ("1", "meshes on which the scene was solved, from coarse to fine"),
    "columns": ("1", "cells along one wavelength of the mesh that was solved"),
    "rows": ("1", "cells over the height of the mesh that was solved"),
    "contact_nodes": ("1", "surface nodes in contact"),
    "iterations": ("1", "Newton steps in finite strain, pivoting steps of all contact solves in small strain"),
    "krylov_iterations": ("1", "applications of the tangent stiffness, in finite strain"),
    "wall_time": ("s", "wall time of the solution and its energies"),
}

# What only scenes of a measured rubber have.
OF_MEASURED = {
    RUBBER_ERROR: (
        "1",
        "error of the friction coefficient from the rubber's data, absolute: half of the 95 % band that their scatter "
        "leaves, where samples were asked for, and all that comes from frequencies beyond those measured",
    ),
    BEYOND: ("1", "share of friction from frequencies beyond those at which the rubber was measured"),
}


def attributes(unit: str, long_name: str, **more: Any) -> dict[str, Any]:
    """Return the attributes of a variable.

    Parameters
    ----------
    unit, long_name : str
        As the CF conventions want them.
    **more
        Further attributes.
    """
    return {"units": unit, "long_name": long_name, **more}


def scalars(solution: SteadySolution, energies: Energies, wall_time: float) -> dict[str, float | int]:
    """Return the values of ``SCALARS`` for a solved scene, and of ``OF_MEASURED`` for one of a measured rubber.

    Parameters
    ----------
    solution : SteadySolution
    energies : Energies
        Of the solution.
    wall_time : float
        Of both, s.
    """
    scene, contact, measured = solution.scene, solution.contact, {}
    if scene.measured:
        outside = sum(beyond(solution))
        measured[RUBBER_ERROR] = abs(energies.stress_power) * (spread(scene) + outside)
        measured[BEYOND] = outside
    frequency = excitation_frequency(scene.material, scene.road, scene.velocity, scene.height, scene.plane)
    return {
        "friction_coefficient": energies.stress_power,
        "friction_coefficient_dissipation": energies.dissipation,
        "friction_coefficient_contact": energies.contact,
        "friction_coefficient_error": friction_error(solution),
        "energy_closure": energies.closure,
        "friction_resolution": energies.resolution,
        "contact_fraction": solution.contact_fraction,
        "maximum_contact_pressure": float(contact.pressure.max()),
        "maximum_local_contact_pressure": float((contact.pressure / solution.surface_stretch).max()),
        "nominal_compression": solution.compression,
        "pressed_energy_density": solution.pressed_energy,
        "finite_strain": int(solution.decision.kinematics == "finite"),
        "finite_strain_correction": solution.decision.correction,
        "branches_relaxed": len(solution.folding.relaxed),
        "branches_frozen": len(solution.folding.frozen),
        "folding_bound": solution.folding.bound,
        "effective_poissons_ratio": float(scene.material.effective_poissons_ratio(frequency)),
        "shear_wave_speed_ratio": float(scene.velocity / scene.material.shear_wave_speed(frequency)),
        "excitation_frequency": frequency,
        "meshes": len(solution.meshes),
        "columns": solution.block.columns,
        "rows": solution.block.rows,
        "contact_nodes": int(np.count_nonzero(contact.touching)),
        "iterations": solution.iterations,
        "krylov_iterations": solution.krylov,
        "wall_time": wall_time,
        **measured,
    }
