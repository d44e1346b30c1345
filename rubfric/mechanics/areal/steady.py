"""Steady sliding over an areal road: from coarse nodes to fine, friction by two routes, and its error."""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np
from scipy import fft

from rubfric.arrays import Complex, Real
from rubfric.errors import InvalidInput, NotConverged
from rubfric.mechanics.areal.compliance import ArealCompliance
from rubfric.mechanics.areal.contact import ArealContact, solve_contact
from rubfric.mechanics.areal.surface import TOLERANCE
from rubfric.mechanics.steady.energies import ROUND_OFF, disagreement
from rubfric.road.areal import ArealSpectrum
from rubfric.scene.areal import ArealScene

# The first nodes are so many along the longer period or fewer; a result has so many along the shortest wave at least.
_COARSEST, _PER_WAVE = 16, 4
# Fewest nodes in contact that make a prediction.
_FEWEST = 16
# What friction from pressures on slopes changed from half as many nodes along each side counts for, and most of its
# share of friction that it counts for; how many times such estimates an error may be: see ``friction_error``.
_SLOPES, _MOST_SLOPES, _MARGIN = 0.4, 0.25, 1.3
# What the same change counts for where nodes were doubled since.
_FINER = 0.25
# Nodes resolve a contact whose dissipation changed by less than this share from half as many.
_MOST_CHANGE = 0.5


@dataclass(frozen=True)
class ArealFriction:
    """Friction on nodes of one shape, dimensionless.

    Attributes
    ----------
    shape : tuple of int
        (ny, nx).
    dissipation : float
        Coefficient from what the waves of pressure dissipate in the block.
    contact : float
        From pressures on slopes.
    across : float
        Force across the direction of sliding over the load, from pressures on slopes; towards its left.
    fraction : float
        Share of the nodes in contact.
    """

    shape: tuple[int, int]
    dissipation: float
    contact: float
    across: float
    fraction: float


@dataclass(frozen=True, eq=False)
class ArealSolution:
    """Steady sliding over an areal road, in the frame of the road.

    Attributes
    ----------
    scene : ArealScene
        What was solved.
    compliance : ArealCompliance
        The block.
    contact : ArealContact
        On the finest nodes.
    meshes : tuple of ArealFriction
        On all nodes that count, from coarse to fine, two at least; each has twice as many along each side as the one
        before.
    """

    scene: ArealScene
    compliance: ArealCompliance
    contact: ArealContact
    meshes: tuple[ArealFriction, ...]

    @property
    def friction_coefficient(self) -> float:
        """From what is dissipated on the finest nodes."""
        return self.meshes[-1].dissipation

    @property
    def friction_error(self) -> float:
        """Estimated error of the friction coefficient, absolute: of nodes, and of the solver."""
        return friction_error(self.meshes)

    @property
    def closure(self) -> float:
        """Difference of the two routes over the larger."""
        fine = self.meshes[-1]
        return disagreement((fine.dissipation, fine.contact), ROUND_OFF)

    @property
    def resolved(self) -> bool:
        """Whether the estimated error is within the accuracy asked for."""
        return self.friction_error <= self.scene.numerics.accuracy * abs(self.friction_coefficient) + ROUND_OFF

    @property
    def displacement(self) -> Real:
        """Displacement of the surface away from the road but for its mean, s + gap - d, mm."""
        shape = self.contact.pressure.shape
        return self.scene.road.spectrum.heights(shape) + self.contact.gap - self.contact.offset

    def dissipated(self) -> Real:
        """Return what each wave of pressure adds to the friction coefficient on the finest nodes.

        Returns
        -------
        ndarray, shape (ny, nx // 2 + 1)
            For wavevectors in the order of ``scipy.fft.rfft2``, a wave and its conjugate together.
        """
        spectrum = self.compliance.surface(self.meshes[-1].shape).compliance
        return _dissipated(self.scene, self.compliance, spectrum, self.contact)


def solve_areal(scene: ArealScene) -> ArealSolution:
    """Slide a block steadily over an areal road.

    Nodes are doubled along each side, each contact starting from the one before, until the estimated error of friction
    is within the accuracy or the nodes are as many as allowed.

    Parameters
    ----------
    scene : ArealScene

    Raises
    ------
    InvalidInput
        For a road whose shortest wave the nodes do not resolve.
    NotConverged
        With the scene's name, step and residual.
    """
    spectrum = scene.road.spectrum
    first, last = _columns(scene, spectrum)
    finest = spectrum.shape(last)
    compliance = ArealCompliance(
        scene.material, scene.velocity, scene.direction, scene.height, spectrum.periods, finest
    )
    contact: ArealContact | None = None
    meshes: list[ArealFriction] = []
    for columns in _doubled(first, last):
        shape = spectrum.shape(columns)
        surface = compliance.surface(shape)
        label = f"{scene.name} on {shape[1]} x {shape[0]} nodes"
        contact = solve_contact(surface, spectrum.heights(shape), scene.pressure, contact and contact.on(shape), label)
        if 2 * columns >= first:
            meshes.append(_friction(scene, compliance, surface.compliance, contact))
        if columns >= first and friction_error(meshes) <= scene.numerics.accuracy * abs(meshes[-1].dissipation):
            break
    assert contact is not None
    _require_nodes(scene, contact)
    coarse, fine = meshes[-2:]
    change = disagreement((coarse.dissipation, fine.dissipation), ROUND_OFF)
    if not change <= _MOST_CHANGE:
        raise NotConverged(
            scene.name,
            contact.pivots + contact.splittings,
            change,
            "relative change of friction from half as many nodes along each side",
            "nodes do not resolve this contact: raise the pressure or numerics.nodes_max, or leave out short waves",
        )
    return ArealSolution(scene, compliance, contact, tuple(meshes))


