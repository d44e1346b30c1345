"""What can be solved: not too light a contact, no block pressed to next to nothing, no rubber without digits left.

Friction of a few surface nodes is a number, but no prediction: the three routes to it may still agree by chance, so
that their difference alone does not show it.
"""

from __future__ import annotations

import math

import numpy as np
from scipy.special import erfinv

from rubfric.arrays import Flags
from rubfric.errors import InvalidInput, NotConverged
from rubfric.mechanics.theory.compression import pressed, pressing
from rubfric.mechanics.theory.layer import full_contact_pressure, westergaard_contact_fraction
from rubfric.road.road import Road
from rubfric.road.waves import WaveRoad
from rubfric.scene.scene import Scene

_FEWEST_NODES = 8
# Share of its height that the load must leave a relaxed block on a flat road: cells on a rough one are pressed further.
_LEAST_HEIGHT = 0.1
# Contact that a half-space has at the excitation frequency is at least that of the block, whose finer waves are stiffer
# still; this margin covers what finite strain and a flat block add.
_MARGIN = 2.0
# On a measured profile Persson's theory counts the slopes of walls, which rubber hardly touches: contact is up to ten
# times what it says. More waves than a sum of sines has are such a profile.
_MARGIN_PROFILE, _MOST_SINES = 10.0, 12
# What is advised puts so many times the fewest nodes into the contact that the half-space has.
_ADVISED = 1.5
# Heights this near to one another, over those of the road, are one height.
_LEVEL = 1e-9
# Largest bulk modulus over shear modulus: far beyond any rubber, and far below the inverse of double precision. In
# finite strain forces balance to about 1e-18 of it (measured), of which the tolerance must stay clear.
_LARGEST_RATIO, _RATIO_PER_TOLERANCE = 1e8, 1e16


def fewest_nodes(scene: Scene) -> int:
    """Return how many surface nodes a contact must have: fewer than 8 only where fewer were asked for."""
    return min(_FEWEST_NODES, scene.numerics.contact_nodes, scene.numerics.finite_contact_nodes)


def estimated_fraction(scene: Scene) -> float:
    """Return the contact fraction of an elastic half-space as stiff as the rubber at the excitation frequencies.

    On one wave that of Westergaard, on many that of Persson for ridges, erf(p / p*).
    """
    filling = full_contact_pressure(scene.material, scene.road, scene.velocity, scene.height, scene.plane)
    if isinstance(scene.road, WaveRoad):
        return math.erf(scene.pressure / filling) if filling > 0.0 else 1.0
    return float(westergaard_contact_fraction(scene.pressure / filling)) if filling > scene.pressure else 1.0


def near_crests(road: Road, columns: int, fraction: float) -> Flags:
    """Return the highest places of a road that make up a share of it, at least one; shape (columns,).

    Parameters
    ----------
    road : Road
    columns : int
    fraction : float
        Share of the road.
    """
    height = road.height(road.period / columns * np.arange(columns))
    count = min(max(round(fraction * columns), 1), columns)
    lowest = np.sort(height)[columns - count]
    return height >= lowest - _LEVEL * np.ptp(height)


def largest_poissons_ratio(scene: Scene, finite: bool) -> float:
    """Return the largest Poisson's ratio that a scene can be solved with, (3 r - 2) / (6 r + 2) with r = K / G.

    Parameters
    ----------
    scene : Scene
    finite : bool
        In finite strain, where r is at most 1e16 times ``numerics.tolerance``.
    """
    ratio = min(_LARGEST_RATIO, _RATIO_PER_TOLERANCE * scene.numerics.tolerance) if finite else _LARGEST_RATIO
    return round((3.0 * ratio - 2.0) / (6.0 * ratio + 2.0), 12)


def require_digits(scene: Scene, finite: bool) -> None:
    """Refuse a rubber so nearly incompressible that round-off of its bulk modulus would reach the results.

    Parameters
    ----------
    scene : Scene
    finite : bool
        In finite strain.

    Raises
    ------
    InvalidInput
        With the largest Poisson's ratio that is possible.
    """
    given, largest = scene.material.poissons_ratio, largest_poissons_ratio(scene, finite)
    if given > largest:
        where = f"finite strain at numerics.tolerance {scene.numerics.tolerance:g}" if finite else "small strain"
        key = f"rubbers.{scene.material.name}.poissons_ratio"
        raise InvalidInput(
            f"{key} is {given:.15g}, but must be at most {largest:.12g} in {where}: "
            "so nearly incompressible a rubber leaves too few digits of double precision"
        )


