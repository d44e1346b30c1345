"""What one step of a march yields, whatever the kinematics."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, replace
from typing import Any, Protocol


@dataclass(frozen=True)
class Outcome:
    """What one step does; works and energies in N mm per mm of thickness.

    Attributes
    ----------
    friction : float
        Friction coefficient by the contact force at the end of the step.
    road_work, load_work : float
        Work of the road on the surface, and of the load on the top, during the step (forces by trapezium).
    stored, stored_change : float
        Strain energy at the end, and how much of it came during the step.
    dissipated : float
        During the step.
    contact_fraction : float
        Contact area over nominal area at the end.
    top : float
        Mean u_y of the top at the end, mm.
    iterations, krylov : int
        Newton or pivoting steps, and applications of the tangent.
    """

    friction: float
    road_work: float
    load_work: float
    stored: float
    stored_change: float
    dissipated: float
    contact_fraction: float
    top: float
    iterations: int
    krylov: int

    @property
    def imbalance(self) -> float:
        """External work less stored and dissipated energy: zero by the first law."""
        return self.road_work + self.load_work - self.stored_change - self.dissipated


def combine_steps(first: Outcome, second: Outcome) -> Outcome:
    """Return what two steps, one after the other, do.

    Parameters
    ----------
    first : Outcome
    second : Outcome
    """
    return replace(
        second,
        road_work=first.road_work + second.road_work,
        load_work=first.load_work + second.load_work,
        stored_change=first.stored_change + second.stored_change,
        dissipated=first.dissipated + second.dissipated,
        iterations=first.iterations + second.iterations,
        krylov=first.krylov + second.krylov,
    )


class Stepper(Protocol):
    """A block that goes one step of a march after the other, in one kinematics."""

    @property
    def offset(self) -> float:
        """How far the road has gone past, mm."""

    @property
    def pressure(self) -> float:
        """The load, MPa."""

    def press_relaxed(self, pressure: float) -> None:
        """Bring the block, relaxed, under a load of ``pressure``, MPa."""

    def slide_steadily(self, solution: Any) -> None:
        """Bring the block into the state of a solution of the same scene and kinematics on the same mesh."""

    def advance(self, duration: float, offset: float, pressure: float) -> Outcome:
        """Go one step: the road to an offset, mm, and the load to a pressure, MPa, in a duration, s.

        Parameters
        ----------
        duration : float
            s.
        offset : float
            How far the road has gone past at the end, mm.
        pressure : float
            Nominal, at the end, MPa.

        Raises
        ------
        NotConverged
            Where no contact is found; the state stays what it was.
        """

    def renew(self) -> None:
        """Forget what speeds up the next steps and is not part of the state."""

    def snapshot(self) -> dict[str, Any]:
        """Return the state as arrays by name."""

    def restore(self, arrays: Mapping[str, Any]) -> None:
        """Take over the state that ``snapshot`` returned."""
