"""
From rest to sliding
====================

*How far must a block slide until friction is that of steady sliding?* Pressed slowly
and then drawn, it first climbs out of the valleys, and friction swings until the
rubber has forgotten the rest: at 1 mm/s at once, at 1000 mm/s after 63 wavelengths,
since the slowest branch remembers 11 ms. The march in time shows it; the steady
solver gives its end at once.
"""

import matplotlib.pyplot as plt
import numpy as np

import rubfric

# %%
# The paper's procedure, step by step in time, from infinitely slow pressing.

campaign = rubfric.load({"kinematics": "small"})
procedure = rubfric.Procedure(
    start="relaxed",
    columns=64,
    steps_per_wavelength=48,
    wavelengths=4,
    until_saturated=False,
)
velocities = [1, 10, 100, 1000]

fig, ax = plt.subplots(figsize=(6.8, 4.2), layout="constrained")
for velocity, colour in zip(
    velocities, plt.cm.viridis(np.linspace(0, 0.85, 4)), strict=True
):
    scene = campaign.scene(1, velocity, 0.5)
    march = rubfric.march(scene, procedure)
    slid = march.records["slid"] / scene.road.wavelength
    ax.plot(
        slid, march.records["friction_contact"], color=colour, label=f"{velocity} mm/s"
    )
    ax.axhline(
        float(rubfric.simulate(scene).friction_coefficient),
        color=colour,
        ls=":",
        lw=1.2,
    )
ax.plot([], [], "k:", label="steady sliding")
ax.set(
    xlabel="distance slid over the wavelength (-)",
    ylabel="friction coefficient (-)",
    xlim=0,
)
ax.legend(ncols=2)
plt.show()