def friction_error(meshes: tuple[ArealFriction, ...] | list[ArealFriction]) -> float:
    """Return the estimated error of friction by dissipation on the last nodes, absolute.

    1.3 times the largest of three: what dissipation changed from half as many nodes along each side; by how much the
    routes differ; and 0.4 times what pressures on slopes changed. The latter two count for at most a quarter of
    friction: they stay where nearly relaxed rubber dissipates next to nothing, which dissipation alone gets right.
    Changes of coarser nodes count too, less by a factor of 4 each, since two resolutions may agree by chance. Factors
    were chosen on 48 scenes at random, and tried on others (``tools/benchmark/areal_error.py``).

    Parameters
    ----------
    meshes : sequence of ArealFriction
        Two at least.
    """
    fine = meshes[-1]
    size, change, slopes = abs(fine.dissipation), 0.0, abs(fine.dissipation - fine.contact)
    share = 1.0
    for before, mesh in zip(meshes[-2::-1], meshes[:0:-1], strict=True):
        change = max(change, share * abs(mesh.dissipation - before.dissipation))
        slopes = max(slopes, share * _SLOPES * abs(mesh.contact - before.contact))
        share *= _FINER
    return _MARGIN * max(change, min(slopes, _MOST_SLOPES * size)) + TOLERANCE * size


def _columns(scene: ArealScene, spectrum: ArealSpectrum) -> tuple[int, int]:
    """Return nodes along the longer period at first and at most, both so many times a power of two."""
    longest, numerics = max(spectrum.periods), scene.numerics
    waves = max((np.abs(spectrum.harmonics) * longest / np.array(spectrum.periods)).max(initial=1.0), 1.0)
    if _PER_WAVE * waves > numerics.nodes_max:
        needed = 16 * math.ceil(_PER_WAVE * waves / 16)
        shortest = _PER_WAVE * longest / numerics.nodes_max
        raise InvalidInput(
            f"numerics.nodes_max is {numerics.nodes_max}, but must be at least {needed}: the road's shortest wave is "
            f"{longest / waves:.4g} mm long, and {_PER_WAVE} nodes along it are the fewest; or leave out waves shorter "
            f"than {shortest:.4g} mm"
        )
    first = _COARSEST
    while first < numerics.nodes_per_wave * waves and 2 * first <= numerics.nodes_max:
        first *= 2
    if first < _PER_WAVE * waves:
        first = numerics.nodes_max
    last = first
    while 2 * last <= numerics.nodes_max:
        last *= 2
    return first, last


def _doubled(first: int, last: int) -> Iterator[int]:
    """Yield nodes along the longer period from coarse to ``last``, by way of ``first``."""
    columns = [first]
    while columns[-1] > _COARSEST and columns[-1] % 4 == 0:
        columns.append(columns[-1] // 2)
    if len(columns) == 1:
        columns.append(first // 2)
    yield from reversed(columns)
    while first < last:
        first *= 2
        yield first


def _friction(
    scene: ArealScene, compliance: ArealCompliance, spectrum: Complex, contact: ArealContact
) -> ArealFriction:
    """Return friction by either route.

    What a wave dissipates is -|p_k|² Im C(k) times the wavenumber along the direction of sliding, in the unit of v p.
    """
    shape = (contact.pressure.shape[0], contact.pressure.shape[1])
    lost = float(_dissipated(scene, compliance, spectrum, contact).sum())
    along, across = (
        float(np.mean(contact.pressure * scene.road.spectrum.slopes(shape, scene.direction + turn))) for turn in (0, 90)
    )
    return ArealFriction(shape, lost, along / scene.pressure, across / scene.pressure, contact.fraction)


def _dissipated(scene: ArealScene, compliance: ArealCompliance, spectrum: Complex, contact: ArealContact) -> Real:
    """Return what each wave of pressure adds to the friction coefficient, shape (ny, nx // 2 + 1)."""
    shape = (contact.pressure.shape[0], contact.pressure.shape[1])
    series = fft.rfft2(contact.pressure) / contact.pressure.size
    both = np.full(series.shape[1], 2.0)  # a wave and its conjugate, which the first and last column hold themselves
    both[0] = both[-1] = 1.0
    return -both * compliance.rates(shape) * np.abs(series) ** 2 * spectrum.imag / scene.pressure


def _require_nodes(scene: ArealScene, contact: ArealContact) -> None:
    count = int(np.count_nonzero(contact.pressure))
    if count < _FEWEST:
        raise NotConverged(
            scene.name,
            contact.pivots + contact.splittings,
            count,
            f"number of nodes in contact, out of {contact.pressure.size},",
            f"at least {_FEWEST} make a prediction: raise the pressure to about "
            f"{2.0 * scene.pressure * _FEWEST / max(count, 1):.2g} MPa, or numerics.nodes_max",
        )
