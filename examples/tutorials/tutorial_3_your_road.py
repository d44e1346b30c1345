"""
3. Your road
============

You have a profile from a laser or a stylus. This tutorial cleans it, finds the band
of wavelengths in which to believe it, and slides over the profile itself, to friction
with the error that the road leaves open.
"""

from pathlib import Path

import matplotlib.pyplot as plt
import numpy as np

import rubfric
from rubfric.profile.analysis import analyse
from rubfric.profile.cleaning import clean
from rubfric.profile.reading import read

# %%
# Read and clean
# --------------
#
# Distance and height in two columns, units from the headings. Cleaning removes plates
# at the ends, spikes, gaps and tilt, and reports each with numbers. Read this list:
# an instrument that lost a tenth of its points on the dark sides of the stones has
# measured another road. The profile of this example is synthetic, with 25 spikes and
# 60 dropouts put in.

file = Path(rubfric.__file__).parents[1] / "examples" / "own_road" / "street.csv"
cleaned = clean(read(str(file)))
for what, how_much in cleaned.removed:
    print(f"{what}: {how_much}")

# %%
# In which band to believe it
# ---------------------------
#
# The spectrum says where noise begins (short waves) and where the profile is too
# short (long ones). Friction depends on slopes, and these on the shortest waves: the
# cutoff is a choice that you make, not a detail. Waves below the trusted band are
# noise, and noise has friction, too.

found = analyse(cleaned)
shortest, longest = found.band.wavelengths
print(f"trusted from {shortest:.2g} to {longest:.2g} mm")
print(f"Hurst exponent {found.hurst.exponent:.2f} ± {found.hurst.error:.2f}")
print(f"root mean square slope {found.slope:.2f}")
print(f"mean profile depth {found.depth.mean:.2f} mm")
for warning in found.warnings():
    print(f"warning: {warning}")

# %%
# Sines, or the profile itself?
# -----------------------------
#
# The paper's route makes a few sines of a road. They keep its spectrum, and lose what
# rubber meets first: the highest summits. A block can slide over the profile itself
# instead, window by window: each window is a periodic road of as many waves as it
# has. Here are both, in one picture.

window = found.road(1, cutoff=1.0)
x = np.linspace(0, window.period, 2000)
fig, ax = plt.subplots(figsize=(7, 3.4), layout="constrained")
ax.plot(x, window.height(x), label="a window of the profile, waves of 1 mm and longer")
ax.plot(
    x, found.sines.height(x) - 3, label="four sines of the same spectrum (3 mm lower)"
)
ax.set(
    xlabel="position (mm)",
    ylabel="height (mm)",
    xlim=(0, window.period),
    ylim=(-4, 2.2),
)
ax.legend(loc="upper right")
plt.show()

# %%
# Slide over it
# -------------
#
# In a config the file is enough. With ``windows`` the whole road is the profile;
# ``whole_scenes`` are the scenes of all its windows.

road = {"profile": str(file), "windows": 6, "cutoff": 1}
grid = {"velocities": [1, 10, 100, 1000], "pressures": [0.3], "aspect": 0.75}
campaign = rubfric.load(
    {
        "road": "street",
        "roads": {"street": road},
        "grid": grid,
        "plane": "strain",
        "kinematics": "small",
    }
)
found = {
    name: rubfric.simulate(scene) for name, scene in campaign.whole_scenes().items()
}
shape = (len(campaign.whole_roads), len(campaign.velocities))
friction = np.reshape(
    [float(one.friction_coefficient) for one in found.values()], shape
)
numerical = np.reshape(
    [float(one.friction_coefficient_error) for one in found.values()], shape
).mean(axis=0)

# %%
# How sure is it?
# ---------------
#
# Every window is a fair sample of the road, and the mean over n of them has a
# standard error of s / √n. That is the error that counts: on this road it is several
# times that of the mesh. Six windows of one lane still say nothing about the next
# kilometre.

mean, road_error = (
    friction.mean(axis=0),
    friction.std(axis=0, ddof=1) / np.sqrt(len(friction)),
)
for v, value, of_mesh, of_road in zip(
    campaign.velocities, mean, numerical, road_error, strict=True
):
    parts = f"± {of_mesh:.4f} (numerical) ± {of_road:.4f} (road, standard error)"
    print(f"{v:5g} mm/s: {value:.4f} {parts}")

fig, ax = plt.subplots(figsize=(6.4, 4), layout="constrained")
ax.loglog(campaign.velocities, friction.T, color="0.75", lw=1)
ax.plot([], [], color="0.75", label="each window")
ax.errorbar(
    campaign.velocities,
    mean,
    road_error,
    fmt="o-",
    capsize=3,
    label="mean of six, error of the road",
)
ax.set(xlabel="sliding speed (mm/s)", ylabel="friction coefficient (-)")
ax.legend()
plt.show()

# %%
# The cutoff is in no error. Waves between 1 mm and the shortest to be trusted add as
# much friction again: state the cutoff with every number, as you state the load.
#
# From the shell
# --------------
#
# .. code-block:: sh
#
#    rubfric road read street.csv                   # a config, and a page on the road
#    rubfric road slide street.csv --velocity 1 10 100 --pressure 0.3 --cutoff 4 2 1
#    snakemake -j2 --configfile road_street.yaml    # a campaign
#
# A scan of a surface, rather than a line, is slid over in three dimensions
# (:doc:`/areal_road`). :doc:`/road` has the rest.
