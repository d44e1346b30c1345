"""
Read a result file
==================

*What is in a file, and how do I get at it years later?* A scene is a netCDF file by
the CF and UGRID conventions: xarray opens it, every variable has its unit and
meaning, and the attributes hold all parameters, from which the scene can be made
again.
"""

import json
from pathlib import Path
from tempfile import TemporaryDirectory

import matplotlib.pyplot as plt
import xarray as xr

import rubfric

# %%
# Write one, and open it without rubfric.

scene = rubfric.load().scene(
    scale="all", velocity=100, pressure=0.5, kinematics="small"
)
with TemporaryDirectory() as folder:
    path = Path(folder, f"{scene.name}.nc")
    rubfric.write(rubfric.simulate(scene), path)
    result = xr.load_dataset(path)

friction, error = result.friction_coefficient, result.friction_coefficient_error
print(f"{friction.long_name}: {float(friction):.4f} ± {float(error):.4f}")
print(f"{result.attrs['title']}, by {result.attrs['source']}")
again = rubfric.Scene.from_parameters(json.loads(result.attrs["scene_parameters"]))
print(f"the same scene again: {again == scene}")

# %%
# Along the surface there are pressure, gap, and the road below.

fig, (above, below) = plt.subplots(
    2, 1, figsize=(6.8, 5), sharex=True, layout="constrained"
)
above.fill_between(
    result.surface_x,
    result.road_height,
    result.road_height.min(),
    color="0.7",
    label="road",
)
above.plot(result.surface_x, result.road_height + result.gap, label="rubber")
above.set(ylabel="height (mm)", xlim=(0, float(result.surface_x[-1])))
above.legend()
below.plot(result.surface_x, result.contact_pressure)
below.set(
    xlabel="position along the road (mm)", ylabel="contact pressure (MPa)", ylim=0
)
plt.show()
