"""Where to begin: coarse fits from all starts of a law, and free shifts that are caught set free."""

from __future__ import annotations

import numpy as np

from rubfric.dma.joint import COARSE, MARGIN, Joint, follow, scales_of, window
from rubfric.dma.laws import LN10, Law
from rubfric.dma.measurements import Measurements
from rubfric.dma.spectrum import grid, solve

# Most branches while starts are compared.
_MOST_BRANCHES = 200
# Starts that are followed to their end.
_FOLLOWED = 3
# How often the steps of free shifts are gone through, and by how many decades each is changed.
_SWEEPS, _CHANGES = 6, (-2.0, -1.0, -0.4, 0.4, 1.0, 2.0, 3.0)


def search(data: Measurements, law: Law, vertical: str, reference: float, static: float | None) -> Joint:
    """Fit coarsely from all starts of a law: the best few are followed to their end.

    Parameters
    ----------
    data : Measurements
    law : Law
    vertical : {"none", "entropic", "free"}
    reference : float
        Reference temperature, degC.
    static : float, optional
        Static modulus, MPa, where it is known.
    """
    free = len(data.temperatures) - 1 if vertical == "free" else 0
    scales = scales_of(vertical, data.temperatures, reference, np.zeros(free))
    tried = []
    for start in law.starts:
        shifts = law.shifts(start)
        times = grid(*window(data, shifts), COARSE, MARGIN)
        if len(times) <= _MOST_BRANCHES:
            residuals = solve(data, times, shifts, scales, static).residuals
            tried.append((float(residuals @ residuals), start))
    best = sorted(tried, key=lambda pair: pair[0])[:_FOLLOWED]
    found = []
    for _, start in best:
        whole = np.concatenate((start, np.zeros(free)))
        for _ in range(2):  # times follow the window, which follows the shifts
            times = grid(*window(data, law.shifts(whole[: len(start)])), COARSE, MARGIN)
            joint = follow(data, law, vertical, reference, whole, times, static)
            whole = joint.parameters
        found.append(joint)
    return min(found, key=lambda joint: joint.cost)


def unstick(data: Measurements, joint: Joint, static: float | None) -> Joint:
    """Fit again with each step of free shifts longer or shorter in turn, while that lowers the cost.

    A step may be caught where a branch of one isotherm meets the next branch of its neighbour.

    Parameters
    ----------
    data : Measurements
    joint : Joint
        Its law is free.
    static : float, optional
        Static modulus, MPa, where it is known.
    """
    count = joint.law.bounds[0].size
    for _ in range(_SWEEPS):
        parameters, best = joint.parameters.copy(), joint.cost
        for step in range(count):
            for change in _CHANGES:
                tried = parameters.copy()
                tried[step] = max(tried[step] + change * LN10, 0.0)
                scales = scales_of(joint.vertical, data.temperatures, joint.reference, tried[count:])
                shifts = joint.law.shifts(tried[:count])
                times = grid(*window(data, shifts), COARSE, MARGIN)
                residuals = solve(data, times, shifts, scales, static).residuals
                if float(residuals @ residuals) < 0.98 * best:
                    parameters, best = tried, float(residuals @ residuals)
        times = grid(*window(data, joint.law.shifts(parameters[:count])), COARSE, MARGIN)
        again = follow(data, joint.law, joint.vertical, joint.reference, parameters, times, static)
        if again.cost > 0.98 * joint.cost:
            return min(joint, again, key=lambda each: each.cost)
        joint = again
    return joint
