"""
How sure is friction on a measured road?
========================================

*I measured half a metre of road: do I know its friction?* The block slides over
windows of 40 mm of the profile itself. What differs from window to window is the
road, not the mesh, and the mean over n windows is known to t s / √n. Twelve windows
leave an eighth of friction open; the mesh adds little to that.
"""

from pathlib import Path

import matplotlib.pyplot as plt
import numpy as np
from scipy.stats import t

import rubfric

# %%
# A road that was measured needs its file; ``windows`` says that the profile itself is
# slid over, down to the waves of ``cutoff`` (mm).

street = Path(rubfric.__file__).parents[1] / "examples" / "own_road" / "street.csv"
road = {"profile": str(street), "windows": 12, "cutoff": 1}
grid = {"velocities": [100], "pressures": [0.3], "aspect": 0.75}
campaign = rubfric.load(
    {
        "road": "street",
        "roads": {"street": road},
        "grid": grid,
        "plane": "strain",
        "kinematics": "small",
    }
)
results = [rubfric.simulate(scene) for scene in campaign.whole_scenes().values()]
friction = np.array([float(result.friction_coefficient) for result in results])
error = np.array([float(result.friction_coefficient_error) for result in results])

# %%
# One window may be off by 30 %; the mean settles, and its interval says how far.

count = np.arange(2, len(friction) + 1)
mean = np.array([friction[:n].mean() for n in count])
half = np.array(
    [t.ppf(0.975, n - 1) * friction[:n].std(ddof=1) / np.sqrt(n) for n in count]
)

fig, ax = plt.subplots(figsize=(6.4, 4), layout="constrained")
number = np.arange(1, len(friction) + 1)
ax.errorbar(
    number, friction, error, fmt="o", capsize=2, label="each window, error of the mesh"
)
ax.plot(count, mean, "C3", label="mean of the windows so far")
ax.fill_between(
    count, mean - half, mean + half, color="C3", alpha=0.2, label="its 95 % interval"
)
ax.set(
    xlabel="windows of the road",
    ylabel="friction coefficient (-)",
    ylim=(0, 2 * mean[-1]),
    xticks=number,
)
ax.legend()
plt.show()
