"""
Validation: contact on a wavy road
==================================

*Does the solver reproduce what is known exactly?* An elastic half-space on a sine has
a closed form (Westergaard 1939): the share of the road that it touches is 2/π arcsin
√(p/p*), with p* the pressure that closes the gap. A tall elastic block follows it
from light contact to full contact.
"""

import matplotlib.pyplot as plt
import numpy as np

import rubfric
from rubfric.mechanics.theory.layer import full_contact_pressure

# %%
# Rubber that hardly relaxes, on a flat sine, in a block twice as high as a
# wavelength.

rubber = rubfric.Material(
    "elastic", 4.0, 0.49, shear_fractions=(1e-3,), relaxation_times=(1e-3,)
)
road = rubfric.SineScale(amplitude=0.001, wavenumber=10)
height = 2 * road.wavelength
filled = full_contact_pressure(rubber, road, 1, height, "strain")
ratios = np.array([0.02, 0.05, 0.1, 0.2, 0.3, 0.4, 0.5, 0.6, 0.7, 0.8, 0.9, 0.97])


def touched(ratio, columns):
    """Return the contact fraction on so many columns of cells."""
    numerics = rubfric.Numerics(accuracy=0.1, columns_min=columns, columns_max=columns)
    scene = rubfric.Scene(
        1, road, 1, ratio * filled, 2.0, rubber, "strain", numerics, kinematics="small"
    )
    return float(rubfric.simulate(scene).contact_fraction)


# %%
# What is left is the width of a cell: contact is counted by nodes.

exact = 2 / np.pi * np.arcsin(np.sqrt(ratios))
fig, (above, below) = plt.subplots(
    2, 1, figsize=(6.4, 5.4), height_ratios=[3, 2], sharex=True, layout="constrained"
)
fine = np.linspace(0, 1, 200)
above.plot(fine, 2 / np.pi * np.arcsin(np.sqrt(fine)), "k-", label="Westergaard 1939")
for columns, marker in ((256, "s"), (1024, "o")):
    found = np.array([touched(ratio, columns) for ratio in ratios])
    above.plot(ratios, found, marker, mfc="none", label=f"block, {columns} columns")
    below.plot(ratios, found - exact, marker, mfc="none")
above.set(ylabel="contact area over nominal area (-)")
above.legend()
below.axhline(0, color="k", lw=0.8)
below.set(
    xlabel="pressure over that of full contact, p / p* (-)", ylabel="difference (-)"
)
plt.show()
