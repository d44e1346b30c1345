"""The mesh of one scene on the block of another that is nearly the same, so that the two can be compared.

Meshes are chosen scene by scene, and friction on two of them differs by their errors: by more than a small change of a
parameter makes. On one mesh that moves with the block these errors are nearly the same on both sides, and cancel.
"""

from __future__ import annotations

from dataclasses import dataclass

from rubfric.mechanics.block.block import Block
from rubfric.mechanics.steady.resolution import Resolution
from rubfric.scene.scene import Scene


@dataclass(frozen=True)
class SameMesh(Resolution):
    """As many columns and rows as those of a block, whatever the scene.

    Attributes
    ----------
    like : Block
        The block.
    """

    like: Block

    @classmethod
    def of(cls, like: Block, growth: float) -> SameMesh:
        """Return the mesh of a block.

        Parameters
        ----------
        like : Block
        growth : float
            Ratio of the heights of its rows.
        """
        return cls(like.columns, growth, like)

    def block(self, scene: Scene) -> Block:
        """Mesh the block of a scene: rows scale with its width, and stretch towards the top as its shape asks for.

        At the road, where the fields vary, cells keep their shape: y goes to w y + (H' - w H) (y / H)^2, with w the
        ratio of the widths, H and H' the heights.
        """
        width = scene.road.period / self.like.width
        share = self.like.row_positions / self.like.height
        rows = width * self.like.row_positions + (scene.height - width * self.like.height) * share**2
        rows[-1] = scene.height
        return Block(scene.road.period, scene.height, self.like.columns, rows, self.like.plane, self.like.dilatation)
