"""A scene's result in words and numbers, for the terminal."""

from __future__ import annotations

import json
from collections.abc import Mapping
from typing import Any

import numpy as np
import xarray as xr

from rubfric.results.selection import BEYOND, RUBBER_ERROR

_WIDTH = 34
_COVERED = "mesh, solver, kinematics; not other {}, the rubber's data or its finite-strain law"
# So many waves whose wavenumbers are all multiples of one are a profile, not scales.
_PROFILE = 8


def summary(result: xr.Dataset) -> str:
    """Return a result as text: the friction first, then contact, mesh and kinematics, then any warnings."""
    attributes = result.attrs
    friction = float(result["friction_coefficient"])
    warm = f", {attributes['temperature']:g} degC" if "temperature" in attributes else ""
    lines = [
        f"{attributes['rubber']} on {_road(attributes)}, "
        f"{attributes['velocity']:g} mm/s, {attributes['pressure']:g} MPa{warm}, "
        f"height/width {attributes['aspect']:g}, plane {attributes['plane']}, {attributes['kinematics_used']} strain",
        "",
        _line("friction coefficient", f"{friction:.5g} +- {float(result['friction_coefficient_error']):.1g}"),
        *([_line("  the error covers", _COVERED.format(_others(attributes)))] if "phase" in attributes else []),
        *_rubber_error(result),
        _line("  from viscous dissipation", f"{float(result['friction_coefficient_dissipation']):.5g}"),
        _line("  from contact pressure", f"{float(result['friction_coefficient_contact']):.5g}"),
        _line("  largest difference", f"{float(result['energy_closure']):.2g} (relative)"),
        _line("contact fraction", f"{float(result['contact_fraction']):.4g}"),
        _line("largest contact pressure", _pressures(result)),
        _line("nominal compression", f"{float(result['nominal_compression']):.3g}"),
        _line("effective Poisson's ratio", f"{float(result['effective_poissons_ratio']):.4f}"),
        _line("speed over shear-wave speed", f"{float(result['shear_wave_speed_ratio']):.2g}"),
        _line("mesh", _mesh(result)),
        _line("solved in", f"{1e3 * float(result['wall_time']):.0f} ms, {_effort(result)}"),
        _line("kinematics", attributes["kinematics_reason"]),
    ]
    warnings = [line for line in attributes["warnings"].splitlines() if line]
    if warnings:
        lines += ["", *(f"Note: {line}" for line in warnings)]
    return "\n".join(lines)


def _rubber_error(result: xr.Dataset) -> list[str]:
    """Return what the data of a measured rubber leave open of friction."""
    if RUBBER_ERROR not in result:
        return []
    samples = len((json.loads(result.attrs["scene_parameters"])["measured"])["samples"])
    scatter = f"scatter by {samples} samples" if samples else "scatter not asked for (uncertainty)"
    share = f"{100.0 * float(result[BEYOND]):.2g} % from beyond the measured frequencies"
    return [_line("  from the rubber's data", f"+- {float(result[RUBBER_ERROR]):.1g} ({scatter}; {share})")]


def _road(attributes: Mapping[str, Any]) -> str:
    """Return the road of a result, in words."""
    if "phase" in attributes and _is_profile(attributes):
        longest, shortest = 2.0 * np.pi / np.asarray(attributes["wavenumber"])[[0, -1]]
        return f"a profile of {longest:.4g} mm, waves of {shortest:.4g} mm and longer"
    if "phase" in attributes:
        return f"all {np.size(attributes['phase'])} scales at once"
    return f"scale {attributes['scale']}: {attributes['amplitude']:g} mm sin({attributes['wavenumber']:g}/mm x)"


def _is_profile(attributes: Mapping[str, Any]) -> bool:
    """Return whether a road of many waves is the Fourier series of a profile."""
    numbers = np.atleast_1d(attributes["wavenumber"])
    return numbers.size >= _PROFILE and np.allclose(numbers, numbers[0] * np.arange(1, numbers.size + 1), rtol=1e-6)


def _others(attributes: Mapping[str, Any]) -> str:
    return "stretches of the road" if _is_profile(attributes) else "phases of the waves"


def _pressures(result: xr.Dataset) -> str:
    """Return the largest contact pressure by both areas, in words."""
    nominal, local = (float(result[name]) for name in ("maximum_contact_pressure", "maximum_local_contact_pressure"))
    return f"{nominal:.4g} MPa per undeformed area, {local:.4g} MPa per deformed area"


def _mesh(result: xr.Dataset) -> str:
    """Return the mesh of the result, in words."""
    size = f"{int(result['columns'])} x {int(result['rows'])} cells"
    return f"{size}, {int(result['contact_nodes'])} nodes in contact; {int(result['meshes'])} meshes"


def _effort(result: xr.Dataset) -> str:
    """Return what the solver did, in words."""
    steps = int(result["iterations"])
    if not int(result["finite_strain"]):
        return f"{steps} contact steps"
    return f"{steps} Newton steps, {int(result['krylov_iterations'])} Krylov iterations"


def _line(label: str, value: str) -> str:
    return f"{label:<{_WIDTH}}{value}"
