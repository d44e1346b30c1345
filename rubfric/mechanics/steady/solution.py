"""What every way of solving a scene returns, and what it says about how it was solved."""

from __future__ import annotations

from abc import ABC, abstractmethod
from dataclasses import dataclass

import numpy as np

from rubfric.arrays import Real
from rubfric.mechanics.block.block import Block
from rubfric.mechanics.block.contact import Contact
from rubfric.mechanics.steady.energies import ROUND_OFF, disagreement
from rubfric.mechanics.steady.resolution import Resolution, count_spots, needed
from rubfric.mechanics.theory.kinematics import Decision
from rubfric.rubber.pruning import Folding, fold
from rubfric.scene.scene import Scene


@dataclass(frozen=True)
class Friction:
    """The friction coefficient on one mesh by two routes, and what the solver cannot tell from zero; dimensionless."""

    stress_power: float
    contact: float
    resolution: float = ROUND_OFF

    @property
    def disagreement(self) -> float:
        """Difference of the two over the larger one."""
        return disagreement((self.stress_power, self.contact), self.resolution)


@dataclass(frozen=True)
class OnMesh:
    """What a scene came to on one mesh.

    Attributes
    ----------
    columns, rows : int
        Cells along the road and over the height.
    growth : float
        Ratio of the heights of neighbouring rows.
    contact_nodes : int
        Surface nodes in contact.
    friction : Friction
    first_row : float
        Height of the row of cells at the road over the width of a column.
    waves : int
        How many times the finest wave of the road fits into the columns.
    spots : int
        Separate places of contact; one on a single wave.
    """

    columns: int
    rows: int
    growth: float
    contact_nodes: int
    friction: Friction
    first_row: float = 1.0
    waves: int = 1
    spots: int = 1


def fold_scene(scene: Scene, wavenumbers: Real) -> Folding:
    """Fold the branches that a scene does not need, within its accuracy.

    Parameters
    ----------
    scene : Scene
    wavenumbers : ndarray, shape (n,)
        Those that take part, 1/mm, none of them zero.
    """
    return fold(scene.material, wavenumbers * scene.velocity, scene.numerics.folding * scene.numerics.accuracy)


@dataclass(frozen=True, kw_only=True)
class SteadySolution(ABC):
    """Steady sliding in the frame of the road; what all solutions have in common.

    Attributes
    ----------
    scene : Scene
        What was solved.
    decision : Decision
        In small or finite strain, and why.
    folding : Folding
        The rubber, without the branches that the scene does not need.
    block : Block
        The mesh that the program chose.
    friction : Friction
        The friction coefficient by two routes.
    contact : Contact
        Pressure (vertical force over the width of a column as it was made) and gap at the surface nodes.
    iterations : int
        Pivoting steps of all contact solves in small strain, Newton steps in finite strain.
    krylov : int
        Applications of the tangent; zero in small strain.
    resolved : bool
        Whether the contact holds the nodes asked for (within 10 %).
    history : tuple of str
        What the solver tried, in order, and why it left it.
    meshes : tuple of OnMesh
        Every mesh that the scene was solved on, from coarse to fine; the last is ``block``.
    unsolved : int
        Columns of a finer mesh on which no solution was found; 0 where there was none.
    """

    scene: Scene
    decision: Decision
    folding: Folding
    block: Block
    friction: Friction
    contact: Contact
    iterations: int
    resolved: bool
    krylov: int = 0
    history: tuple[str, ...] = ()
    meshes: tuple[OnMesh, ...] = ()
    unsolved: int = 0

    @property
    def contact_fraction(self) -> float:
        """Contact area over nominal area, dimensionless."""
        return float(np.count_nonzero(self.contact.touching)) / self.block.columns

    def needed(self, finite: bool, share: float = 1.0) -> Resolution:
        """Return the mesh that this contact needs, or a smaller one.

        Parameters
        ----------
        finite : bool
            In finite strain.
        share : float
            Of the contact fraction.
        """
        spots = count_spots(self.scene, self.contact.touching)
        return needed(self.scene, share * self.contact_fraction, finite, spots)

    @property
    def frequencies(self) -> Real:
        """Angular frequencies n k v, rad/s, of all harmonics of the mesh but the mean, shape (columns // 2,)."""
        return self.block.wavenumbers[1:] * self.scene.velocity

    @property
    def surface_position(self) -> Real:
        """Where the surface nodes are, mm along the road, shape (columns,)."""
        return self.block.column_positions

    @property
    def surface_stretch(self) -> Real:
        """Area of the surface at its nodes, along the road and across, over that as it was made, shape (columns,)."""
        return np.ones(self.block.columns)

    @property
    @abstractmethod
    def compression(self) -> float:
        """Share of its height that the load takes from the relaxed block on a flat road, dimensionless."""

    @property
    @abstractmethod
    def pressed_energy(self) -> float:
        """Strain-energy density of the relaxed block on a flat road under the load, MPa."""
