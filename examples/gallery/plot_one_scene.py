"""
One scene in three lines
========================

*What does rubber do on the crests of a road while it slides?* It is pressed up on the
near side of each crest and recovers too late on the far side. So it presses harder
where it comes from than where it goes, and that asymmetry is friction: 0.206 here,
known to 0.002.
"""

import matplotlib.pyplot as plt
import numpy as np

import rubfric

# %%
# The paper's rubber on the coarsest scale of its road, at 100 mm/s under 5 MPa.
# Whether that needs finite strain, and how fine a mesh, follows from the accuracy
# asked for, 1 % unless said otherwise.

campaign = rubfric.load()
scene = campaign.scene(scale=1, velocity=100, pressure=5)
result = rubfric.simulate(scene)

friction = float(result.friction_coefficient)
error = float(result.friction_coefficient_error)
print(f"friction {friction:.4f} ± {error:.4f}")
print(result.kinematics_used, "strain, since", result.kinematics_reason)

# %%
# The result is an xarray dataset with the fields at the nodes of the mesh, in the
# undeformed block, and along the surface.

x, y = (
    result.mesh_node_x + result.displacement_x,
    result.mesh_node_y + result.displacement_y,
)
cells = result.mesh_face_nodes.values
triangles = np.concatenate([cells[:, [0, 1, 2]], cells[:, [0, 2, 3]]])
wavelength = scene.road.wavelength

fig, (block, pressure) = plt.subplots(
    2, 1, figsize=(7, 5.6), height_ratios=[3, 2], sharex=True, layout="constrained"
)
for copy in (-1, 0, 1):  # the field repeats
    shift = copy * wavelength
    colours = block.tripcolor(
        x + shift,
        y,
        triangles,
        result.strain_energy_density,
        shading="gouraud",
        cmap="magma_r",
    )
    pressure.plot(result.surface_position + shift, result.local_contact_pressure, "C0")
fig.colorbar(colours, ax=block, label="strain energy density (MPa)")
along = np.linspace(-0.25, 1.25, 400) * wavelength
block.fill_between(along, scene.road.height(along), -0.025, color="0.7")
block.annotate(
    "",
    (0.6, 0.92),
    (0.4, 0.92),
    xycoords="axes fraction",
    arrowprops={"arrowstyle": "->", "lw": 1.5},
)
block.text(0.39, 0.92, "sliding", ha="right", va="center", transform=block.transAxes)
block.set(
    ylabel="height (mm)",
    aspect="equal",
    xlim=(along[0], along[-1]),
    ylim=(-0.025, 0.11),
)

pressure.axhline(scene.pressure, color="0.5", ls="--", label="nominal")
pressure.set(
    xlabel="position along the road (mm)", ylabel="contact pressure (MPa)", ylim=0
)
pressure.legend()
plt.show()
