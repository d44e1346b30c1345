"""The result of a scene as a dataset: fields on a UGRID mesh, scalars, units, and all that reproduces it."""

from __future__ import annotations

import os
from pathlib import Path
from typing import Any

import numpy as np
import xarray as xr

from rubfric.arrays import Real
from rubfric.checksums import AGAIN, PLACEHOLDER, check_seal, seal
from rubfric.errors import BrokenResult
from rubfric.files import whole
from rubfric.mechanics.steady.energies import Energies
from rubfric.mechanics.steady.solution import SteadySolution
from rubfric.results.provenance import OTHER_SCENE, about
from rubfric.results.scalars import OF_MEASURED, SCALARS, attributes, scalars
from rubfric.results.selection import REFUSAL
from rubfric.results.warnings import below_noise_warning, warnings

# The variable that holds the checksum of a file.
_CHECKSUM = "checksum"


def build(solution: SteadySolution, energies: Energies, wall_time: float) -> xr.Dataset:
    """Return the dataset of a solved scene.

    Parameters
    ----------
    solution : SteadySolution
    energies : Energies
        Of the solution.
    wall_time : float
        Of the solution and its energies, s.

    Returns
    -------
    xarray.Dataset
        Mesh ``mesh`` (UGRID) with ``displacement_x``, ``displacement_y`` (mm) and ``strain_energy_density``
        (MPa) at its nodes; ``contact_pressure``, ``local_contact_pressure`` (MPa), ``gap``, ``surface_position``
        and ``road_height`` (mm) along ``surface_x``;
        ``strain_energy_density_profile`` over ``depth``; the scalars of ``SCALARS``; the scene's parameters.
    """
    variables = _mesh(solution, energies) | _surface(solution)
    variables |= {
        name: ((), value, attributes(*(SCALARS | OF_MEASURED)[name]))
        for name, value in scalars(solution, energies, wall_time).items()
    }
    return xr.Dataset(variables, attrs=_provenance(solution, energies))


def _mesh(solution: SteadySolution, energies: Energies) -> dict[str, Any]:
    """Return the output mesh: every few columns of the mesh that was solved, the first repeated at the far end."""
    block = solution.block
    shear = "" if solution.decision.kinematics == "finite" else ", without the mean shear that friction causes"
    rows, columns = energies.density.shape
    x = np.linspace(0.0, block.width, columns + 1)
    place = {"mesh": "mesh", "location": "node"}
    node = np.arange(rows * (columns + 1), dtype=np.int32).reshape(rows, columns + 1)
    faces = np.stack((node[:-1, :-1], node[:-1, 1:], node[1:, 1:], node[1:, :-1]), axis=-1).reshape(-1, 4)

    def around(field: Real) -> Real:
        return np.concatenate((field, field[:, :1]), axis=1).ravel()

    every = solution.block.columns // columns
    topology = {
        "cf_role": "mesh_topology",
        "long_name": "rubber block in its reference configuration, one wavelength wide, repeating along x"
        + (f"; every {every}th column of the mesh that was solved" if every > 1 else ""),
        "units": "1",
        "topology_dimension": 2,
        "node_coordinates": "mesh_node_x mesh_node_y",
        "face_node_connectivity": "mesh_face_nodes",
    }
    return {
        "mesh": ((), np.int32(0), topology),
        "mesh_node_x": (
            "node",
            np.tile(x, rows),
            attributes("mm", "distance along the road"),
        ),
        "mesh_node_y": (
            "node",
            np.repeat(block.row_positions, columns + 1),
            attributes("mm", "height above the bottom of the block"),
        ),
        "mesh_face_nodes": (
            ("face", "corner"),
            faces,
            {
                "cf_role": "face_node_connectivity",
                "long_name": "nodes of each cell, counter-clockwise",
                "units": "1",
                "start_index": np.int32(0),
            },
        ),
        "displacement_x": (
            "node",
            around(energies.displacement[:, 0]),
            attributes("mm", "displacement along the road" + shear, **place),
        ),
        "displacement_y": (
            "node",
            around(energies.displacement[:, 1]),
            attributes(
                "mm",
                "displacement away from the road; y + displacement_y is the height above the road's mean plane",
                **place,
            ),
        ),
        "strain_energy_density": (
            "node",
            around(energies.density),
            attributes("MPa", "strain-energy density stored in the springs (1 MPa = 1 N mm mm-3)", **place),
        ),
        "depth": (
            "depth",
            block.row_positions,
            attributes("mm", "distance from the bottom of the block", axis="Y", positive="up"),
        ),
        "strain_energy_density_profile": (
            "depth",
            energies.depth_profile,
            attributes("MPa", "strain-energy density stored in the springs, mean over a wavelength"),
        ),
    }


