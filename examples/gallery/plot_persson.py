"""
Persson's theory against the block
==================================

*When is the closed form enough?* Persson's theory costs microseconds. Where rubber is
soft, slow and well pressed it is within a few per cent: at 5 MPa, up to 50 mm/s.
Where it is stiff and touches lightly, the theory counts many fine waves in a patch
that is in truth a single tip, and gives up to four times the friction.
"""

import matplotlib.pyplot as plt
import numpy as np

import rubfric
from rubfric.mechanics.theory.persson import persson_friction

# %%
# The whole road of the paper, slow to fast, lightly and heavily loaded; both in small
# strain.

campaign = rubfric.load({"plane": "strain", "kinematics": "small"})
velocities = np.geomspace(0.1, 1e4, 16)
fine = np.geomspace(0.1, 1e4, 100)

fig, ax = plt.subplots(figsize=(6.4, 4.2), layout="constrained")
for pressure, colour in ((0.5, "C0"), (5, "C3")):
    scenes = [campaign.scene("all", v, pressure, preset="draft") for v in velocities]
    block = [float(rubfric.simulate(scene).friction_coefficient) for scene in scenes]
    about = campaign.material, campaign.whole_road
    theory = [
        persson_friction(*about, v, pressure, scenes[0].height, "strain").sum()
        for v in fine
    ]
    ax.plot(velocities, block, "o-", color=colour, label=f"block, {pressure} MPa")
    ax.plot(fine, theory, "--", color=colour, label=f"Persson 2001, {pressure} MPa")
ax.set(
    xscale="log",
    xlabel="sliding speed (mm/s)",
    ylabel="friction coefficient (-)",
    ylim=0,
)
ax.legend()
plt.show()
