"""What can be solved: not too light a contact, no block pressed to next to nothing, no rubber without digits left.

Friction of a few surface nodes is a number, but no prediction: the three routes to it may still agree by chance, so
that their difference alone does not show it.
"""

from __future__ import annotations

import math

import numpy as np

from rubfric.arrays import Flags, Real
from rubfric.errors import InvalidInput, NotConverged
from rubfric.mechanics.theory.compression import pressed, pressing
from rubfric.mechanics.theory.layer import full_contact_pressure, westergaard_contact_fraction
from rubfric.scene.scene import Scene

_FEWEST_NODES = 8
# Share of its height that the load must leave a relaxed block on a flat road: cells on a rough one are pressed further.
_LEAST_HEIGHT = 0.1
# Contact that a half-space has at the excitation frequency is at least that of the block, whose finer waves are stiffer
# still; this margin covers what finite strain and a flat block add.
_MARGIN = 2.0
# Largest bulk modulus over shear modulus: far beyond any rubber, and far below the inverse of double precision. In
# finite strain forces balance to about 1e-18 of it (measured), of which the tolerance must stay clear.
_LARGEST_RATIO, _RATIO_PER_TOLERANCE = 1e8, 1e16


def fewest_nodes(scene: Scene) -> int:
    """Return how many surface nodes a contact must have: fewer than 8 only where fewer were asked for."""
    return min(_FEWEST_NODES, scene.numerics.contact_nodes, scene.numerics.finite_contact_nodes)


def estimated_fraction(scene: Scene) -> float:
    """Return the contact fraction of an elastic half-space as stiff as the rubber at the excitation frequency."""
    filling = full_contact_pressure(scene.material, scene.road, scene.velocity, scene.height, scene.plane)
    return float(westergaard_contact_fraction(scene.pressure / filling)) if filling > scene.pressure else 1.0


def near_crest(columns: int, fraction: float) -> Flags:
    """Return which surface nodes lie in a share of the wavelength around the crest, at least one; shape (columns,)."""
    from_crest: Real = np.abs((np.arange(columns) / columns + 0.25) % 1.0 - 0.5)  # in wavelengths
    return from_crest <= max(0.5 * fraction, 0.5 / columns)


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
    columns : int
        Of the finest mesh.
    remedy : str
        What the reader may do instead.

    Raises
    ------
    InvalidInput
    """
    fewest = fewest_nodes(scene)
    if _MARGIN * estimated_fraction(scene) * columns >= fewest:
        return
    filling = full_contact_pressure(scene.material, scene.road, scene.velocity, scene.height, scene.plane)
    lightest = filling * math.sin(0.5 * math.pi * fewest / (_MARGIN * columns)) ** 2
    raise InvalidInput(
        f"pressure of {scene.name} is {scene.pressure:g} MPa, but must be at least {lightest:.2g} MPa: "
        f"lighter contacts have fewer than {fewest} surface nodes on the finest mesh, of {columns} columns; {remedy}"
    )


def require_height(scene: Scene) -> None:
    """Refuse to solve a scene in finite strain whose load leaves hardly anything of the block.

    Raises
    ------
    InvalidInput
        With the heaviest pressure that is possible.
    """
    left = pressed(scene.material, scene.pressure, scene.plane)[0]
    if left < _LEAST_HEIGHT:
        heaviest = pressing(scene.material, _LEAST_HEIGHT, scene.plane)
        raise InvalidInput(
            f"pressure of {scene.name} is {scene.pressure:g} MPa, but must be at most {heaviest:.3g} MPa: it leaves "
            f"{left:.2%} of the height of the relaxed block; less than {_LEAST_HEIGHT:.0%} is outside the model's range"
        )


def require_columns(scene: Scene, columns: int, fewest: float) -> None:
    """Refuse to march a scene whose contact has fewer than ``fewest`` nodes on a surface of so many columns.

    Raises
    ------
    InvalidInput
    """
    needed = fewest / (_MARGIN * estimated_fraction(scene))
    if columns < needed:
        raise InvalidInput(
            f"procedure.columns is {columns}, but must be at least {8 * math.ceil(needed / 8)} for {scene.name}: so "
            f"light a contact has fewer than {fewest:g} surface nodes otherwise"
        )


def require_resolved(scene: Scene, touching: Flags, steps: int, remedy: str) -> None:
    """Refuse a contact that has too few nodes.

    Parameters
    ----------
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
        raise NotConverged(
            scene.name,
            steps,
            count,
            f"number of surface nodes in contact, out of {len(touching)},",
            f"at least {fewest} make a prediction: raise the pressure; {remedy}",
        )