def require_resolvable(scene: Scene, columns: int, remedy: str) -> None:
    """Refuse a scene whose contact has too few nodes on any mesh.

    Parameters
    ----------
    scene : Scene
    columns : int
        Of the finest mesh.
    remedy : str
        What the reader may do instead.

    Raises
    ------
    InvalidInput
    """
    fewest = fewest_nodes(scene)
    margin = _MARGIN if len(scene.road.waves.amplitudes) <= _MOST_SINES else _MARGIN_PROFILE
    if margin * estimated_fraction(scene) * columns >= fewest:
        return
    filling = full_contact_pressure(scene.material, scene.road, scene.velocity, scene.height, scene.plane)
    fraction = min(_ADVISED * fewest / columns, 0.5)
    ratio = erfinv(fraction) if isinstance(scene.road, WaveRoad) else math.sin(0.5 * math.pi * fraction) ** 2
    raise InvalidInput(
        f"pressure of {scene.name} is {scene.pressure:g} MPa, but must be at least about "
        f"{_rounded(filling * ratio, 2, up=True):g} MPa: so light a contact has fewer than {fewest} surface nodes on "
        f"the finest mesh, of {columns} columns; {remedy}"
    )


def _rounded(value: float, digits: int, up: bool) -> float:
    """Return a positive number in so many digits, no smaller than it was, or no larger."""
    unit = 10.0 ** (math.floor(math.log10(value)) + 1 - digits)
    steps = value / unit
    return float(f"{(math.ceil(steps) if up else math.floor(steps)) * unit:.{digits}g}")


def require_height(scene: Scene) -> None:
    """Refuse to solve a scene in finite strain whose load leaves hardly anything of the block.

    Raises
    ------
    InvalidInput
        With the heaviest pressure that is possible.
    """
    left = pressed(scene.material, scene.pressure, scene.plane)[0]
    if left < _LEAST_HEIGHT:
        heaviest = _rounded(pressing(scene.material, _LEAST_HEIGHT, scene.plane), 3, up=False)
        raise InvalidInput(
            f"pressure of {scene.name} is {scene.pressure:g} MPa, but must be at most {heaviest:g} MPa: it leaves "
            f"{left:.2%} of the height of the relaxed block; less than {_LEAST_HEIGHT:.0%} is outside the model's range"
        )


def require_columns(scene: Scene, columns: int, fewest: float) -> None:
    """Refuse to march a scene whose contact has fewer than ``fewest`` nodes on a surface of so many columns.

    Parameters
    ----------
    scene : Scene
    columns : int
    fewest : float
        Nodes that the contact must have.

    Raises
    ------
    InvalidInput
    """
    needed = fewest / estimated_fraction(scene)
    if _MARGIN * columns < needed:
        advised = 8 * math.ceil(_ADVISED * needed / 8)
        raise InvalidInput(
            f"procedure.columns is {columns}, but must be at least about {advised} for {scene.name}: so "
            f"light a contact has fewer than {fewest:g} surface nodes otherwise"
        )


def require_resolved(scene: Scene, touching: Flags, steps: int, remedy: str) -> None:
    """Refuse a contact that has too few nodes.

    Parameters
    ----------
    scene : Scene
    touching : ndarray of bool, shape (columns,)
        Surface nodes in contact.
    steps : int
        Steps taken to find them.
    remedy : str
        What the reader may do besides raising the pressure.

    Raises
    ------
    NotConverged
    """
    count, fewest = int(np.count_nonzero(touching)), fewest_nodes(scene)
    if count < fewest:
        # On a sine the contact widens as the root of so light a load, on many waves faster.
        heavier = scene.pressure * (_ADVISED * fewest / max(count, 1)) ** 2
        raise NotConverged(
            scene.name,
            steps,
            count,
            f"number of surface nodes in contact, out of {len(touching)},",
            f"at least {fewest} make a prediction: raise the pressure to about {_rounded(heavier, 2, up=True):g} MPa; "
            f"{remedy}",
        )
