"""Shifts and spectrum fitted at once, for one law of shifting and one set of relaxation times."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from scipy.optimize import least_squares

from rubfric.arrays import Real
from rubfric.dma.laws import LN10, Law
from rubfric.dma.measurements import Measurements
from rubfric.dma.spectrum import Spectrum, grid, solve
from rubfric.rubber.shift import KELVIN

# Branches a decade while shifts are looked for.
COARSE = 2.0
# Decades beyond the window in which a branch may lie, since the slope of its moduli still shows at the end.
MARGIN = 1.0
# Largest |ln b_T|: moduli do not double by a change of temperature alone.
_LARGEST_SCALE = 0.7
# How far a relaxation time may move, in ln tau.
_FARTHEST = 1.5


@dataclass(frozen=True, eq=False)
class Joint:
    """A joint fit.

    Attributes
    ----------
    law : Law
    vertical : {"none", "entropic", "free"}
    reference : float
        Reference temperature, degC.
    parameters : ndarray
        Those of the law, then ln b_T of all isotherms but one, where they are free, then ln tau, where times are.
    times : ndarray, shape (branches,)
        Relaxation times, s; at the reference temperature, but for free shifts.
    spectrum : Spectrum
    jacobian : ndarray, shape (2 points, parameters)
        Derivative of the residuals by the parameters, the moduli eliminated.
    moving : bool
        Whether the relaxation times were fitted too.
    """

    law: Law
    vertical: str
    reference: float
    parameters: Real
    times: Real
    spectrum: Spectrum
    jacobian: Real
    moving: bool = False

    @property
    def cost(self) -> float:
        """Sum of the squared residuals."""
        return float(self.spectrum.residuals @ self.spectrum.residuals)

    @property
    def unknowns(self) -> int:
        """Moduli above 0, and parameters of the shifts."""
        return int(np.count_nonzero(self.spectrum.moduli)) + len(self.parameters)

    @property
    def bic(self) -> float:
        """Bayesian information criterion, n ln(cost / n) + unknowns ln n (Schwarz 1978)."""
        count = len(self.spectrum.residuals)
        return count * float(np.log(max(self.cost, 1e-30) / count)) + self.unknowns * float(np.log(count))

    @property
    def shifts(self) -> Real:
        """Shifts ln a_T of the isotherms."""
        return self.law.shifts(self.parameters[: self.law.bounds[0].size])

    def scales(self, temperatures: Real) -> Real:
        """Return ln b_T of the isotherms, whose temperatures are given in degC."""
        return scales_of(self.vertical, temperatures, self.reference, own_parameters(self)[self.law.bounds[0].size :])


def own_parameters(joint: Joint) -> Real:
    """Return the parameters of law and scales, without relaxation times."""
    return joint.parameters[: len(joint.parameters) - (len(joint.times) if joint.moving else 0)]


def scales_of(vertical: str, temperatures: Real, reference: float, own: Real) -> Real:
    """Return ln b_T of the isotherms.

    Parameters
    ----------
    vertical : {"none", "entropic", "free"}
    temperatures : ndarray, shape (isotherms,)
        degC.
    reference : float
        Reference temperature, degC.
    own : ndarray, shape (isotherms - 1,) or (0,)
        Those of all isotherms but the one nearest the reference, where they are free.
    """
    if vertical == "free":
        return np.insert(own, int(np.argmin(np.abs(temperatures - reference))), 0.0)
    if vertical == "entropic":
        return np.log((temperatures + KELVIN) / (reference + KELVIN))
    return np.zeros_like(temperatures)


def window(data: Measurements, shifts: Real) -> tuple[float, float]:
    """Return the least and the largest reduced frequency, rad/s.

    Parameters
    ----------
    data : Measurements
    shifts : ndarray, shape (isotherms,)
        ln a_T.
    """
    reduced = np.log(data.frequency) + shifts[data.isotherm]
    return float(np.exp(reduced.min())), float(np.exp(reduced.max()))


def times_window(data: Measurements, shifts: Real) -> tuple[float, float]:
    """Return ln of the shortest and the longest relaxation time that the data can tell of: the window and a margin.

    Parameters
    ----------
    data : Measurements
    shifts : ndarray, shape (isotherms,)
        ln a_T.
    """
    low, high = window(data, shifts)
    return -float(np.log(high)) - MARGIN * LN10, -float(np.log(low)) + MARGIN * LN10


def follow(
    data: Measurements,
    law: Law,
    vertical: str,
    reference: float,
    start: Real,
    times: Real,
    static: float | None,
    moving: bool = False,
    tolerance: float = 1e-8,
) -> Joint:
    """Fit from one start.

    Parameters
    ----------
    data : Measurements
    law : Law
    vertical : {"none", "entropic", "free"}
    reference : float
        Reference temperature, degC.
    start : ndarray, shape (parameters,)
        Of law and scales.
    times : ndarray, shape (branches,)
        Relaxation times, s.
    static : float, optional
        Static modulus, MPa, where it is known.
    moving : bool
        Whether the times are only where to begin.
    tolerance : float
        Relative changes of cost and parameters at which the fit ends.
    """
    count, temperatures = law.bounds[0].size, data.temperatures
    nearest = int(np.argmin(np.abs(temperatures - reference))) if vertical == "free" else 0
    free = len(start) - count
    which = np.delete(np.eye(len(temperatures)), nearest, axis=1)
    shortest, longest = times_window(data, law.shifts(start[:count]))
    own = np.clip(np.log(times), shortest, longest) if moving else np.log(times)
    slow, fast = np.minimum(own + _FARTHEST, longest), np.maximum(own - _FARTHEST, shortest)
    low = np.concatenate((law.bounds[0], np.full(free, -_LARGEST_SCALE), fast if moving else []))
    high = np.concatenate((law.bounds[1], np.full(free, _LARGEST_SCALE), slow if moving else []))
    both = np.concatenate((data.isotherm, data.isotherm))
    last: tuple[Real, Spectrum] | None = None

    def at(parameters: Real) -> Spectrum:
        nonlocal last
        if last is None or not np.array_equal(last[0], parameters):
            scales = scales_of(vertical, temperatures, reference, parameters[count : count + free])
            here = np.exp(parameters[count + free :]) if moving else times
            last = parameters.copy(), solve(data, here, law.shifts(parameters[:count]), scales, static)
        return last[1]

    def jacobian(parameters: Real) -> Real:
        found = at(parameters)
        columns = [law.derivative(parameters[:count])[both] * found.by_time.sum(axis=1)[:, None]]
        if free:
            columns.append(which[both] * found.by_scale[:, None])
        if moving:
            columns.append(found.by_time)
        return found.project(np.column_stack(columns))

    start = np.concatenate((start, own)) if moving else start
    start = np.clip(start, low + 1e-6 * (high - low), high - 1e-6 * (high - low))
    if start.size:
        start = least_squares(
            lambda parameters: at(parameters).residuals,
            start,
            jacobian,
            bounds=(low, high),
            x_scale="jac",
            ftol=tolerance,
            xtol=tolerance,
            gtol=1e-12,
            max_nfev=80,
        ).x
    found = np.exp(start[count + free :]) if moving else times
    return Joint(law, vertical, reference, start, found, at(start), jacobian(start), moving)


def refine(data: Measurements, joint: Joint, per_decade: float, margin: float, static: float | None) -> Joint:
    """Fit again, from a fit, with evenly spaced relaxation times.

    Parameters
    ----------
    data : Measurements
    joint : Joint
    per_decade : float
        Branches a decade.
    margin : float
        Decades by which the times reach beyond the window.
    static : float, optional
        Static modulus, MPa, where it is known.
    """
    times = grid(*window(data, joint.shifts), per_decade, margin)
    start = own_parameters(joint)
    return follow(data, joint.law, joint.vertical, joint.reference, start, times, static)


def merge(data: Measurements, joint: Joint, static: float | None) -> Joint:
    """Fit again, from a fit with dense times: neighbouring branches become one, whose time is fitted too.

    Parameters
    ----------
    data : Measurements
    joint : Joint
        Its times are evenly spaced.
    static : float, optional
        Static modulus, MPa, where it is known.
    """
    moduli, own = joint.spectrum.moduli[1:], np.log(joint.times)
    times, place = [], 0
    while place < len(moduli):
        here = slice(place, place + 2)
        if moduli[place] > 0.0:
            times.append(float(np.average(own[here], weights=moduli[here])))
            place += 1
        place += 1
    return follow(
        data, joint.law, joint.vertical, joint.reference, joint.parameters, np.exp(times), static, moving=True
    )


def repeat(data: Measurements, joint: Joint, static: float | None) -> Joint:
    """Fit other data of the same rubber, from a fit and in the same way.

    Parameters
    ----------
    data : Measurements
    joint : Joint
    static : float, optional
        Static modulus, MPa, where it is known.
    """
    start = own_parameters(joint)
    return follow(data, joint.law, joint.vertical, joint.reference, start, joint.times, static, joint.moving, 1e-5)
