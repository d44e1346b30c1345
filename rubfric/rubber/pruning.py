"""Prony branches that a scene does not need: relaxed or frozen at every frequency that it excites.

A branch far faster than the excitation carries nothing, and one far slower is a spring to all that moves. Folding
drops the former and gathers the latter in one branch that never relaxes while the rubber slides; what that does to
the complex modulus is bounded.
"""

from __future__ import annotations

import dataclasses
from dataclasses import dataclass

import numpy as np

from rubfric.arrays import Real
from rubfric.errors import InvalidInput
from rubfric.rubber.material import Material

# Relaxation time, s, of the branch that never relaxes.
_NEVER = 1e30


@dataclass(frozen=True)
class Folding:
    """A rubber reduced to the branches that a scene needs.

    Attributes
    ----------
    material : Material
        The rubber without the relaxed branches, the frozen ones gathered in one.
    relaxed, frozen : tuple of int
        Indices of the branches folded.
    bound : float
        Largest change of the complex shear modulus over its loss part at any of the frequencies: about the largest
        relative change of friction.
    """

    material: Material
    relaxed: tuple[int, ...]
    frozen: tuple[int, ...]
    bound: float


def fold(material: Material, frequencies: Real, tolerance: float) -> Folding:
    """Fold as many branches as ``tolerance`` allows, the least important first.

    Parameters
    ----------
    material : Material
    frequencies : ndarray, shape (n,)
        Every angular frequency that the scene excites, rad/s, none of them zero.
    tolerance : float
        Bound on ``Folding.bound``.
    """
    transfer = material.branch_transfer(frequencies)
    shear = material.branch_shear_moduli[:, None]
    loss = np.abs((shear * transfer).sum(axis=0).imag)
    if not len(shear) or not loss.min() > 0.0:
        return Folding(material, (), (), 0.0)
    dropped, gathered = shear * np.abs(transfer) / loss, shear * np.abs(1.0 - transfer) / loss
    relaxes = dropped.max(axis=1) <= gathered.max(axis=1)
    effect = np.where(relaxes[:, None], dropped, gathered)
    bound, folded = np.zeros_like(loss), []
    for branch in np.argsort(effect.max(axis=1)):
        if (bound + effect[branch]).max() > tolerance:
            break
        bound += effect[branch]
        folded.append(int(branch))
    relaxed = tuple(sorted(branch for branch in folded if relaxes[branch]))
    frozen = tuple(sorted(branch for branch in folded if not relaxes[branch]))
    if not relaxed and len(frozen) < 2:  # one frozen branch gathered is the branch that it was
        return Folding(material, (), (), 0.0)
    try:
        reduced = _reduced(material, relaxed, frozen)
    except InvalidInput:  # a rubber so near to a liquid that its digits do not suffice
        return Folding(material, (), (), 0.0)
    # Nor may the digits of the new fractions, whose sum is taken from 1, change more than folding does.
    change = np.abs(reduced.complex_shear_modulus(frequencies) - material.complex_shear_modulus(frequencies)) / loss
    largest = float(max(bound.max(), change.max()))
    return Folding(reduced, relaxed, frozen, largest) if largest <= tolerance else Folding(material, (), (), 0.0)


def _reduced(material: Material, relaxed: tuple[int, ...], frozen: tuple[int, ...]) -> Material:
    kept = [i for i in range(len(material.relaxation_times)) if i not in relaxed and i not in frozen]
    moduli = [float(material.branch_shear_moduli[i]) for i in kept]
    times = [material.relaxation_times[i] for i in kept]
    if frozen:
        moduli.append(float(material.branch_shear_moduli[list(frozen)].sum()))
        times.append(_NEVER)
    shear, bulk = material.long_term_shear_modulus, material.long_term_bulk_modulus
    total = shear + sum(moduli)
    return dataclasses.replace(
        material,
        youngs_modulus=9.0 * bulk * shear / (3.0 * bulk + shear),
        poissons_ratio=(3.0 * bulk - 2.0 * shear) / (2.0 * (3.0 * bulk + shear)),
        shear_fractions=tuple(modulus / total for modulus in moduli),
        relaxation_times=tuple(times),
        moduli="long_term",
    )
