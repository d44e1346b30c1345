"""What a config says of the test rig: measured runs, or a virtual rig."""

from __future__ import annotations

from typing import Annotated

from rubfric.config.entries import Entry, grid_values
from rubfric.config.place import Place
from rubfric.rules import Choice, Integer, Items, Number

# Where the sensor of traction sits.
TRACTIONS = ("rubber", "rope")


class VirtualRig(Entry):
    """Virtual rig, whose weights the program chooses so that speeds span what was simulated."""

    area: Annotated[float, Number("Nominal area of the rubber.", "mm²")] = 100.0
    traction: Annotated[
        str,
        Choice(
            "Where the sensor of traction sits, at the rubber or in the rope, where it also reads the drag of the "
            "bearings and what accelerates the sled.",
            TRACTIONS,
        ),
    ] = "rubber"
    sled_mass: Annotated[float, Number("Mass of the sled with the road.", "kg")] = 5.0
    heaviest_weight: Annotated[float, Number("Heaviest weight that may hang from the rope.", "kg")] = 100.0
    travel: Annotated[float, Number("Travel of the sled.", "mm")] = 300.0
    bearing_force: Annotated[float, Number("Drag of the bearings without a load.", "N", low=0.0)] = 0.5
    bearing_coefficient: Annotated[float, Number("Drag of the bearings per normal force.", low=0.0)] = 0.005
    force_noise: Annotated[float, Number("Standard deviation of the noise of both forces.", "N", low=0.0)] = 0.2
    displacement_noise: Annotated[
        float, Number("Standard deviation of the noise of the displacement.", "mm", low=0.0)
    ] = 0.002
    displacement_step: Annotated[
        float, Number("Step of the readings of the displacement; 0 for none.", "mm", low=0.0)
    ] = 0.005
    sampling: Annotated[
        float, Number("Samples per second; slow runs are sampled more slowly.", "Hz", low=100.0, high=1e6)
    ] = 5000.0
    seed: Annotated[int, Integer("Seed of the noise.", 0, 2**31)] = 2019


class RigChoice(Entry):
    """Test rig of Figs 8 and 9, measured or virtual."""

    data: Annotated[
        tuple[str, ...],
        Items(
            "Files of measured runs, CSV tables of time, normal force, traction and displacement; while there are "
            "none, a virtual rig measures what was simulated.",
            Place(),
            least=0,
            ascending=False,
        ),
    ] = ()
    columns: Annotated[
        str | None,
        Place(
            "YAML file that names their columns and the area of the rubber, see docs/rig.md; null where there is none.",
            optional=True,
        ),
    ] = None
    pressures: Annotated[
        tuple[float, ...], grid_values("Nominal pressures at which Fig. 9 shows friction over speed.", "MPa")
    ] = ()
    speeds: Annotated[
        tuple[float, ...], grid_values("Speeds at which Fig. 9 shows friction over pressure.", "mm/s")
    ] = ()
    virtual: VirtualRig = VirtualRig()
