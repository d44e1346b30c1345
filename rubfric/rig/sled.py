"""The motion of the rig's sled under a hanging weight: simulated."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
from scipy.integrate import cumulative_trapezoid, solve_ivp
from scipy.optimize import brentq

from rubfric.arrays import Real
from rubfric.errors import InvalidInput, NotConverged
from rubfric.results.friction_map import FrictionCurve

GRAVITY = 9806.65  # mm/s²
# Relative accuracy of the motion, and number of speeds at which forces are evaluated.
_ACCURACY, _POINTS = 1e-7, 4001
# A sweep reaches its speed within this part of the travel, under at least this multiple of the largest force.
_REACH, _EXCESS = 0.8, 1.03


@dataclass(frozen=True)
class Sled:
    """The moving parts of the rig.

    Attributes
    ----------
    area : float
        Nominal area of the rubber, mm².
    mass : float
        Of the sled with the road sample, kg.
    travel : float
        Of the sled, mm.
    bearing_force, bearing_coefficient, bearing_damping : float
        Drag of the bearings: a force (N), a share of the normal force, and a force per speed (N s/mm).
    """

    area: float
    mass: float
    travel: float
    bearing_force: float = 0.0
    bearing_coefficient: float = 0.0
    bearing_damping: float = 0.0

    def drag(self, speed: Real | float, normal: float) -> Real | float:
        """Return the drag of the bearings, N.

        Parameters
        ----------
        speed : numpy.ndarray of any shape, or float
            mm/s, positive.
        normal : float
            Normal force, N.
        """
        return self.bearing_force + self.bearing_coefficient * normal + self.bearing_damping * speed

    def resistance(self, curve: FrictionCurve, pressure: float) -> Callable[[Real | float], Real]:
        """Return friction plus drag of the bearings, N, as a function of the speed (mm/s) of the sled.

        Parameters
        ----------
        curve : FrictionCurve
            Friction over speed at ``pressure``.
        pressure : float
            Nominal, MPa.
        """
        normal = pressure * self.area
        return lambda speed: np.asarray(curve(speed) * normal + self.drag(speed, normal))


@dataclass(frozen=True)
class Motion:
    """The sled from its release until it stops or exceeds the speeds of the friction curve.

    Attributes
    ----------
    duration : float
        s.
    state : callable
        Displacement (mm) and speed (mm/s), shape (2, times), at times (s, from 0 to ``duration``).
    end : str
        Why it ended.
    """

    duration: float
    state: Callable[[Real], Real]
    end: str


def slide(sled: Sled, curve: FrictionCurve, pressure: float, weight: float, most: float, distance: float) -> Motion:
    """Release the sled and integrate (sled + weight) dv/dt = weight g - friction - bearings.

    Near rest friction rises so steeply with speed that the equation is stiff, past its peak it is not: LSODA, which
    changes between an implicit and an explicit method of many orders.

    Parameters
    ----------
    sled : Sled
    curve : FrictionCurve
        Friction of the rubber over speed at ``pressure``.
    pressure : float
        Nominal, MPa.
    weight : float
        Hanging from the rope, kg.
    most, distance : float
        The sled is stopped after this time (s) and this displacement (mm), and at the fastest speed of ``curve``.

    Raises
    ------
    InvalidInput
        For a weight that the bearings hold.
    NotConverged
        Where the integration fails.
    """
    resistance = sled.resistance(curve, pressure)
    pull, mass = 1e-3 * weight * GRAVITY, 1e-3 * (sled.mass + weight)
    held = float(resistance(0.0))
    if pull <= held:
        raise InvalidInput(
            f"weight is {weight:g} kg, which pulls with {pull:.4g} N, but must exceed {1e3 * held / GRAVITY:.4g} kg: "
            f"the bearings hold the sled with {held:.4g} N"
        )

    def rates(_: float, state: Real) -> list[float]:
        return [state[1], (pull - float(resistance(state[1]))) / mass]

    def travelled(_: float, state: Real) -> float:
        return float(state[0] - distance)

    def known(_: float, state: Real) -> float:
        return float(state[1] - curve.speeds[-1])

    for event in (travelled, known):
        event.terminal = True  # type: ignore[attr-defined]
    solved = solve_ivp(
        rates,
        (0.0, most),
        [0.0, 0.0],
        method="LSODA",
        dense_output=True,
        events=(travelled, known),
        rtol=_ACCURACY,
        atol=[1e-7, 1e-6 * float(curve.speeds[0])],
    )
    if not solved.success:
        raise NotConverged("motion of the sled", int(solved.nfev), float(solved.t[-1]), "time reached, s")
    ends = ["stopped by hand", f"stopped after {distance:g} mm", "faster than what was simulated"]
    end = ends[0] if solved.status == 0 else ends[1] if solved.t_events[0].size else ends[2]
    return Motion(float(solved.t[-1]), solved.sol, end)


@dataclass(frozen=True)
class Weight:
    """A weight for a speed.

    Attributes
    ----------
    mass : float
        kg.
    settles : bool
        Whether the sled settles at the speed, or passes through it.
    """

    mass: float
    settles: bool


def choose_weight(sled: Sled, curve: FrictionCurve, pressure: float, speed: float, heaviest: float) -> Weight | str:
    """Return the weight with which the sled slides at a speed (mm/s), or why there is none.

    Where the resistance exceeds that of every slower speed, the sled settles there under a weight equal to it. Where
    it does not, past the peak of friction, no weight holds the sled at that speed: it runs through it, under the
    lightest weight that brings it there within the travel.

    Parameters
    ----------
    sled : Sled
    curve : FrictionCurve
    pressure : float
        Nominal, MPa.
    speed : float
        mm/s, one of those that ``curve`` knows.
    heaviest : float
        kg.
    """
    resistance = sled.resistance(curve, pressure)
    slower = np.concatenate(([0.0], np.geomspace(min(1e-3 * curve.speeds[0], 1e-3 * speed), speed, _POINTS)))
    forces = resistance(slower)
    settles = bool(forces[-1] > forces[:-1].max() and forces[-1] > forces[-2] * (1.0 + 1e-6))
    if settles:
        needed = 1e3 * float(forces[-1]) / GRAVITY
    else:
        least = _EXCESS * 1e3 * float(forces.max()) / GRAVITY

        def beyond(logarithm: float) -> float:
            return _run_up(sled.mass, float(np.exp(logarithm)), slower, forces) - _REACH * sled.travel

        fastest = float(np.sqrt(2.0 * GRAVITY * _REACH * sled.travel))
        if beyond(np.log(max(least, heaviest))) > 0.0:
            if speed >= fastest:
                return f"not reached: even in free fall {_REACH * sled.travel:g} mm of travel give {fastest:.0f} mm/s"
            return f"not reached within the travel of {sled.travel:g} mm under the heaviest weight, {heaviest:g} kg"
        within = beyond(np.log(least)) <= 0.0
        needed = least if within else float(np.exp(brentq(beyond, np.log(least), np.log(heaviest), xtol=1e-6)))
    if needed > heaviest:
        return f"needs a weight of {needed:.1f} kg, more than the heaviest, {heaviest:g} kg"
    return Weight(needed, settles)


def _run_up(mass: float, weight: float, speeds: Real, forces: Real) -> float:
    """Return the travel, mm, in which a weight (kg) brings the sled to the last of some speeds: the work of forces."""
    excess = 1e-3 * weight * GRAVITY - forces
    return float(cumulative_trapezoid(1e-3 * (mass + weight) * speeds / excess, speeds)[-1])
