"""How the friction of the whole road is obtained, and the roads that are simulated for it."""

from __future__ import annotations

import math
import random
from dataclasses import dataclass, replace

from rubfric.errors import InvalidInput
from rubfric.road.waves import WaveRoad

# The ways from the scales to the whole road; direct simulates all scales at once, auto takes the cheapest that will do.
WAYS = ("sum", "corrected", "cascade", "persson", "direct", "auto")
# Those that simulate the whole road.
DIRECT = ("direct", "auto")


@dataclass(frozen=True)
class Multiscale:
    """The way to the friction of the whole road.

    Attributes
    ----------
    way : {"sum", "corrected", "cascade", "persson", "direct", "auto"}
    preset : str
        The preset with which the whole road is simulated.
    draws : int
        Random sets of phases to average over; 0 for the phases given at the scales.
    seed : int
        Of the random phases.
    """

    way: str
    preset: str
    draws: int
    seed: int

    @property
    def simulated(self) -> bool:
        """Whether the whole road is simulated."""
        return self.way in DIRECT

    def roads(
        self, name: str, amplitudes: tuple[float, ...], wavenumbers: tuple[float, ...], phases: tuple[float, ...]
    ) -> dict[str, WaveRoad]:
        """Return the whole road under no name, or with random phases every draw under ``drawN/``; nothing for others.

        Parameters
        ----------
        name : str
            Of the road, for the message.
        amplitudes, wavenumbers, phases : tuple of float, shape (scales,)
            mm, 1/mm and rad.

        Raises
        ------
        InvalidInput
            Where the scales have no common period.
        """
        if not self.simulated:
            return {}
        try:
            road = WaveRoad(amplitudes, wavenumbers, phases)
        except InvalidInput as error:
            raise InvalidInput(
                f"roads.{name} cannot be taken whole, as multiscale: {self.way} does: {error}; multiscale: sum does "
                "without"
            ) from None
        numbers = random.Random(self.seed)
        drawn = [tuple(numbers.uniform(0.0, 2.0 * math.pi) for _ in amplitudes) for _ in range(self.draws)]
        return {f"draw{1 + place}/": replace(road, phases=one) for place, one in enumerate(drawn)} or {"": road}
