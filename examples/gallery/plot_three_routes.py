"""
Energy as a check
=================

*How do I notice a mesh that is too coarse?* Friction follows from stress power, from
what the Maxwell elements dissipate, and from pressures on slopes. On coarse meshes
the three differ; that they meet as the mesh is refined is a check that needs no
reference. Every result carries their largest difference as ``energy_closure``.
"""

import matplotlib.pyplot as plt
import numpy as np

import rubfric

# %%
# One scene in finite strain on given meshes, without further refinement.

campaign = rubfric.load()
scene = campaign.scene(1, 100, 0.5, kinematics="finite")
columns = [48, 64, 96, 128, 192, 256, 384]


def on_mesh(count):
    """Return the result on one mesh."""
    mesh = {
        "columns_min": 8,
        "finite_columns_min": count,
        "columns_max": count,
        "refinements": 0,
    }
    numerics = rubfric.Numerics(accuracy=0.1, finite_contact_nodes=4, **mesh)
    return rubfric.simulate(
        rubfric.Scene(
            1, scene.road, 100, 0.5, material=scene.material, numerics=numerics
        )
    )


results = [on_mesh(count) for count in columns]
routes = {
    "stress power": "friction_coefficient",
    "dissipation": "friction_coefficient_dissipation",
    "pressure on slopes": "friction_coefficient_contact",
}

# %%
# The bars are the estimated errors of the first route.

fig, ax = plt.subplots(figsize=(6.4, 4), layout="constrained")
for (label, name), marker in zip(routes.items(), "os^", strict=True):
    values = np.array([float(result[name]) for result in results])
    ax.plot(columns, values, marker + "-", mfc="none", label=label)
errors = [float(result.friction_coefficient_error) for result in results]
ax.errorbar(
    columns,
    [float(result.friction_coefficient) for result in results],
    errors,
    fmt="none",
    ecolor="C0",
)
ax.set(
    xscale="log",
    xlabel="columns of cells",
    ylabel="friction coefficient (-)",
    xticks=columns,
    xticklabels=columns,
)
ax.minorticks_off()
ax.legend()
plt.show()
