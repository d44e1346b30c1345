"""
Small or finite strain
======================

*May I use linear theory?* It is ten times as fast. On the coarsest scale of the
paper's road it is within 6 % up to 0.5 MPa, an eighth of Young's modulus at rest;
under 5 MPa it misses two fifths of friction at 100 mm/s and half of it at 1 mm/s.
``kinematics: auto``, the default, takes it only where it is within the accuracy asked
for.
"""

import matplotlib.pyplot as plt
import numpy as np

import rubfric

# %%
# The same scenes twice, from the lightest to the heaviest load of the paper.

campaign = rubfric.load()
pressures = np.array([0.1, 0.2, 0.5, 1, 2, 3, 5])
velocities = [1, 100]


def friction(velocity, pressure, kinematics):
    """Return the friction coefficient on scale 1 and its error."""
    result = rubfric.simulate(
        campaign.scene(1, velocity, pressure, kinematics=kinematics, preset="draft")
    )
    return float(result.friction_coefficient), float(result.friction_coefficient_error)


found = {
    (v, kinematics): np.array([friction(v, p, kinematics) for p in pressures])
    for v in velocities
    for kinematics in ("small", "finite")
}

# %%
# The error bars are those of mesh and solver; the distance between the curves is what
# linear theory leaves out.

fig, ax = plt.subplots(figsize=(6.4, 4.2), layout="constrained")
for (velocity, kinematics), values in found.items():
    colour = "C0" if velocity == 1 else "C3"
    style = "--" if kinematics == "small" else "-"
    label = f"{kinematics} strain, {velocity} mm/s"
    ax.errorbar(
        pressures,
        values[:, 0],
        values[:, 1],
        color=colour,
        ls=style,
        capsize=2,
        label=label,
    )
ax.set(
    xscale="log",
    xlabel="nominal pressure (MPa)",
    ylabel="friction coefficient (-)",
    ylim=0,
)
ax.legend()
plt.show()
