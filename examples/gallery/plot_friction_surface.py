"""
A friction law for a finite-element model
=========================================

*How do I use this in my tyre model?* As a table of friction over slip speed and
contact pressure, which ``rubfric export`` writes for Abaqus and Ansys. Codes
interpolate linearly in speed while friction is a curve over decades of it, so the
table gets more points than were simulated: on a monotone cubic, whose own error is
added.
"""

import matplotlib.pyplot as plt
import numpy as np

import rubfric
from rubfric.results.lookup import lookup_table

# %%
# A road of one wave, on a grid of two speeds a decade: the same table as
# ``tables/friction_total.csv`` of a campaign.

road = {"road": "fine", "roads": {"fine": [{"amplitude": 0.003, "wavelength": 0.03}]}}
campaign = rubfric.load(
    road, {"kinematics": "small", "plane": "strain", "numerics": {"preset": "draft"}}
)
totals = rubfric.friction(
    campaign, velocities=np.geomspace(0.1, 1e3, 9), pressures=[0.2, 0.5, 1, 3]
)
table = lookup_table(totals, per_decade=6)
print(
    table[
        [
            "velocity_mm_per_s",
            "pressure_MPa",
            "friction_total",
            "friction_total_error",
            "way",
        ]
    ]
    .head(8)
    .to_string()
)

# %%
# From the shell it is ``rubfric export results --to abaqus -o friction.inp``. Dots
# were simulated.

surface = table.pivot(
    index="pressure_MPa", columns="velocity_mm_per_s", values="friction_total"
)
fig, ax = plt.subplots(figsize=(6.8, 4.2), layout="constrained")
colours = ax.contourf(
    surface.columns, surface.index, surface, np.arange(0, 0.36, 0.025), cmap="viridis"
)
lines = ax.contour(
    surface.columns,
    surface.index,
    surface,
    [0.1, 0.2, 0.3],
    colors="white",
    linewidths=0.8,
)
ax.clabel(lines)
ax.plot(totals.velocity_mm_per_s, totals.pressure_MPa, "k.", ms=5, clip_on=False)
fig.colorbar(colours, ax=ax, label="friction coefficient (-)")
ax.set(
    xscale="log",
    yscale="log",
    xlabel="slip speed (mm/s)",
    ylabel="contact pressure (MPa)",
)
ax.set(yticks=[0.2, 0.5, 1, 2, 3], yticklabels=[0.2, 0.5, 1, 2, 3])
ax.minorticks_off()
plt.show()
