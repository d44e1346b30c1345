"""
Two compounds on one road
=========================

*Which compound grips more, and is the difference more than the error?* A winter
compound relaxes faster, here ten times. Slow sliding belongs to the summer compound,
fast sliding to the winter one, and they change places between 100 and 200 mm/s; at
every speed drawn the difference is larger than its error.
"""

import matplotlib.pyplot as plt
import numpy as np

import rubfric

# %%
# Several rubbers in one config make a campaign of pairs. All waves of the road are
# slid over at once, in small strain.

summer = {
    "youngs_modulus": 4.17,
    "poissons_ratio": 0.49,
    "shear_fractions": [
        0.000592717,
        0.002536278,
        0.024459921,
        0.17432432,
        0.387971288,
        0.408678482,
    ],
    "relaxation_times": [0.01134034, 0.0002628, 1.316e-5, 1.295e-6, 7.708e-8, 4.2e-10],
}
winter = summer | {
    "relaxation_times": [0.1 * time for time in summer["relaxation_times"]]
}
campaign = rubfric.load(
    {"rubber": ["summer", "winter"], "rubbers": {"summer": summer, "winter": winter}}
)
velocities = np.geomspace(0.1, 1e4, 16)


def slide(pair, velocity):
    """Return friction of the whole road and its estimated error."""
    scene = pair.scene(
        "all", velocity, 1, plane="strain", kinematics="small", preset="draft"
    )
    result = rubfric.simulate(scene)
    return float(result.friction_coefficient), float(result.friction_coefficient_error)


found = {
    rubber: np.array([slide(pair, v) for v in velocities]).T
    for (rubber, road), pair in campaign.pairs.items()
}

# %%
# Bands are errors of the mesh, at 5 % accuracy (``preset="draft"``); a finer preset
# narrows them.

fig, (above, below) = plt.subplots(
    2, 1, figsize=(6.4, 5.4), height_ratios=[3, 2], sharex=True, layout="constrained"
)
for rubber, (friction, error) in found.items():
    above.plot(velocities, friction, label=rubber)
    above.fill_between(velocities, friction - error, friction + error, alpha=0.3)
above.set(xscale="log", ylabel="friction coefficient (-)", ylim=0)
above.legend()
difference = found["summer"][0] - found["winter"][0]
below.errorbar(
    velocities,
    difference,
    np.hypot(found["summer"][1], found["winter"][1]),
    fmt="o-",
    color="C2",
    capsize=2,
)
below.axhline(0, color="0.5", lw=0.8)
below.set(xlabel="sliding speed (mm/s)", ylabel="summer less winter (-)")
plt.show()