def _surface(solution: SteadySolution) -> dict[str, Any]:
    block, road, contact = solution.block, solution.scene.road, solution.contact
    x = block.column_positions
    return {
        "surface_x": ("surface_x", x, attributes("mm", "distance along the road, undeformed block")),
        "surface_position": (
            "surface_x",
            solution.surface_position,
            attributes("mm", "distance along the road of the deformed surface, where the gap is measured"),
        ),
        "road_height": ("surface_x", road.height(x), attributes("mm", "height of the road above its mean plane")),
        "contact_pressure": (
            "surface_x",
            contact.pressure,
            attributes("MPa", "vertical pressure of the road per area of the undeformed rubber"),
        ),
        "local_contact_pressure": (
            "surface_x",
            contact.pressure / solution.surface_stretch,
            attributes("MPa", "normal pressure of the road per area of the deformed rubber"),
        ),
        "gap": ("surface_x", contact.gap, attributes("mm", "height of the rubber above the road")),
    }


def _provenance(solution: SteadySolution, energies: Energies) -> dict[str, Any]:
    scene = solution.scene
    return about(scene, f"Steady sliding of a rubber block on a sine road: {scene.name}") | {
        "kinematics_used": solution.decision.kinematics,
        "kinematics_reason": solution.decision.reason,
        "solver_history": "\n".join(solution.history),
        "warnings": "\n".join(
            [*warnings(solution, energies.closure), *below_noise_warning(energies.stress_power, energies.resolution)]
        ),
    }


def write(result: xr.Dataset, path: str | os.PathLike[str]) -> None:
    """Write a dataset to a netCDF file, whole or not at all.

    The file appears under its name only when it is complete; an interrupted run leaves at most a file whose
    name begins with a dot. It carries its checksum, which every reader checks (``rubfric.checksums``).

    Parameters
    ----------
    result : xarray.Dataset
    path : path-like
        Missing folders are made.

    Raises
    ------
    NotWritten
        Where the disk is full or the place is not writable; the message says what to do.

    Examples
    --------
    >>> import tempfile
    >>> from pathlib import Path
    >>> import rubfric, xarray
    >>> result = rubfric.simulate(rubfric.load().scene(scale=1, velocity=100, pressure=0.5, kinematics="small"))
    >>> with tempfile.TemporaryDirectory() as folder:
    ...     rubfric.write(result, Path(folder, "scene.nc"))
    ...     with xarray.open_dataset(Path(folder, "scene.nc")) as kept:
    ...         print(kept.friction_coefficient.equals(result.friction_coefficient))
    True
    """
    result = result.assign({_CHECKSUM: ((), np.bytes_(PLACEHOLDER), attributes("1", "checksum of this file"))})
    # Nothing is missing from a field, so none has a fill value, except in a campaign, where not all was run.
    encoding: dict[str, dict[str, Any]] = {
        str(name): {"zlib": variable.size > 1, "complevel": 1}
        | ({} if variable.dtype.kind == "f" and np.isnan(variable.values).any() else {"_FillValue": None})
        for name, variable in result.variables.items()
    }
    encoding[_CHECKSUM]["char_dim_name"] = "checksum_length"
    with whole(path) as part:
        try:
            result.to_netcdf(part, engine="netcdf4", encoding=encoding)
            seal(part)
        except (OSError, RuntimeError):
            _reserve(part, 2 * result.nbytes)  # netCDF does not give the reason, the system does
            raise


def _reserve(path: Path, size: int) -> None:
    """Allocate a file of ``size`` bytes: OSError with the system's errno where there is no room for it."""
    with path.open("wb", buffering=0) as stream:
        stream.write(b"\0")  # a device takes no reservation
        if hasattr(os, "posix_fallocate"):
            os.posix_fallocate(stream.fileno(), 0, size)
        else:  # macOS
            stream.write(bytes(size))


def read(path: str | os.PathLike[str], digest: str | None = None, refusals: bool = False) -> xr.Dataset:
    """Read the result of a scene, completely into memory.

    Parameters
    ----------
    path : path-like
    digest : str, optional
        ``Scene.digest`` that the result must have.
    refusals : bool
        Whether to return what says why a scene was refused, too; it has the attribute ``refusal``.

    Raises
    ------
    BrokenResult
        For a file that is missing, damaged, no result of rubfric, or that of another scene or of a refused one.
    """
    result = load(path)
    if "scene_digest" not in result.attrs:
        raise BrokenResult(f"{os.fspath(path)} is no result of rubfric: it lacks the attribute scene_digest")
    if digest not in (None, result.attrs["scene_digest"]):
        raise BrokenResult(f"{os.fspath(path)} {OTHER_SCENE}; {AGAIN}")
    if REFUSAL in result.attrs and not refusals:
        raise BrokenResult(f"{os.fspath(path)} holds no friction, since the scene was refused: {result.attrs[REFUSAL]}")
    return result


def load(path: str | os.PathLike[str]) -> xr.Dataset:
    """Read a netCDF file of rubfric completely into memory; BrokenResult where it cannot be read or was changed."""
    check_seal(path)
    try:
        with xr.open_dataset(path, engine="netcdf4") as stored:
            return stored.drop_vars(_CHECKSUM, errors="ignore").load()
    except (OSError, ValueError, RuntimeError, AttributeError, KeyError) as error:
        raise BrokenResult(f"{os.fspath(path)} cannot be read: {error}; {AGAIN}") from error
