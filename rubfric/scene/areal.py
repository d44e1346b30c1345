"""One job on an areal road: the road, a speed and its direction, a load, a block, a rubber, and its numerics."""

from __future__ import annotations

import hashlib
import json
import math
from collections.abc import Mapping
from dataclasses import asdict, dataclass, field
from typing import Annotated, Any

from rubfric import checks
from rubfric.errors import InvalidInput
from rubfric.road.areal import ArealRoad
from rubfric.road.areal_waves import ArealWaves
from rubfric.road.self_affine import SelfAffine
from rubfric.rubber.material import Material
from rubfric.rubber.shift import degrees
from rubfric.rules import Integer, Number, check_fields
from rubfric.scene.scene import ASPECT

# Fewest nodes along the shortest wave.
NODES_PER_WAVE = 4
# Roads that their parameters hold.
_ROADS: dict[str, type[SelfAffine | ArealWaves]] = {"self_affine": SelfAffine, "waves": ArealWaves}


@dataclass(frozen=True)
class ArealNumerics:
    """How finely a scene on an areal road is solved: meaning, bounds and default of each field are beside it.

    Raises
    ------
    InvalidInput
        For any value outside these bounds.

    Examples
    --------
    >>> import rubfric
    >>> rubfric.ArealNumerics(accuracy=0.05, nodes_max=512)
    ArealNumerics(accuracy=0.05, nodes_per_wave=8, nodes_max=512)
    """

    accuracy: Annotated[
        float, Number("Relative accuracy of friction, for which nodes are doubled.", low=1e-4, high=0.5)
    ] = 0.02
    nodes_per_wave: Annotated[
        int, Integer("Nodes along the shortest wave on the first nodes that may suffice.", NODES_PER_WAVE, 256)
    ] = 8
    nodes_max: Annotated[
        int, Integer("Most nodes along the longer period; a result that needs more says so.", 16, 8192, step=16)
    ] = 1024

    def __post_init__(self) -> None:
        check_fields(self, "numerics.")


@dataclass(frozen=True)
class ArealScene:
    """Everything that one simulation of steady sliding over an areal road depends on, in small strain.

    Parameters
    ----------
    road : ArealRoad
        The block is one period of it long and wide.
    velocity : float
        Sliding speed v, mm/s.
    pressure : float
        Nominal pressure p on the top of the block, MPa.
    material : Material
        The rubber.
    direction : float
        In which the rubber meets the road: slopes along it resist. Degrees from x towards y.
    aspect : float
        Height of the block over the longest wavelength of the road.
    numerics : ArealNumerics
        Accuracy and resolution.
    temperature : float, optional
        Of the rubber, degC; ``material`` is the rubber at it. None for a rubber that is known at one temperature only.

    Examples
    --------
    >>> import rubfric
    >>> road = rubfric.ArealWaves([0.01, 0.01], [10, 10], [0, 90], [0, 0])
    >>> scene = rubfric.ArealScene(road, velocity=100, pressure=0.3, material=rubfric.load().material, direction=45)
    >>> scene.name
    'areal_v100_p0.3_direction45_aspect0.75'
    """

    road: ArealRoad
    velocity: Annotated[float, Number(unit="mm/s")]
    pressure: Annotated[float, Number(unit="MPa")]
    material: Material
    direction: Annotated[float, Number(unit="degrees", low=-360.0, high=360.0)] = 0.0
    aspect: Annotated[float, Number(low=0.01, high=1e6)] = ASPECT
    numerics: ArealNumerics = field(default_factory=ArealNumerics)
    temperature: Annotated[float | None, degrees()] = None

    def __post_init__(self) -> None:
        check_fields(self)

    def __repr__(self) -> str:
        warm = "" if self.temperature is None else f", {self.temperature:g} degC"
        return (
            f"<ArealScene: {self.velocity:g} mm/s, {self.pressure:g} MPa{warm}, rubber {self.material.name}, "
            f"{self.direction:g} degrees, friction to {100.0 * self.numerics.accuracy:g} %, {self.road!r}>"
        )

    @property
    def wavelength(self) -> float:
        """Longest wavelength of the road, mm; of a flat one its longer period."""
        spectrum = self.road.spectrum
        return 2.0 * math.pi / spectrum.wavenumbers.min() if len(spectrum.amplitudes) else max(spectrum.periods)

    @property
    def height(self) -> float:
        """H = aspect x wavelength, mm."""
        return self.aspect * self.wavelength

    def parameters(self) -> dict[str, Any]:
        """Return plain nested values: numbers, words, lists."""
        numbers = {name: getattr(self, name) for name in ("velocity", "pressure", "direction", "aspect")}
        numbers |= {} if self.temperature is None else {"temperature": self.temperature}
        parts = {"road": self.road.parameters(), "material": asdict(self.material), "numerics": asdict(self.numerics)}
        plain: dict[str, Any] = json.loads(json.dumps(numbers | parts))
        return plain

    @classmethod
    def from_parameters(cls, parameters: Mapping[str, Any], road: ArealRoad | None = None) -> ArealScene:
        """Build the scene that ``parameters`` describes.

        Parameters
        ----------
        parameters : mapping
            As the method ``parameters`` gives them.
        road : ArealRoad, optional
            A road that they do not hold, but name by a digest: a scan.

        Raises
        ------
        InvalidInput
            For a scan that is not given, or is another one.
        """
        given = dict(parameters)
        held = dict(given.pop("road"))
        kind = held["kind"]
        if road is None and kind not in _ROADS:
            raise InvalidInput(f"the road of the parameters is a {kind}, but must be one of {', '.join(_ROADS)}")
        if road is not None and json.loads(json.dumps(road.parameters())) != held:
            raise InvalidInput("the areal scan is another than the scene was planned for: run again")
        material, numerics = Material(**given.pop("material")), ArealNumerics(**given.pop("numerics"))
        road = road or _ROADS[held.pop("kind")](**held)
        return cls(road=road, material=material, numerics=numerics, **given)

    @property
    def digest(self) -> str:
        """SHA-256 of the parameters, for provenance."""
        return hashlib.sha256(json.dumps(self.parameters(), sort_keys=True).encode()).hexdigest()

    def digest_of_profiles(self, count: int) -> str:
        """Return what friction on so many profiles of the road, in the plane model, is known by."""
        return hashlib.sha256(f"{count} profiles of {self.digest}".encode()).hexdigest()

    @property
    def name(self) -> str:
        """``areal_v100_p0.3_aspect0.75``, with ``_T20`` for a temperature and a direction other than x."""
        velocity, pressure, aspect = (checks.written(value) for value in (self.velocity, self.pressure, self.aspect))
        warm = "" if self.temperature is None else f"_T{checks.written(self.temperature)}"
        turned = f"_direction{checks.written(self.direction)}" if self.direction else ""
        return f"areal_v{velocity}_p{pressure}{warm}{turned}_aspect{aspect}"
