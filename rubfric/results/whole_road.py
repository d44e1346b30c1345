"""By which way the friction of a road is found: all scales at once, or cheaper where that is accurate enough."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

from rubfric.errors import NotConverged
from rubfric.mechanics.theory.coupling import Coupling, estimate
from rubfric.mechanics.theory.layer import full_contact_pressure
from rubfric.road.road import finest_waves
from rubfric.road.waves import WaveRoad
from rubfric.rubber.material import Material

# Finest waves in contact, of one period, beyond which the whole road takes minutes in finite strain, or has no solution
# that can be found; fewer under a heavy load, of so many long-term shear moduli.
_MOST_WAVES, _MOST_WAVES_HEAVY, _HEAVY = 40.0, 13.0, 1.5


@dataclass(frozen=True)
class WholeRoad:
    """What the friction of the whole road depends on besides the results of scenes.

    Attributes
    ----------
    way : {"sum", "corrected", "cascade", "persson", "direct", "auto"}
        By which it is asked for.
    accuracy : float
        Relative; what ``auto`` asks of the coupling.
    material : Material
    plane : {"stress", "strain"}
    kinematics : {"small", "finite", "auto"}
    aspect : float
        Height over width of the blocks on the scales.
    height : float
        Of the block on the whole road, mm.
    roads : tuple of WaveRoad
        The road, or those with random phases; of a measured profile its sines.
    windows : int
        How many windows of a measured profile are slid over in their place; 0 for none.
    """

    way: str
    accuracy: float
    material: Material
    plane: str
    kinematics: str
    aspect: float
    height: float
    roads: tuple[WaveRoad, ...]
    windows: int = 0

    @property
    def count(self) -> int:
        """How many roads are simulated, if any."""
        return self.windows or len(self.roads)

    @classmethod
    def from_parameters(cls, parameters: Mapping[str, Any]) -> WholeRoad:
        """Return it from plain values, as ``Campaign.whole_parameters`` gives them."""
        roads = tuple(WaveRoad(**{name: tuple(of) for name, of in road.items()}) for road in parameters["roads"])
        return cls(**dict(parameters) | {"material": Material(**parameters["material"]), "roads": roads})

    def couplings(self, velocity: float, pressure: float) -> list[Coupling]:
        """Return what the scales of each road do to one another at a speed (mm/s) and a pressure (MPa).

        Parameters
        ----------
        velocity : float
            mm/s.
        pressure : float
            Nominal, MPa.
        """
        about = (velocity, pressure, self.height, self.plane, self.kinematics)
        return [estimate(self.material, road, *about) for road in self.roads]

    def accurate_enough(self, velocity: float, pressure: float) -> str:
        """Return the cheapest way whose total is accurate enough on every road, or "direct" where none is.

        Parameters
        ----------
        velocity : float
            mm/s.
        pressure : float
            Nominal, MPa.

        Raises
        ------
        NotConverged
            As ``solve_contact`` does.
        """
        ways = {one.cheapest(self.accuracy) for one in self.couplings(velocity, pressure)}
        return ways.pop() if len(ways) == 1 else "direct"

    def cheapest(self, velocity: float, pressure: float) -> str:
        """Return the cheapest way that is accurate enough, on every road, at a speed (mm/s) and a pressure (MPa).

        In finite strain it is the corrected sum where no way is, and many of the road's waves are in contact: the whole
        road would take minutes there.

        Parameters
        ----------
        velocity : float
            mm/s.
        pressure : float
            Nominal, MPa.
        """
        try:
            way = self.accurate_enough(velocity, pressure)
        except NotConverged:
            return "direct"
        return "corrected" if way == "direct" and self._dear(velocity, pressure) else way

    def _dear(self, velocity: float, pressure: float) -> bool:
        """Return whether the whole road would take minutes at a speed (mm/s) and a pressure (MPa)."""
        if self.kinematics == "small":
            return False
        heavy = pressure > _HEAVY * self.material.long_term_shear_modulus
        return self._waves_in_contact(velocity, pressure) > (_MOST_WAVES_HEAVY if heavy else _MOST_WAVES)

    def _waves_in_contact(self, velocity: float, pressure: float) -> float:
        """Return the finest waves of a period times Persson's contact fraction of the whole road, erf(p / p*)."""
        about = (velocity, self.height, self.plane)
        waves = [
            finest_waves(road) * math.erf(pressure / full_contact_pressure(self.material, road, *about))
            for road in self.roads
            if road.steepest_slope
        ]
        return max(waves, default=math.inf)
