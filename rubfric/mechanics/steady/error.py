"""How far a friction coefficient may be from that of the model: an estimate, calibrated."""

from __future__ import annotations

import math
from collections.abc import Sequence

from rubfric.mechanics.steady.solution import OnMesh, SteadySolution

# Order at which the error of friction is taken to fall with the size of the cells, between the 1 of a contact edge
# that jumps from node to node and the 2 of a smooth field.
ORDER = 1.5
# How many times the extrapolated change from mesh to mesh, and the difference between two routes, the error may be:
# calibrated, see the page on accuracy.
_CHANGE, _ROUTES = 1.5, 1.3
# Two meshes may agree by chance, the error along the road against that over the depth: no error is taken to be smaller
# than this times the square of the mesh's size there, in the finest wave's own measure.
_LEAST = 1.0 / 16.0
# A mesh hardly finer than another says nothing of it; meshes whose columns differ by less, nothing of these.
_LEAST_RATIO, _MORE_COLUMNS = 1.1, 1.2
# What spots of contact, whose edges jump from node to node, are off by where no other mesh says so: this times their
# nodes to the power -ORDER, over the root of their number.
_EDGES = 3.0


def discretisation_error(meshes: Sequence[OnMesh]) -> float:
    """Return the estimated error of friction by stress power on the last mesh, absolute, dimensionless.

    Every coarser mesh extrapolates to an error by either route, the difference between the routes is another, and the
    size of the cells allows none smaller than its square over 16: the largest counts. That size is 2 pi over the
    columns of the finest wave, or over the nodes of a spot of contact where these are more, and the growth of the rows
    over the depth. Where no coarser mesh has fewer columns, as on roads of many waves in finite strain, the nodes of
    these spots say how far off their edges may be. Cells at the road that are higher than wide make the largest as many
    times larger: by so much and more it was missed where they are 5 to 100 times as high.
    """
    *coarser, fine = meshes
    along = min(fine.waves / fine.columns, fine.spots / max(1, fine.contact_nodes))
    size = 2.0 * math.pi * along + fine.growth - 1.0
    found = [
        _ROUTES * abs(fine.friction.stress_power - fine.friction.contact),
        _LEAST * size**2 * abs(fine.friction.stress_power),
    ]
    if fine.waves > 1 and all(fine.columns < _MORE_COLUMNS * mesh.columns for mesh in coarser):
        nodes = max(1, fine.contact_nodes) / fine.spots
        found.append(_EDGES * nodes**-ORDER / math.sqrt(fine.spots) * abs(fine.friction.stress_power))
    for mesh in coarser:
        ratio = max(math.sqrt(fine.columns / mesh.columns * (mesh.growth - 1.0) / (fine.growth - 1.0)), _LEAST_RATIO)
        power = abs(fine.friction.stress_power - mesh.friction.stress_power)
        contact = abs(fine.friction.contact - mesh.friction.contact)
        found.append(_CHANGE * max(power, contact) / (ratio**ORDER - 1.0))
    return max(fine.first_row, 1.0) * max(found) + fine.friction.resolution


def allowance(solution: SteadySolution) -> float:
    """Return the error of discretisation that leaves the whole within the accuracy asked for, absolute."""
    return (solution.scene.numerics.accuracy - _model(solution)) * abs(solution.friction.stress_power)


def friction_error(solution: SteadySolution) -> float:
    """Return the estimated error of friction by stress power, absolute, dimensionless.

    It bounds what meshes, solver, folded branches and, where small strain was chosen for its accuracy, small strain
    change. Where small strain was asked for, the error is to small strain, finely meshed.
    """
    return discretisation_error(solution.meshes) + _model(solution) * abs(solution.friction.stress_power)


def _model(solution: SteadySolution) -> float:
    """Return the relative error of what the scene was solved without: folded branches, and finite strain."""
    chosen = solution.scene.kinematics == "auto" and solution.decision.kinematics == "small"
    return solution.folding.bound + (solution.decision.correction if chosen else 0.0)
