"""Solutions that were never solved: friction with a known error on every mesh, for the tests of error estimates."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from rubfric.mechanics.block.contact import Contact
from rubfric.mechanics.steady.refinement import SHORTFALL
from rubfric.mechanics.steady.resolution import Resolution
from rubfric.mechanics.steady.solution import Friction, OnMesh, SteadySolution
from rubfric.mechanics.theory.kinematics import Decision
from rubfric.rubber.pruning import Folding
from rubfric.scene.scene import Scene

FRICTION = 0.3
Law = Callable[[Resolution], Friction]


def cell_size(resolution: Resolution) -> float:
    """Return the size of the cells: what refinement in both directions divides by its factor."""
    return math.sqrt((resolution.growth - 1.0) / resolution.columns)


def power_law(constant: float, order: float, contact: float = 0.0) -> Law:
    """Return friction with a relative error constant x (size)**order, by contact another constant times that."""

    def friction(resolution: Resolution) -> Friction:
        error = constant * cell_size(resolution) ** order
        return Friction(FRICTION * (1.0 + error), FRICTION * (1.0 + contact * error))

    return friction


def on_mesh(resolution: Resolution, friction: Friction) -> OnMesh:
    return OnMesh(resolution.columns, 10, resolution.growth, 8, friction)


class Synthetic(SteadySolution):
    """A solution of nothing."""

    compression = 0.0
    pressed_energy = 0.0


def synthetic(
    scene: Scene,
    resolution: Resolution,
    friction: Friction,
    nodes: int = 8,
    decision: Decision | None = None,
    bound: float = 0.0,
    finite: bool = False,
) -> Synthetic:
    """Return a solution with so many nodes in contact."""
    columns, numerics = resolution.columns, scene.numerics
    wanted = numerics.finite_contact_nodes if finite else numerics.contact_nodes
    touching = np.arange(columns) < nodes
    return Synthetic(
        scene=scene,
        decision=decision or Decision("small", 0.0, "some reason"),
        folding=Folding(scene.material, (), (), bound),
        block=resolution.block(scene),
        friction=friction,
        contact=Contact(np.where(touching, 1.0, 0.0), np.where(touching, 0.0, 1.0), 0.0, 1),
        iterations=1,
        resolved=bool(nodes >= (1.0 - SHORTFALL) * min(wanted, columns)),
        meshes=(on_mesh(resolution, friction),),
    )


@dataclass
class Solver:
    """Solves nothing, and keeps the meshes on which it should have."""

    scene: Scene
    start: Resolution
    law: Law
    fraction: Callable[[int], float] = lambda columns: 1.0
    bound: float = 0.0
    finite: bool = False

    def __post_init__(self) -> None:
        self.seen: list[Resolution] = []

    def first(self) -> Resolution:
        return self.start

    def solve(self, resolution: Resolution) -> Synthetic:
        self.seen.append(resolution)
        nodes = max(1, round(self.fraction(resolution.columns) * resolution.columns))
        return synthetic(self.scene, resolution, self.law(resolution), nodes, bound=self.bound, finite=self.finite)
