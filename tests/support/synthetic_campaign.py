"""Made-up campaigns whose friction is known in closed form."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
import xarray as xr

SPEEDS = (0.1, 1.0, 10.0, 100.0, 1000.0, 10000.0)


def make_campaign(
    scales: Sequence[int] = (1, 2, 3, 4),
    speeds: Sequence[float] = SPEEDS,
    pressures: Sequence[float] = (0.5, 1.0, 5.0),
    aspects: Sequence[float] = (0.25, 0.75, 1.5),
) -> xr.Dataset:
    """Return a campaign whose friction peaks at a known speed of the grid: mm/s, MPa."""
    axes = {"scale": list(scales), "velocity": list(speeds), "pressure": list(pressures), "aspect": list(aspects)}
    scale, speed, pressure, aspect = np.meshgrid(*axes.values(), indexing="ij")
    # The peak lies at 1000 mm/s at scale 1, at 100 mm/s at scale 2, and so on.
    distance = np.log10(speed) - (4.0 - scale)
    friction = 0.1 * scale * (1.0 + 0.1 * pressure) * np.exp(-0.3 * distance**2) * (1.0 + 0.01 / aspect)
    # 0.2 % at the slowest speed, and more the faster: 1.2 % at the last of six.
    error = friction * 0.002 * np.arange(1.0, len(speeds) + 1.0)[:, None, None]
    fields = {"friction_coefficient": friction, "friction_coefficient_error": error}
    return xr.Dataset({name: (tuple(axes), field) for name, field in fields.items()}, coords=axes)
