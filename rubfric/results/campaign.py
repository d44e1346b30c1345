"""All scenes of a campaign as one dataset over (scale, velocity, pressure, aspect), and any temperature."""

from __future__ import annotations

import json
import math
import os
from collections.abc import Iterable
from typing import NamedTuple

import netCDF4
import numpy as np
import xarray as xr

from rubfric import __version__
from rubfric.checks import written
from rubfric.checksums import AGAIN, check_seal, fingerprint
from rubfric.errors import BrokenResult
from rubfric.mechanics.steady.energies import disagreement
from rubfric.results.dataset import load
from rubfric.results.provenance import CONVENTIONS, OTHER_SCENE, PAPER
from rubfric.results.scalars import OF_MEASURED, SCALARS, attributes
from rubfric.results.selection import REFUSAL, REFUSALS, RUBBER_ERROR, WARNINGS
from rubfric.results.temperature import ABOUT, AXIS, MATERIALS

AXES: dict[str, tuple[str, str]] = {
    "scale": ("1", "scale of the road, 1 being the coarsest; 0 is all at once"),
    "velocity": ("mm s-1", "sliding speed"),
    "pressure": ("MPa", "nominal pressure"),
    "aspect": ("1", "height of the block over its width"),
}
# Of all scales at once, which are scale 0, the smallest of each.
_ROAD = {"amplitude": ("mm", "peak-to-mean height of the scale"), "wavenumber": ("mm-1", "wavenumber of the scale")}
_ROUTES = ("friction_coefficient", "friction_coefficient_dissipation", "friction_coefficient_contact")
# The attribute of a collection that stands for the scenes that it was collected from.
COLLECTED = "scene_digests"


class _Found(NamedTuple):
    """The coordinates of a result, its scalars, what it shares with its campaign, its road, any refusal, its digest.

    With a temperature, the last coordinate, the rubber at it is no part of what is shared.
    """

    point: tuple[float, ...]
    values: dict[str, float]
    shared: dict[str, str]
    road: dict[str, float]
    refusal: str
    digest: str
    material: str = ""


def collect(paths: Iterable[str | os.PathLike[str]], digests: Iterable[str] | None = None) -> xr.Dataset:
    """Collect the scalars of scene results in one dataset; scenes that were not run, or were refused, are NaN.

    Parameters
    ----------
    paths : iterable of path-like
        Files written by ``rubfric.write``.
    digests : iterable of str, optional
        ``Scene.digest`` that each file must have, in the order of ``paths``.

    Returns
    -------
    xarray.Dataset
        Dimensions scale, velocity (mm/s), pressure (MPa), aspect, and temperature (degC) where scenes have one;
        ``amplitude`` and ``wavenumber`` over scale. What was refused, and why: ``refusals``.

    Raises
    ------
    BrokenResult
        For files that cannot be read or are of other scenes, all of them named; for two files of one scene; for
        scenes that differ in rubber, plane or numerics, or of which some have a temperature and others none.
    """
    files = [os.fspath(path) for path in paths]
    found = _read_all(files, [None] * len(files) if digests is None else digests)
    first: dict[tuple[float, ...], _Found] = {}
    road: dict[float, dict[str, float]] = {}
    materials: dict[float, str] = {}
    for path, one in zip(files, found, strict=True):
        if one.point in first:
            raise BrokenResult(f"{path} is a second result of its scene; keep one of them")
        if len(one.point) != len(found[0].point):
            has, had = ("a", "none") if one.material else ("no", "one")
            raise BrokenResult(f"{path} has {has} temperature, but the results before it have {had}")
        shared = found[0].shared
        if shared != one.shared:
            other = next(name for name in shared if one.shared[name] != shared[name])
            raise BrokenResult(f"{path} has the {other} {one.shared[other]}, but the results before it {shared[other]}")
        if road.setdefault(one.point[0], one.road) != one.road:
            raise BrokenResult(
                f"{path} has {one.road} on scale {one.point[0]:g}, but another result {road[one.point[0]]}"
            )
        if one.material and materials.setdefault(one.point[-1], one.material) != one.material:
            raise BrokenResult(f"{path} has another rubber at {one.point[-1]:g} degC than the results before it")
        first[one.point] = one
    if not first:
        raise BrokenResult("there are no results to collect")
    return _assemble(found, road, materials)


def read(path: str | os.PathLike[str], scenes: str | None = None) -> xr.Dataset:
    """Read a campaign from the file that holds it, completely into memory.

    Parameters
    ----------
    path : path-like
    scenes : str, optional
        ``fingerprint`` of the sorted digests of the scenes that it must have been collected from.

    Raises
    ------
    BrokenResult
        For a file that is missing, damaged, no collection of results, or one of other scenes.
    """
    campaign = load(path)
    if not {"friction_coefficient", *AXES} <= set(campaign.variables):
        raise BrokenResult(f"{os.fspath(path)} is no collection of results; {AGAIN}")
    if scenes not in (None, campaign.attrs.get(COLLECTED)):
        raise BrokenResult(f"{os.fspath(path)} {OTHER_SCENE}; {AGAIN}")
    return campaign


