"""
4. Compare compounds
====================

Two compounds, one road: which grips more, by how much, and is that certain? The
friction of each may be known to a tenth only, and their difference much better,
because both slide over the same road. This tutorial shows why, and how not to be
fooled.
"""

from pathlib import Path

import matplotlib.pyplot as plt
import numpy as np
from scipy.stats import ttest_rel

import rubfric

# %%
# A campaign of pairs
# -------------------
#
# ``rubber`` and ``road`` take lists. The second compound here relaxes in four fifths
# of the time, as if it were some degrees warmer: a difference that a compounder would
# call small. Both slide over six windows of a measured road.

examples = Path(rubfric.__file__).parents[1] / "examples"
base = rubfric.load().material
series = {
    "youngs_modulus": 4.17,
    "poissons_ratio": 0.49,
    "shear_fractions": list(base.shear_fractions),
}
campaign = rubfric.load(
    {
        "rubber": ["tread", "faster"],
        "rubbers": {
            "tread": series | {"relaxation_times": list(base.relaxation_times)},
            "faster": series
            | {"relaxation_times": [0.8 * time for time in base.relaxation_times]},
        },
        "road": "street",
        "roads": {
            "street": {
                "profile": str(examples / "own_road" / "street.csv"),
                "windows": 6,
                "cutoff": 2,
            }
        },
        "grid": {
            "velocities": [1, 10, 100, 1000, 10000],
            "pressures": [0.3],
            "aspect": 0.75,
        },
        "plane": "strain",
        "kinematics": "small",
        "multiscale_preset": "standard",
    }
)
print(*campaign.pairs)

# %%
# Friction of each, window by window
# ----------------------------------


def slide(pair):
    """Return friction over windows and speeds, and its numerical error."""
    results = [rubfric.simulate(scene) for scene in pair.whole_scenes().values()]
    shape = (len(pair.whole_roads), len(pair.velocities))
    values = (
        [float(one[name]) for one in results]
        for name in ("friction_coefficient", "friction_coefficient_error")
    )
    return [np.reshape(one, shape) for one in values]


friction = {rubber: slide(pair) for (rubber, road), pair in campaign.pairs.items()}

# %%
# Compare means, or differences?
# ------------------------------
#
# The windows of a road scatter: a rough one has more friction for *every* rubber. So
# the means of the two compounds have wide intervals that overlap everywhere, and one
# would conclude nothing. In the difference within each window the road drops out.
# That is the paired t-test; only its interval answers the question.

(one, one_error), (other, other_error) = friction["tread"], friction["faster"]
difference = one - other
test = ttest_rel(one, other, axis=0)
interval = test.confidence_interval(0.95)
for v, value, low, high in zip(
    campaign.velocities, difference.mean(axis=0), *interval, strict=True
):
    verdict = (
        "tread grips more"
        if low > 0
        else "faster grips more"
        if high < 0
        else "cannot be told apart"
    )
    print(
        f"{v:5g} mm/s: {value:+.4f}, 95 % interval {low:+.4f} to {high:+.4f}: {verdict}"
    )

fig, (above, below) = plt.subplots(
    2, 1, figsize=(6.4, 5.6), sharex=True, layout="constrained"
)
for (rubber, (values, _)), colour, shift in zip(
    friction.items(), ("C0", "C1"), (0.95, 1.05), strict=True
):
    half = (
        2.571 * values.std(axis=0, ddof=1) / np.sqrt(len(values))
    )  # Student's t, five degrees of freedom
    place = shift * np.array(campaign.velocities)
    above.errorbar(
        place, values.mean(axis=0), half, fmt="o", color=colour, capsize=3, label=rubber
    )
above.set(xscale="log", ylabel="friction coefficient (-)", ylim=0)
above.legend()
below.semilogx(campaign.velocities, difference.T, ".", color="0.7")
middle = difference.mean(axis=0)
below.errorbar(
    campaign.velocities,
    middle,
    [middle - interval.low, interval.high - middle],
    fmt="o",
    color="C2",
    capsize=3,
)
below.axhline(0, color="k", lw=0.8)
below.set(xlabel="sliding speed (mm/s)", ylabel="tread less faster (-)")
plt.show()

# %%
# The other parts of the error
# ----------------------------
#
# The interval above is of the road alone. The numerical errors of both compounds are
# to be added in squares; one rule makes both meshes, so that this says too much
# rather than too little. Where the data of a rubber were measured their bands are
# added, too. The workflow does all of that, and writes sentences:
#
# .. code-block:: sh
#
#    snakemake -j2 --configfile examples/own_road/compare.yaml
#
# ``results/compare/tables/ranking.html`` then says, point by point, *tread grips more
# than faster on street at 100 mm/s and 0.3 MPa, by 0.0035 ± 0.0009*, or that they
# cannot be told apart.

numerical = np.hypot(one_error, other_error).mean(axis=0)
half = (interval.high - interval.low) / 2
for v, of_road, of_mesh in zip(campaign.velocities, half, numerical, strict=True):
    print(
        f"{v:5g} mm/s: ± {of_road:.4f} from the road, ± {of_mesh:.4f} from the meshes"
    )

# %%
# How not to be fooled
# --------------------
#
# Of a hundred comparisons of *equal* compounds five find a difference at 95 %. Trust
# a ranking that holds over neighbouring speeds and loads, not the one point of a
# large table that suits. And a ranking belongs to its speeds, its temperature and its
# cutoff: at another speed the order may be the opposite (see the two compounds of the
# gallery). :doc:`/comparison` has the statistics.
