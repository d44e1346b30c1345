"""
Why friction has a peak over speed
==================================

*At which speed does a compound grip best on a texture?* Each wave of the road strokes
the rubber at the frequency k v, so that friction follows the loss of the rubber at
that frequency, and the finer the wave, the slower its peak. Drawn over the frequency,
the four scales of a road nearly share one curve. Its peak comes before that of tan δ:
rubber that stiffens rides on the crests, and touches less.
"""

import matplotlib.pyplot as plt
import numpy as np

import rubfric

# %%
# Friction of each scale by itself over eight decades of speed.

campaign = rubfric.load()
velocities = np.geomspace(1e-2, 1e6, 25)


def friction(scale, velocity):
    """Return the friction coefficient."""
    scene = campaign.scene(scale, velocity, 1, kinematics="small", preset="draft")
    return float(rubfric.simulate(scene).friction_coefficient)


curves = {scale: [friction(scale, v) for v in velocities] for scale in campaign.scales}

# %%
# Beside it the loss factor tan delta of the rubber, and friction over the frequency
# that a scale excites.

frequency = np.geomspace(1e-1, 1e9, 200)
modulus = campaign.material.complex_shear_modulus(frequency)

fig, (left, right) = plt.subplots(
    1, 2, figsize=(9, 4), sharey=True, layout="constrained"
)
for scale, values in curves.items():
    sine = campaign.road[scale - 1]
    left.semilogx(
        velocities, values, label=f"wavelength {1000 * sine.wavelength:.0f} µm"
    )
    right.semilogx(sine.wavenumber * velocities, values)
left.set(
    xlabel="sliding speed v (mm/s)", ylabel="friction coefficient (-)", ylim=(0, 0.4)
)
left.legend()
right.set(xlabel="frequency k v (rad/s)")
loss = right.twinx()
loss.semilogx(
    frequency, modulus.imag / modulus.real, "k--", label="loss factor of the rubber"
)
loss.set(ylabel="tan δ (-)", ylim=(0, 2.8))
loss.legend(loc="upper right")
plt.show()
