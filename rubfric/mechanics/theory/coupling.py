"""What the scales of a road do to one another, and what a total that leaves it out is worth.

Small strain on the closed-form layer: all ways from scales to the total cost milliseconds there, so that their ratios
say, for one point, how far each way may be from the truth in any kinematics.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import lru_cache

from rubfric.mechanics.theory.cascade import cascade_friction
from rubfric.mechanics.theory.layercontact import Layer, load_road, load_sine
from rubfric.mechanics.theory.persson import persson_friction, scales
from rubfric.road.sine import SineScale
from rubfric.road.waves import WaveRoad
from rubfric.rubber.material import Material

WAYS = ("sum", "cascade", "persson", "direct")
_FACTOR, _FLOOR = 1.5, 0.02


@dataclass(frozen=True)
class Coupling:
    """The total friction coefficient of a road by four ways, in small strain on the closed-form layer.

    Attributes
    ----------
    sum : float
        Of all scales, each at the nominal pressure.
    cascade : float
        Each finer scale under the contact pressures of the coarser one.
    persson : float
        By Persson's theory for ridges.
    direct : float
        All waves at once.
    """

    sum: float
    cascade: float
    persson: float
    direct: float

    def error(self, way: str) -> float:
        """Return how far a total by this way may be from the direct one, over the total; 0 for the direct one.

        Parameters
        ----------
        way : {"sum", "cascade", "persson", "direct"}
        """
        if way == "direct":
            return 0.0
        value = {"sum": self.sum, "cascade": self.cascade, "persson": self.persson}[way]
        if value == 0.0:
            return 0.0
        return _FACTOR * abs(self.direct / value - 1.0) + _FLOOR


@lru_cache(maxsize=1024)
def estimate(
    material: Material, road: WaveRoad, velocity: float, pressure: float, height: float, plane: str
) -> Coupling:
    """Return the total friction by four ways.

    Parameters
    ----------
    material : Material
    road : WaveRoad
    velocity : float
        v, mm/s.
    pressure : float
        Nominal, MPa.
    height : float
        H, mm.
    plane : {"stress", "strain"}

    Raises
    ------
    NotConverged
        As ``solve_contact`` does.
    """
    layer = Layer(material, velocity, height, plane)
    amplitudes, wavenumbers = scales(road)
    sines = tuple(SineScale(a, k) for a, k in zip(amplitudes.tolist(), wavenumbers.tolist(), strict=True))
    if not sines:
        return Coupling(0.0, 0.0, 0.0, 0.0)
    return Coupling(
        sum=sum(load_sine(layer, sine, pressure).friction for sine in sines),
        cascade=cascade_friction(layer, sines, pressure),
        persson=float(persson_friction(material, road, velocity, pressure, height, plane).sum()),
        direct=load_road(layer, road, pressure).friction,
    )
