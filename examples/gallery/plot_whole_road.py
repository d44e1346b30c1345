"""
The whole road is not the sum of its scales
===========================================

*May I simulate wavelength by wavelength and add?* That is how the paper obtains a
total, and where rubber fills everything it is right. Elsewhere fine waves touch only
where coarse ones do, and are pressed harder there. All waves at once are one scene
like any other; the sum is up to half as much again in the middle of the speeds, and
too little where light and fast.
"""

import matplotlib.pyplot as plt
import numpy as np

import rubfric

# %%
# Each scale by itself, and all of them at once, in small strain.

campaign = rubfric.load({"plane": "strain", "kinematics": "small"})
velocities = np.geomspace(0.1, 1e4, 13)


def friction(scale, velocity, pressure):
    """Return the friction coefficient of one scale, or of all at once."""
    return float(
        rubfric.simulate(
            campaign.scene(scale, velocity, pressure, preset="draft")
        ).friction_coefficient
    )


# %%
# The sum stacks the scales, coarse to fine; the line is the whole road.

fig, panels = plt.subplots(1, 2, figsize=(9, 4), sharey=True, layout="constrained")
for ax, pressure in zip(panels, [0.5, 5], strict=True):
    parts = [
        [friction(scale, v, pressure) for v in velocities] for scale in campaign.scales
    ]
    labels = [f"wavelength {1000 * sine.wavelength:.0f} µm" for sine in campaign.road]
    ax.stackplot(
        velocities, parts, labels=labels, colors=plt.cm.Blues(np.linspace(0.7, 0.25, 4))
    )
    ax.plot(
        velocities,
        [friction("all", v, pressure) for v in velocities],
        "k-",
        lw=2,
        label="all waves at once",
    )
    ax.set(
        xscale="log",
        xlabel="sliding speed (mm/s)",
        xlim=(velocities[0], velocities[-1]),
    )
    ax.text(0.97, 0.95, f"{pressure} MPa", ha="right", va="top", transform=ax.transAxes)
panels[0].set(ylabel="friction coefficient (-)")
panels[0].legend(loc="upper left")
plt.show()
