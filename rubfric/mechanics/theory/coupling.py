"""What the scales of a road do to one another, and what a total that leaves it out is worth.

In small strain on the closed-form layer each way from scales to the total costs milliseconds. There the ratio of the
direct total to that of another way is the coupling of the scales at this point; it carries over to the total T of
single scales that were solved in finite strain on a mesh, but for a margin M (calibrated, docs/multiscale.md):

    T_way = T_sum way / sum,    T_direct / T_way = direct / way (1 +- M).
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from functools import lru_cache

from rubfric.mechanics.theory.cascade import cascade_friction
from rubfric.mechanics.theory.compression import pressed
from rubfric.mechanics.theory.layer_contact import Layer, load_road, load_sine
from rubfric.mechanics.theory.persson import persson_friction, scales
from rubfric.road.sine import SineScale
from rubfric.road.waves import WaveRoad
from rubfric.rubber.material import Material

# What may be asked for in place of the direct total, the cheapest first.
WAYS = ("sum", "cascade", "persson", "corrected")
# M in small strain; in finite strain, and what it grows by with the share of its height that a flat block loses.
_SMALL, _FINITE, _PRESSED = 0.04, 0.13, 0.4
# Friction coefficients below this are those of rubber that dissipates nothing.
_NONE = 1e-9


@dataclass(frozen=True)
class Coupling:
    """The total friction coefficient of a road by several ways, in small strain on the closed-form layer.

    Attributes
    ----------
    sum : float
        Of all scales, each at the nominal pressure on a block as high in its own wavelengths (the paper's).
    cascade : float
        Each finer scale under the contact pressures of the coarser one.
    persson : float
        By Persson's theory for ridges.
    direct : float
        All waves at once.
    margin : float
        M, by how much the ratios of these four may differ from those of the kinematics in question, relative.
    """

    sum: float
    cascade: float
    persson: float
    direct: float
    margin: float

    def total(self, way: str, single: float) -> float:
        """Return the total by a way, from the sum of the friction coefficients of single scales in any kinematics.

        Parameters
        ----------
        way : {"sum", "cascade", "persson", "corrected"}
            By ``corrected`` it is the sum times direct over sum in small strain.
        single : float
            The sum.
        """
        return single if self.sum < _NONE else single * self._of(way) / self.sum

    def error(self, way: str) -> float:
        """Return a bound on how far the direct total is from ``total`` by this way, over the latter.

        Parameters
        ----------
        way : {"sum", "cascade", "persson", "corrected"}
        """
        value = self._of(way)
        if value < _NONE:
            return 0.0
        ratio = self.direct / value
        return abs(ratio - 1.0) + self.margin * ratio

    def cheapest(self, accuracy: float) -> str:
        """Return the cheapest way whose total is accurate to a relative accuracy, or "direct": a scene of all waves."""
        return next((way for way in WAYS if self.error(way) <= accuracy), "direct")

    def _of(self, way: str) -> float:
        return {"sum": self.sum, "cascade": self.cascade, "persson": self.persson, "corrected": self.direct}[way]


@lru_cache(maxsize=1024)
def estimate(
    material: Material,
    road: WaveRoad,
    velocity: float,
    pressure: float,
    height: float,
    plane: str,
    kinematics: str = "finite",
) -> Coupling:
    """Return the total friction by several ways.

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
    kinematics : {"small", "finite", "auto"}
        Of the scenes whose total is in question; what is not small has the margin of finite strain.

    Raises
    ------
    NotConverged
        As ``solve_contact`` does.
    """
    margin = _SMALL if kinematics == "small" else _FINITE + _PRESSED * (1.0 - pressed(material, pressure, plane)[0])
    layer = Layer(material, velocity, height, plane)
    sines = tuple(SineScale(float(a), float(k)) for a, k in zip(*scales(road), strict=True))
    if not sines:
        return Coupling(0.0, 0.0, 0.0, 0.0, margin)
    return Coupling(
        sum=sum(load_sine(_block(layer, sines[0], sine), sine, pressure).friction for sine in sines),
        cascade=cascade_friction(layer, sines, pressure),
        persson=float(persson_friction(material, road, velocity, pressure, height, plane).sum()),
        direct=load_road(layer, road, pressure).friction,
        margin=margin,
    )


def _block(layer: Layer, coarsest: SineScale, sine: SineScale) -> Layer:
    """Return the layer of a single scale."""
    return replace(layer, height=layer.height * sine.wavelength / coarsest.wavelength)
