"""Press and slide, step by step: the procedure of Zhou, Wang and Wei (2019) on one scene, and what it yields."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from rubfric.arrays import Real
from rubfric.mechanics.block.block import Block
from rubfric.mechanics.march.saturation import Saturation, wavelength_means
from rubfric.mechanics.steady.energies import ROUND_OFF, disagreement
from rubfric.scene.procedure import PHASES, Procedure
from rubfric.scene.scene import Scene

# Surface nodes in contact at full speed, on average, below which a mesh does not see the contact that it moves.
FEWEST_NODES = 2.0
# Distance from balance at which a step in finite strain is solved, and the share of what friction varies by while a
# node is passed that its mean is good for: friction below either cannot be told from zero.
_TOLERANCE, _SHARE = 1e-6, 1e-2


@dataclass(frozen=True)
class Transient:
    """A block pressed and slid.

    Attributes
    ----------
    scene : Scene
    procedure : Procedure
    kinematics : {"small", "finite"}
    block : Block
    records : dict of ndarray, each of shape (steps,)
        By the names and in the units of ``rubfric.mechanics.march.march.Record``.
    saturation : Saturation
        Whether friction has settled, and on what.
    seconds : float
        Wall time of the steps.
    """

    scene: Scene
    procedure: Procedure
    kinematics: str
    block: Block
    records: dict[str, Real]
    saturation: Saturation
    seconds: float

    @property
    def sliding(self) -> slice:
        """The steps at full speed."""
        return slice(int(np.searchsorted(self.records["phase"], PHASES.index("slide"))), None)

    def means(self, route: str = "friction_contact") -> Real:
        """Return friction averaged over each whole wavelength at full speed, shape (wavelengths,)."""
        return wavelength_means(self.records[route][self.sliding], self.procedure.steps_per_period(self.scene.road))

    @property
    def imbalance(self) -> float:
        """The first law: sum of what is missing at full speed over the work of the road there, dimensionless."""
        missing = self.records["imbalance"][self.sliding].sum()
        return float(abs(missing) / self.records["road_work"][self.sliding].sum())

    @property
    def friction(self) -> tuple[float, float, float]:
        """Friction coefficient by contact, by the work of the road and by energy: means at full speed."""
        routes = ("friction_contact", "friction_work", "friction_energy")
        contact, work, energy = (float(self.records[route][self.sliding].mean()) for route in routes)
        return contact, work, energy

    @property
    def resolution(self) -> float:
        """Friction at full speed that the march cannot tell from zero, dimensionless."""
        variation = float(self.records["friction_contact"][self.sliding].std())
        return max(_TOLERANCE * self.scene.road.steepest_slope, _SHARE * variation, ROUND_OFF)

    @property
    def closure(self) -> float:
        """Largest relative difference of the three means, or of ``resolution`` where that is larger."""
        return disagreement(self.friction, self.resolution)

    @property
    def contact_nodes(self) -> float:
        """Surface nodes in contact at full speed, on average."""
        return float(self.records["contact_fraction"][self.sliding].mean()) * self.block.columns
