"""
Which waves carry friction
==========================

*How fine must I measure a road?* Friction grows with every octave of wavelength that
the road keeps, since each adds as much slope again. The profile is slid over with
fewer and fewer of its fine waves: a road that was measured down to 4 mm only would
seem to have a third of the friction that it has down to 0.5 mm at 100 mm/s, and an
eighth of it at 1 mm/s.
"""

from pathlib import Path

import matplotlib.pyplot as plt
import numpy as np

import rubfric
from rubfric.profile.analysis import analyse
from rubfric.profile.cleaning import clean
from rubfric.profile.reading import read

# %%
# A window of 40 mm, cut off at ever longer waves, under a block 8 mm high.

street = Path(rubfric.__file__).parents[1] / "examples" / "own_road" / "street.csv"
found = analyse(clean(read(str(street))), cutoff=0.5)
cutoffs, velocities = [8, 4, 2, 1, 0.5], [1, 10, 100, 1000]
rubber = rubfric.load().material


def slide(velocity, cutoff):
    """Return the result on the first window."""
    road = found.road(1, cutoff)
    scene = rubfric.Scene(
        "all",
        road,
        velocity,
        0.3,
        8 / road.wavelength,
        rubber,
        "strain",
        kinematics="small",
    )
    return rubfric.simulate(scene, accuracy=0.05)


# %%
# Faster sliding excites the rubber more with coarse waves; slow sliding lives on the
# finest.

fig, ax = plt.subplots(figsize=(6.4, 4), layout="constrained")
for velocity, colour in zip(
    velocities, plt.cm.viridis(np.linspace(0, 0.85, 4)), strict=True
):
    friction = [
        float(slide(velocity, cutoff).friction_coefficient) for cutoff in cutoffs
    ]
    ax.plot(cutoffs, friction, "o-", color=colour, label=f"{velocity} mm/s")
ax.set(
    xscale="log",
    yscale="log",
    xlabel="shortest wavelength kept (mm)",
    ylabel="friction coefficient (-)",
)
ax.set(xticks=cutoffs, xticklabels=cutoffs)
ax.minorticks_off()
ax.invert_xaxis()
ax.legend()
plt.show()
