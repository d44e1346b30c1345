"""
How far to trust the error
==========================

*A friction coefficient comes with an error: is it true?* Scenes at random, solved
with each of the presets ``draft``, ``standard`` and ``reference`` (5, 1 and 0.2 %),
are compared with solutions of an accuracy of 0.02 %. A point below the line is an
error that its estimate covers; an estimate some times too large is the price of one
that rarely is too small.
"""

import matplotlib.pyplot as plt
import numpy as np

import rubfric

# %%
# Any scale, speed and load of the paper, in small strain; the study of accuracy does
# the same in finite strain, with other rubbers too.

campaign = rubfric.load({"kinematics": "small"})
random = np.random.default_rng(1)
points = [
    (
        random.integers(1, 5),
        10 ** random.uniform(-1, 3),
        10 ** random.uniform(-0.7, 0.7),
    )
    for _ in range(15)
]


def solve(preset, accuracy=None):
    """Return friction coefficients and their estimated errors."""
    scenes = [
        campaign.scene(int(scale), v, p, preset=preset, accuracy=accuracy)
        for scale, v, p in points
    ]
    results = [rubfric.simulate(scene) for scene in scenes]
    return np.array(
        [
            (float(r.friction_coefficient), float(r.friction_coefficient_error))
            for r in results
        ]
    ).T


truth, _ = solve("reference", accuracy=0.0002)

# %%
# Both errors relative to friction; dotted lines are the accuracies asked for.

fig, ax = plt.subplots(figsize=(6, 4.6), layout="constrained")
for preset, marker in zip(("draft", "standard", "reference"), "^so", strict=True):
    friction, estimate = solve(preset)
    ax.loglog(estimate / truth, abs(friction / truth - 1), marker, label=preset)
    ax.axvline(campaign.presets[preset].accuracy, color="0.7", lw=0.8, ls=":")
ax.loglog([1e-4, 0.1], [1e-4, 0.1], "k--", lw=1, label="true error = estimate")
ax.set(xlabel="estimated error (relative)", ylabel="true error (relative)")
ax.legend()
plt.show()
