"""One job: a scale of the road, a speed, a load, a block, a rubber, and the numerics to solve it with."""

from __future__ import annotations

import hashlib
import json
from collections.abc import Mapping
from dataclasses import asdict, dataclass, field, fields
from functools import lru_cache
from typing import Any

from rubfric import checks
from rubfric.errors import InvalidInput
from rubfric.road.sine import SineScale
from rubfric.rubber.material import PLANES, Material

KINEMATICS = ("small", "finite", "auto")
DILATATIONS = ("auto", "pointwise", "mean")
# Fewest columns in the height of a block: cells much wider than it is high would lock.
COLUMNS_PER_HEIGHT = 8
# Most columns that may be asked for.
MOST_COLUMNS = 2**20


@dataclass(frozen=True)
class Numerics:
    """How finely a scene is solved. The defaults are those of the workflow's config.

    Parameters
    ----------
    accuracy : float
        Relative accuracy of friction asked for, 1e-6 to 0.5: it decides between small and finite strain, which
        Prony branches a scene needs, and whether the first mesh suffices.
    contact_nodes, finite_contact_nodes : int
        Fewest surface nodes inside the contact on the first mesh that may suffice, 4 to 4096; the number of columns
        follows from it. In finite strain the latter.
    columns_min, finite_columns_min, columns_max : int
        Bounds on the number of columns of cells along one wavelength, multiples of 8 up to 2**20. In finite strain the
        second.
    row_growth : float
        Ratio of the heights of neighbouring rows on that mesh, away from the road, 1.00001 to 3.
    refinements : int
        Most finer meshes that may follow where the estimated error exceeds the accuracy, 0 to 12.
    first_row : float
        Height of the row at the road over the width of a column, 0.01 to 100.
    dilatation : {"auto", "pointwise", "mean"}
        How the cells integrate dilatation; see ``rubfric.mechanics.block.block.Block``.
    folding : float
        Share of the accuracy that leaving out or gathering Prony branches may use, 0 to 1; 0 keeps them all.
    tolerance : float
        Distance from balance and contact at which finite strain is solved, root mean square over the amplitude of
        the road, 1e-12 to 1e-2.
    output_columns : int
        Most columns of cells that the fields of the result file keep, a multiple of 8.
    """

    accuracy: float = 0.01
    contact_nodes: int = 32
    finite_contact_nodes: int = 16
    columns_min: int = 128
    finite_columns_min: int = 64
    columns_max: int = 32768
    row_growth: float = 1.2
    refinements: int = 3
    first_row: float = 1.0
    dilatation: str = "auto"
    folding: float = 0.01
    tolerance: float = 1e-6
    output_columns: int = 128

    def __post_init__(self) -> None:
        at, put = "numerics.", object.__setattr__
        ranges = {
            "accuracy": (1e-6, 0.5),
            "row_growth": (1.00001, 3.0),
            "first_row": (0.01, 100.0),
            "folding": (0.0, 1.0),
            "tolerance": (1e-12, 1e-2),
        }
        for name, (least, most) in ranges.items():
            put(self, name, checks.at_least(at + name, getattr(self, name), least))
            checks.at_most(at + name, getattr(self, name), most)
        counts = {"contact_nodes": (4, 4096), "finite_contact_nodes": (4, 4096), "refinements": (0, 12)}
        for name, (fewest, highest) in counts.items():
            put(self, name, checks.whole(at + name, getattr(self, name), fewest))
            checks.at_most(at + name, getattr(self, name), highest)
        for name in ("columns_min", "finite_columns_min", "columns_max", "output_columns"):
            put(self, name, checks.multiple(at + name, getattr(self, name), 8, MOST_COLUMNS))
        checks.one_of(at + "dilatation", self.dilatation, DILATATIONS)
        checks.at_least(at + "columns_max", self.columns_max, max(self.columns_min, self.finite_columns_min))


