"""
1. Reproduce the paper
======================

Zhou, Wang and Wei (*J. Eng.* 2019(23), 8986-8990) take a road apart into four sine
waves, slide a block of rubber over each, obtain friction from the energy that the
rubber dissipates, and add the four coefficients. Here you repeat that on a small grid
within Python, see what its errors cover, and put the sum to the test. At the end
stands the command that runs the whole campaign.
"""

import matplotlib.pyplot as plt
import numpy as np

import rubfric

# %%
# Rubber and road
# ---------------
#
# ``rubfric.load()`` without arguments is the paper's campaign: its Table 1 for the
# rubber, six Maxwell elements and a spring, its road of four scales, and its speeds
# (Table 2). Everything is in mm, s, N and MPa. The paper leaves some things open,
# such as the pressures: those of the campaign were chosen to run from partial to full
# contact.

campaign = rubfric.load()
print(campaign.words())
for number, sine in enumerate(campaign.road, 1):
    slope = sine.amplitude * sine.wavenumber
    print(f"scale {number}: wavelength {sine.wavelength:.3f} mm, slope {slope:.2f}")

# %%
# One scene
# ---------
#
# A scene is one scale, one speed, one load. The result is an xarray dataset. Look at
# three things first: the friction coefficient, its estimated error, and the warnings.
# The error is numerical: what the mesh, the solver and simplifications change. In 420
# scenes of the accuracy study the true error was within it in 98.8 %
# (:doc:`/accuracy`). It does not cover the model: hysteresis alone, without adhesion,
# heating or wear, and one law of finite strain.

result = rubfric.simulate(campaign.scene(scale=1, velocity=100, pressure=1))
friction, error = result.friction_coefficient, result.friction_coefficient_error
print(f"friction {float(friction):.4f} ± {float(error):.4f}")
print(f"contact on {float(result.contact_fraction):.0%} of the road")
print(f"solved in {result.kinematics_used} strain")
print(f"the three routes to friction agree within {float(result.energy_closure):.2%}")
print(f"warnings: {result.attrs['warnings'] or 'none'}")

# %%
# Friction of every scale over speed
# ----------------------------------
#
# This is Fig. 6 of the paper, at one pressure. ``preset="draft"`` asks for 5 %
# instead of 1 %, at less than half the cost; error bars are drawn, and most are
# smaller than the markers.

velocities = campaign.velocities
shape = (len(campaign.road), len(velocities))
found = [
    rubfric.simulate(campaign.scene(scale, v, 1, preset="draft"))
    for scale in campaign.scales
    for v in velocities
]
friction = np.reshape([float(one.friction_coefficient) for one in found], shape)
error = np.reshape([float(one.friction_coefficient_error) for one in found], shape)

fig, ax = plt.subplots(figsize=(6.8, 4.2), layout="constrained")
for number, sine in enumerate(campaign.road):
    label = f"scale {number + 1}, {1000 * sine.wavelength:.0f} µm"
    ax.errorbar(
        velocities,
        friction[number],
        error[number],
        fmt="o-",
        ms=4,
        capsize=2,
        label=label,
    )
ax.set(
    xscale="log",
    xlabel="sliding speed (mm/s)",
    ylabel="friction coefficient (-)",
    ylim=0,
)
ax.legend()
plt.show()

# %%
# Each scale has an interior maximum, as the paper claims (C6), and the finer the
# scale the slower it is. With seven speeds over five decades the peak is known to lie
# between two neighbours, not more; the lines between the points only guide the eye.
#
# Is the sum the friction of the road?
# ------------------------------------
#
# The paper adds the scales. Nothing in its procedure says what that costs, since the
# scales never meet. Here all of them can be slid over at once: that is a scene like
# any other. ``rubfric.friction`` gives both, with their errors: that of the sum
# includes what adding may be off by.

table = rubfric.friction(
    rubfric.load({"kinematics": "small", "multiscale": "direct"}),
    velocities=[10, 100, 1000],
    pressures=[1],
)
for row in table.itertuples():
    direct, total = row.friction_direct, row.friction_sum
    off = total / direct - 1
    print(f"{row.velocity_mm_per_s:5g} mm/s: {total:.3f} for {direct:.3f}, {off:+.0%}")

# %%
# That was small strain, to be quick. Over the paper's grid in finite strain the bare
# sum misses the whole road by 35 % at the median and by up to 75 %
# (:doc:`/multiscale`). This is the one thing to take away from a reproduction: the
# curves of the single scales hold, their sum is a model of its own.
#
# The whole campaign
# ------------------
#
# In a clone, ``make figures`` does all of this at 1 %: every scale, speed and load,
# blocks of several heights, the march in time, the whole road, a virtual test rig,
# and the verdict on each of the paper's claims. With the environment active it is
#
# .. code-block:: sh
#
#    snakemake -j2
#
# A second run does nothing, and one that was interrupted continues.
# ``results/claims.html`` says which claims hold, by which number and against which
# limit (:doc:`/claims`); ``results/explorer.html`` has every scene. The paper
# tabulates no friction, so that claims are what can be compared: shapes, peaks,
# trends. Some hold in part only: the height of the block matters at high speed (C1),
# and fast marches end before friction has saturated (C5).
