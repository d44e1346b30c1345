"""
Friction falls once a texture is filled
=======================================

*Does a heavier load help?* A light load touches crests only, and more load brings
more rubber to work: friction rises. Once the rubber fills the valleys there is
nothing left to touch; the loss stays as it is while the load grows, and friction
falls with 1/p.
"""

import matplotlib.pyplot as plt
import numpy as np

import rubfric
from rubfric.mechanics.theory.layer import full_contact_friction, full_contact_pressure

# %%
# One scale in small strain, slow to fast, over the nominal pressure.

campaign = rubfric.load()
pressures = np.geomspace(0.05, 50, 22)
velocities = [1, 10, 100, 1000]


def slide(velocity, pressure):
    """Return the result on scale 1."""
    return rubfric.simulate(
        campaign.scene(1, velocity, pressure, plane="strain", kinematics="small")
    )


results = {v: [slide(v, p) for p in pressures] for v in velocities}

# %%
# Full contact has a closed form, which the simulation follows beyond the pressure at
# which it begins.

fig, (left, right) = plt.subplots(1, 2, figsize=(9, 4), layout="constrained")
for velocity, colour in zip(
    velocities, plt.cm.viridis(np.linspace(0, 0.85, 4)), strict=True
):
    scene = campaign.scene(1, velocity, 1)
    about = scene.material, scene.road, velocity
    filled = full_contact_pressure(*about, scene.height, "strain")
    left.loglog(
        pressures,
        [float(r.friction_coefficient) for r in results[velocity]],
        color=colour,
    )
    right.loglog(
        pressures,
        [float(r.contact_fraction) for r in results[velocity]],
        color=colour,
        label=f"{velocity} mm/s",
    )
    beyond = pressures[pressures > filled]
    if beyond.size:
        left.loglog(
            beyond,
            [full_contact_friction(*about, p, scene.height, "strain") for p in beyond],
            "k:",
        )
left.plot([], [], "k:", label="full contact, closed form")
left.set(xlabel="nominal pressure (MPa)", ylabel="friction coefficient (-)")
left.legend()
right.set(xlabel="nominal pressure (MPa)", ylabel="contact area over nominal area (-)")
right.legend()
plt.show()
