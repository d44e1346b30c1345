"""
Temperature shifts the peak
===========================

*How much does friction change from a cold morning to a hot track?* A rubber with
shift factors is the same rubber at every temperature, only slower or faster:
relaxation times are multiplied by a_T. So the curve of friction over speed moves
along the speed, by decades, and one master curve over a_T v holds for all
temperatures.
"""

import matplotlib.pyplot as plt
import numpy as np

import rubfric

# %%
# Any rubber of the config takes shift factors; here those of the
# Williams-Landel-Ferry equation.

base = rubfric.load()
rubber = {
    "youngs_modulus": 4.17,
    "poissons_ratio": 0.49,
    "shear_fractions": list(base.material.shear_fractions),
    "relaxation_times": list(base.material.relaxation_times),
    "shift": {"law": "wlf", "c1": 8.86, "c2": 101.6, "reference_temperature": 20},
}
campaign = rubfric.load(
    {"rubber": "tread", "rubbers": {"tread": rubber}, "kinematics": "small"}
)
temperatures, velocities = [-10, 0, 20, 40, 80], np.geomspace(0.1, 1e5, 19)


def friction(velocity, temperature):
    """Return the friction coefficient on scale 1."""
    scene = campaign.scene(1, velocity, 1, temperature=temperature, preset="draft")
    return float(rubfric.simulate(scene).friction_coefficient)


curves = {at: [friction(v, at) for v in velocities] for at in temperatures}

# %%
# What grips best at walking pace on a cold road need not do so at full speed on a hot
# one.

fig, (left, right) = plt.subplots(
    1, 2, figsize=(9, 4), sharey=True, layout="constrained"
)
for at, colour in zip(
    temperatures, plt.cm.plasma(np.linspace(0, 0.85, 5)), strict=True
):
    left.semilogx(velocities, curves[at], color=colour)
    right.semilogx(
        velocities * campaign.shift.factor(at),
        curves[at],
        "o",
        ms=4,
        color=colour,
        label=f"{at} °C",
    )
left.set(xlabel="sliding speed v (mm/s)", ylabel="friction coefficient (-)", ylim=0)
right.set(xlabel=r"reduced speed $a_T v$ (mm/s)")
right.legend()
plt.show()
