"""
Where rubber touches a road
===========================

*How large is the real contact, and how high the pressure in it?* On a road that is a
surface, not a set of ridges, rubber closes around summits. Ten times the load makes
more and larger spots, but hardly raises the mean pressure in them: from 2.2 to 2.4
MPa.
"""

import matplotlib.pyplot as plt

import rubfric

# %%
# A self-affine road, 1 mm by 1 mm, with waves down to 0.05 mm, solved in three
# dimensions in small strain.

rubber = rubfric.load().material
road = rubfric.SelfAffine(hurst=0.8, period=1.0, cut_off=0.05, rms_slope=0.25, seed=1)
numerics = rubfric.ArealNumerics(accuracy=0.05)
results = {
    pressure: rubfric.simulate_areal(
        rubfric.ArealScene(road, 100.0, pressure, rubber, numerics=numerics)
    )
    for pressure in (0.1, 1.0)
}

# %%
# The friction coefficient comes with its error, and with friction by wavelength; here
# the map of the pressure.

fig, panels = plt.subplots(1, 2, figsize=(9, 4.2), sharey=True, layout="constrained")
highest = max(float(result.contact_pressure.max()) for result in results.values())
for ax, (pressure, result) in zip(panels, results.items(), strict=True):
    touching = result.contact_pressure.where(result.contact_pressure > 0)
    ax.pcolormesh(
        result.x,
        result.y,
        result.road_height,
        cmap="gray",
        vmin=3 * float(result.road_height.min()),
    )
    colours = ax.pcolormesh(
        result.x, result.y, touching, cmap="inferno_r", vmin=0, vmax=highest
    )
    friction, error = float(result.friction_coefficient), float(result.friction_error)
    contact = 100 * float(result.contact_fraction)
    ax.set(aspect="equal", xlabel="x (mm)")
    ax.set_title(
        f"{pressure:g} MPa: μ = {friction:.3f} ± {error:.3f}, contact {contact:.1f} %",
        fontsize="medium",
    )
panels[0].set(ylabel="y (mm)")
fig.colorbar(colours, ax=panels, label="contact pressure (MPa)")
plt.show()