@dataclass(frozen=True)
class Scene:
    """Everything that one sliding simulation depends on; hashable, and equal to its equals.

    Parameters
    ----------
    scale : int
        Number of the scale on its road, 1 being the coarsest.
    road : SineScale
        That scale.
    velocity : float
        Sliding speed v, mm/s.
    pressure : float
        Nominal pressure p on the top of the block, MPa.
    aspect : float
        Height of the block over its width, one wavelength.
    material : Material
        The rubber.
    plane : {"stress", "strain"}
        Plane stress (the paper's CPS4R) or plane strain.
    numerics : Numerics
        Accuracy and resolution.
    kinematics : {"small", "finite", "auto"}
        Small strain, finite strain, or small strain only where that is accurate enough.
    """

    scale: int
    road: SineScale
    velocity: float
    pressure: float
    aspect: float
    material: Material
    plane: str = "stress"
    numerics: Numerics = field(default_factory=Numerics)
    kinematics: str = "auto"

    def __post_init__(self) -> None:
        put = object.__setattr__
        put(self, "scale", checks.whole("scale", self.scale, 1, 10**6))
        put(self, "velocity", checks.positive("velocity", self.velocity, "mm/s"))
        put(self, "pressure", checks.positive("pressure", self.pressure, "MPa"))
        put(self, "aspect", checks.positive("aspect", self.aspect))
        checks.one_of("plane", self.plane, PLANES)
        checks.one_of("kinematics", self.kinematics, KINEMATICS)
        flattest = COLUMNS_PER_HEIGHT / self.numerics.columns_max
        if self.aspect < flattest:
            raise InvalidInput(
                f"aspect is {self.aspect:g}, but must be at least {flattest:.3g}: so flat a block needs more columns "
                f"of cells than numerics.columns_max, {self.numerics.columns_max}"
            )

    @property
    def name(self) -> str:
        """Canonical name: ``scale1_v100_p5_aspect0.75_stress``; one scene of a rubber and a road, one name."""
        numbers = (checks.written(value) for value in (self.velocity, self.pressure, self.aspect))
        return "scale{}_v{}_p{}_aspect{}_{}".format(self.scale, *numbers, self.plane)

    @property
    def height(self) -> float:
        """H = aspect x wavelength, mm."""
        return self.aspect * self.road.wavelength

    def parameters(self) -> dict[str, Any]:
        """Return plain nested values (numbers, words, lists) that ``from_parameters`` reads back."""
        own = {each.name: getattr(self, each.name) for each in fields(self)}
        return own | {name: _copied(_plain(own[name])) for name in ("road", "material", "numerics")}

    @classmethod
    def from_parameters(cls, parameters: Mapping[str, Any]) -> Scene:
        """Build the scene that ``parameters`` describes; InvalidInput names what is wrong."""
        given = dict(_known("scene parameters", parameters, cls))
        road = SineScale(**_known("road", given.pop("road"), SineScale))
        material = Material(**_known("material", given.pop("material"), Material))
        numerics = Numerics(**_known("numerics", given.pop("numerics"), Numerics))
        return cls(road=road, material=material, numerics=numerics, **given)

    @property
    def digest(self) -> str:
        """SHA-256 of the parameters, for provenance."""
        return hashlib.sha256(json.dumps(self.parameters(), sort_keys=True).encode()).hexdigest()


@lru_cache(maxsize=256)
def _plain(part: SineScale | Material | Numerics) -> dict[str, Any]:
    """Return the plain values of what thousands of scenes share; not to be changed."""
    return json.loads(json.dumps(asdict(part)))


def _copied(plain: dict[str, Any]) -> dict[str, Any]:
    return {name: value.copy() if isinstance(value, list) else value for name, value in plain.items()}


def _known(key: str, given: Any, kind: type) -> Mapping[str, Any]:
    names = [field.name for field in fields(kind)]
    return checks.known_keys(key, given, names, names)