def _read_all(files: list[str], digests: Iterable[str | None]) -> list[_Found]:
    """Read the scalars of all files; one error names every file that cannot be used."""
    found, wrong = [], []
    for path, digest in zip(files, digests, strict=True):
        try:
            found.append(_read_scalars(path, digest))
        except BrokenResult as error:
            wrong.append((path, str(error).removesuffix(f"; {AGAIN}")))
    if wrong:
        paths = [path for path, _ in wrong]
        again = AGAIN
        if len(paths) > 1:
            again = f"{len(paths) - 1} more cannot be used either; delete them all and run again: rm {' '.join(paths)}"
        raise BrokenResult(f"{wrong[0][1]}; {again}")
    return found


def _read_scalars(path: str, digest: str | None) -> _Found:
    check_seal(path)
    try:
        with netCDF4.Dataset(path) as stored:
            stored.set_auto_maskandscale(False)  # scalars are neither masked nor scaled; looking for it takes time
            axes = [*AXES, AXIS] if AXIS in stored.ncattrs() else AXES
            point = tuple(float(stored.getncattr(axis)) for axis in axes)
            refused = str(stored.getncattr(REFUSAL)) if REFUSAL in stored.ncattrs() else ""
            own = [*SCALARS, *(name for name in OF_MEASURED if name in stored.variables)]
            values = {} if refused else {name: float(stored[name][...]) for name in own}
            if not refused:
                values[WARNINGS] = float(len(list(filter(None, stored.getncattr("warnings").splitlines()))))
            common = {name: str(stored.getncattr(name)) for name in ("rubber", "plane", "kinematics")}
            parameters = json.loads(stored.getncattr("scene_parameters"))
            common |= {name: json.dumps(parameters[name], sort_keys=True) for name in ("material", "numerics")}
            road = {name: float(np.min(stored.getncattr(name))) for name in _ROAD}
            digest_of_file = str(stored.getncattr("scene_digest"))
    except (OSError, AttributeError, IndexError, KeyError, RuntimeError, ValueError) as error:
        raise BrokenResult(f"{path} is no readable result: {error}") from error
    if digest not in (None, digest_of_file):
        raise BrokenResult(f"{path} {OTHER_SCENE}")
    if not refused:
        _check_bounds(path, values)
    material = common.pop("material") if len(point) > len(AXES) else ""
    return _Found(point, values, common, road, refused, digest_of_file, material)


def _check_bounds(path: str, values: dict[str, float]) -> None:
    """Raise BrokenResult where scalars are not finite, outside what is possible, or contradict one another."""
    routes = tuple(values[name] for name in _ROUTES)
    friction, error, closure = routes[0], values["friction_coefficient_error"], values["energy_closure"]
    differ = disagreement(routes, values["friction_resolution"])
    bounds = {
        "a number that is not finite": not all(map(math.isfinite, values.values())),
        "a friction below zero by more than its error": friction < -error,
        "a negative error": min(error, values.get(RUBBER_ERROR, 0.0)) < 0.0,
        "a contact fraction outside 0 to 1": not 0.0 < values["contact_fraction"] <= 1.0,
        "a negative pressure": min(values["maximum_contact_pressure"], values["maximum_local_contact_pressure"]) < 0.0,
        "routes to friction that do not differ by its energy_closure": abs(differ - closure) > 1e-9 * max(differ, 1.0),
    }
    if broken := [what for what, is_so in bounds.items() if is_so]:
        raise BrokenResult(f"{path} has {', '.join(broken)}, which no result has")


def _assemble(found: list[_Found], road: dict[float, dict[str, float]], materials: dict[float, str]) -> xr.Dataset:
    about_axes = AXES | ({AXIS: ABOUT} if materials else {})
    axes = {name: np.array(sorted({one.point[place] for one in found})) for place, name in enumerate(about_axes)}
    shape = tuple(len(axis) for axis in axes.values())
    of_measured = {name: about for name, about in OF_MEASURED.items() if any(name in one.values for one in found)}
    about_all = SCALARS | of_measured | {WARNINGS: ("1", "number of warnings in the attributes of the result")}
    arrays = {name: np.full(shape, np.nan) for name in about_all}
    for one in found:
        index = tuple(int(np.searchsorted(axis, value)) for axis, value in zip(axes.values(), one.point, strict=True))
        for name, value in one.values.items():
            arrays[name][index] = value
    coordinates = {name: (name, axis, attributes(*about_axes[name])) for name, axis in axes.items()}
    coordinates["scale"] = ("scale", axes["scale"].astype(np.int64), attributes(*AXES["scale"]))
    variables = {name: (tuple(axes), array, attributes(*about_all[name])) for name, array in arrays.items()}
    for name, about in _ROAD.items():
        variables[name] = (
            ("scale",),
            np.array([road[scale][name] for scale in axes["scale"]]),
            attributes(*about),
        )
    described = {
        "title": "Friction of a rubber block over scale, speed, pressure and height-to-width ratio",
        "Conventions": CONVENTIONS.split()[0],
        "source": f"rubfric {__version__}",
        "references": PAPER,
    }
    refused = sorted((one.point, one.refusal) for one in found if one.refusal)
    kept = {REFUSALS: json.dumps(refused)} if refused else {}
    if materials:
        kept[MATERIALS] = json.dumps({written(at): json.loads(each) for at, each in sorted(materials.items())})
    kept[COLLECTED] = fingerprint(sorted(one.digest for one in found))
    return xr.Dataset(variables, coords=coordinates, attrs=described | found[0].shared | kept)
